#include "paint.h"

#include <math.h>

static const float PI_F = 3.14159265f;

/* Reflectance of the coat where light falls on it straight: of an index of refraction of 1.5. */
static const float COAT_F0 = 0.04f;

static float coat_fresnel(float cosine) { return COAT_F0 + (1.0f - COAT_F0) * powf(1.0f - cosine, 5.0f); }

/* How often samples follow the coat: as much as it reflects of all, and never too seldom. */
static float coat_chance(const float *view) { return fmaxf(0.5f, coat_fresnel(view[2])); }

static float density_of_slopes(float alpha, float z) {
    const float a2 = alpha * alpha, d = z * z * (a2 - 1.0f) + 1.0f;
    return a2 / (PI_F * d * d);
}

/* Smith's masking, over twice the cosine. */
static float masking(float alpha, float z) {
    return 1.0f / (z + sqrtf(alpha * alpha + (1.0f - alpha * alpha) * z * z));
}

/* The unit vector halfway between view and light; returns their cosine to it. */
static float halfway(const float *view, const float *light, float half[3]) {
    float length = 0.0f;
    for (int i = 0; i < 3; i++) half[i] = view[i] + light[i];
    for (int i = 0; i < 3; i++) length += half[i] * half[i];
    length = sqrtf(fmaxf(length, 1e-12f));
    for (int i = 0; i < 3; i++) half[i] /= length;
    return half[0] * view[0] + half[1] * view[1] + half[2] * view[2];
}

static void paint_eval(void *user, const float *view, const float *light, float *f) {
    const Paint *paint = user;
    float half[3];
    const float cosine = halfway(view, light, half), fresnel = coat_fresnel(cosine);
    const float coat = fresnel * density_of_slopes(paint->alpha, half[2]) * masking(paint->alpha, view[2]) *
                       masking(paint->alpha, light[2]) * light[2];
    /* What the coat lets in and out again; the same seen either way. */
    const float through = (1.0f - coat_fresnel(view[2])) * (1.0f - coat_fresnel(light[2]));
    for (int c = 0; c < 3; c++) f[c] = coat + through * paint->albedo[c] * light[2] / PI_F;
}

static void paint_sample(void *user, const float *u, const float *view, float *light) {
    const Paint *paint = user;
    const float chance = coat_chance(view), turn = 2.0f * PI_F * u[1];
    if (u[0] >= chance) {
        const float a = (u[0] - chance) / (1.0f - chance), radius = sqrtf(a);
        light[0] = radius * cosf(turn);
        light[1] = radius * sinf(turn);
        light[2] = sqrtf(fmaxf(0.0f, 1.0f - a));
        return;
    }
    const float a = u[0] / chance, tangent2 = paint->alpha * paint->alpha * a / fmaxf(1.0f - a, 1e-7f);
    const float z = 1.0f / sqrtf(1.0f + tangent2), across = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    const float half[3] = {across * cosf(turn), across * sinf(turn), z};
    const float cosine = half[0] * view[0] + half[1] * view[1] + half[2] * view[2];
    for (int i = 0; i < 3; i++) light[i] = 2.0f * cosine * half[i] - view[i];
}

static float paint_pdf(void *user, const float *view, const float *light) {
    const Paint *paint = user;
    const float chance = coat_chance(view);
    float half[3];
    const float cosine = halfway(view, light, half);
    const float coat = half[2] > 0.0f && cosine > 0.0f
                           ? density_of_slopes(paint->alpha, half[2]) * half[2] / (4.0f * cosine)
                           : 0.0f;
    return chance * coat + (1.0f - chance) * fmaxf(0.0f, light[2]) / PI_F;
}

StriaeHostBrdf paint_host(Paint *paint) {
    return (StriaeHostBrdf){.struct_size = sizeof(StriaeHostBrdf),
                            .eval = paint_eval,
                            .sample = paint_sample,
                            .pdf = paint_pdf,
                            .user = paint,
                            .lobe = STRIAE_LOBE_GLOSSY,
                            .alpha_across = paint->alpha,
                            .alpha_along = paint->alpha};
}
