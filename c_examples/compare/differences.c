#include "differences.h"

#include <math.h>

Difference difference(const Film *a, const Film *b) {
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    Difference sums = {0};
    for (size_t i = 0; i < pixels; i++) {
        for (int c = 0; c < 3; c++) {
            const double apart = (double)a->rgb[i][c] - (double)b->rgb[i][c];
            sums.mean += (double)b->rgb[i][c];
            sums.mean_absolute += fabs(apart);
            sums.signed_mean += apart;
            sums.worst = fmax(sums.worst, fabs(apart));
        }
    }
    const double count = 3.0 * (double)pixels, mean = sums.mean / count;
    return (Difference){.mean = mean,
                        .mean_absolute = sums.mean_absolute / count / mean,
                        .signed_mean = sums.signed_mean / count / mean,
                        .worst = sums.worst / mean};
}

bool film_mean(const Film *a, const Film *b, Film *mean) {
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    if (!film_init(mean, a->width, a->height)) return false;
    for (size_t i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++) mean->rgb[i][c] = 0.5f * (a->rgb[i][c] + b->rgb[i][c]);
    return true;
}
