/* For paths: lights by chance, the more of them the more light they might send, and how likely that was. */
#ifndef RENDERER_CHOOSE_LIGHT_H
#define RENDERER_CHOOSE_LIGHT_H
#include "lights.h"
#include "ray.h"

typedef struct ChosenLight {
    Vec direction;   /* unit */
    double distance; /* scene units; HUGE_VAL for surroundings and suns */
    double value[3]; /* what arrives, over the chance of having chosen it: times BRDF times cosine it is light */
    double pdf;      /* per steradian; 0 for points and suns, which no other way of choosing finds */
} ChosenLight;

/* From a point of a surface: `which` chooses the light, u its place, each in [0,1). False where there is none. */
bool choose_light(const Lights *lights, Vec from, double which, const double u[2], ChosenLight *chosen);

/* Called for each light that a ray meets before `distance`, with the density of choose_light() from the ray's origin. */
typedef void LightMet(const double radiance[3], double pdf, void *user);
void meet_lights(const Lights *lights, const Ray *ray, double distance, LightMet *met, void *user);
#endif
