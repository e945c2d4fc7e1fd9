/* The lamps: bright rectangles, cut into patches small enough to count as points. */
#ifndef RENDERER_LIGHTS_H
#define RENDERER_LIGHTS_H
#include "camera.h"

enum { LIGHTS_MAX_PATCHES = 96 };

typedef struct Patch {
    Vec position, normal; /* its middle, and the side it shines to */
    Vec edge_a, edge_b;   /* its edges */
    double area;
    double radiance[3];
} Patch;

typedef struct Lights {
    Patch patches[LIGHTS_MAX_PATCHES];
    size_t count;
} Lights;

/* A rectangle of columns by rows patches that shines on a point. Its radiance falls smoothly from the top edge
   to `fade` times as much at the bottom edge. */
typedef struct Lamp {
    Vec centre, towards;
    double width, height; /* scene units */
    int columns, rows;
    double radiance[3], fade;
} Lamp;

/* Patches for which there is no room are left out. */
void lights_add(Lights *lights, const Lamp *lamp);

/* A flash beside the camera, and a dim large soft box across the scene, both of which go where the camera goes. */
Lights lights_for_view(const Scene *scene, const Camera *camera);

/* A point of the patch, a and b in [0,1). */
Vec patch_point(const Patch *patch, double a, double b);

/* Light that arrives at `to` from one point of the patch as though the whole patch were there: per channel,
   radiance times the patch's solid angle. */
void patch_irradiance(const Patch *patch, Vec from, Vec to, double irradiance[3]);
#endif
