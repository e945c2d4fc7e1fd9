#include "camera.h"

Camera camera_for_view(const Scene *scene, const View *view, int width, int height) {
    const double heading = radians(view->heading_deg), elevation = radians(view->elevation_deg);
    const Vec back = vec(cos(elevation) * cos(heading), cos(elevation) * sin(heading), sin(elevation));
    const Vec forward = vec_scale(back, -1.0);
    const Vec level = vec_unit(vec_cross(forward, vec(0.0, 0.0, 1.0))), below = vec_cross(forward, level);
    const double roll = radians(view->roll_deg);
    const Vec right = vec_along(vec_scale(level, cos(roll)), sin(roll), below);
    const double pixel = 2.0 * tan(radians(view->width_deg) / 2.0) / width;
    const Vec target = vec_add(scene->target, view->aside);
    return (Camera){.position = vec_along(target, view->distance, back),
                    .forward = forward,
                    .right = vec_scale(right, pixel),
                    .down = vec_scale(vec_cross(forward, right), pixel),
                    .centre_x = 0.5 * width,
                    .centre_y = 0.5 * height,
                    .lens_radius = view->lens_radius,
                    .focus = view->distance};
}

Vec camera_direction(const Camera *camera, double x, double y) {
    const Vec across = vec_along(camera->forward, x - camera->centre_x, camera->right);
    return vec_along(across, y - camera->centre_y, camera->down);
}

/* How far apart two rays meet the tangent plane: those half a step to either side of a direction that approaches the plane so
   fast, from so high above it. Their two places are not subtracted: that would lose the digits they share. */
static bool edge_on_plane(const Surface *surface, double height, Vec direction, double toward, Vec step, Vec *edge) {
    const double away = vec_dot(step, surface->geometric), least = toward - 0.5 * fabs(away);
    if (!(least > 0.0)) return false;
    const double scale = height / (least * (toward + 0.5 * fabs(away)));
    *edge = vec_along(vec_scale(step, toward * scale), away * scale, direction);
    return true;
}

bool camera_footprint(const Camera *camera, const Surface *surface, double x, double y, double size,
                      float duv_dx[2], float duv_dy[2]) {
    const Vec direction = camera_direction(camera, x, y);
    const double toward = -vec_dot(direction, surface->geometric);
    const double height = vec_dot(vec_sub(camera->position, surface->position), surface->geometric);
    Vec right, below;
    if (!edge_on_plane(surface, height, direction, toward, vec_scale(camera->right, size), &right) ||
        !edge_on_plane(surface, height, direction, toward, vec_scale(camera->down, size), &below))
        return false;
    double across[2], down[2];
    surface_to_uv(surface, right, across);
    surface_to_uv(surface, below, down);
    for (int axis = 0; axis < 2; axis++) {
        duv_dx[axis] = (float)across[axis];
        duv_dy[axis] = (float)down[axis];
    }
    return true;
}

Ray camera_ray(const Camera *camera, const Sample *sample, const double lens[2]) {
    const double radius = camera->lens_radius * sqrt(lens[0]), turn = 2.0 * PI * lens[1];
    const Vec aside = vec_along(vec_scale(vec_unit(camera->right), radius * cos(turn)), radius * sin(turn),
                                vec_unit(camera->down));
    const Vec through = vec_scale(camera_direction(camera, sample->x, sample->y), camera->focus);
    const Vec steps[2] = {vec_scale(camera->right, sample->size * camera->focus),
                          vec_scale(camera->down, sample->size * camera->focus)};
    const Vec path = vec_sub(through, aside);
    const double distance = vec_length(path);
    Ray ray = {.origin = vec_add(camera->position, aside), .direction = vec_scale(path, 1.0 / distance)};
    for (int k = 0; k < 2; k++)
        ray.direction_by[k] = vec_scale(vec_across(steps[k], ray.direction), 1.0 / distance);
    return ray;
}
