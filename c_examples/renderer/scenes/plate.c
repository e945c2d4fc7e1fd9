/* The titanium plate of the paper's Figure 10: five parallel scratches made by a scratch tester's Rockwell C
   cone, each with a smaller force than its neighbour. */
#include <stdio.h>

#include "props.h"
#include "scenes.h"
#include "slab.h"

enum { SCRATCH_COUNT = 5 };

static const double MM_PER_UNIT = 10.0;
static const double PLATE_MM[3] = {60.0, 40.0, 3.0};

/* The range of loads of the paper's tests, in equal steps. */
static const double FORCE_KGF[SCRATCH_COUNT] = {4.0, 3.125, 2.25, 1.375, 0.5};
static const double SPACING_MM = 5.5;
static const double LENGTH_MM = 34.0;
/* The part of its length, at each end, over which a scratch grows from nothing to its full force. */
static const double SOFT_END = 0.05;

/* One scratch along the plate's long side; the first is the nearest to the viewer of the third picture. */
static StriaeStatus add_scratch(StriaePatternBuilder *builder, const StriaeTool *tool, int index) {
    const double y_mm = (index - (SCRATCH_COUNT - 1) / 2.0) * SPACING_MM;
    const double v = 0.5 + y_mm / PLATE_MM[1], u_margin = 0.5 - 0.5 * LENGTH_MM / PLATE_MM[0];
    const double path_uv[2][2] = {{u_margin, v}, {1.0 - u_margin, v}};
    const double force = FORCE_KGF[index];
    const StriaeKey keys[4] = {{.at = 0.0, .force_kgf = 0.0},
                               {.at = SOFT_END, .force_kgf = force},
                               {.at = 1.0 - SOFT_END, .force_kgf = force},
                               {.at = 1.0, .force_kgf = 0.0}};
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = tool,
                                   .curve = STRIAE_CURVE_POLYLINE,
                                   .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                                   .points_uv = path_uv,
                                   .point_count = 2,
                                   .keys = keys,
                                   .key_count = 4};
    return striae_pattern_builder_add_scratch(builder, &scratch);
}

static StriaeStatus add_scratches(StriaePatternBuilder *builder, const StriaeTool *tool) {
    StriaeStatus status = STRIAE_STATUS_OK;
    for (int i = 0; i < SCRATCH_COUNT && status == STRIAE_STATUS_OK; i++) status = add_scratch(builder, tool, i);
    return status;
}

/* The whole process: material, tool, five scratches. Everything but the pattern is let go of again. */
static StriaeStatus scratch_pattern(StriaePattern **pattern) {
    const StriaePatternOptions options = {.struct_size = sizeof options,
                                          .mm_per_scene_unit = MM_PER_UNIT,
                                          .units_per_uv = {PLATE_MM[0] / MM_PER_UNIT, PLATE_MM[1] / MM_PER_UNIT}};
    StriaeMaterial titanium = {.struct_size = sizeof titanium};
    StriaeTool *tool = NULL;
    StriaePatternBuilder *builder = NULL;

    StriaeStatus status = striae_material_metal(STRIAE_METAL_TITANIUM, &titanium);
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &tool);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_new(&titanium, &options, &builder);
    if (status == STRIAE_STATUS_OK) status = add_scratches(builder, tool);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_build(builder, pattern);
    striae_pattern_builder_free(builder);
    striae_tool_release(tool);
    return status;
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

/* A flash beside the camera, and a dim large soft box across the scene, both of which go where the camera goes. */
static void add_lamps(const Scene *scene, const Camera *camera, Lights *lights) {
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
    lights_add(lights, &flash);

    /* About where a mirror in the plate's place would show it to the camera, so that it gives the metal its sheen. */
    const Lamp soft_box = {.centre = lamp_place(scene, camera, 200.0, 72.0, distance),
                           .towards = scene->target,
                           .width = 0.9 * distance,
                           .height = 0.6 * distance,
                           .columns = 5,
                           .rows = 3,
                           .radiance = {0.15, 0.18, 0.23},
                           .fade = 0.1};
    lights_add(lights, &soft_box);

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
        lights_add(lights, &room);
    }
}

/* Aimed so far beside the plate's middle, in mm along its sides, that it stands in the picture's. */
static View view(const char *name, double heading_deg, double elevation_deg, double roll_deg, double width_deg,
                 double x_mm, double y_mm) {
    return (View){.name = name,
                  .heading_deg = heading_deg,
                  .elevation_deg = elevation_deg,
                  .roll_deg = roll_deg,
                  .distance = 14.0,
                  .width_deg = width_deg,
                  .aside = {x_mm / MM_PER_UNIT, y_mm / MM_PER_UNIT, 0.0}};
}

bool scene_plate(Scene *scene, char error[SCENE_ERROR_SIZE]) {
    scene->mm_per_unit = MM_PER_UNIT;
    scene->target = vec(0.0, 0.0, PLATE_MM[2] / MM_PER_UNIT);
    scene->judged_face = SLAB_TOP;
    scene->exposure = 1.3;
    /* Camera and flash go round the plate together. First they look along the scratches, which throw the flash
       aside; then across them and from high up, so that even the weakest is steep enough to throw it back; then
       from the other side and lower, where the weakest is not. */
    scene->views[0] = view("plate-1", -20.0, 66.0, 60.0, 37.0, 2.8, -2.1);
    scene->views[1] = view("plate-2", 84.0, 71.0, -12.0, 35.0, 1.6, 1.4);
    scene->views[2] = view("plate-3", -89.0, 65.0, -8.0, 35.0, -1.6, -2.3);
    scene->view_count = 3;
    scene->sheet = "contact-sheet";
    scene->add_lamps = add_lamps;

    StriaePattern *pattern = NULL;
    if (scratch_pattern(&pattern) != STRIAE_STATUS_OK) {
        snprintf(error, SCENE_ERROR_SIZE, "%s", striae_last_error());
        return false;
    }
    scene->mesh_count = 2;
    const Slab plate = {{PLATE_MM[0], PLATE_MM[1], PLATE_MM[2]}, 0.5, MM_PER_UNIT};
    Mesh *ground = &scene->meshes[1];
    const bool built = slab_mesh(&scene->meshes[0], &plate) && prop_table(ground, 400.0, 0.0);
    scene->meshes[0].pattern = pattern;
    const double dark[3] = {0.030, 0.032, 0.036};
    for (int c = 0; c < 3; c++) ground->albedo[c] = dark[c];
    if (!built) snprintf(error, SCENE_ERROR_SIZE, "out of memory");
    return built;
}
