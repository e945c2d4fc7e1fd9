/* Scratches and patterns that cannot be; a builder that refused one goes on as if it had not been offered. */
#include <math.h>
#include <stdint.h>

#include "plate_fixture.h"

static Plate plate;
static StriaePatternBuilder *builder;

static void expect_no_builder(const StriaeMaterial *surface, const StriaePatternOptions *options,
                              const char *argument, const char *value) {
    StriaePatternBuilder *out = (StriaePatternBuilder *)(void *)&plate;
    EXPECT_REFUSED(striae_pattern_builder_new(surface, options, &out), argument, value);
    EXPECT(out == NULL);
}

static void builders(void) {
    protects("a builder needs a material and sound scales");
    const double bad[] = {NAN, INFINITY, 0.0, -10.0};
    const char *const text[] = {"NaN", "inf", "0", "-10"};
    for (int i = 0; i < 4; i++) {
        StriaePatternOptions options = plate.options;
        options.mm_per_scene_unit = bad[i];
        expect_no_builder(&plate.titanium, &options, "mm_per_scene_unit", text[i]);
        options = plate.options;
        options.units_per_uv[0] = bad[i];
        expect_no_builder(&plate.titanium, &options, "units_per_uv", text[i]);
        options = plate.options;
        options.units_per_uv[1] = bad[i];
        expect_no_builder(&plate.titanium, &options, "units_per_uv", text[i]);
        StriaeMaterial material = plate.titanium;
        material.hardness_hv = bad[i];
        expect_no_builder(&material, &plate.options, "hardness_hv", text[i]);
    }
    expect_no_builder(NULL, &plate.options, "surface", "NULL");
    expect_no_builder(&plate.titanium, NULL, "options", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_new(&plate.titanium, &plate.options, NULL), "builder", "NULL");
}

#define EXPECT_BAD_SCRATCH(field, bad, argument, value)                                                            \
    do {                                                                                                           \
        StriaeScratch scratch = plate.scratch;                                                                     \
        scratch.field = (bad);                                                                                     \
        EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, &scratch), argument, value);                    \
    } while (0)

static void scratches(void) {
    protects("NULL, empty and over-long arrays and unknown kinds are refused");
    EXPECT_BAD_SCRATCH(tool, NULL, "tool", "NULL");
    EXPECT_BAD_SCRATCH(points_uv, NULL, "points_uv", "NULL");
    EXPECT_BAD_SCRATCH(point_count, 0, "point_count", "0");
    EXPECT_BAD_SCRATCH(point_count, 1, "point_count", "1");
    EXPECT_BAD_SCRATCH(point_count, SIZE_MAX, "point_count", "");
    EXPECT_BAD_SCRATCH(keys, NULL, "keys", "NULL");
    EXPECT_BAD_SCRATCH(key_count, 0, "key_count", "0");
    EXPECT_BAD_SCRATCH(key_count, SIZE_MAX / 2, "key_count", "");
    EXPECT_BAD_SCRATCH(curve, 9u, "curve", "9");
    EXPECT_BAD_SCRATCH(depth_law, 9u, "depth_law", "9");
    EXPECT_BAD_SCRATCH(struct_size, 0, "struct_size", "0");
    StriaeScratch bezier = plate.scratch; /* needs 3n + 1 points */
    bezier.curve = STRIAE_CURVE_CUBIC_BEZIER;
    EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, &bezier), "point_count", "2");
    EXPECT_REFUSED(striae_pattern_builder_add_scratch(NULL, &plate.scratch), "builder", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, NULL), "scratch", "NULL");
}

static void paths(void) {
    protects("a path with a hole in it, or without length, is refused");
    const double bad[3][2][2] = {{{0.1, NAN}, {0.9, 0.5}}, {{0.1, 0.5}, {INFINITY, 0.5}}, {{0.3, 0.3}, {0.3, 0.3}}};
    const char *const text[3] = {"NaN", "inf", ""};
    for (int i = 0; i < 3; i++) EXPECT_BAD_SCRATCH(points_uv, bad[i], "points_uv", text[i]);
}

static void expect_bad_keys(StriaeKey first, StriaeKey second, const char *argument, const char *value) {
    const StriaeKey keys[2] = {first, second};
    EXPECT_BAD_SCRATCH(keys, keys, argument, value);
}

static void keys(void) {
    protects("keys lie in order between 0 and 1 and hold processes that can be");
    const StriaeKey start = {.at = 0.0, .force_kgf = 2.0}, end = {.at = 1.0, .force_kgf = 2.0};
    StriaeKey bad = start;
    expect_bad_keys(end, start, "at", "");
    bad.at = -0.5;
    expect_bad_keys(bad, end, "at", "-0.5");
    bad.at = NAN;
    expect_bad_keys(bad, end, "at", "NaN");
    bad.at = 1.5;
    expect_bad_keys(start, bad, "at", "1.5");
    bad = start;
    bad.force_kgf = -2.0;
    expect_bad_keys(bad, end, "force_kgf", "-2");
    bad.force_kgf = NAN;
    expect_bad_keys(bad, end, "force_kgf", "NaN");
    bad.force_kgf = INFINITY;
    expect_bad_keys(bad, end, "force_kgf", "inf");
    bad = start;
    bad.tilt_deg = 100.0;
    expect_bad_keys(bad, end, "tilt_deg", "100");
    bad = start;
    bad.spin_deg = INFINITY;
    expect_bad_keys(bad, end, "spin_deg", "inf");
    bad = start;
    bad.azimuth_deg = NAN;
    expect_bad_keys(bad, end, "azimuth_deg", "NaN");
}

static void short_tool(void) {
    protects("a tool too short for a key's force is refused where the scratch is added");
    StriaeTool *stub = NULL;
    EXPECT_OK(striae_tool_sphero_cone(60.0, 0.005, 0.001, &stub));
    EXPECT_BAD_SCRATCH(tool, stub, "force_kgf", "4");
    EXPECT(strstr(striae_last_error(), "height_mm") != NULL);
    striae_tool_release(stub);
}

static void builder_survives(void) {
    protects("after all these refusals the builder is empty, takes a good scratch, and builds again and again");
    StriaePattern *empty = NULL, *scratched = NULL;
    StriaeShading shading;
    const StriaePoint point = plate_point(0.5, 0.5, 0.5);
    const float view[3] = {0.0f, 0.0f, 1.0f};
    EXPECT_OK(striae_pattern_builder_build(builder, &empty));
    EXPECT_OK(striae_shade(empty, &point, view, &shading));
    EXPECT(shading.scratch_count == 0 && shading.coverage == 0.0f);
    EXPECT_OK(striae_pattern_builder_add_scratch(builder, &plate.scratch));
    EXPECT_OK(striae_pattern_builder_build(builder, &scratched));
    EXPECT_OK(striae_shade(scratched, &point, view, &shading));
    EXPECT(shading.scratch_count == 1 && shading.coverage > 0.0f && shading.coverage <= 1.0f);
    EXPECT_OK(striae_shade(empty, &point, view, &shading));
    EXPECT(shading.scratch_count == 0);
    striae_pattern_release(empty);
    striae_pattern_release(scratched);

    StriaePattern *pattern = empty;
    EXPECT_REFUSED(striae_pattern_builder_build(NULL, &pattern), "builder", "NULL");
    EXPECT(pattern == NULL);
    EXPECT_REFUSED(striae_pattern_builder_build(builder, NULL), "pattern", "NULL");
}

static void many_scratches(void) {
    protects("scratches added together are all there and numbered; where one is refused, none is, and its number is told");
    StriaeScratch three[3] = {plate.scratch, plate.scratch, plate.scratch};
    const double other[2][2] = {{0.5, 0.1}, {0.5, 0.9}};
    three[1].points_uv = other;
    three[2].curve = 9u;
    size_t before = 0, after = 0;
    EXPECT_OK(striae_pattern_builder_scratch_count(builder, &before));
    EXPECT_REFUSED(striae_pattern_builder_add_scratches(builder, three, 3), "scratches[2]", "9");
    EXPECT_OK(striae_pattern_builder_scratch_count(builder, &after));
    EXPECT(before == after);
    EXPECT_OK(striae_pattern_builder_add_scratches(builder, three, 2));
    EXPECT_OK(striae_pattern_builder_scratch_count(builder, &after));
    EXPECT(after == before + 2);
    StriaePattern *pattern = NULL;
    StriaeShading shading;
    const StriaePoint point = plate_point(0.5, 0.2, 0.5); /* only the second runs here */
    const float view[3] = {0.0f, 0.0f, 1.0f};
    EXPECT_OK(striae_pattern_builder_build(builder, &pattern));
    EXPECT_OK(striae_shade(pattern, &point, view, &shading));
    EXPECT(shading.scratch_count == 1);
    striae_pattern_release(pattern);
    EXPECT_OK(striae_pattern_builder_add_scratches(builder, NULL, 0));
    EXPECT_REFUSED(striae_pattern_builder_add_scratches(builder, NULL, 1), "scratches", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_add_scratches(NULL, three, 1), "builder", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_scratch_count(builder, NULL), "count", "NULL");
}

int main(void) {
    plate_init(&plate);
    EXPECT_OK(striae_pattern_builder_new(&plate.titanium, &plate.options, &builder));
    builders();
    scratches();
    paths();
    keys();
    short_tool();
    builder_survives();
    many_scratches();
    striae_pattern_builder_free(builder);
    striae_tool_release(plate.tool);
    return expect_summary();
}
