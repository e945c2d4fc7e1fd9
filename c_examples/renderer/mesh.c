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

Surface mesh_surface(const Mesh *mesh, size_t triangle, Vec origin, Vec direction) {
    const unsigned *corner = mesh->triangles[triangle];
    const Vec a = mesh->positions[corner[0]];
    const Vec ab = vec_sub(mesh->positions[corner[1]], a), ac = vec_sub(mesh->positions[corner[2]], a);
    const double *uv_a = mesh->uv[corner[0]], *uv_b = mesh->uv[corner[1]], *uv_c = mesh->uv[corner[2]];
    const double du1 = uv_b[0] - uv_a[0], dv1 = uv_b[1] - uv_a[1];
    const double du2 = uv_c[0] - uv_a[0], dv2 = uv_c[1] - uv_a[1];
    const Vec cross = vec_cross(ab, ac);
    const double twice_area_squared = vec_dot(cross, cross);

    /* The distance again, in double precision: Embree's single precision would show as a shaking texture. */
    const double distance = vec_dot(vec_sub(a, origin), cross) / vec_dot(direction, cross);
    const Vec position = vec_along(origin, distance, direction);
    const Vec offset = vec_sub(position, a);
    const double b = vec_dot(vec_cross(offset, ac), cross) / twice_area_squared;
    const double c = vec_dot(vec_cross(ab, offset), cross) / twice_area_squared;

    const double uv_area = du1 * dv2 - du2 * dv1;
    const Vec dp_du = vec_scale(vec_sub(vec_scale(ab, dv2), vec_scale(ac, dv1)), 1.0 / uv_area);
    const Vec dp_dv = vec_scale(vec_sub(vec_scale(ac, du1), vec_scale(ab, du2)), 1.0 / uv_area);
    return (Surface){.mesh = mesh,
                     .face = mesh->faces[triangle],
                     .position = position,
                     .normal = vec_scale(cross, 1.0 / sqrt(twice_area_squared)),
                     .uv = {uv_a[0] + b * du1 + c * du2, uv_a[1] + b * dv1 + c * dv2},
                     .dp_du = dp_du,
                     .dp_dv = dp_dv};
}
