/* Scratches drawn on meshes: what a surface takes and refuses, and a scratch that is where it was drawn. */
#include <math.h>
#include <stdint.h>

#include "plate_fixture.h"

static Plate plate;
static double positions[4][3] = {{0, 0, 0}, {60, 0, 0}, {60, 40, 0}, {0, 40, 0}};
static double uv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static uint32_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
static double points[3][3] = {{6, 20, 1}, {30, 20, -2}, {54, 20, 1}};

static StriaeStatus make(size_t vertex_count, size_t triangle_count, StriaeSurface **surface) {
    return striae_surface_new((const double (*)[3])positions, (const double (*)[2])uv, vertex_count,
                              (const uint32_t (*)[3])triangles, triangle_count, surface);
}

static StriaeScratch drawn_on(const StriaeSurface *surface) {
    StriaeScratch scratch = plate.scratch;
    scratch.surface = surface;
    scratch.points_uv = NULL;
    scratch.points_xyz = (const double (*)[3])points;
    scratch.point_count = 3;
    scratch.curve = STRIAE_CURVE_CATMULL_ROM;
    return scratch;
}

static void where_it_was_drawn(void) {
    protects("a path drawn on a mesh lies in texture space where the mesh has it, and outlives the surface");
    StriaeSurface *surface = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaePattern *pattern = NULL;
    StriaeShading shading;
    const float view[3] = {0.0f, 0.0f, 1.0f};
    EXPECT_OK(make(4, 2, &surface));
    striae_surface_retain(surface);
    striae_surface_release(surface);
    StriaeScratch scratch = drawn_on(surface);
    EXPECT_OK(striae_pattern_builder_new(&plate.titanium, &plate.options, &builder));
    EXPECT_OK(striae_pattern_builder_add_scratch(builder, &scratch));
    scratch.points_xyz = NULL;
    EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, &scratch), "points_xyz", "NULL");
    scratch = drawn_on(surface);
    points[1][2] = NAN;
    EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, &scratch), "points_xyz[1]", "NaN");
    points[1][2] = 0.0;
    for (int i = 0; i < 3; i++) points[i][0] += 1000.0;
    EXPECT_REFUSED(striae_pattern_builder_add_scratch(builder, &scratch), "points_xyz", "off the surface");
    striae_surface_release(surface);
    EXPECT_OK(striae_pattern_builder_build(builder, &pattern));
    const StriaePoint on = plate_point(0.5, 0.5, 0.05), off = plate_point(0.5, 0.55, 0.05);
    EXPECT_OK(striae_shade(pattern, &on, view, &shading));
    EXPECT(shading.coverage > 0.9f);
    EXPECT_OK(striae_shade(pattern, &off, view, &shading));
    EXPECT(shading.coverage == 0.0f);
    striae_pattern_release(pattern);
    striae_pattern_builder_free(builder);
}

static void bad_meshes(void) {
    protects("meshes that cannot be are refused");
    StriaeSurface *surface = (StriaeSurface *)(void *)&plate;
    EXPECT_REFUSED(make(4, 0, &surface), "triangle_count", "0");
    EXPECT(surface == NULL);
    EXPECT_REFUSED(make(3, 2, &surface), "triangles[1]", "3");
    EXPECT_REFUSED(make(SIZE_MAX / 4, 2, &surface), "vertex_count", "");
    EXPECT_REFUSED(make(4, 2, NULL), "surface", "NULL");
    EXPECT_REFUSED(striae_surface_new(NULL, (const double (*)[2])uv, 4, (const uint32_t (*)[3])triangles, 2, &surface),
                   "positions", "NULL");
    EXPECT_REFUSED(
        striae_surface_new((const double (*)[3])positions, NULL, 4, (const uint32_t (*)[3])triangles, 2, &surface),
        "uv", "NULL");
    positions[2][1] = INFINITY;
    EXPECT_REFUSED(make(4, 2, &surface), "positions[2]", "inf");
    positions[2][1] = 40.0;
    uv[3][0] = NAN;
    EXPECT_REFUSED(make(4, 2, &surface), "uv[3]", "NaN");
    uv[3][0] = 0.0;
    striae_surface_retain(NULL);
    striae_surface_release(NULL);
}

int main(void) {
    plate_init(&plate);
    where_it_was_drawn();
    bad_meshes();
    striae_tool_release(plate.tool);
    return expect_summary();
}
