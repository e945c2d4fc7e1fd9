/* The paper's Figure 11: an aluminium plate scratched by hand with a nail, five times, pressed more and less along the way. */
#include <stdio.h>

#include "props.h"
#include "scenes.h"
#include "slab.h"

enum { STROKES = 5, MOST_POINTS = 7, MOST_KEYS = 10 };

static const Slab PLATE = {{72.0, 46.0, 2.0}, 0.4, 10.0};

/* One stroke of the hand, from the far edge towards the viewer: mm from the plate's middle, and kgf along the way. */
typedef struct Stroke {
    double points_mm[MOST_POINTS][2];
    size_t point_count;
    double forces[MOST_KEYS][2]; /* where along the path, how much */
    size_t force_count;
} Stroke;

/* The paper says of them: the first and the fourth nearly constant and not high; the second and the fifth stronger, and
   less at the end; the third different all along. */
static const Stroke strokes[STROKES] = {
    {{{-27.5, 15.0}, {-26.1, 8.2}, {-25.3, 1.0}, {-25.6, -6.8}, {-24.2, -14.5}},
     5,
     {{0.0, 0.0}, {0.03, 0.62}, {0.3, 0.7}, {0.6, 0.6}, {0.97, 0.68}, {1.0, 0.0}},
     6},
    {{{-16.5, 17.0}, {-14.0, 11.5}, {-12.8, 4.4}, {-13.9, -3.8}, {-12.3, -11.0}, {-9.5, -16.6}},
     6,
     {{0.0, 2.6}, {0.12, 3.4}, {0.45, 3.6}, {0.68, 2.9}, {0.85, 1.2}, {1.0, 0.0}},
     6},
    {{{-1.5, 16.2}, {1.8, 11.8}, {0.6, 6.0}, {-2.6, 0.4}, {-1.8, -6.2}, {2.2, -10.9}, {1.2, -16.8}},
     7,
     {{0.0, 0.0}, {0.06, 1.4}, {0.2, 3.3}, {0.32, 0.7}, {0.45, 0.5}, {0.58, 3.8}, {0.7, 2.2}, {0.8, 0.5}, {0.9, 2.4}, {1.0, 0.0}},
     10},
    {{{12.0, 15.8}, {12.6, 9.0}, {14.4, 1.8}, {14.0, -6.0}, {15.6, -15.2}},
     5,
     {{0.0, 0.0}, {0.04, 0.8}, {0.35, 0.9}, {0.65, 0.78}, {0.96, 0.85}, {1.0, 0.0}},
     6},
    {{{24.5, 16.6}, {27.0, 10.4}, {26.6, 3.6}, {24.4, -3.0}, {25.6, -10.2}, {28.4, -15.8}},
     6,
     {{0.0, 3.0}, {0.15, 4.0}, {0.5, 4.2}, {0.7, 3.2}, {0.88, 1.1}, {1.0, 0.0}},
     6},
};

static StriaeStatus add_stroke(const Stroke *stroke, const StriaeTool *nail, StriaePatternBuilder *builder) {
    double points_uv[MOST_POINTS][2];
    StriaeKey keys[MOST_KEYS];
    for (size_t i = 0; i < stroke->point_count; i++)
        for (int axis = 0; axis < 2; axis++)
            points_uv[i][axis] = 0.5 + stroke->points_mm[i][axis] / PLATE.size_mm[axis];
    for (size_t i = 0; i < stroke->force_count; i++)
        keys[i] = (StriaeKey){.at = stroke->forces[i][0], .force_kgf = stroke->forces[i][1]};
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = nail,
                                   .curve = STRIAE_CURVE_CATMULL_ROM,
                                   .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                                   .points_uv = (const double (*)[2])points_uv,
                                   .point_count = stroke->point_count,
                                   .keys = keys,
                                   .key_count = stroke->force_count};
    return striae_pattern_builder_add_scratch(builder, &scratch);
}

/* Rolled sheet: lines along its length, which spread light across. */
static StriaeStatus rolled_aluminium(StriaeMaterial *material) {
    StriaeStatus status = striae_material_metal(STRIAE_METAL_ALUMINIUM, material);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_metal(STRIAE_METAL_ALUMINIUM, 0.16f, &material->surface);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_metal(STRIAE_METAL_ALUMINIUM, 0.13f, &material->scratched);
    material->surface.kind = STRIAE_BRDF_KIND_ANISOTROPIC_GGX;
    material->surface.alpha_across = 0.20f;
    material->surface.alpha_along = 0.12f;
    return status;
}

static StriaeStatus aluminium_pattern(StriaePattern **pattern) {
    const StriaePatternOptions options = {
        sizeof options, PLATE.mm_per_unit, {PLATE.size_mm[0] / PLATE.mm_per_unit, PLATE.size_mm[1] / PLATE.mm_per_unit}};
    StriaeMaterial aluminium = {.struct_size = sizeof aluminium};
    StriaeTool *nail = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaeStatus status = rolled_aluminium(&aluminium);
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_NAIL, &nail);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_new(&aluminium, &options, &builder);
    for (int i = 0; i < STROKES && status == STRIAE_STATUS_OK; i++) status = add_stroke(&strokes[i], nail, builder);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_build(builder, pattern);
    striae_pattern_builder_free(builder);
    striae_tool_release(nail);
    return status;
}

/* Grey from behind the plate, which its flat parts mirror, and dark elsewhere. */
static void room(Vec direction, double radiance[3]) {
    static const double grey[3] = {0.36, 0.40, 0.47};
    const double up = fmax(0.0, direction.z), behind = fmax(0.0, direction.y), right = 0.5 + 0.5 * direction.x;
    for (int c = 0; c < 3; c++) radiance[c] = 0.02 + grey[c] * up * behind * (0.35 + 1.1 * right * right);
}

/* To both sides: where the scratches' walls mirror to the camera, and the flat parts do not. */
static void add_lamps(const Scene *scene, const Camera *camera, Lights *lights) {
    static const double right[3] = {7.0, 6.6, 6.0}, left[3] = {3.4, 3.7, 4.2};
    (void)camera;
    prop_soft_box(lights, scene->target, 34.0, 24.0, 14.0, 5.0, 4.0, right);
    prop_soft_box(lights, scene->target, 146.0, 24.0, 14.0, 5.0, 4.0, left);
}

bool scene_aluminium(Scene *scene, char error[SCENE_ERROR_SIZE]) {
    scene->mm_per_unit = PLATE.mm_per_unit;
    scene->target = vec(0.0, 0.0, PLATE.size_mm[2] / PLATE.mm_per_unit);
    scene->exposure = 1.0;
    scene->paths = 96;
    scene->most_indirect = 2.0;
    scene->add_lamps = add_lamps;
    scene->views[0] = (View){.name = "figure-11",
                             .heading_deg = -84.0,
                             .elevation_deg = 52.0,
                             .distance = 16.0,
                             .width_deg = 30.0,
                             .aside = {0.0, -0.1, 0.0},
                             .lens_radius = 0.06};
    scene->view_count = 1;
    scene->mesh_count = 2;
    snprintf(error, SCENE_ERROR_SIZE, "out of memory");
    Mesh *plate = &scene->meshes[0], *table = &scene->meshes[1];
    if (!slab_mesh(plate, &PLATE) || !prop_table(table, 400.0, 0.0) || !environment_paint(&scene->environment, 128, room))
        return false;
    for (int c = 0; c < 3; c++) table->albedo[c] = 0.09;
    StriaePattern *pattern = NULL;
    if (aluminium_pattern(&pattern) != STRIAE_STATUS_OK) return prop_refused(error);
    plate->pattern = pattern;
    return true;
}
