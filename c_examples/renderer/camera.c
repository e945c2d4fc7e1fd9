#include "camera.h"

Camera camera_for_view(const Scene *scene, const View *view, int width, int height) {
    const double heading = radians(view->heading_deg), elevation = radians(view->elevation_deg);
    const Vec back = vec(cos(elevation) * cos(heading), cos(elevation) * sin(heading), sin(elevation));
    const Vec forward = vec_scale(back, -1.0);
    const Vec level = vec_unit(vec_cross(forward, vec(0.0, 0.0, 1.0))), below = vec_cross(forward, level);
    const double roll = radians(view->roll_deg);
    const Vec right = vec_along(vec_scale(level, cos(roll)), sin(roll), below);
    const double pixel = 2.0 * tan(radians(view->width_deg) / 2.0) / width;
    return (Camera){.position = vec_along(scene->target, view->distance, back),
                    .forward = forward,
                    .right = vec_scale(right, pixel),
                    .down = vec_scale(vec_cross(forward, right), pixel),
                    .centre_x = 0.5 * width,
                    .centre_y = 0.5 * height};
}

Vec camera_direction(const Camera *camera, double x, double y) {
    const Vec across = vec_along(camera->forward, x - camera->centre_x, camera->right);
    return vec_along(across, y - camera->centre_y, camera->down);
}

/* Where the ray through (x, y) meets the tangent plane, relative to the surface point. */
static bool plane_offset(const Camera *camera, const Surface *surface, double x, double y, Vec *offset) {
    const Vec direction = camera_direction(camera, x, y);
    const Vec from = vec_sub(camera->position, surface->position);
    const double toward = -vec_dot(direction, surface->normal);
    if (!(toward > 0.0)) return false;
    *offset = vec_along(from, vec_dot(from, surface->normal) / toward, direction);
    return true;
}

/* A tangent vector in texture coordinates: the (du, dv) with du dP/du + dv dP/dv = tangent. */
static void tangent_to_uv(const Surface *surface, Vec tangent, float duv[2]) {
    const double uu = vec_dot(surface->dp_du, surface->dp_du), vv = vec_dot(surface->dp_dv, surface->dp_dv);
    const double uv = vec_dot(surface->dp_du, surface->dp_dv), determinant = uu * vv - uv * uv;
    const double tu = vec_dot(tangent, surface->dp_du), tv = vec_dot(tangent, surface->dp_dv);
    duv[0] = (float)((vv * tu - uv * tv) / determinant);
    duv[1] = (float)((uu * tv - uv * tu) / determinant);
}

bool camera_footprint(const Camera *camera, const Surface *surface, double x, double y, double size,
                      float duv_dx[2], float duv_dy[2]) {
    const double half = 0.5 * size;
    Vec left, right, top, bottom;
    if (!plane_offset(camera, surface, x - half, y, &left) || !plane_offset(camera, surface, x + half, y, &right) ||
        !plane_offset(camera, surface, x, y - half, &top) || !plane_offset(camera, surface, x, y + half, &bottom))
        return false;
    tangent_to_uv(surface, vec_sub(right, left), duv_dx);
    tangent_to_uv(surface, vec_sub(bottom, top), duv_dy);
    return true;
}
