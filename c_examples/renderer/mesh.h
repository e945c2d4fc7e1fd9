/* Triangle meshes with texture coordinates, and the surface they give at a point of a triangle. */
#ifndef RENDERER_MESH_H
#define RENDERER_MESH_H
#include <stdbool.h>
#include <stddef.h>
#include <striae.h>

#include "vec.h"

/* A mesh is covered either by a striae pattern or, where that is NULL, by a matte paint. */
typedef struct Mesh {
    Vec *positions;
    double (*uv)[2];
    size_t vertex_count;
    unsigned (*triangles)[3]; /* counter-clockwise seen from outside */
    unsigned *faces;          /* per triangle: the smooth face that it is part of; edges lie between faces */
    size_t triangle_count;
    const StriaePattern *pattern;
    double albedo[3];
} Mesh;

/* A point of a surface, with all that shading asks of it. */
typedef struct Surface {
    const Mesh *mesh;
    unsigned face;
    Vec position;
    Vec normal; /* unit, outward */
    double uv[2];
    Vec dp_du, dp_dv; /* scene units per unit of u and v */
} Surface;

/* An empty mesh with room for so many quadrilaterals; false where memory is short. */
bool mesh_init(Mesh *mesh, size_t quad_count);
void mesh_free(Mesh *mesh);

/* Adds a flat quadrilateral, counter-clockwise seen from outside. */
void mesh_add_quad(Mesh *mesh, unsigned face, const Vec corners[4], double uv[4][2]);

/* Where a ray meets the plane of a triangle that it is known to hit. */
Surface mesh_surface(const Mesh *mesh, size_t triangle, Vec origin, Vec direction);
#endif
