/* The earlier systems: made of a pattern's scratches, shaded by the same calls; refusals by name. */
#include <math.h>

#include "plate_fixture.h"

static const StriaeCanvas CANVAS = {.area_uv = {{0.0, 0.0}, {1.0, 1.0}}, .texels = {600, 400}};
static const float UP[3] = {0.0f, 0.0f, 1.0f}, SPECULAR[3] = {0.5f, 0.5f, 0.5f};

static StriaeTwoAngles two_angles(void) {
    StriaeTwoAngles scratch = {
        .struct_size = sizeof scratch, .width_mm = 0.2, .peak_deg = 20.0, .groove_deg = 35.0};
    for (int i = 0; i < 4; i++)
        scratch.zones[i] = (StriaeBrdf){.kind = STRIAE_BRDF_KIND_LAMBERT, .albedo = {0.5f, 0.5f, 0.5f}};
    return scratch;
}

/* Each texel is a tenth of a millimetre; the scratch runs along v = 0.5. */
static StriaeShading shaded(const StriaeBaseline *baseline, double v) {
    const StriaePoint point = plate_point(0.5, v, 0.5);
    StriaeShading shading = {.coverage = -1.0f};
    EXPECT_OK(striae_baseline_shade(baseline, &point, UP, &shading));
    return shading;
}

static void shades(const StriaePattern *pattern) {
    protects("each system shows its scratch where the pattern has it, through the calls that shade patterns");
    const StriaeTwoAngles scratch = two_angles();
    StriaeBaseline *systems[3] = {NULL, NULL, NULL};
    EXPECT_OK(striae_baseline_bb90(pattern, &CANVAS, 0.3f, 0.6f, 1, &systems[0]));
    EXPECT_OK(striae_baseline_bl99(pattern, &CANVAS, SPECULAR, 30.0f, &systems[1]));
    EXPECT_OK(striae_baseline_mdg01(pattern, &CANVAS, &scratch, &systems[2]));
    static const float share[3] = {1.0f, 0.5f, 0.4f};
    for (int i = 0; i < 3; i++) {
        const StriaeShading on = shaded(systems[i], 0.501), beside = shaded(systems[i], 0.6);
        EXPECT(on.scratch_count == 1 && fabsf(on.coverage - share[i]) < 1e-4f);
        EXPECT(beside.scratch_count == 0 && beside.coverage == 0.0f);
        static const float light[3] = {0.0f, 0.6f, 0.8f}, u[3] = {0.3f, 0.6f, 0.7f};
        float with[3], without[3], pdf;
        EXPECT_OK(striae_eval(&on, light, 0, with));
        EXPECT_OK(striae_eval(&beside, light, 0, without));
        EXPECT(fabsf(with[0] - without[0]) > 1e-3f);
        EXPECT_OK(striae_pdf(&on, light, &pdf));
        EXPECT(pdf > 0.0f);
        StriaeSample sample;
        EXPECT_OK(striae_sample(&on, u, &sample));
        size_t bytes = 0;
        EXPECT_OK(striae_baseline_memory(systems[i], &bytes));
        EXPECT(bytes >= 600 * 400);
        striae_baseline_retain(systems[i]);
        striae_baseline_release(systems[i]);
    }
    /* A pixel of half a millimetre, seen and lit from above: diffuse BB90 tells its intensity. */
    const StriaeShading on = shaded(systems[0], 0.501);
    float f[3];
    EXPECT_OK(striae_eval(&on, UP, 0, f));
    EXPECT(f[0] * 3.14159265f >= 0.299f && f[0] * 3.14159265f <= 0.601f);
    for (int i = 0; i < 3; i++) striae_baseline_release(systems[i]);
}

static void refuses(const StriaePattern *pattern) {
    protects("what cannot be is refused by name, and leaves NULL");
    StriaeBaseline *baseline = (StriaeBaseline *)&baseline;
    StriaeCanvas canvas = CANVAS;
    canvas.texels[1] = 0;
    EXPECT_REFUSED(striae_baseline_bb90(pattern, &canvas, 0.0f, 1.0f, 0, &baseline), "texels", "0");
    EXPECT(baseline == NULL);
    EXPECT_REFUSED(striae_baseline_bb90(NULL, &CANVAS, 0.0f, 1.0f, 0, &baseline), "pattern", "NULL");
    EXPECT_REFUSED(striae_baseline_bb90(pattern, NULL, 0.0f, 1.0f, 0, &baseline), "canvas", "NULL");
    EXPECT_REFUSED(striae_baseline_bb90(pattern, &CANVAS, 0.75f, 0.25f, 0, &baseline), "intensity", "0.75");
    EXPECT_REFUSED(striae_baseline_bb90(pattern, &CANVAS, 0.0f, 1.0f, 0, NULL), "baseline", "NULL");
    EXPECT_REFUSED(striae_baseline_bl99(pattern, &CANVAS, NULL, 30.0f, &baseline), "specular", "NULL");
    EXPECT_REFUSED(striae_baseline_bl99(pattern, &CANVAS, SPECULAR, NAN, &baseline), "exponent", "NaN");
    StriaeTwoAngles scratch = two_angles();
    scratch.width_mm = -1.0;
    EXPECT_REFUSED(striae_baseline_mdg01(pattern, &CANVAS, &scratch, &baseline), "width_mm", "-1");
    scratch = two_angles();
    scratch.zones[2].kind = 99;
    EXPECT_REFUSED(striae_baseline_mdg01(pattern, &CANVAS, &scratch, &baseline), "kind", "99");
    scratch = two_angles();
    scratch.struct_size = 4;
    EXPECT_REFUSED(striae_baseline_mdg01(pattern, &CANVAS, &scratch, &baseline), "struct_size", "4");
    scratch = two_angles();
    EXPECT_OK(striae_baseline_mdg01(pattern, &CANVAS, &scratch, &baseline));
    StriaeShading shading;
    StriaePoint point = plate_point(0.5, 0.501, 0.5);
    point.normal[1] = NAN;
    EXPECT_REFUSED(striae_baseline_shade(baseline, &point, UP, &shading), "normal", "NaN");
    EXPECT(shading.coverage == 0.0f);
    EXPECT_REFUSED(striae_baseline_shade(NULL, &point, UP, &shading), "baseline", "NULL");
    EXPECT_REFUSED(striae_baseline_memory(baseline, NULL), "bytes", "NULL");
    striae_baseline_release(baseline);
    striae_baseline_release(NULL);
}

static void tells_memory(const StriaePattern *pattern) {
    protects("a pattern tells how much memory it takes");
    size_t bytes = 0;
    EXPECT_OK(striae_pattern_memory(pattern, &bytes));
    EXPECT(bytes > 100 && bytes < 1000000);
    EXPECT_REFUSED(striae_pattern_memory(NULL, &bytes), "pattern", "NULL");
    EXPECT_REFUSED(striae_pattern_memory(pattern, NULL), "bytes", "NULL");
}

int main(void) {
    Plate plate;
    plate_init(&plate);
    StriaePattern *pattern = plate_pattern(&plate);
    shades(pattern);
    refuses(pattern);
    tells_memory(pattern);
    striae_pattern_release(pattern);
    striae_tool_release(plate.tool);
    return expect_summary();
}
