#include "slab.h"

/* Texture coordinates of the plate unfolded like a carton: the top, around it the bevels, around those the
   sides, all to the top's scale, so that (0,0)-(1,1) is the plate seen from above. */
static void unfold(const Slab *slab, Vec corner, double unfolded_mm, int side, double uv[2]) {
    const double along[2] = {corner.x * slab->mm_per_unit, corner.y * slab->mm_per_unit};
    const double sign = side < 2 ? 1.0 : -1.0;
    for (int axis = 0; axis < 2; axis++) {
        const double mm = axis == side % 2 ? sign * unfolded_mm : along[axis];
        uv[axis] = 0.5 + mm / slab->size_mm[axis];
    }
}

/* The strip on one side (0: +x, 1: +y, 2: -x, 3: -y) between two rectangles, each given by its half sizes and
   height and by how far its border lies from the middle of the unfolded plate. */
typedef struct Ring {
    double half_mm[2], z_mm, unfolded_mm[2];
} Ring;

static Vec ring_corner(const Slab *slab, const Ring *ring, double sign_x, double sign_y) {
    return vec(sign_x * ring->half_mm[0] / slab->mm_per_unit, sign_y * ring->half_mm[1] / slab->mm_per_unit,
               ring->z_mm / slab->mm_per_unit);
}

static void add_strip(Mesh *mesh, const Slab *slab, unsigned face, const Ring *inner, const Ring *outer, int side) {
    static const double signs[4][2][2] = {
        {{1, -1}, {1, 1}}, {{1, 1}, {-1, 1}}, {{-1, 1}, {-1, -1}}, {{-1, -1}, {1, -1}}};
    const double (*s)[2] = signs[side];
    const Vec corners[4] = {ring_corner(slab, outer, s[0][0], s[0][1]), ring_corner(slab, outer, s[1][0], s[1][1]),
                            ring_corner(slab, inner, s[1][0], s[1][1]), ring_corner(slab, inner, s[0][0], s[0][1])};
    double uv[4][2];
    for (int i = 0; i < 4; i++)
        unfold(slab, corners[i], (i < 2 ? outer : inner)->unfolded_mm[side % 2], side, uv[i]);
    mesh_add_quad(mesh, face, corners, uv);
}

bool slab_mesh(Mesh *mesh, const Slab *slab) {
    if (!mesh_init(mesh, 9)) return false;
    const double hx = slab->size_mm[0] / 2, hy = slab->size_mm[1] / 2, top = slab->size_mm[2], b = slab->bevel_mm,
                 slope = b * sqrt(2.0);
    const double wall = top - b;
    const Ring face = {{hx - b, hy - b}, top, {hx - b, hy - b}};
    const Ring rim = {{hx, hy}, top - b, {hx - b + slope, hy - b + slope}};
    const Ring foot = {{hx, hy}, 0.0, {hx - b + slope + wall, hy - b + slope + wall}};

    const Vec corners[4] = {ring_corner(slab, &face, -1, -1), ring_corner(slab, &face, 1, -1),
                            ring_corner(slab, &face, 1, 1), ring_corner(slab, &face, -1, 1)};
    double uv[4][2];
    for (int i = 0; i < 4; i++) {
        uv[i][0] = 0.5 + corners[i].x * slab->mm_per_unit / slab->size_mm[0];
        uv[i][1] = 0.5 + corners[i].y * slab->mm_per_unit / slab->size_mm[1];
    }
    mesh_add_quad(mesh, SLAB_TOP, corners, uv);
    for (int side = 0; side < 4; side++) {
        add_strip(mesh, slab, SLAB_EDGES + (unsigned)side, &face, &rim, side);
        add_strip(mesh, slab, SLAB_EDGES + 4 + (unsigned)side, &rim, &foot, side);
    }
    return true;
}
