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
    Vec *normals; /* unit, of each vertex, where the mesh stands for something round; NULL for flat triangles */
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
    Vec normal;    /* unit, outward, of the round shape that the triangles stand for */
    Vec geometric; /* unit, outward, of the triangle itself */
    double uv[2];
    Vec dp_du, dp_dv; /* scene units per unit of u and v */
    Vec dn_du, dn_dv; /* how the normal turns */
} Surface;

/* An empty mesh with room for so many quadrilaterals; false where memory is short. */
bool mesh_init(Mesh *mesh, size_t quad_count);
void mesh_free(Mesh *mesh);

/* Adds a flat quadrilateral, counter-clockwise seen from outside. */
void mesh_add_quad(Mesh *mesh, unsigned face, const Vec corners[4], double uv[4][2]);

/* A mesh of columns by rows quadrilaterals over (0,0)-(1,1) in texture coordinates, the whole of it one face. The place of
   each vertex and its normal come from a function, which u and v must meet counter-clockwise seen from outside. */
typedef void MeshPlace(double u, double v, const void *user, Vec *position, Vec *normal);
bool mesh_init_grid(Mesh *mesh, unsigned face, int columns, int rows, MeshPlace *place, const void *user);

/* Where a ray meets the plane of a triangle that it is known to hit. */
Surface mesh_surface(const Mesh *mesh, size_t triangle, Vec origin, Vec direction);

/* A tangent vector in texture coordinates: the (du, dv) with du dP/du + dv dP/dv = tangent. */
static inline void surface_to_uv(const Surface *surface, Vec tangent, double duv[2]) {
    const double uu = vec_dot(surface->dp_du, surface->dp_du), vv = vec_dot(surface->dp_dv, surface->dp_dv);
    const double uv = vec_dot(surface->dp_du, surface->dp_dv), determinant = uu * vv - uv * uv;
    const double tu = vec_dot(tangent, surface->dp_du), tv = vec_dot(tangent, surface->dp_dv);
    duv[0] = (vv * tu - uv * tv) / determinant;
    duv[1] = (uu * tv - uv * tu) / determinant;
}
#endif
