/* Figures of all benches in one file: a flat JSON object of numbers. */
#ifndef BENCH_FIGURES_H
#define BENCH_FIGURES_H
#include <stdbool.h>

enum { FIGURES_MAX = 512 };

typedef struct Figure {
    char name[64];
    double value;
} Figure;

typedef struct Figures {
    Figure all[FIGURES_MAX];
    int count;
} Figures;

/* Sets one; where there is no room it is left out. */
void figures_set(Figures *figures, const char *name, double value);

/* Adds them to what a file holds, of which other names stay as they are. False, with a reason on stderr, where it cannot be. */
bool figures_merge(const Figures *figures, const char *path);

/* What the measurements ran on: the processor, and how many of its cores. */
void machine_name(char *name, int size);
#endif
