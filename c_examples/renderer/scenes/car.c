/* The paper's Figure 12: a scratched metal part of a car. Painted: its deep scratches run through clear colour and primer
   to the steel. Scene units are mm. */
#include <stdio.h>

#include "paint.h"
#include "props.h"
#include "scenes.h"

enum { FACE_PANEL = 1, STROKES = 5, MOST_POINTS = 6, MOST_KEYS = 6 };

static const double PANEL_MM[2] = {260.0, 200.0};

static Paint red = {.albedo = {0.26f, 0.008f, 0.010f}, .alpha = 0.03f};

/* A long crease, above which the panel is all but level and below which it falls away; a wide dome all over. */
static double height_at(double x, double y) {
    const double crease = 9.0 + 0.10 * x + 0.0006 * x * x, round = 5.0;
    const double below = (crease - y) / round, ramp = below > 30.0 ? below : log1p(exp(below));
    return -0.62 * round * ramp - 0.0016 * y * y - 0.0007 * x * x;
}

static void panel_place(double u, double v, const void *user, Vec *position, Vec *normal) {
    (void)user;
    const double x = (u - 0.5) * PANEL_MM[0], y = (v - 0.5) * PANEL_MM[1], h = 1e-3;
    const double slope_x = (height_at(x + h, y) - height_at(x - h, y)) / (2.0 * h);
    const double slope_y = (height_at(x, y + h) - height_at(x, y - h)) / (2.0 * h);
    *position = vec(x, y, height_at(x, y));
    *normal = vec_unit(vec(-slope_x, -slope_y, 1.0));
}

/* A deliberate scratch: mm on the panel seen from above, kgf along the way. */
typedef struct Stroke {
    uint32_t tool;
    double points_mm[MOST_POINTS][2];
    size_t point_count;
    double forces[MOST_KEYS][2];
    size_t force_count;
} Stroke;

static const Stroke strokes[STROKES] = {
    {STRIAE_TOOL_PRESET_KEY,
     {{-52.0, 22.0}, {-30.0, 15.5}, {-8.0, 12.0}, {14.0, 4.0}, {34.0, -5.0}, {50.0, -9.0}},
     6,
     {{0.0, 0.0}, {0.08, 3.6}, {0.35, 6.4}, {0.6, 4.6}, {0.8, 6.8}, {1.0, 0.0}},
     6},
    {STRIAE_TOOL_PRESET_KEY,
     {{-46.0, 17.0}, {-24.0, 10.6}, {-4.0, 8.4}, {12.0, 1.0}, {24.0, -5.5}},
     5,
     {{0.0, 0.0}, {0.15, 1.8}, {0.5, 3.4}, {0.8, 2.0}, {1.0, 0.0}},
     5},
    {STRIAE_TOOL_PRESET_SCRIBER,
     {{-18.0, -24.0}, {-10.0, -12.0}, {-4.5, 2.0}, {-2.0, 18.0}},
     4,
     {{0.0, 0.0}, {0.2, 1.2}, {0.7, 1.9}, {1.0, 0.0}},
     4},
    {STRIAE_TOOL_PRESET_SCRIBER,
     {{26.0, 30.0}, {33.0, 20.0}, {38.0, 9.0}},
     3,
     {{0.0, 0.0}, {0.4, 1.6}, {1.0, 0.0}},
     3},
    {STRIAE_TOOL_PRESET_NAIL,
     {{-40.0, -17.0}, {-34.0, -16.0}, {-27.5, -17.5}},
     3,
     {{0.0, 3.0}, {0.5, 4.2}, {1.0, 0.0}},
     3},
};

static StriaeStatus add_stroke(const Stroke *stroke, StriaePatternBuilder *builder) {
    double points_uv[MOST_POINTS][2];
    StriaeKey keys[MOST_KEYS];
    StriaeTool *tool = NULL;
    for (size_t i = 0; i < stroke->point_count; i++)
        for (int axis = 0; axis < 2; axis++) points_uv[i][axis] = 0.5 + stroke->points_mm[i][axis] / PANEL_MM[axis];
    for (size_t i = 0; i < stroke->force_count; i++)
        keys[i] = (StriaeKey){.at = stroke->forces[i][0], .force_kgf = stroke->forces[i][1]};
    StriaeStatus status = striae_tool_preset(stroke->tool, &tool);
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = tool,
                                   .curve = STRIAE_CURVE_CATMULL_ROM,
                                   .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                                   .points_uv = (const double (*)[2])points_uv,
                                   .point_count = stroke->point_count,
                                   .keys = keys,
                                   .key_count = stroke->force_count};
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_add_scratch(builder, &scratch);
    striae_tool_release(tool);
    return status;
}

/* What years of washing leave in the clear coat. */
static StriaeStatus add_wear(StriaePatternBuilder *builder) {
    StriaeGenerator swirls = {.struct_size = sizeof swirls};
    StriaeTool *grain = NULL;
    StriaeStatus status = striae_generator_preset(STRIAE_STYLE_HANDLING, &swirls);
    swirls.per_cm2 = 1.0;
    swirls.length_mm.from = 3.0;
    swirls.force_kgf.from = 4e-4;
    swirls.force_kgf.to = 0.1;
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_ABRASIVE_GRAIN, &grain);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_generate(builder, &swirls, grain, NULL, 12);
    striae_tool_release(grain);
    return status;
}

/* Paint as soft as paint is, ploughed up matte and pale; under it grey primer, then bright steel. */
static StriaeStatus painted_steel(StriaeMaterial *material, StriaeLayer layers[2]) {
    static const float pale[3] = {0.40f, 0.13f, 0.12f}, grey[3] = {0.42f, 0.41f, 0.39f};
    const StriaeHostBrdf paint = paint_host(&red);
    StriaeStatus status = striae_material_metal(STRIAE_METAL_STEEL, material);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_host(&paint, &material->surface);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_metal(STRIAE_METAL_STEEL, 0.28f, &material->scratched);
    layers[0] = (StriaeLayer){.thickness_mm = 0.035};
    layers[1] = (StriaeLayer){.thickness_mm = 0.022};
    if (status == STRIAE_STATUS_OK) status = striae_brdf_lambert(pale, &layers[0].scratched);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_lambert(grey, &layers[1].scratched);
    material->hardness_hv = 20.0;
    material->pile_up_fraction = 0.6;
    material->layers = layers;
    material->layer_count = 2;
    return status;
}

static StriaeStatus car_pattern(StriaePattern **pattern) {
    const StriaePatternOptions options = {sizeof options, 1.0, {PANEL_MM[0], PANEL_MM[1]}};
    StriaeMaterial steel = {.struct_size = sizeof steel};
    StriaeLayer layers[2];
    StriaePatternBuilder *builder = NULL;
    StriaeStatus status = painted_steel(&steel, layers);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_new(&steel, &options, &builder);
    if (status == STRIAE_STATUS_OK) status = add_wear(builder);
    for (int i = 0; i < STROKES && status == STRIAE_STATUS_OK; i++) status = add_stroke(&strokes[i], builder);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_build(builder, pattern);
    striae_pattern_builder_free(builder);
    return status;
}

/* An evening outdoors: a bright horizon, a dark ground, a deep sky. */
static void evening(Vec direction, double radiance[3]) {
    static const double horizon[3] = {1.05, 0.86, 0.66}, sky[3] = {0.10, 0.17, 0.34},
                        ground[3] = {0.035, 0.032, 0.03};
    const double glow = exp(-7.0 * fmax(0.0, direction.z)), west = 0.35 + 0.65 * pow(0.5 + 0.5 * direction.y, 2.0);
    const double edge = fmin(1.0, fmax(0.0, 0.5 + 12.0 * direction.z));
    for (int c = 0; c < 3; c++) radiance[c] = edge * (sky[c] + glow * west * horizon[c]) + (1.0 - edge) * ground[c];
}

/* Long lamps overhead, as in a workshop: their edges show how the panel bends. */
static void add_lamps(const Scene *scene, const Camera *camera, Lights *lights) {
    static const double tube[3] = {5.0, 4.9, 4.7}, dim[3] = {2.2, 2.3, 2.5}, low[3] = {7.0, 6.7, 6.2};
    (void)camera;
    prop_soft_box(lights, scene->target, 96.0, 66.0, 700.0, 900.0, 90.0, tube);
    prop_soft_box(lights, scene->target, 84.0, 40.0, 800.0, 900.0, 70.0, dim);
    /* From behind the camera's left: what the panel does not show, and the long scratches' walls do. */
    prop_soft_box(lights, scene->target, -166.0, 46.0, 600.0, 260.0, 240.0, low);
}

bool scene_car(Scene *scene, char error[SCENE_ERROR_SIZE]) {
    scene->mm_per_unit = 1.0;
    scene->target = vec(0.0, 2.0, -6.0);
    scene->exposure = 1.0;
    scene->paths = 128;
    scene->most_indirect = 3.0;
    scene->add_lamps = add_lamps;
    scene->views[0] = (View){.name = "figure-12",
                             .heading_deg = -78.0,
                             .elevation_deg = 40.0,
                             .distance = 330.0,
                             .width_deg = 14.0,
                             .lens_radius = 2.2};
    scene->view_count = 1;
    scene->mesh_count = 1;
    snprintf(error, SCENE_ERROR_SIZE, "out of memory");
    Mesh *panel = &scene->meshes[0];
    if (!mesh_init_grid(panel, FACE_PANEL, 260, 200, panel_place, NULL) ||
        !environment_paint(&scene->environment, 256, evening))
        return false;
    StriaePattern *pattern = NULL;
    if (car_pattern(&pattern) != STRIAE_STATUS_OK) return prop_refused(error);
    panel->pattern = pattern;
    return true;
}
