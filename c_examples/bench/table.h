/* A table for people: on the screen as it grows, and as a file of its own. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H
#include <stdbool.h>
#include <stdio.h>

typedef struct Table {
    FILE *file;
} Table;

/* FOLDER/NAME.txt, with what it is measured on as its first line. False, with a reason on stderr, where it cannot be. */
bool table_open(Table *table, const char *folder, const char *name);
bool table_close(Table *table);

#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
void table_say(const Table *table, const char *format, ...);
#endif
