/* The scratches as explicit micro-geometry: every facet a triangle for Embree. And what of it a normal map keeps. */
#ifndef BENCH_RELIEF_H
#define BENCH_RELIEF_H
#include "plate.h"

typedef struct Relief {
    const Plate *plate;
    Scene scene;
    Tracer *tracer;
    double top;  /* above all relief, mm */
    double step; /* off a facet that a ray leaves, mm */
    double build_seconds;
    size_t bytes; /* of the triangles, Embree's tree included */
} Relief;

bool relief_init(Relief *relief, const Plate *plate, char error[SCENE_ERROR_SIZE]);
void relief_free(Relief *relief);

/* Where a ray from outside meets the relief; false where it misses the plate. */
bool relief_find(const Relief *relief, Vec origin, Vec direction, Vec *position, Vec *normal);

/* Whether light of a lamp outside reaches a place of it. */
bool relief_is_lit(const Relief *relief, Vec position, Vec normal, Vec lamp);

/* Unit normals in texels over the plate's texture space: x and y of each, in 32767ths. */
typedef struct NormalMap {
    int columns, rows;
    int16_t (*xy)[2];
    double build_seconds;
} NormalMap;

/* Of the facet that lies under each texel's middle. */
bool normal_map_init(NormalMap *map, const Relief *relief, unsigned texels);
void normal_map_free(NormalMap *map);
size_t normal_map_bytes(const NormalMap *map);

/* Interpolated between the four nearest texels. */
void normal_map_at(const NormalMap *map, const double uv[2], float normal[3]);
#endif
