/* A titanium plate of 60 x 40 units and mm, one scratch along u at v = 0.5: what most tests shade. */
#ifndef TESTS_PLATE_FIXTURE_H
#define TESTS_PLATE_FIXTURE_H
#include "expect.h"

typedef struct Plate {
    StriaeTool *tool;
    StriaeMaterial titanium;
    StriaePatternOptions options;
    double path_uv[2][2];
    StriaeKey keys[2];
    StriaeScratch scratch;
} Plate;

/* Fills `plate` in place: the scratch points into it. */
static inline void plate_init(Plate *plate) {
    *plate = (Plate){
        .titanium = {.struct_size = sizeof plate->titanium},
        .options = {.struct_size = sizeof plate->options, .mm_per_scene_unit = 1.0, .units_per_uv = {60.0, 40.0}},
        .path_uv = {{0.1, 0.5}, {0.9, 0.5}},
        .keys = {{.at = 0.0, .force_kgf = 4.0}, {.at = 1.0, .force_kgf = 1.0}}};
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &plate->tool));
    EXPECT_OK(striae_material_metal(STRIAE_METAL_TITANIUM, &plate->titanium));
    plate->scratch = (StriaeScratch){.struct_size = sizeof plate->scratch,
                                     .tool = plate->tool,
                                     .curve = STRIAE_CURVE_POLYLINE,
                                     .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                                     .points_uv = (const double (*)[2])plate->path_uv,
                                     .point_count = 2,
                                     .keys = plate->keys,
                                     .key_count = 2};
}

/* A builder without scratches. */
static inline StriaePatternBuilder *plate_builder(const Plate *plate) {
    StriaePatternBuilder *builder = NULL;
    EXPECT_OK(striae_pattern_builder_new(&plate->titanium, &plate->options, &builder));
    return builder;
}

static inline StriaePattern *plate_pattern(const Plate *plate) {
    StriaePatternBuilder *builder = plate_builder(plate);
    StriaePattern *pattern = NULL;
    EXPECT_OK(striae_pattern_builder_add_scratch(builder, &plate->scratch));
    EXPECT_OK(striae_pattern_builder_build(builder, &pattern));
    striae_pattern_builder_free(builder);
    return pattern;
}

/* A square pixel of the plate, lying in the world's x-y plane. */
static inline StriaePoint plate_point(double u, double v, double side_mm) {
    return (StriaePoint){.uv = {u, v},
                         .dp_du = {60.0f, 0.0f, 0.0f},
                         .dp_dv = {0.0f, 40.0f, 0.0f},
                         .normal = {0.0f, 0.0f, 1.0f},
                         .footprint = STRIAE_FOOTPRINT_DIFFERENTIALS,
                         .radius = (float)(0.5 * side_mm),
                         .duv_dx = {(float)(side_mm / 60.0), 0.0f},
                         .duv_dy = {0.0f, (float)(side_mm / 40.0)}};
}

/* A pixel of 1 mm, seen from above. */
static inline StriaeShading plate_shading(const StriaePattern *pattern, double u, double v) {
    const StriaePoint point = plate_point(u, v, 1.0);
    const float view[3] = {0.0f, 0.0f, 1.0f};
    StriaeShading shading = {.coverage = -1.0f};
    EXPECT_OK(striae_shade(pattern, &point, view, &shading));
    return shading;
}

/* The same pixel of what a builder holds so far. */
static inline StriaeShading plate_built_shading(const StriaePatternBuilder *builder, double u, double v) {
    StriaePattern *pattern = NULL;
    EXPECT_OK(striae_pattern_builder_build(builder, &pattern));
    const StriaeShading shading = plate_shading(pattern, u, v);
    striae_pattern_release(pattern);
    return shading;
}
#endif
