/* How far one filtered sample per pixel is from the mean of 256. */
#ifndef RENDERER_CHECK_H
#define RENDERER_CHECK_H
#include "shade.h"

typedef struct CheckResult {
    size_t pixels;        /* compared: those that show the judged face only */
    double mean_radiance; /* of the 256-sample picture over those pixels and the three channels */
    double rms;           /* root mean square difference, relative to the mean radiance */
    double worst;         /* largest difference of a channel of a pixel, likewise */
} CheckResult;

/* Compares every `stride`-th pixel of each row, the columns shifting from row to row. */
CheckResult check_view(const Stage *stage, int width, int height, int stride, int threads);
#endif
