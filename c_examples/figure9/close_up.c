#include "close_up.h"

#include "render.h"

/* Where the camera stands, counter-clockwise from the right of the scratch's travel. The lamp faces it. */
static const double CAMERA_HEADING_DEG = -35.0, CAMERA_ELEVATION_DEG = 45.0, LAMP_ELEVATION_DEG = 42.0;

/* In widths of the picture. So near that the light on the plate changes from side to side. */
static const double CAMERA_DISTANCE = 2.2, LAMP_DISTANCE = 3.0;

/* A place as seen from the plate's middle. */
static Vec place(double heading_deg, double elevation_deg, double distance) {
    const double heading = radians(heading_deg), elevation = radians(elevation_deg);
    return vec_scale(vec(cos(elevation) * cos(heading), cos(elevation) * sin(heading), sin(elevation)), distance);
}

/* A view camera: it stands aside, but its film is parallel to the plate, so that the plate has one scale all over the
   picture, which is that of the cross-section below. */
static Camera view_camera(const Shot *shot) {
    const double across = shot->group->across_mm, pixel = across / shot->width;
    const Vec position = place(CAMERA_HEADING_DEG, CAMERA_ELEVATION_DEG, CAMERA_DISTANCE * across);
    const double slope = pixel / position.z;
    return (Camera){.position = position,
                    .forward = vec(0.0, 0.0, -1.0),
                    .right = vec(slope, 0.0, 0.0),
                    .down = vec(0.0, -slope, 0.0),
                    .centre_x = 0.5 * shot->width + position.x / pixel,
                    .centre_y = 0.5 * shot->height - position.y / pixel};
}

/* A soft box that faces the camera across the plate, and a dim room. */
static Lights lamps(const Shot *shot) {
    const double distance = LAMP_DISTANCE * shot->group->across_mm;
    const Lamp soft_box = {.centre = place(CAMERA_HEADING_DEG + 180.0, LAMP_ELEVATION_DEG, distance),
                           .width = distance,
                           .height = 0.7 * distance,
                           .columns = 18,
                           .rows = 5,
                           .radiance = {1.0, 0.97, 0.93},
                           .fade = 0.0};
    Lights lights = {.count = 0};
    lights_add(&lights, &soft_box);
    for (int wall = 0; wall < 4; wall++) {
        const Lamp room = {.centre = place(CAMERA_HEADING_DEG + 45.0 + 90.0 * wall, 25.0, 3.0 * distance),
                           .width = 4.0 * distance,
                           .height = 3.0 * distance,
                           .columns = 1,
                           .rows = 1,
                           .radiance = {0.115, 0.122, 0.133},
                           .fade = 1.0};
        lights_add(&lights, &room);
    }
    return lights;
}

const char *close_up(const Shot *shot, int threads, Film *film) {
    static char error[SCENE_ERROR_SIZE];
    Scene scene;
    const char *failure = scratched_plate(shot, &scene);
    if (failure) return failure;
    const View view = {.name = shot->cell->name};
    const RenderSettings settings = {1, threads};
    Tracer *tracer = tracer_new(&scene, error);
    if (tracer) {
        const Stage stage = {
            .scene = &scene, .view = &view, .tracer = tracer, .camera = view_camera(shot), .lights = lamps(shot)};
        if (!film_init(film, shot->width, shot->height) || !render_view(&stage, &settings, film))
            failure = "out of memory";
    } else {
        failure = error;
    }
    tracer_free(tracer);
    scene_free(&scene);
    return failure;
}
