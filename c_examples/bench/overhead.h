/* Table 1 again: what scratches add to the time of a render. */
#ifndef BENCH_OVERHEAD_H
#define BENCH_OVERHEAD_H
#include "figures.h"

/* Prints the table, also to FOLDER/overhead.txt, and notes its figures; false, with a reason on stderr, where it cannot be done. */
bool overhead_run(Figures *figures, const char *folder);
#endif
