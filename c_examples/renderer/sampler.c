#include "sampler.h"

/* PCG's output permutation as a hash (Jarzynski and Olano, JCGT 9(3), 2020). */
static uint32_t hash(uint32_t x) {
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28) + 4u)) ^ x) * 277803737u;
    return (x >> 22) ^ x;
}

static uint32_t mirror_bits(uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/* Turns about each bit depending on all higher ones: Laine and Karras's permutation, with the better constants of
   N. Vegdahl (2021). */
static uint32_t scramble(uint32_t x, uint32_t seed) {
    x = mirror_bits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return mirror_bits(x);
}

static uint32_t sobol_second(uint32_t index) {
    uint32_t result = 0;
    for (uint32_t column = 0x80000000u; index; index >>= 1, column ^= column >> 1)
        if (index & 1u) result ^= column;
    return result;
}

Sampler sampler_start(int x, int y, uint32_t index) {
    return (Sampler){.pixel = hash((uint32_t)x ^ hash((uint32_t)y ^ 0x9e3779b9u)), .index = index};
}

void sampler_next(Sampler *sampler, double u[2]) {
    const uint32_t seed = hash(sampler->pixel ^ hash(sampler->dimension++));
    /* Each pair meets the samples in an order of its own, or pairs would go together. */
    const uint32_t index = scramble(sampler->index, seed);
    u[0] = scramble(mirror_bits(index), hash(seed ^ 1u)) * (1.0 / 4294967296.0);
    u[1] = scramble(sobol_second(index), hash(seed ^ 2u)) * (1.0 / 4294967296.0);
}
