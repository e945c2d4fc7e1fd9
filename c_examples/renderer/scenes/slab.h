/* A flat plate with bevelled edges, lying on the ground about the origin. */
#ifndef RENDERER_SLAB_H
#define RENDERER_SLAB_H
#include "mesh.h"

/* Its top, then four bevels and four sides. */
enum { SLAB_TOP = 1, SLAB_EDGES };

typedef struct Slab {
    double size_mm[3], bevel_mm, mm_per_unit;
} Slab;

/* (0,0)-(1,1) in texture coordinates is the slab seen from above. False where memory is short. */
bool slab_mesh(Mesh *mesh, const Slab *slab);
#endif
