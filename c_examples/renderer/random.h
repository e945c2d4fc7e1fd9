/* Numbers that look random but are the same in every run. */
#ifndef RENDERER_RANDOM_H
#define RENDERER_RANDOM_H
#include <stdint.h>

/* The next one in [0,1) (PCG's output permutation). */
static inline double next_random(uint32_t *state) {
    *state = *state * 747796405u + 2891336453u;
    const uint32_t word = ((*state >> ((*state >> 28) + 4u)) ^ *state) * 277803737u;
    return ((word >> 22) ^ word) * (1.0 / 4294967296.0);
}
#endif
