#include "scratched_plate.h"

/* Far more than any picture shows. */
static const double PLATE_MM = 8.0;

enum { KEY_COUNT = 12 };

/* Full force up to somewhat below the picture's middle, then less and less. */
static void add_keys(const Cell *cell, StriaeKey keys[KEY_COUNT]) {
    for (int i = 0; i < KEY_COUNT; i++) {
        const double t = 1.0 - (double)i / (KEY_COUNT - 1);
        keys[i] = (StriaeKey){.at = 1.0 - 0.65 * t,
                              .force_kgf = cell->force_kgf * t * t * (3.0 - 2.0 * t),
                              .tilt_deg = cell->tilt_deg,
                              .azimuth_deg = cell->azimuth_deg};
    }
}

/* From below the picture straight up, then bending away. At the picture's lower edge its cross-section is the one that
   is drawn there. */
static StriaeStatus add_scratch(const Shot *shot, const StriaeTool *tool, StriaePatternBuilder *builder) {
    const double across = shot->group->across_mm / PLATE_MM, tall = across * shot->height / shot->width;
    const double u = 0.5 - shot->middle_mm / PLATE_MM;
    const double points_uv[4][2] = {
        {u, 0.5 - 0.6 * tall}, {u, 0.5 - 0.2 * tall}, {u, 0.5 + 0.1 * tall}, {u - 0.1 * across, 0.5 + 0.38 * tall}};
    StriaeKey keys[KEY_COUNT];
    add_keys(shot->cell, keys);
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = tool,
                                   .curve = STRIAE_CURVE_CUBIC_BEZIER,
                                   .depth_law = cell_process(shot->cell).depth_law,
                                   .points_uv = points_uv,
                                   .point_count = 4,
                                   .keys = keys,
                                   .key_count = KEY_COUNT};
    return striae_pattern_builder_add_scratch(builder, &scratch);
}

/* Grooves are cut into as many facets as the smoothest finish asks for that a scratch could reach. A smooth layer that
   none does reach makes them so many that they do not show from as near as this. */
static StriaeStatus add_smooth_layer(const Group *group, StriaeMaterial *material, StriaeLayer layers[2]) {
    layers[0] = (StriaeLayer){.thickness_mm = 1.0, .scratched = material->scratched};
    layers[1] = (StriaeLayer){.thickness_mm = 1.0};
    material->layers = layers;
    material->layer_count = 2;
    return striae_brdf_metal(group->metal, 0.04f, &layers[1].scratched);
}

static StriaeStatus make_pattern(const Shot *shot, StriaePattern **pattern) {
    const StriaePatternOptions options = {sizeof options, 1.0, {PLATE_MM, PLATE_MM}};
    StriaeMaterial material;
    StriaeLayer layers[2];
    StriaeTool *tool = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaeStatus status = cell_material(shot->group, shot->cell, &material);
    if (status == STRIAE_STATUS_OK) status = add_smooth_layer(shot->group, &material, layers);
    if (status == STRIAE_STATUS_OK) status = shot->cell->make_tool(&tool);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_new(&material, &options, &builder);
    if (status == STRIAE_STATUS_OK) status = add_scratch(shot, tool, builder);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_build(builder, pattern);
    striae_pattern_builder_free(builder);
    striae_tool_release(tool);
    return status;
}

const char *scratched_plate(const Shot *shot, Scene *scene) {
    StriaePattern *pattern = NULL;
    *scene = (Scene){.name = shot->cell->name, .mm_per_unit = 1.0, .mesh_count = 1};
    if (make_pattern(shot, &pattern) != STRIAE_STATUS_OK) return striae_last_error();
    Mesh *mesh = &scene->meshes[0];
    if (!mesh_init(mesh, 1)) {
        striae_pattern_release(pattern);
        return "out of memory";
    }
    const double h = 0.5 * PLATE_MM;
    const Vec corners[4] = {vec(-h, -h, 0), vec(h, -h, 0), vec(h, h, 0), vec(-h, h, 0)};
    double uv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh_add_quad(mesh, 1, corners, uv);
    mesh->pattern = pattern;
    return NULL;
}
