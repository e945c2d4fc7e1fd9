/* Scratches along every kind of curve, open and closed, and what each kind refuses. */
#include <math.h>
#include <stdint.h>

#include "plate_fixture.h"

enum { POINTS = 9 };

static Plate plate;
static StriaePatternBuilder *builder;
static double ring[POINTS][2];
static const double clamped[] = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6};
static const double periodic[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};

static StriaeScratch along(uint32_t curve, size_t point_count, uint32_t closed) {
    StriaeScratch scratch = plate.scratch;
    scratch.curve = curve;
    scratch.points_uv = (const double (*)[2])ring;
    scratch.point_count = point_count;
    scratch.closed = closed;
    if (curve == STRIAE_CURVE_NON_UNIFORM_B_SPLINE) {
        scratch.knots = closed ? periodic : clamped;
        scratch.knot_count = closed ? 10 : 13;
    }
    return scratch;
}

static void every_kind(void) {
    protects("every kind of curve is taken, open and closed");
    const size_t counts[5][2] = {{9, 9}, {7, 9}, {9, 9}, {9, 9}, {9, 9}};
    for (uint32_t curve = 0; curve < 5; curve++) {
        for (uint32_t closed = 0; closed < 2; closed++) {
            const StriaeScratch scratch = along(curve, counts[curve][closed], closed);
            EXPECT_OK(striae_pattern_builder_add_scratch(builder, &scratch));
        }
    }
}

/* Coverage at the middle of the side that only a closed path has. */
static float covered_where_it_closes(uint32_t closed) {
    StriaePatternBuilder *own = NULL;
    StriaePattern *pattern = NULL;
    StriaeShading shading;
    const StriaeScratch scratch = along(STRIAE_CURVE_POLYLINE, POINTS, closed);
    const double *first = ring[0], *last = ring[POINTS - 1];
    const StriaePoint point = plate_point(0.5 * (first[0] + last[0]), 0.5 * (first[1] + last[1]), 0.05);
    const float view[3] = {0.0f, 0.0f, 1.0f};
    EXPECT_OK(striae_pattern_builder_new(&plate.titanium, &plate.options, &own));
    EXPECT_OK(striae_pattern_builder_add_scratch(own, &scratch));
    EXPECT_OK(striae_pattern_builder_build(own, &pattern));
    EXPECT_OK(striae_shade(pattern, &point, view, &shading));
    striae_pattern_release(pattern);
    striae_pattern_builder_free(own);
    return shading.coverage;
}

static void closing(void) {
    protects("a closed path goes back to its first point, an open one does not");
    EXPECT(covered_where_it_closes(0) == 0.0f);
    EXPECT(covered_where_it_closes(1) > 0.5f);
}

#define EXPECT_BAD(curve, points, closed, field, bad, argument, value)                                             \
    do {                                                                                                           \
        StriaeScratch scratch = along(curve, points, closed);                                                      \
        scratch.field = (bad);                                                                                     \
        EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, &scratch), argument, value);                    \
    } while (0)

static void counts(void) {
    protects("too few points of each kind are refused");
    static const size_t few[5][2] = {{1, 2}, {5, 4}, {1, 2}, {3, 2}, {3, 2}};
    static const char *const text[] = {"0", "1", "2", "3", "4", "5"};
    for (uint32_t curve = 0; curve < 5; curve++) {
        for (uint32_t closed = 0; closed < 2; closed++) {
            const size_t count = few[curve][closed];
            EXPECT_BAD(curve, count, closed, point_count, count, "point_count", text[count]);
        }
    }
    EXPECT_BAD(STRIAE_CURVE_B_SPLINE, POINTS, 0, closed, 2u, "closed", "2");
    EXPECT_BAD(STRIAE_CURVE_B_SPLINE, POINTS, 0, curve, 5u, "curve", "5");
}

static void knots(void) {
    protects("knots belong to non-uniform B-splines, ascend, and are as many as the points ask for");
    const uint32_t kind = STRIAE_CURVE_NON_UNIFORM_B_SPLINE;
    EXPECT_BAD(kind, POINTS, 0, knots, NULL, "knots", "NULL");
    EXPECT_BAD(kind, POINTS, 0, knot_count, 12, "knot_count", "12");
    EXPECT_BAD(kind, POINTS, 1, knot_count, 9, "knot_count", "9");
    EXPECT_BAD(kind, POINTS, 0, knot_count, SIZE_MAX / 2, "knot_count", "");
    EXPECT_BAD(kind, POINTS, 0, curve, STRIAE_CURVE_B_SPLINE, "knot_count", "13");
    double bad[13];
    memcpy(bad, clamped, sizeof bad);
    bad[6] = 1.5;
    EXPECT_BAD(kind, POINTS, 0, knots, bad, "knots[6]", "1.5");
    bad[6] = NAN;
    EXPECT_BAD(kind, POINTS, 0, knots, bad, "knots[6]", "NaN");
    bad[4] = bad[5] = bad[6] = bad[7] = 4.0;
    EXPECT_BAD(kind, POINTS, 0, knots, bad, "knots[4]", "4");
    for (int i = 0; i < 13; i++) bad[i] = 7.0;
    EXPECT_BAD(kind, POINTS, 0, knots, bad, "knots[9]", "7");
}

int main(void) {
    plate_init(&plate);
    for (int i = 0; i < POINTS; i++) {
        const double angle = 6.283185307179586 * i / POINTS;
        ring[i][0] = 0.5 + 0.3 * cos(angle);
        ring[i][1] = 0.5 + 0.3 * sin(angle);
    }
    EXPECT_OK(striae_pattern_builder_new(&plate.titanium, &plate.options, &builder));
    every_kind();
    closing();
    counts();
    knots();
    striae_pattern_builder_free(builder);
    striae_tool_release(plate.tool);
    return expect_summary();
}
