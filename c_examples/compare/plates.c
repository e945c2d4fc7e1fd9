#include "plates.h"

#include <math.h>
#include <string.h>

#include "random.h"

/* Scratches reach so many scratch widths from the middle: farther than is seen from the greatest distance. */
static const double REACH = 320.0, VIEW = 210.0;
static const double FORCE_KGF = 2.0;
enum { STROKES = 700 };

typedef struct Workshop {
    StriaePatternBuilder *builder;
    StriaeTool *tools[2];
    double width_mm;
} Workshop;

static StriaeMaterial material(bool is_matte) {
    StriaeMaterial metal = {.struct_size = sizeof metal};
    striae_material_metal(STRIAE_METAL_TITANIUM, &metal);
    StriaeBrdf surface = {.kind = STRIAE_BRDF_KIND_GGX, .alpha = 0.25f, .f0 = {0.60f, 0.57f, 0.52f}};
    StriaeBrdf scratched = {.kind = STRIAE_BRDF_KIND_GGX, .alpha = 0.15f, .f0 = {0.75f, 0.72f, 0.68f}};
    if (is_matte) {
        surface = (StriaeBrdf){.kind = STRIAE_BRDF_KIND_LAMBERT, .albedo = {0.30f, 0.32f, 0.40f}};
        scratched = (StriaeBrdf){.kind = STRIAE_BRDF_KIND_LAMBERT, .albedo = {0.85f, 0.80f, 0.70f}};
    }
    metal.surface = surface;
    metal.scratched = scratched;
    return metal;
}

/* One stroke, its points in scratch widths. */
static bool add(const Workshop *shop, int tool, uint32_t curve, const double (*points)[2], size_t count,
                const StriaeKey *keys, size_t key_count) {
    double points_mm[8][2];
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 2; axis++) points_mm[i][axis] = points[i][axis] * shop->width_mm;
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = shop->tools[tool],
                                   .curve = curve,
                                   .depth_law = STRIAE_DEPTH_LAW_SCRATCH_HARDNESS,
                                   .points_uv = (const double (*)[2])points_mm,
                                   .point_count = count,
                                   .keys = keys,
                                   .key_count = key_count};
    return striae_pattern_builder_add_scratch(shop->builder, &scratch) == STRIAE_STATUS_OK;
}

/* Long bows side by side, like a grinding disc's: none meets another, all go on beyond what is seen. */
static bool add_bows(const Workshop *shop) {
    uint32_t random = 7;
    double beside = -REACH;
    while (beside < REACH) {
        const double share = 0.5 + next_random(&random), sag = 150.0;
        const double points[4][2] = {{-1.2 * REACH, beside - sag},
                                     {-0.4 * REACH, beside + sag / 3.0},
                                     {0.4 * REACH, beside + sag / 3.0},
                                     {1.2 * REACH, beside - sag}};
        const StriaeKey keys[2] = {{.at = 0.0, .force_kgf = share * FORCE_KGF},
                                   {.at = 1.0, .force_kgf = (2.0 - share) * FORCE_KGF}};
        if (!add(shop, 0, STRIAE_CURVE_CUBIC_BEZIER, points, 4, keys, 2)) return false;
        beside += 1.6 + 5.0 * next_random(&random) * next_random(&random);
    }
    return true;
}

/* Strokes every which way, hard and soft ends in turn, and a knot of them in the middle for the nearest view. */
static bool add_strokes(const Workshop *shop) {
    static const double knot[5][4] = {{-30.0, -1.5, 28.0, 1.2},
                                      {-14.0, 20.0, 12.0, -24.0},
                                      {-1.2, 1.4, 60.0, 25.0},
                                      {-40.0, -18.0, 1.0, -1.6},
                                      {2.2, 30.0, 2.6, -22.0}};
    uint32_t random = 11;
    for (int i = 0; i < STROKES + 5; i++) {
        double stroke[4];
        if (i < STROKES) {
            const double angle = 2.0 * 3.14159265358979 * next_random(&random), length = 15.0 + 60.0 * next_random(&random);
            stroke[0] = VIEW * (2.0 * next_random(&random) - 1.0);
            stroke[1] = VIEW * (2.0 * next_random(&random) - 1.0);
            stroke[2] = stroke[0] + length * cos(angle);
            stroke[3] = stroke[1] + length * sin(angle);
        } else {
            memcpy(stroke, knot[i - STROKES], sizeof stroke);
        }
        const double bend = 0.06 * (next_random(&random) - 0.5);
        const double along[2] = {stroke[2] - stroke[0], stroke[3] - stroke[1]};
        const double points[3][2] = {
            {stroke[0], stroke[1]},
            {0.5 * (stroke[0] + stroke[2]) - bend * along[1], 0.5 * (stroke[1] + stroke[3]) + bend * along[0]},
            {stroke[2], stroke[3]}};
        const double force = FORCE_KGF * (0.6 + 0.8 * next_random(&random)), soft = i % 2 ? 1.0 : 0.0;
        const StriaeKey keys[3] = {{.at = 0.0, .force_kgf = force * (1.0 - soft)},
                                   {.at = 0.3, .force_kgf = force},
                                   {.at = 1.0, .force_kgf = force * (i % 3 ? 1.0 : 0.0)}};
        if (!add(shop, i % 4 == 1, STRIAE_CURVE_CATMULL_ROM, points, 3, keys, 3)) return false;
    }
    return true;
}

/* How wide a scratch of middling force is, from foot to foot of its rims. */
static double usual_width(const StriaeTool *tool, const StriaeMaterial *metal) {
    const StriaeProcess process = {
        .struct_size = sizeof process, .depth_law = STRIAE_DEPTH_LAW_SCRATCH_HARDNESS, .force_kgf = FORCE_KGF};
    StriaeCrossSectionInfo info = {.struct_size = sizeof info};
    StriaeCrossSection *section = NULL;
    if (striae_cross_section(tool, metal, &process, &section) != STRIAE_STATUS_OK) return 0.0;
    striae_cross_section_info(section, &info);
    striae_cross_section_release(section);
    return info.crest_width_mm + info.left.outer_width_mm + info.right.outer_width_mm;
}

static bool build(Plate *plate) {
    const StriaeMaterial metal = material(plate->is_matte);
    const StriaePatternOptions options = {
        .struct_size = sizeof options, .mm_per_scene_unit = 1.0, .units_per_uv = {1.0, 1.0}};
    Workshop shop = {0};
    bool made = striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &shop.tools[0]) == STRIAE_STATUS_OK &&
                striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &shop.tools[1]) == STRIAE_STATUS_OK &&
                striae_pattern_builder_new(&metal, &options, &shop.builder) == STRIAE_STATUS_OK;
    if (made) {
        plate->width_mm = shop.width_mm = usual_width(shop.tools[0], &metal);
        made = plate->is_crossed ? add_strokes(&shop) : add_bows(&shop);
    }
    made = made && striae_pattern_builder_build(shop.builder, &plate->pattern) == STRIAE_STATUS_OK;
    striae_pattern_builder_free(shop.builder);
    striae_tool_release(shop.tools[0]);
    striae_tool_release(shop.tools[1]);
    return made;
}

bool plates_build(Plate plates[PLATE_COUNT]) {
    static const Plate known[PLATE_COUNT] = {{.name = "bows-metal"},
                                             {.name = "bows-matte", .is_matte = true},
                                             {.name = "strokes-metal", .is_crossed = true},
                                             {.name = "strokes-matte", .is_crossed = true, .is_matte = true}};
    bool made = true;
    memcpy(plates, known, sizeof known);
    for (int i = 0; i < PLATE_COUNT && made; i++) made = build(&plates[i]);
    return made;
}

void plates_free(Plate plates[PLATE_COUNT]) {
    for (int i = 0; i < PLATE_COUNT; i++) striae_pattern_release(plates[i].pattern);
}
