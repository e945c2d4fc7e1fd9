#include "mesh.h"

#include <stdlib.h>

bool mesh_init(Mesh *mesh, size_t quad_count) {
    *mesh = (Mesh){.positions = calloc(4 * quad_count, sizeof *mesh->positions),
                   .uv = calloc(4 * quad_count, sizeof *mesh->uv),
                   .triangles = calloc(2 * quad_count, sizeof *mesh->triangles),
                   .faces = calloc(2 * quad_count, sizeof *mesh->faces)};
    if (mesh->positions && mesh->uv && mesh->triangles && mesh->faces) return true;
    mesh_free(mesh);
    return false;
}

void mesh_free(Mesh *mesh) {
    free(mesh->positions);
    free(mesh->uv);
    free(mesh->normals);
    free(mesh->triangles);
    free(mesh->faces);
    striae_pattern_release(mesh->pattern);
    *mesh = (Mesh){0};
}

static void add_triangle(Mesh *mesh, unsigned face, unsigned a, unsigned b, unsigned c) {
    unsigned *corners = mesh->triangles[mesh->triangle_count];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
    mesh->faces[mesh->triangle_count++] = face;
}

void mesh_add_quad(Mesh *mesh, unsigned face, const Vec corners[4], double uv[4][2]) {
    const unsigned first = (unsigned)mesh->vertex_count;
    for (unsigned i = 0; i < 4; i++) {
        mesh->positions[first + i] = corners[i];
        mesh->uv[first + i][0] = uv[i][0];
        mesh->uv[first + i][1] = uv[i][1];
    }
    mesh->vertex_count += 4;
    add_triangle(mesh, face, first, first + 1, first + 2);
    add_triangle(mesh, face, first, first + 2, first + 3);
}

static void add_grid_vertex(Mesh *mesh, double u, double v, MeshPlace *place, const void *user) {
    const size_t i = mesh->vertex_count++;
    place(u, v, user, &mesh->positions[i], &mesh->normals[i]);
    mesh->uv[i][0] = u;
    mesh->uv[i][1] = v;
}

bool mesh_init_grid(Mesh *mesh, unsigned face, int columns, int rows, MeshPlace *place, const void *user) {
    const size_t vertices = (size_t)(columns + 1) * (size_t)(rows + 1), triangles = 2 * (size_t)columns * (size_t)rows;
    *mesh = (Mesh){.positions = calloc(vertices, sizeof *mesh->positions),
                   .uv = calloc(vertices, sizeof *mesh->uv),
                   .normals = calloc(vertices, sizeof *mesh->normals),
                   .triangles = calloc(triangles, sizeof *mesh->triangles),
                   .faces = calloc(triangles, sizeof *mesh->faces)};
    if (!mesh->positions || !mesh->uv || !mesh->normals || !mesh->triangles || !mesh->faces) {
        mesh_free(mesh);
        return false;
    }
    for (int row = 0; row <= rows; row++)
        for (int column = 0; column <= columns; column++)
            add_grid_vertex(mesh, (double)column / columns, (double)row / rows, place, user);
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            const unsigned below = (unsigned)(row * (columns + 1) + column), above = below + (unsigned)columns + 1;
            add_triangle(mesh, face, below, below + 1, above + 1);
            add_triangle(mesh, face, below, above + 1, above);
        }
    }
    return true;
}

/* The derivatives by u and v of what is linear over a triangle, from its differences along two edges. */
static void by_uv(Vec along_1, Vec along_2, const double duv_1[2], const double duv_2[2], Vec *by_u, Vec *by_v) {
    const double area = duv_1[0] * duv_2[1] - duv_2[0] * duv_1[1];
    *by_u = vec_scale(vec_sub(vec_scale(along_1, duv_2[1]), vec_scale(along_2, duv_1[1])), 1.0 / area);
    *by_v = vec_scale(vec_sub(vec_scale(along_2, duv_1[0]), vec_scale(along_1, duv_2[0])), 1.0 / area);
}

Surface mesh_surface(const Mesh *mesh, size_t triangle, Vec origin, Vec direction) {
    const unsigned *corner = mesh->triangles[triangle];
    const Vec a = mesh->positions[corner[0]];
    const Vec ab = vec_sub(mesh->positions[corner[1]], a), ac = vec_sub(mesh->positions[corner[2]], a);
    const double *uv_a = mesh->uv[corner[0]], *uv_b = mesh->uv[corner[1]], *uv_c = mesh->uv[corner[2]];
    const double duv_b[2] = {uv_b[0] - uv_a[0], uv_b[1] - uv_a[1]}, duv_c[2] = {uv_c[0] - uv_a[0], uv_c[1] - uv_a[1]};
    const Vec cross = vec_cross(ab, ac);
    const double twice_area_squared = vec_dot(cross, cross);

    /* The distance again, in double precision: Embree's single precision would show as a shaking texture. */
    const double distance = vec_dot(vec_sub(a, origin), cross) / vec_dot(direction, cross);
    const Vec position = vec_along(origin, distance, direction);
    const Vec offset = vec_sub(position, a);
    const double b = vec_dot(vec_cross(offset, ac), cross) / twice_area_squared;
    const double c = vec_dot(vec_cross(ab, offset), cross) / twice_area_squared;

    Surface surface = {.mesh = mesh,
                       .face = mesh->faces[triangle],
                       .position = position,
                       .geometric = vec_scale(cross, 1.0 / sqrt(twice_area_squared)),
                       .uv = {uv_a[0] + b * duv_b[0] + c * duv_c[0], uv_a[1] + b * duv_b[1] + c * duv_c[1]}};
    surface.normal = surface.geometric;
    by_uv(ab, ac, duv_b, duv_c, &surface.dp_du, &surface.dp_dv);
    if (mesh->normals) {
        const Vec n = mesh->normals[corner[0]];
        const Vec nb = vec_sub(mesh->normals[corner[1]], n), nc = vec_sub(mesh->normals[corner[2]], n);
        surface.normal = vec_unit(vec_along(vec_along(n, b, nb), c, nc));
        by_uv(nb, nc, duv_b, duv_c, &surface.dn_du, &surface.dn_dv);
    }
    return surface;
}
