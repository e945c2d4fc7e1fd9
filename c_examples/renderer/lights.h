/* Lights: bright rectangles, points, suns, and surroundings as a picture. Lamps are seen through: they hide nothing. */
#ifndef RENDERER_LIGHTS_H
#define RENDERER_LIGHTS_H
#include <stddef.h>

#include "environment.h"

enum { LIGHTS_MAX_PATCHES = 96, LIGHTS_MAX_POINTS = 4, LIGHTS_MAX_SUNS = 2 };

typedef struct Patch {
    Vec position, normal; /* its middle, and the side it shines to */
    Vec edge_a, edge_b;   /* its edges */
    double area;
    double radiance[3];
} Patch;

typedef struct PointLight {
    Vec position;
    double intensity[3]; /* radiance times square scene units */
} PointLight;

typedef struct Sun {
    Vec direction; /* unit, to the light */
    double irradiance[3];
} Sun;

typedef struct Lights {
    Patch patches[LIGHTS_MAX_PATCHES];
    PointLight points[LIGHTS_MAX_POINTS];
    Sun suns[LIGHTS_MAX_SUNS];
    size_t count; /* of patches */
    size_t point_count, sun_count;
    const Environment *environment; /* NULL: black; does not count for shade.h, which looks at lamps only */
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

/* A point of the patch, a and b in [0,1). */
Vec patch_point(const Patch *patch, double a, double b);

/* Light that arrives at `to` from one point of the patch as though the whole patch were there: per channel,
   radiance times the patch's solid angle. */
void patch_irradiance(const Patch *patch, Vec from, Vec to, double irradiance[3]);

/* How many lamps there are of all three kinds, each of which arrives from one place: of patches the one at a and b. */
size_t lights_lamp_count(const Lights *lights);
Vec lights_arrival(const Lights *lights, size_t lamp, double a, double b, Vec to, double irradiance[3]);
#endif
