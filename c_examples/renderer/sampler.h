/* Numbers that fill the unit square evenly, by counting: pixel, sample and dimension say all, so that a picture is the same
   however its tiles are shared out. Sobol's first two dimensions, scrambled by hashing as Owen does: B. Burley, Practical
   Hash-based Owen Scrambling, JCGT 9(4), 2020. */
#ifndef RENDERER_SAMPLER_H
#define RENDERER_SAMPLER_H
#include <stdint.h>

typedef struct Sampler {
    uint32_t pixel;     /* a hash of it */
    uint32_t index;     /* the sample's number within the pixel */
    uint32_t dimension; /* how many pairs were taken so far */
} Sampler;

Sampler sampler_start(int x, int y, uint32_t index);

/* The next pair, each in [0,1). Of samples 0 to 2^k - 1 of a pixel, the same pair is well spread in both together. */
void sampler_next(Sampler *sampler, double u[2]);
#endif
