#include "curves.h"

enum { LOOPS = 5, LOOP_POINTS = 57, BOWS = 7, STROKES = 4 };

typedef struct Hand {
    StriaePatternBuilder *builder;
    StriaeTool *tool;
} Hand;

static bool draw(const Hand *hand, const double (*points_uv)[2], size_t count) {
    const StriaeKey keys[1] = {{.at = 0.0, .force_kgf = PLATE_FORCE_KGF}};
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = hand->tool,
                                   .curve = STRIAE_CURVE_CATMULL_ROM,
                                   .depth_law = STRIAE_DEPTH_LAW_SCRATCH_HARDNESS,
                                   .points_uv = points_uv,
                                   .point_count = count,
                                   .keys = keys,
                                   .key_count = 1};
    return striae_pattern_builder_add_scratch(hand->builder, &scratch) == STRIAE_STATUS_OK;
}

/* Round and round while the hand goes on to the right, as in writing. */
static bool draw_loops(const Hand *hand, double u, double v) {
    double points[LOOP_POINTS][2];
    for (int i = 0; i < LOOP_POINTS; i++) {
        const double share = (double)i / (LOOP_POINTS - 1), angle = 2.0 * PI * LOOPS * share;
        points[i][0] = u + 0.42 * share + 0.055 * sin(angle);
        points[i][1] = v + 0.03 * share - (0.075 + 0.015 * sin(7.0 * share)) * cos(angle);
    }
    return draw(hand, (const double (*)[2])points, LOOP_POINTS);
}

static bool draw_bow(const Hand *hand, int number) {
    const double v = 0.08 + 0.035 * number, sag = 0.10 + 0.015 * number;
    const double points[5][2] = {
        {0.10, v}, {0.30, v + 0.7 * sag}, {0.52, v + sag}, {0.72, v + 0.75 * sag}, {0.93, v + 0.1 * sag}};
    return draw(hand, points, 5);
}

static bool draw_stroke(const Hand *hand, int number) {
    const double u = 0.62 + 0.06 * number, lean = 0.12 - 0.05 * number;
    const double points[3][2] = {{u, 0.45}, {u + 0.5 * lean + 0.01, 0.68}, {u + lean, 0.93}};
    return draw(hand, points, 3);
}

static bool draw_all(const Hand *hand) {
    bool drawn = draw_loops(hand, 0.12, 0.55) && draw_loops(hand, 0.20, 0.78);
    for (int i = 0; i < BOWS && drawn; i++) drawn = draw_bow(hand, i);
    for (int i = 0; i < STROKES && drawn; i++) drawn = draw_stroke(hand, i);
    return drawn;
}

bool curves_scratch(Plate *plate) {
    const StriaeMaterial titanium = plate_material();
    const StriaePatternOptions options = {.struct_size = sizeof options,
                                          .mm_per_scene_unit = 1.0,
                                          .units_per_uv = {plate->width_mm, plate->height_mm}};
    Hand hand = {0};
    StriaePattern *pattern = NULL;
    const bool made = striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &hand.tool) == STRIAE_STATUS_OK &&
                      striae_pattern_builder_new(&titanium, &options, &hand.builder) == STRIAE_STATUS_OK &&
                      draw_all(&hand) && striae_pattern_builder_build(hand.builder, &pattern) == STRIAE_STATUS_OK;
    striae_pattern_builder_free(hand.builder);
    striae_tool_release(hand.tool);
    plate_set_pattern(plate, pattern);
    return made;
}
