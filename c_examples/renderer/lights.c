#include "lights.h"

void lights_add(Lights *lights, const Lamp *lamp) {
    const Vec normal = vec_unit(vec_sub(lamp->towards, lamp->centre));
    const Vec across = vec_unit(vec_cross(vec(0.0, 0.0, 1.0), normal));
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

/* Where a lamp stands: an azimuth from the camera's, an elevation, and a distance from the scene's target. */
static Vec lamp_place(const Scene *scene, const Camera *camera, double azimuth_deg, double elevation_deg,
                      double distance) {
    const Vec to_camera = vec_sub(camera->position, scene->target);
    const double azimuth = atan2(to_camera.y, to_camera.x) + radians(azimuth_deg),
                 elevation = radians(elevation_deg);
    const Vec direction = vec(cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation));
    return vec_along(scene->target, distance, direction);
}

Lights lights_for_view(const Scene *scene, const Camera *camera) {
    Lights lights = {.count = 0};
    const double distance = vec_length(vec_sub(camera->position, scene->target));

    /* A hand's breadth beside the lens. */
    const Lamp flash = {.centre = vec_along(camera->position, 0.05 * distance, vec_unit(camera->right)),
                        .towards = scene->target,
                        .width = 0.02 * distance,
                        .height = 0.02 * distance,
                        .columns = 1,
                        .rows = 1,
                        .radiance = {3200.0, 3250.0, 3300.0},
                        .fade = 1.0};
    lights_add(&lights, &flash);

    /* About where a mirror in the plate's place would show it to the camera, so that it gives the metal its sheen. */
    const Lamp soft_box = {.centre = lamp_place(scene, camera, 200.0, 72.0, distance),
                           .towards = scene->target,
                           .width = 0.9 * distance,
                           .height = 0.6 * distance,
                           .columns = 5,
                           .rows = 3,
                           .radiance = {0.15, 0.18, 0.23},
                           .fade = 0.1};
    lights_add(&lights, &soft_box);

    /* The room's four walls, far away and dim: what the plate's own sides mirror. */
    for (int wall = 0; wall < 4; wall++) {
        const Lamp room = {.centre = lamp_place(scene, camera, 45.0 + 90.0 * wall, 10.0, 3.0 * distance),
                           .towards = scene->target,
                           .width = 6.0 * distance,
                           .height = 2.0 * distance,
                           .columns = 2,
                           .rows = 1,
                           .radiance = {0.05, 0.06, 0.07},
                           .fade = 1.0};
        lights_add(&lights, &room);
    }
    return lights;
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
