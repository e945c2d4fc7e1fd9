/* A base BRDF as a host might have: matt paint. `user` is its albedo, three numbers. */
#ifndef TESTS_MATT_HOST_H
#define TESTS_MATT_HOST_H
#include <math.h>
#include <striae.h>

#define MATT_PI 3.14159265f

static inline void matt_eval(void *user, const float *view, const float *light, float *f) {
    const float *albedo = user;
    (void)view;
    for (int c = 0; c < 3; c++) f[c] = albedo[c] * light[2] / MATT_PI;
}

static inline void matt_sample(void *user, const float *u, const float *view, float *light) {
    const float radius = sqrtf(u[1]), azimuth = 2.0f * MATT_PI * u[0];
    (void)user;
    (void)view;
    light[0] = radius * cosf(azimuth);
    light[1] = radius * sinf(azimuth);
    light[2] = sqrtf(1.0f - u[1]);
}

static inline float matt_pdf(void *user, const float *view, const float *light) {
    (void)user;
    (void)view;
    return light[2] > 0.0f ? light[2] / MATT_PI : 0.0f;
}

static inline StriaeHostBrdf matt(float albedo[3]) {
    return (StriaeHostBrdf){.struct_size = sizeof(StriaeHostBrdf),
                            .eval = matt_eval,
                            .sample = matt_sample,
                            .pdf = matt_pdf,
                            .user = albedo,
                            .lobe = STRIAE_LOBE_DIFFUSE,
                            .alpha_across = 1.0f,
                            .alpha_along = 1.0f};
}
#endif
