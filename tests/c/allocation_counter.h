/* Counts this thread's calls of the allocator. Linked into a program, it stands in for malloc and its kin, also
   for the shared libraries that the program uses. */
#ifndef TESTS_ALLOCATION_COUNTER_H
#define TESTS_ALLOCATION_COUNTER_H
#include <stddef.h>

/* Starts at zero; frees count too, since giving memory back takes the same locks. */
void allocation_counter_start(void);
size_t allocation_counter_stop(void);
#endif
