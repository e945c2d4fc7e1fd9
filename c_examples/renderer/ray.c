#include "ray.h"

/* Below this cosine a footprint has no end worth counting. */
static const double LEAST_COSINE = 1e-3;

bool ray_footprint(const Ray *ray, const Surface *surface, Vec offsets[2]) {
    const double distance = vec_dot(vec_sub(surface->position, ray->origin), ray->direction);
    const double cosine = vec_dot(ray->direction, surface->geometric);
    for (int k = 0; k < 2; k++) {
        const Vec beside = vec_along(ray->origin_by[k], distance, ray->direction_by[k]);
        const double held = fabs(cosine) > LEAST_COSINE ? cosine : LEAST_COSINE;
        offsets[k] = vec_along(beside, -vec_dot(beside, surface->geometric) / held, ray->direction);
    }
    return fabs(cosine) > LEAST_COSINE;
}

/* How the direction of a ray that is mirrored changes, where its neighbour meets the surface `offset` beside it. */
static Vec mirrored_by(const Ray *ray, const Surface *surface, Vec offset, Vec direction_by) {
    double duv[2];
    surface_to_uv(surface, offset, duv);
    const Vec n = surface->normal;
    const Vec turn = vec_along(vec_scale(surface->dn_du, duv[0]), duv[1], surface->dn_dv);
    const Vec normal_by = vec_across(turn, n);
    const double changed = vec_dot(direction_by, n) + vec_dot(ray->direction, normal_by);
    const Vec mirrored = vec_along(direction_by, -2.0 * vec_dot(ray->direction, n), normal_by);
    return vec_along(mirrored, -2.0 * changed, n);
}

Ray ray_onwards(const Ray *ray, const Surface *surface, Vec direction, double pdf, int samples) {
    Ray onwards = {.origin = surface->position, .direction = direction};
    const double spread = fmin(0.05, sqrt(1.0 / (samples * pdf)));
    Vec by[2];
    ray_footprint(ray, surface, onwards.origin_by);
    for (int k = 0; k < 2; k++)
        by[k] = vec_across(mirrored_by(ray, surface, onwards.origin_by[k], ray->direction_by[k]), direction);
    const double length = vec_length(by[0]);
    const Vec side = length > 1e-12 ? vec_scale(by[0], 1.0 / length) : vec_aside(direction);
    const Vec other = vec_cross(direction, side);
    onwards.direction_by[0] = vec_along(by[0], spread, side);
    onwards.direction_by[1] = vec_along(by[1], vec_dot(by[1], other) < 0.0 ? -spread : spread, other);
    return onwards;
}
