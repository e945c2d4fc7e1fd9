/* The scratches in a footprint, as a renderer asks for them. */
#include <math.h>
#include <stdint.h>

#include "plate_fixture.h"

static bool near_to(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

static void one_scratch(const StriaePattern *pattern) {
    protects("a pixel beside the centre line knows the scratch, its place on it, and the direction in the scene");
    StriaeHit hits[4];
    StriaeHitCount count;
    StriaeFrame frame;
    float world[3];
    memset(hits, 0xff, sizeof hits);
    /* A quarter along the path of 48 mm, 0.04 mm to the left of travel along +u. */
    const StriaePoint point = plate_point(0.3, 0.5 + 0.04 / 40.0, 0.01);
    EXPECT_OK(striae_pattern_query(pattern, &point, hits, 4, &count));
    EXPECT(count.written == 1 && count.found == 1 && count.complete == 1);
    EXPECT(hits[0].scratch == 0);
    EXPECT(near_to(hits[0].arc_length, 12.0, 1e-4));
    EXPECT(near_to(hits[0].offset_mm, -0.04, 1e-6));
    EXPECT((double)hits[0].coverage == 1.0);
    EXPECT(hits[0].depth_mm < hits[0].deepest_mm && hits[0].deepest_mm > 0.0f);
    EXPECT_OK(striae_frame(&point, &frame));
    EXPECT_OK(striae_frame_to_world(&frame, hits[0].travel, world));
    EXPECT(near_to((double)world[0], 1.0, 1e-6) && near_to((double)world[1], 0.0, 1e-6) && world[2] == 0.0f);
    EXPECT(hits[1].scratch == UINT32_MAX);

    protects("without room the count is told all the same, and NULL will do");
    EXPECT_OK(striae_pattern_query(pattern, &point, NULL, 0, &count));
    EXPECT(count.written == 0 && count.found == 1 && count.complete == 1);
}

static void near_or_not(const StriaePattern *pattern) {
    protects("what is not near the scratch is told without shading it, from anywhere and from one direction");
    const float above[3] = {0.0f, 0.0f, 2.0f}, grazing[3] = {0.0f, 1.0f, 0.01f};
    StriaePoint point = plate_point(0.3, 0.5 + 0.04 / 40.0, 0.01);
    uint32_t is_near = 7;
    EXPECT_OK(striae_near(pattern, &point, NULL, &is_near));
    EXPECT(is_near == 1);
    EXPECT_OK(striae_near(pattern, &point, above, &is_near));
    EXPECT(is_near == 1);
    point = plate_point(0.3, 0.9, 0.01);
    EXPECT_OK(striae_near(pattern, &point, NULL, &is_near));
    EXPECT(is_near == 0);
    is_near = 7;
    EXPECT_OK(striae_near(pattern, &point, grazing, &is_near));
    EXPECT(is_near == 0);

    protects("a point that cannot be told is left to striae_shade(), which says why");
    point.normal[2] = 0.0f;
    EXPECT_OK(striae_near(pattern, &point, above, &is_near));
    EXPECT(is_near == 1);
    EXPECT_REFUSED(striae_near(NULL, &point, above, &is_near), "pattern", "NULL");
    EXPECT_REFUSED(striae_near(pattern, NULL, above, &is_near), "point", "NULL");
    EXPECT_REFUSED(striae_near(pattern, &point, above, NULL), "is_near", "NULL");
}

static void refused(const StriaePattern *pattern) {
    protects("what cannot be is refused by name, and leaves a count of nothing");
    StriaePoint point = plate_point(0.5, 0.5, 0.1);
    StriaeHit hit;
    StriaeHitCount count = {9, 9, 9};
    EXPECT_REFUSED(striae_pattern_query(NULL, &point, &hit, 1, &count), "pattern", "NULL");
    EXPECT_REFUSED(striae_pattern_query(pattern, NULL, &hit, 1, &count), "point", "NULL");
    EXPECT_REFUSED(striae_pattern_query(pattern, &point, NULL, 1, &count), "hits", "NULL");
    EXPECT_REFUSED(striae_pattern_query(pattern, &point, &hit, 1, NULL), "count", "NULL");
    EXPECT_REFUSED(striae_pattern_query(pattern, &point, &hit, SIZE_MAX, &count), "capacity", "1844674407");
    point.footprint = 7;
    EXPECT_REFUSED(striae_pattern_query(pattern, &point, &hit, 1, &count), "footprint", "7");
    point = plate_point((double)NAN, 0.5, 0.1);
    count = (StriaeHitCount){9, 9, 9};
    EXPECT_REFUSED(striae_pattern_query(pattern, &point, &hit, 1, &count), "uv", "NaN");
    EXPECT(count.written == 0 && count.found == 0 && count.complete == 0);
}

int main(void) {
    Plate plate;
    plate_init(&plate);
    StriaePattern *pattern = plate_pattern(&plate);
    one_scratch(pattern);
    near_or_not(pattern);
    refused(pattern);
    striae_tool_release(plate.tool);
    striae_pattern_release(pattern);
    return expect_summary();
}
