#include "plate.h"

#include <stdio.h>

#include "progress.h"

const double PLATE_FORCE_KGF = 0.25;

static const uint64_t SEED = 2004;

StriaeMaterial plate_material(void) {
    StriaeMaterial titanium = {.struct_size = sizeof titanium};
    striae_material_metal(STRIAE_METAL_TITANIUM, &titanium);
    titanium.surface = (StriaeBrdf){.kind = STRIAE_BRDF_KIND_GGX, .alpha = 0.1f, .f0 = {0.60f, 0.57f, 0.52f}};
    titanium.scratched = titanium.surface;
    return titanium;
}

static bool lay_flat(Plate *plate) {
    Mesh *mesh = &plate->scene.meshes[0];
    const double x = 0.5 * plate->width_mm, y = 0.5 * plate->height_mm;
    const Vec corners[4] = {vec(-x, -y, 0), vec(x, -y, 0), vec(x, y, 0), vec(-x, y, 0)};
    double uv[4][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    if (!mesh_init(mesh, 1)) return false;
    mesh_add_quad(mesh, 1, corners, uv);
    plate->scene.mesh_count = 1;
    return true;
}

bool plate_init(Plate *plate, double width_mm, int width, char error[SCENE_ERROR_SIZE]) {
    *plate = (Plate){.width_mm = width_mm,
                     .height_mm = 0.75 * width_mm,
                     .metal = plate_material().surface,
                     .scene = {.name = "plate", .mm_per_unit = 1.0, .judged_face = 1},
                     .view = {.name = "plate",
                              .heading_deg = -90.0,
                              .elevation_deg = 65.0,
                              .distance = 2.3 * width_mm,
                              .width_deg = 20.0},
                     .lamp_elevation_deg = 52.0,
                     .width = width,
                     .height = width * 3 / 4};
    plate->camera = camera_for_view(&plate->scene, &plate->view, plate->width, plate->height);
    plate_light(plate, 1);
    if (!lay_flat(plate)) {
        snprintf(error, SCENE_ERROR_SIZE, "out of memory");
        return false;
    }
    plate->tracer = tracer_new(&plate->scene, error);
    return plate->tracer != NULL;
}

void plate_light(Plate *plate, int across) {
    const double heading = radians(70.0), up = radians(plate->lamp_elevation_deg), distance = 4.0 * plate->width_mm,
                 side = 0.2 * distance;
    const Vec middle =
        vec(distance * cos(up) * cos(heading), distance * cos(up) * sin(heading), distance * sin(up));
    const Vec right = vec(-sin(heading), cos(heading), 0.0), above = vec_cross(vec_unit(middle), right);
    plate->lamp_count = across * across;
    for (int i = 0; i < plate->lamp_count; i++) {
        const double a = (i % across + 0.5) / across - 0.5, b = (i / across + 0.5) / across - 0.5;
        plate->lamps[i] = vec_along(vec_along(middle, a * side, right), b * side, above);
    }
    plate->intensity = PI * distance * distance / plate->lamp_count;
}

void plate_set_pattern(Plate *plate, StriaePattern *pattern) {
    striae_pattern_release(plate->pattern);
    plate->pattern = pattern;
}

static StriaeGenerator straight(unsigned count) {
    StriaeGenerator generator = {.struct_size = sizeof generator};
    striae_generator_preset(STRIAE_STYLE_STRAIGHT, &generator);
    generator.count = count;
    generator.force_kgf = (StriaeDistribution){
        .kind = STRIAE_DISTRIBUTION_KIND_UNIFORM, .from = PLATE_FORCE_KGF, .to = PLATE_FORCE_KGF};
    generator.depth_law = STRIAE_DEPTH_LAW_SCRATCH_HARDNESS;
    generator.taper[0] = generator.taper[1] = 0.0;
    return generator;
}

bool plate_scratch(Plate *plate, unsigned count) {
    const double started = seconds_now();
    const StriaeMaterial titanium = plate_material();
    const StriaePatternOptions options = {.struct_size = sizeof options,
                                          .mm_per_scene_unit = 1.0,
                                          .units_per_uv = {plate->width_mm, plate->height_mm}};
    const StriaeGenerator generator = straight(count);
    StriaeTool *pyramid = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaePattern *pattern = NULL;
    bool made = striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &pyramid) == STRIAE_STATUS_OK &&
                striae_pattern_builder_new(&titanium, &options, &builder) == STRIAE_STATUS_OK;
    if (count > 0)
        made =
            made && striae_pattern_builder_generate(builder, &generator, pyramid, NULL, SEED) == STRIAE_STATUS_OK;
    made = made && striae_pattern_builder_build(builder, &pattern) == STRIAE_STATUS_OK;
    striae_pattern_builder_free(builder);
    striae_tool_release(pyramid);
    plate_set_pattern(plate, pattern);
    plate->build_seconds = seconds_now() - started;
    return made;
}

void plate_free(Plate *plate) {
    tracer_free(plate->tracer);
    scene_free(&plate->scene);
    striae_pattern_release(plate->pattern);
    *plate = (Plate){0};
}

bool plate_two_angles(StriaeTwoAngles *scratch) {
    const StriaeMaterial titanium = plate_material();
    const StriaeProcess process = {.struct_size = sizeof process,
                                   .depth_law = STRIAE_DEPTH_LAW_SCRATCH_HARDNESS,
                                   .force_kgf = PLATE_FORCE_KGF};
    StriaeCrossSectionInfo info = {.struct_size = sizeof info};
    StriaeTool *pyramid = NULL;
    StriaeCrossSection *section = NULL;
    bool known = striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &pyramid) == STRIAE_STATUS_OK &&
                 striae_cross_section(pyramid, &titanium, &process, &section) == STRIAE_STATUS_OK &&
                 striae_cross_section_info(section, &info) == STRIAE_STATUS_OK;
    if (known) {
        const double fall = info.depth_mm + info.left.height_mm;
        *scratch = (StriaeTwoAngles){
            .struct_size = sizeof *scratch,
            .width_mm = info.crest_width_mm + info.left.outer_width_mm + info.right.outer_width_mm,
            .peak_deg = atan(info.left.height_mm / info.left.outer_width_mm) * (180.0 / PI),
            .groove_deg = atan(fall / (0.5 * info.crest_width_mm)) * (180.0 / PI),
            .zones = {titanium.scratched, titanium.scratched, titanium.scratched, titanium.scratched}};
    }
    striae_cross_section_release(section);
    striae_tool_release(pyramid);
    return known;
}

StriaeCanvas plate_canvas(unsigned texels) {
    return (StriaeCanvas){.area_uv = {{0.0, 0.0}, {1.0, 1.0}}, .texels = {texels, texels * 3 / 4}};
}
