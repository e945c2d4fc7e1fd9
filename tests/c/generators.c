/* Generators: presets, the same seed twice, layers, and refusals that leave the builder as it was. */
#include <math.h>

#include "plate_fixture.h"

static Plate plate;
static StriaeTool *grain;

static StriaeGenerator preset(uint32_t style) {
    StriaeGenerator generator = {.struct_size = sizeof generator};
    EXPECT_OK(striae_generator_preset(style, &generator));
    return generator;
}

/* A corner of the plate, 6 mm wide and 4 mm high. */
static StriaeGenerator corner(uint32_t style) {
    StriaeGenerator generator = preset(style);
    generator.area_uv[1][0] = generator.area_uv[1][1] = 0.1;
    return generator;
}

/* The corner as one pixel sees it. */
static StriaeShading seen(const StriaePatternBuilder *builder) { return plate_built_shading(builder, 0.05, 0.05); }

static void presets(void) {
    protects("every style fills in a generator that scratches the plate");
    for (uint32_t style = STRIAE_STYLE_STRAIGHT; style <= STRIAE_STYLE_HANDLING; style++) {
        StriaeGenerator generator = corner(style);
        StriaePatternBuilder *builder = plate_builder(&plate);
        EXPECT(generator.count == 0 && generator.per_cm2 > 1.0);
        EXPECT_OK(striae_pattern_builder_generate(builder, &generator, grain, NULL, 1));
        EXPECT(seen(builder).coverage > 0.0f);
        striae_pattern_builder_free(builder);
    }
}

static void seeds(void) {
    protects("a seed gives the same scratches again, another one others; layers add up");
    const StriaeGenerator generator = corner(STRIAE_STYLE_SWIRLS);
    StriaePatternBuilder *builders[3];
    float coverage[4];
    for (int i = 0; i < 3; i++) {
        builders[i] = plate_builder(&plate);
        EXPECT_OK(striae_pattern_builder_generate(builders[i], &generator, grain, NULL, i == 2 ? 8 : 7));
        coverage[i] = seen(builders[i]).coverage;
    }
    EXPECT(coverage[0] == coverage[1] && coverage[0] != coverage[2]);
    StriaeMaterial gold = {.struct_size = sizeof gold};
    EXPECT_OK(striae_material_metal(STRIAE_METAL_GOLD, &gold));
    EXPECT_OK(striae_pattern_builder_generate(builders[0], &generator, grain, &gold, 8));
    coverage[3] = seen(builders[0]).coverage;
    EXPECT(coverage[3] > coverage[0]);
    for (int i = 0; i < 3; i++) striae_pattern_builder_free(builders[i]);
}

#define EXPECT_BAD(field, bad, argument, value)                                                                    \
    do {                                                                                                           \
        StriaeGenerator generator = corner(STRIAE_STYLE_HANDLING);                                                 \
        generator.field = (bad);                                                                                   \
        EXPECT_REFUSED(striae_pattern_builder_generate(builder, &generator, grain, NULL, 1), argument, value);     \
    } while (0)

static void refusals(void) {
    protects("absurd generators are refused by the field, and the builder stays empty");
    StriaePatternBuilder *builder = plate_builder(&plate);
    StriaeGenerator good = corner(STRIAE_STYLE_HANDLING), small = {.struct_size = 8};
    EXPECT_REFUSED(striae_generator_preset(99, &good), "style", "99");
    EXPECT_REFUSED(striae_generator_preset(0, NULL), "generator", "NULL");
    EXPECT_REFUSED(striae_generator_preset(0, &small), "struct_size", "8");
    EXPECT_REFUSED(striae_pattern_builder_generate(NULL, &good, grain, NULL, 1), "builder", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_generate(builder, NULL, grain, NULL, 1), "generator", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_generate(builder, &good, NULL, NULL, 1), "tool", "NULL");
    EXPECT_BAD(struct_size, 0, "struct_size", "0");
    EXPECT_BAD(per_cm2, NAN, "per_cm2", "NaN");
    EXPECT_BAD(count, 4000000000u, "count", "4000000000");
    EXPECT_BAD(area_uv[0][0], 0.5, "area_uv", "0.5");
    EXPECT_BAD(length_mm.kind, 9, "length_mm.kind", "9");
    EXPECT_BAD(length_mm.from, -1.0, "length_mm.from", "-1");
    EXPECT_BAD(force_kgf.to, INFINITY, "force_kgf.to", "inf");
    EXPECT_BAD(force_kgf.exponent, 77.0, "force_kgf.exponent", "77");
    EXPECT_BAD(depth_mm.to, -2.0, "depth_mm.to", "-2");
    EXPECT_BAD(spread_deg, -3.0, "spread_deg", "-3");
    EXPECT_BAD(curves, 65, "curves", "65");
    EXPECT_BAD(taper[1], 0.875, "taper", "1.125");
    EXPECT_BAD(tilt_deg, 89.0, "tilt_deg", "89");
    EXPECT_BAD(held, 2, "held", "2");
    EXPECT_BAD(depth_law, 3, "depth_law", "3");
    striae_pattern_builder_free(builder);
}

static void short_tools(void) {
    protects("a tool too short for some scratch names it, and nothing is added");
    StriaePatternBuilder *builder = plate_builder(&plate);
    StriaeGenerator generator = corner(STRIAE_STYLE_STRAIGHT);
    generator.force_kgf.to = 900.0;
    generator.count = 50;
    EXPECT_REFUSED(striae_pattern_builder_generate(builder, &generator, grain, NULL, 1), "scratches[", "force_kgf");
    EXPECT(seen(builder).coverage == 0.0f);
    striae_pattern_builder_free(builder);
}

int main(void) {
    plate_init(&plate);
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_ABRASIVE_GRAIN, &grain));
    presets();
    seeds();
    refusals();
    short_tools();
    striae_tool_release(grain);
    striae_tool_release(plate.tool);
    return expect_summary();
}
