/* Rays that know how far they lie from their neighbours: H. Igehy, Tracing Ray Differentials, SIGGRAPH 1999. */
#ifndef RENDERER_RAY_H
#define RENDERER_RAY_H
#include "mesh.h"

typedef struct Ray {
    Vec origin, direction;             /* unit */
    Vec origin_by[2], direction_by[2]; /* what changes from one sample to the next, across and down */
} Ray;

/* How the place where a ray meets a surface changes, on the surface's tangent plane; false where it all but grazes it. */
bool ray_footprint(const Ray *ray, const Surface *surface, Vec offsets[2]);

/* The ray that goes on from a surface, chosen with a density. Its neighbours leave as from a mirror of the surface's
   curvature, and spread further by what the sample stands for: of a lobe that so many samples share out, one has the
   solid angle 1 / (samples pdf) (Colbert and Krivanek, GPU Gems 3, 2007). So does what scatters evenly show all that it
   sees as if through frosted glass. */
Ray ray_onwards(const Ray *ray, const Surface *surface, Vec direction, double pdf, int samples);
#endif
