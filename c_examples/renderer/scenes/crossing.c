/* The paper's Figure 5, from near: where two scratches cross, and where one ends under force. Scene units are mm. */
#include <stdio.h>

#include "props.h"
#include "scenes.h"

static const double PLATE_MM = 16.0;

/* The crossing's and the end's places, mm from the plate's middle. */
static const double CROSSING_MM[2] = {-4.0, 0.0}, END_MM[2] = {4.0, 0.0};

static StriaeStatus add(const StriaeTool *tool, const double centre_mm[2], double from[2], double to[2],
                        double force_kgf, StriaePatternBuilder *builder) {
    const double points_uv[2][2] = {
        {0.5 + (centre_mm[0] + from[0]) / PLATE_MM, 0.5 + (centre_mm[1] + from[1]) / PLATE_MM},
        {0.5 + (centre_mm[0] + to[0]) / PLATE_MM, 0.5 + (centre_mm[1] + to[1]) / PLATE_MM}};
    const StriaeKey key = {.force_kgf = force_kgf};
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = tool,
                                   .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                                   .points_uv = points_uv,
                                   .point_count = 2,
                                   .keys = &key,
                                   .key_count = 1};
    return striae_pattern_builder_add_scratch(builder, &scratch);
}

static StriaeStatus add_all(const StriaeTool *cone, const StriaeTool *pyramid, StriaePatternBuilder *builder) {
    StriaeStatus status = add(cone, CROSSING_MM, (double[2]){-2.4, -1.5}, (double[2]){2.4, 1.5}, 3.0, builder);
    if (status == STRIAE_STATUS_OK)
        status = add(cone, CROSSING_MM, (double[2]){-2.2, 1.9}, (double[2]){2.2, -1.9}, 3.6, builder);
    if (status == STRIAE_STATUS_OK)
        status = add(pyramid, END_MM, (double[2]){3.0, 0.8}, (double[2]){-0.25, -0.07}, 4.0, builder);
    return status;
}

/* Grooves are cut into as many facets as the smoothest finish asks for that a scratch could reach. A smooth layer that
   none does reach makes them so many that they do not show from as near as this. */
static StriaeStatus make_material(StriaeMaterial *material, StriaeLayer layers[2]) {
    StriaeStatus status = striae_material_metal(STRIAE_METAL_ALUMINIUM, material);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_metal(STRIAE_METAL_ALUMINIUM, 0.20f, &material->surface);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_metal(STRIAE_METAL_ALUMINIUM, 0.15f, &material->scratched);
    layers[0] = (StriaeLayer){.thickness_mm = 1.0, .scratched = material->scratched};
    layers[1] = (StriaeLayer){.thickness_mm = 1.0};
    material->layers = layers;
    material->layer_count = 2;
    return status == STRIAE_STATUS_OK ? striae_brdf_metal(STRIAE_METAL_ALUMINIUM, 0.03f, &layers[1].scratched)
                                      : status;
}

static StriaeStatus make_pattern(StriaePattern **pattern) {
    const StriaePatternOptions options = {sizeof options, 1.0, {PLATE_MM, PLATE_MM}};
    StriaeMaterial aluminium = {.struct_size = sizeof aluminium};
    StriaeLayer layers[2];
    StriaeTool *cone = NULL, *pyramid = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaeStatus status = make_material(&aluminium, layers);
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &cone);
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &pyramid);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_new(&aluminium, &options, &builder);
    if (status == STRIAE_STATUS_OK) status = add_all(cone, pyramid, builder);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_build(builder, pattern);
    striae_pattern_builder_free(builder);
    striae_tool_release(cone);
    striae_tool_release(pyramid);
    return status;
}

/* Dim, and a little lighter where the flat plate mirrors it. */
static void room(Vec direction, double radiance[3]) {
    static const double grey[3] = {0.24, 0.23, 0.22};
    const double up = fmax(0.0, direction.z), behind = fmax(0.0, direction.y);
    for (int c = 0; c < 3; c++) radiance[c] = 0.015 + grey[c] * up * behind * (1.2 - 0.8 * direction.x);
}

/* A lamp from the upper left, as reliefs are lit: what faces it is bright. One fills in from the right, cool and dim. */
static void add_lamps(const Scene *scene, const Camera *camera, Lights *lights) {
    static const double key[3] = {7.0, 6.7, 6.1}, fill[3] = {0.9, 1.0, 1.25};
    (void)scene;
    const Vec aim = vec_along(camera->position, camera->focus, camera->forward);
    prop_soft_box(lights, aim, 138.0, 30.0, 8.0, 3.6, 3.0, key);
    prop_soft_box(lights, aim, 30.0, 34.0, 8.0, 3.0, 4.0, fill);
}

static View near_view(const char *name, const double place_mm[2], double width_deg) {
    return (View){.name = name,
                  .heading_deg = -90.0,
                  .elevation_deg = 58.0,
                  .distance = 5.0,
                  .width_deg = width_deg,
                  .aside = {place_mm[0], place_mm[1], 0.0},
                  .lens_radius = 0.05};
}

bool scene_crossing(Scene *scene, char error[SCENE_ERROR_SIZE]) {
    scene->mm_per_unit = 1.0;
    scene->exposure = 1.0;
    scene->paths = 32;
    scene->add_lamps = add_lamps;
    scene->views[0] = near_view("figure-5-crossing", CROSSING_MM, 25.0);
    scene->views[1] = near_view("figure-5-end", END_MM, 18.0);
    scene->view_count = 2;
    scene->sheet = "figure-5";
    scene->mesh_count = 1;
    snprintf(error, SCENE_ERROR_SIZE, "out of memory");
    Mesh *plate = &scene->meshes[0];
    if (!prop_table(plate, 0.5 * PLATE_MM, 0.0) || !environment_paint(&scene->environment, 64, room)) return false;
    StriaePattern *pattern = NULL;
    if (make_pattern(&pattern) != STRIAE_STATUS_OK) return prop_refused(error);
    plate->pattern = pattern;
    return true;
}
