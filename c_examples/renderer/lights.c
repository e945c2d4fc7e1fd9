#include "lights.h"

/* Farther than any scene reaches, near enough for single precision. */
static const double SUN_DISTANCE = 1e4;

void lights_add(Lights *lights, const Lamp *lamp) {
    const Vec normal = vec_unit(vec_sub(lamp->towards, lamp->centre));
    const Vec across = vec_unit(vec_cross(fabs(normal.z) < 0.999 ? vec(0.0, 0.0, 1.0) : vec(0.0, 1.0, 0.0), normal));
    const Vec upward = vec_cross(normal, across);
    const Vec a = vec_scale(across, lamp->width / lamp->columns), b = vec_scale(upward, lamp->height / lamp->rows);
    for (int row = 0; row < lamp->rows; row++) {
        for (int column = 0; column < lamp->columns; column++) {
            if (lights->count == LIGHTS_MAX_PATCHES) return;
            Patch *patch = &lights->patches[lights->count++];
            const double up = (row + 0.5) / lamp->rows, smooth = up * up * (3.0 - 2.0 * up);
            const Vec in_column = vec_along(lamp->centre, column + 0.5 - 0.5 * lamp->columns, a);
            *patch = (Patch){.position = vec_along(in_column, row + 0.5 - 0.5 * lamp->rows, b),
                             .normal = normal,
                             .edge_a = a,
                             .edge_b = b,
                             .area = vec_length(a) * vec_length(b)};
            for (int c = 0; c < 3; c++)
                patch->radiance[c] = lamp->radiance[c] * (lamp->fade + (1.0 - lamp->fade) * smooth);
        }
    }
}

Vec patch_point(const Patch *patch, double a, double b) {
    return vec_along(vec_along(patch->position, a - 0.5, patch->edge_a), b - 0.5, patch->edge_b);
}

void patch_irradiance(const Patch *patch, Vec from, Vec to, double irradiance[3]) {
    const Vec path = vec_sub(to, from);
    const double squared = vec_dot(path, path);
    const double cosine = vec_dot(path, patch->normal) / sqrt(squared);
    const double solid_angle = cosine > 0.0 ? patch->area * cosine / squared : 0.0;
    for (int c = 0; c < 3; c++) irradiance[c] = patch->radiance[c] * solid_angle;
}

size_t lights_lamp_count(const Lights *lights) { return lights->count + lights->point_count + lights->sun_count; }

Vec lights_arrival(const Lights *lights, size_t lamp, double a, double b, Vec to, double irradiance[3]) {
    if (lamp < lights->count) {
        const Vec from = patch_point(&lights->patches[lamp], a, b);
        patch_irradiance(&lights->patches[lamp], from, to, irradiance);
        return from;
    }
    lamp -= lights->count;
    if (lamp < lights->point_count) {
        const PointLight *point = &lights->points[lamp];
        const Vec path = vec_sub(to, point->position);
        for (int c = 0; c < 3; c++) irradiance[c] = point->intensity[c] / vec_dot(path, path);
        return point->position;
    }
    const Sun *sun = &lights->suns[lamp - lights->point_count];
    for (int c = 0; c < 3; c++) irradiance[c] = sun->irradiance[c];
    return vec_along(to, SUN_DISTANCE, sun->direction);
}
