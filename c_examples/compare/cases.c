#include "cases.h"

#include <stdio.h>

const double DISTANCE_PIXELS[DISTANCE_COUNT] = {8.0, 1.0, 0.2};
const double ELEVATION_DEG[ELEVATION_COUNT] = {75.0, 45.0, 15.0};

/* How far the relief's triangles may stray, in scratch widths: where a pixel holds a whole scratch, only slopes count. */
static const double TOLERANCE[DISTANCE_COUNT] = {2e-4, 6e-4, 2e-3};

/* The plate goes on so many scratch widths beyond what is seen: more than any shadow is long. */
static const double BEYOND = 4.0;

static const double CAMERA_HEADING_DEG = -60.0, CAMERA_ELEVATION_DEG = 55.0, CAMERA_WIDTH_DEG = 14.0;
static const double LAMP_HEADING_DEG = 90.0, LAMP_DISTANCE = 20000.0;

/* The picture's corners on the plane of the plate. */
static void see(Sight *sight, double beyond) {
    const Camera *camera = &sight->stage.camera;
    StriaeMeshRegion *region = &sight->region;
    for (int i = 0; i < 4; i++) {
        const Vec ray = camera_direction(camera, i % 2 * PICTURE_WIDTH, i / 2 * PICTURE_HEIGHT);
        const Vec on = vec_along(camera->position, -camera->position.z / ray.z, ray);
        const double place[2] = {on.x, on.y};
        for (int axis = 0; axis < 2; axis++) {
            region->low_uv[axis] = fmin(i ? region->low_uv[axis] : place[axis], place[axis]);
            region->high_uv[axis] = fmax(i ? region->high_uv[axis] : place[axis], place[axis]);
        }
    }
    for (int axis = 0; axis < 2; axis++) {
        region->low_uv[axis] -= beyond;
        region->high_uv[axis] += beyond;
    }
}

static bool lay_flat(Sight *sight) {
    Mesh *mesh = &sight->scene.meshes[0];
    const double *low = sight->region.low_uv, *high = sight->region.high_uv;
    const Vec corners[4] = {vec(low[0], low[1], 0), vec(high[0], low[1], 0), vec(high[0], high[1], 0),
                            vec(low[0], high[1], 0)};
    double uv[4][2];
    if (!mesh_init(mesh, 1)) return false;
    for (int i = 0; i < 4; i++) {
        uv[i][0] = corners[i].x;
        uv[i][1] = corners[i].y;
    }
    mesh_add_quad(mesh, 1, corners, uv);
    striae_pattern_retain(sight->plate->pattern);
    mesh->pattern = sight->plate->pattern;
    sight->scene.mesh_count = 1;
    return true;
}

bool sight_init(Sight *sight, const Plate *plate, int distance, char error[SCENE_ERROR_SIZE]) {
    const double width = PICTURE_WIDTH * plate->width_mm / DISTANCE_PIXELS[distance];
    *sight = (Sight){.plate = plate,
                     .scene = {.name = plate->name, .mm_per_unit = 1.0, .judged_face = 1},
                     .view = {.name = plate->name,
                              .heading_deg = CAMERA_HEADING_DEG,
                              .elevation_deg = CAMERA_ELEVATION_DEG,
                              .distance = 0.5 * width / tan(radians(0.5 * CAMERA_WIDTH_DEG)),
                              .width_deg = CAMERA_WIDTH_DEG},
                     .region = {.struct_size = sizeof sight->region,
                                .tolerance_mm = TOLERANCE[distance] * plate->width_mm}};
    sight->stage = (Stage){.scene = &sight->scene, .view = &sight->view};
    sight->stage.camera = camera_for_view(&sight->scene, &sight->view, PICTURE_WIDTH, PICTURE_HEIGHT);
    see(sight, BEYOND * plate->width_mm);
    if (!lay_flat(sight)) {
        snprintf(error, SCENE_ERROR_SIZE, "out of memory");
        return false;
    }
    sight->stage.tracer = sight->tracer = tracer_new(&sight->scene, error);
    return sight->tracer != NULL;
}

void sight_free(Sight *sight) {
    tracer_free(sight->tracer);
    scene_free(&sight->scene);
}

Lights sight_lamps(const Sight *sight) {
    Lights lamps = {.count = ELEVATION_COUNT};
    const double heading = radians(LAMP_HEADING_DEG), distance = LAMP_DISTANCE * sight->plate->width_mm;
    for (int i = 0; i < ELEVATION_COUNT; i++) {
        const double up = radians(ELEVATION_DEG[i]);
        const Vec towards = vec(cos(up) * cos(heading), cos(up) * sin(heading), sin(up));
        const double radiance = PI * distance * distance;
        lamps.patches[i] = (Patch){.position = vec_scale(towards, distance),
                                   .normal = vec_scale(towards, -1.0),
                                   .area = 1.0,
                                   .radiance = {radiance, radiance, radiance}};
    }
    return lamps;
}
