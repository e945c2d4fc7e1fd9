/* The library's pictures beside those of each judge. */
#ifndef COMPARE_JUDGES_H
#define COMPARE_JUDGES_H
#include "report.h"
#include "truth.h"

/* A plate from one distance, with its relief in full. */
typedef struct Bench {
    const Sight *sight;
    const Truth *truth;
    int distance, threads;
} Bench;

/* Brute force by so many samples per pixel. */
bool judge_by_force(Report *report, const Bench *bench, uint32_t samples);

/* POV-Ray, of matte plates near by: its own finishes take the place of the plate's for the second half. */
bool judge_by_povray(Report *report, const Bench *bench);
#endif
