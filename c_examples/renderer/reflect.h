/* How a surface reflects at a point: by striae where it has a pattern, as matte paint elsewhere. Directions are unit vectors
   in the scene's frame, away from the surface. */
#ifndef RENDERER_REFLECT_H
#define RENDERER_REFLECT_H
#include "ray.h"

typedef struct Reflector {
    const StriaePattern *pattern; /* NULL: matte */
    StriaeFrame frame;
    StriaeShading shading;
    Vec normal, geometric;
    double albedo[3];
} Reflector;

/* The point that a ray meets, with all that the ray covers of the surface as footprint. `bounces` within scratches. */
void reflect_prepare(Reflector *reflector, const Surface *surface, const Ray *ray, uint32_t bounces);

/* BRDF times cosine, and the density with which reflect_sample() chooses the light. */
void reflect_eval(const Reflector *reflector, Vec light, double f[3], double *pdf);

/* Chooses a light by three numbers in [0,1); `weight` is BRDF times cosine over density. False where none is chosen. */
bool reflect_sample(const Reflector *reflector, const double u[3], Vec *light, double weight[3], double *pdf);
#endif
