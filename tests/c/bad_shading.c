/* Shading with arguments that make no sense: refused with a text, and still no reason for a black or broken pixel. */
#include <math.h>

#include "plate_fixture.h"

static StriaePattern *pattern;
static const float above[3] = {0.0f, 0.0f, 1.0f};

/* Whatever was refused, the shading can be evaluated. */
static void expect_usable(const StriaeShading *shading) {
    const float lights[3][3] = {{0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}, {0.0f, 0.6f, -0.8f}};
    for (int i = 0; i < 3; i++) {
        float f[3] = {-1.0f, -1.0f, -1.0f};
        EXPECT_OK(striae_eval(shading, lights[i], 0, f));
        for (int c = 0; c < 3; c++) EXPECT(isfinite(f[c]) && f[c] >= 0.0f);
    }
}

static void expect_refused_but_usable(const StriaePoint *point, const float view[3], const char *argument,
                                      const char *value) {
    StriaeShading shading;
    memset(&shading, 0xff, sizeof shading);
    EXPECT_REFUSED(striae_shade(pattern, point, view, &shading), argument, value);
    expect_usable(&shading);
}

#define EXPECT_BAD_POINT(change, argument, value)                                                                  \
    do {                                                                                                           \
        StriaePoint point = plate_point(0.5, 0.5, 0.2);                                                            \
        change;                                                                                                    \
        expect_refused_but_usable(&point, above, argument, value);                                                 \
    } while (0)

static void footprints(void) {
    protects("a footprint of zero, infinite or undefined size is refused by name, and leaves a usable shading");
    EXPECT_BAD_POINT(point.footprint = 9, "footprint", "9");
    EXPECT_BAD_POINT((point.footprint = STRIAE_FOOTPRINT_RADIUS, point.radius = 0.0f), "radius", "0");
    EXPECT_BAD_POINT((point.footprint = STRIAE_FOOTPRINT_RADIUS, point.radius = -1.0f), "radius", "-1");
    EXPECT_BAD_POINT((point.footprint = STRIAE_FOOTPRINT_RADIUS, point.radius = INFINITY), "radius", "inf");
    EXPECT_BAD_POINT((point.footprint = STRIAE_FOOTPRINT_RADIUS, point.radius = NAN), "radius", "NaN");
    EXPECT_BAD_POINT((point.duv_dx[0] = 0.0f, point.duv_dy[1] = 0.0f), "duv_d", "0");
    EXPECT_BAD_POINT(point.duv_dx[0] = INFINITY, "duv_dx", "inf");
    EXPECT_BAD_POINT(point.duv_dy[1] = NAN, "duv_dy", "NaN");
}

static void surface(void) {
    protects("so are places and tangents that are none");
    EXPECT_BAD_POINT(point.uv[0] = (double)NAN, "uv", "NaN");
    EXPECT_BAD_POINT(point.uv[1] = (double)INFINITY, "uv", "inf");
    EXPECT_BAD_POINT(point.normal[2] = 0.0f, "normal", "0");
    EXPECT_BAD_POINT(point.normal[0] = NAN, "normal", "NaN");
    EXPECT_BAD_POINT(point.dp_du[0] = 0.0f, "dp_du", "0");
    EXPECT_BAD_POINT(point.dp_du[1] = INFINITY, "dp_du", "inf");
    EXPECT_BAD_POINT(point.dp_dv[1] = NAN, "dp_dv", "NaN");
}

static void directions(void) {
    protects("and directions; a view from below is no error, and light from nowhere or from below adds nothing");
    const StriaePoint point = plate_point(0.5, 0.5, 0.2);
    const float nan_view[3] = {0.0f, NAN, 1.0f}, none[3] = {0.0f, 0.0f, 0.0f}, infinite[3] = {INFINITY, 0.0f, 1.0f};
    expect_refused_but_usable(&point, nan_view, "view", "NaN");
    expect_refused_but_usable(&point, none, "view", "0");
    expect_refused_but_usable(&point, infinite, "view", "inf");

    StriaeShading shading;
    const float below[3] = {0.0f, 0.6f, -0.8f};
    EXPECT_OK(striae_shade(pattern, &point, below, &shading));
    expect_usable(&shading);

    EXPECT_OK(striae_shade(pattern, &point, above, &shading));
    const float *const dark[] = {nan_view, none, infinite, below};
    for (int i = 0; i < 4; i++) {
        float f[3] = {-1.0f, -1.0f, -1.0f};
        EXPECT_OK(striae_eval(&shading, dark[i], 0, f));
        for (int c = 0; c < 3; c++) EXPECT(f[c] == 0.0f);
    }
}

static void null_arguments(void) {
    protects("NULL is answered in every place");
    const StriaePoint point = plate_point(0.5, 0.5, 0.2);
    StriaeShading shading;
    StriaeFrame frame;
    float out[3];
    EXPECT_REFUSED(striae_shade(NULL, &point, above, &shading), "pattern", "NULL");
    EXPECT_REFUSED(striae_shade(pattern, NULL, above, &shading), "point", "NULL");
    EXPECT_REFUSED(striae_shade(pattern, &point, NULL, &shading), "view", "NULL");
    EXPECT_REFUSED(striae_shade(pattern, &point, above, NULL), "shading", "NULL");
    EXPECT_OK(striae_shade(pattern, &point, above, &shading));
    EXPECT_REFUSED(striae_eval(NULL, above, 0, out), "shading", "NULL");
    EXPECT_REFUSED(striae_eval(&shading, NULL, 0, out), "light", "NULL");
    EXPECT_REFUSED(striae_eval(&shading, above, 0, NULL), "f", "NULL");
    EXPECT_REFUSED(striae_frame(NULL, &frame), "point", "NULL");
    EXPECT_REFUSED(striae_frame(&point, NULL), "frame", "NULL");
    EXPECT_REFUSED(striae_shade_world(NULL, &point, above, &frame, &shading), "pattern", "NULL");
    EXPECT_REFUSED(striae_shade_world(pattern, NULL, above, &frame, &shading), "point", "NULL");
    EXPECT_REFUSED(striae_shade_world(pattern, &point, NULL, &frame, &shading), "view", "NULL");
    EXPECT_REFUSED(striae_shade_world(pattern, &point, above, NULL, &shading), "frame", "NULL");
    EXPECT_REFUSED(striae_shade_world(pattern, &point, above, &frame, NULL), "shading", "NULL");
    EXPECT_OK(striae_frame(&point, &frame));
    EXPECT_REFUSED(striae_eval_world(NULL, &frame, above, 0, out), "shading", "NULL");
    EXPECT_REFUSED(striae_eval_world(&shading, NULL, above, 0, out), "frame", "NULL");
    EXPECT_REFUSED(striae_eval_world(&shading, &frame, NULL, 0, out), "light", "NULL");
    EXPECT_REFUSED(striae_eval_world(&shading, &frame, above, 0, NULL), "f", "NULL");
    EXPECT_REFUSED(striae_frame_to_local(NULL, above, out), "frame", "NULL");
    EXPECT_REFUSED(striae_frame_to_local(&frame, NULL, out), "world", "NULL");
    EXPECT_REFUSED(striae_frame_to_local(&frame, above, NULL), "local", "NULL");
    EXPECT_REFUSED(striae_frame_to_world(NULL, above, out), "frame", "NULL");
    EXPECT_REFUSED(striae_frame_to_world(&frame, NULL, out), "local", "NULL");
    EXPECT_REFUSED(striae_frame_to_world(&frame, above, NULL), "world", "NULL");
    EXPECT(striae_last_error() != NULL);
}

static void size(void) {
    protects("a shading takes 8 KiB of stack at most");
    EXPECT(sizeof(StriaeShading) <= 8192);
}

static void releases(void) {
    protects("retaining, releasing and freeing NULL is fine");
    striae_tool_retain(NULL);
    striae_tool_release(NULL);
    striae_cross_section_retain(NULL);
    striae_cross_section_release(NULL);
    striae_pattern_retain(NULL);
    striae_pattern_release(NULL);
    striae_pattern_builder_free(NULL);
    EXPECT(striae_version() == ((STRIAE_VERSION_MAJOR << 16) | (STRIAE_VERSION_MINOR << 8) | STRIAE_VERSION_PATCH));
}

int main(void) {
    Plate plate;
    plate_init(&plate);
    pattern = plate_pattern(&plate);
    striae_tool_release(plate.tool);
    footprints();
    surface();
    directions();
    null_arguments();
    size();
    releases();
    striae_pattern_release(pattern);
    return expect_summary();
}
