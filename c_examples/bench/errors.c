#include "errors.h"

#include <math.h>

/* The mean of the products of two pictures' differences from a third. */
static double products(const Film *a, const Film *b, const Film *truth, double *mean) {
    const size_t pixels = (size_t)truth->width * (size_t)truth->height;
    double sum = 0.0;
    *mean = 0.0;
    for (size_t i = 0; i < pixels; i++) {
        for (int c = 0; c < 3; c++) {
            const double right = (double)truth->rgb[i][c];
            sum += ((double)a->rgb[i][c] - right) * ((double)b->rgb[i][c] - right);
            *mean += right;
        }
    }
    *mean /= 3.0 * (double)pixels;
    return sum / (3.0 * (double)pixels);
}

double relative_rms(const Film *film, const Film *truth) {
    double mean;
    return sqrt(products(film, film, truth, &mean)) / mean;
}

double relative_bias(const Film *a, const Film *b, const Film *truth) {
    double mean;
    const double square = products(a, b, truth, &mean);
    return copysign(sqrt(fabs(square)), square) / mean;
}
