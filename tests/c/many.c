/* Whole arrays at once: each element as its own call has it, packed or interleaved; errors told by name. */
#include <math.h>

#include "plate_fixture.h"

enum { POINTS = 21, EACH = 5, LIGHTS = POINTS * EACH };

static StriaePattern *pattern;
static StriaeShading shadings[POINTS];
static float lights[LIGHTS][3], f[LIGHTS][3];
static float packed_x[LIGHTS], packed_y[LIGHTS], packed_z[LIGHTS], pdf[LIGHTS];

static float share(int i, double step) { return (float)fmod(0.5 + i * step, 1.0); }

static bool near(const float a[3], const float b[3]) {
    for (int i = 0; i < 3; i++)
        if (fabsf(a[i] - b[i]) > 1e-5f * fmaxf(fmaxf(fabsf(a[i]), fabsf(b[i])), 1.0f)) return false;
    return true;
}

static StriaeVectors interleaved(float v[][3]) {
    return (StriaeVectors){v[0], v[0] + 1, v[0] + 2, 3};
}

static StriaeVectorsOut interleaved_out(float v[][3]) {
    return (StriaeVectorsOut){v[0], v[0] + 1, v[0] + 2, 3};
}

static void shades(void) {
    protects("striae_shade_many prepares each point as striae_shade does, and names the one that it refuses");
    StriaePoint points[POINTS];
    float views[POINTS][3];
    for (int i = 0; i < POINTS; i++) {
        points[i] = plate_point(0.15, 0.5 + 0.0005 * (i % 5), 0.05 * (1 + i % 4));
        for (int k = 0; k < 3; k++) views[i][k] = k < 2 ? share(i, 0.3 + 0.2 * k) - 0.5f : 0.7f;
    }
    const StriaeVectors view = interleaved(views);
    EXPECT_OK(striae_shade_many(pattern, points, sizeof points[0], &view, POINTS, shadings));
    int scratched = 0;
    for (int i = 0; i < POINTS; i++) {
        StriaeShading alone;
        EXPECT_OK(striae_shade(pattern, &points[i], views[i], &alone));
        EXPECT(alone.coverage == shadings[i].coverage && alone.scratch_count == shadings[i].scratch_count);
        scratched += alone.coverage > 0.0f;
    }
    EXPECT(scratched > POINTS / 2);
    StriaeShading refused[3];
    points[1].normal[0] = NAN;
    EXPECT_REFUSED(striae_shade_many(pattern, points, sizeof points[0], &view, 3, refused), "points[1]", "NaN");
    EXPECT(refused[0].coverage == shadings[0].coverage && refused[2].coverage == shadings[2].coverage);
    EXPECT_REFUSED(striae_shade_many(pattern, points, 4, &view, 3, refused), "point_stride", "4");
    EXPECT_REFUSED(striae_shade_many(pattern, NULL, sizeof points[0], &view, 3, refused), "points", "NULL");
    EXPECT_OK(striae_shade_many(pattern, NULL, sizeof points[0], &view, 0, NULL));
}

static void evaluates(void) {
    protects("striae_eval_many gives each light what striae_eval does, whatever the arrays' layout");
    for (int i = 0; i < LIGHTS; i++) {
        for (int k = 0; k < 3; k++) lights[i][k] = k < 2 ? share(i, 0.7548777 - 0.185 * k) - 0.5f : 0.4f;
        packed_x[i] = lights[i][0], packed_y[i] = lights[i][1], packed_z[i] = lights[i][2];
    }
    const StriaeVectors packed = {packed_x, packed_y, packed_z, 1}, apart = interleaved(lights);
    const StriaeVectorsOut out = interleaved_out(f);
    for (uint32_t flags = 0; flags <= STRIAE_EVAL_BRDF_ONLY; flags += STRIAE_EVAL_BRDF_ONLY) {
        EXPECT_OK(striae_eval_many(shadings, EACH, &packed, LIGHTS, flags, &out));
        for (int i = 0; i < LIGHTS; i++) {
            float alone[3];
            EXPECT_OK(striae_eval(&shadings[i / EACH], lights[i], flags, alone));
            EXPECT(near(f[i], alone));
        }
    }
    EXPECT_OK(striae_eval_pdf_many(shadings, EACH, &apart, LIGHTS - 2, &out, pdf));
    for (int i = 0; i < LIGHTS - 2; i++) {
        StriaeEvaluated alone;
        EXPECT_OK(striae_eval_pdf(&shadings[i / EACH], lights[i], &alone));
        EXPECT(near(f[i], alone.f));
        EXPECT(fabsf(pdf[i] - alone.pdf) <= 1e-5f * fmaxf(alone.pdf, 1.0f));
    }
}

static void samples(void) {
    protects("striae_sample_many chooses what striae_sample does");
    float u[LIGHTS][3], weights[LIGHTS][3];
    uint32_t lobes[LIGHTS];
    for (int i = 0; i < LIGHTS; i++)
        for (int k = 0; k < 3; k++) u[i][k] = share(i, 0.8191725 - 0.13 * k);
    const StriaeVectors numbers = interleaved(u);
    StriaeSamplesOut out = {interleaved_out(lights), interleaved_out(weights), pdf, lobes};
    EXPECT_OK(striae_sample_many(shadings, EACH, &numbers, LIGHTS, &out));
    for (int i = 0; i < LIGHTS; i++) {
        StriaeSample alone;
        EXPECT_OK(striae_sample(&shadings[i / EACH], u[i], &alone));
        EXPECT(near(lights[i], alone.light) && near(weights[i], alone.weight) && lobes[i] == alone.lobe);
        EXPECT(fabsf(pdf[i] - alone.pdf) <= 1e-5f * fmaxf(alone.pdf, 1.0f));
    }
    out.lobe = NULL;
    EXPECT_OK(striae_sample_many(shadings, EACH, &numbers, LIGHTS, &out));
    out.pdf = NULL;
    EXPECT_REFUSED(striae_sample_many(shadings, EACH, &numbers, LIGHTS, &out), "samples.pdf", "NULL");
}

static void refusals(void) {
    protects("what is wrong with an array is told");
    const StriaeVectors good = interleaved(lights);
    const StriaeVectorsOut out = interleaved_out(f);
    StriaeVectors still = good, hollow = good;
    still.stride = 0;
    hollow.y = NULL;
    EXPECT_REFUSED(striae_eval_many(shadings, 1, &still, POINTS, 0, &out), "lights", "0");
    EXPECT_REFUSED(striae_eval_many(shadings, 1, &hollow, POINTS, 0, &out), "lights", "NULL");
    EXPECT_REFUSED(striae_eval_many(shadings, 0, &good, POINTS, 0, &out), "per_shading", "0");
    EXPECT_REFUSED(striae_eval_many(shadings, 1, &good, POINTS, 7, &out), "flags", "7");
    EXPECT_REFUSED(striae_eval_many(NULL, 1, &good, POINTS, 0, &out), "shadings", "NULL");
    EXPECT_REFUSED(striae_eval_many(shadings, 1, &good, POINTS, 0, NULL), "f", "NULL");
    EXPECT_REFUSED(striae_eval_pdf_many(shadings, 1, &good, POINTS, &out, NULL), "pdf", "NULL");
    EXPECT_REFUSED(striae_eval_many(shadings, 1, &good, SIZE_MAX / 2, 0, &out), "count", "");
    EXPECT_REFUSED(striae_set_simd(2), "allowed", "2");
}

static void simd(void) {
    protects("without SIMD instructions all is the same");
    const StriaeVectors apart = interleaved(lights);
    float without[LIGHTS][3];
    const StriaeVectorsOut out = interleaved_out(f), other = interleaved_out(without);
    EXPECT_OK(striae_eval_many(shadings, EACH, &apart, LIGHTS, 0, &out));
    EXPECT_OK(striae_set_simd(0));
    EXPECT_OK(striae_eval_many(shadings, EACH, &apart, LIGHTS, 0, &other));
    EXPECT_OK(striae_set_simd(1));
    for (int i = 0; i < LIGHTS; i++) EXPECT(near(f[i], without[i]));
}

int main(void) {
    Plate plate;
    plate_init(&plate);
    pattern = plate_pattern(&plate);
    shades();
    evaluates();
    samples();
    refusals();
    simd();
    striae_pattern_release(pattern);
    striae_tool_release(plate.tool);
    return expect_summary();
}
