#include "props.h"

#include <stdio.h>

bool prop_table(Mesh *mesh, double half_width, double z) {
    if (!mesh_init(mesh, 1)) return false;
    const double h = half_width;
    const Vec corners[4] = {vec(-h, -h, z), vec(h, -h, z), vec(h, h, z), vec(-h, h, z)};
    double uv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh_add_quad(mesh, FACE_TABLE, corners, uv);
    return true;
}

void prop_soft_box(Lights *lights, Vec target, double heading_deg, double elevation_deg, double distance,
                   double width, double height, const double radiance[3]) {
    const double heading = radians(heading_deg), elevation = radians(elevation_deg);
    const Vec direction = vec(cos(elevation) * cos(heading), cos(elevation) * sin(heading), sin(elevation));
    const Lamp lamp = {.centre = vec_along(target, distance, direction),
                       .towards = target,
                       .width = width,
                       .height = height,
                       .columns = 1,
                       .rows = 1,
                       .radiance = {radiance[0], radiance[1], radiance[2]},
                       .fade = 1.0};
    lights_add(lights, &lamp);
}

bool prop_refused(char error[SCENE_ERROR_SIZE]) {
    snprintf(error, SCENE_ERROR_SIZE, "%s", striae_last_error());
    return false;
}
