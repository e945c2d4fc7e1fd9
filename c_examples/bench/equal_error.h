/* How long each way to have scratches takes until its picture is right to 1 %. */
#ifndef BENCH_EQUAL_ERROR_H
#define BENCH_EQUAL_ERROR_H
#include "figures.h"

/* Prints the table, also to FOLDER/equal-error.txt, notes its figures, and draws the curves: FOLDER/equal-error.svg. False, with
   a reason on stderr, where it cannot be done. */
bool equal_error_run(Figures *figures, const char *folder);
#endif
