/* Tools, base BRDFs and materials that cannot be. */
#include <math.h>

#include "expect.h"

/* What an out-pointer held before the call; a failure must not leave it there. */
#define STALE ((StriaeTool *)(void *)&expect_count)

#define EXPECT_NO_TOOL(call, argument, value)                                                                      \
    do {                                                                                                           \
        StriaeTool *tool = STALE;                                                                                  \
        EXPECT_REFUSED(call, argument, value);                                                                     \
        EXPECT(tool == NULL);                                                                                      \
    } while (0)

static void cones(void) {
    protects("a cone with impossible sizes is refused by name, value and range, and not built");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(NAN, 0.2, 1.0, &tool), "half_angle_deg", "NaN");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(INFINITY, 0.2, 1.0, &tool), "half_angle_deg", "inf");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(-INFINITY, 0.2, 1.0, &tool), "half_angle_deg", "-inf");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(-60.0, 0.2, 1.0, &tool), "half_angle_deg", "-60");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(0.0, 0.2, 1.0, &tool), "half_angle_deg", "0");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(90.0, 0.2, 1.0, &tool), "half_angle_deg", "90");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(1e300, 0.2, 1.0, &tool), "half_angle_deg", "");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, NAN, 1.0, &tool), "tip_radius_mm", "NaN");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, -0.2, 1.0, &tool), "tip_radius_mm", "-0.2");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, INFINITY, 1.0, &tool), "tip_radius_mm", "inf");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, 0.2, NAN, &tool), "height_mm", "NaN");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, 0.2, 0.0, &tool), "height_mm", "0");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, 0.2, -1.0, &tool), "height_mm", "-1");
    EXPECT_NO_TOOL(striae_tool_sphero_cone(60.0, 0.2, INFINITY, &tool), "height_mm", "inf");
    EXPECT_REFUSED(striae_tool_sphero_cone(60.0, 0.2, 1.0, NULL), "tool", "NULL");
}

static void pyramids_and_wedges(void) {
    protects("so is a pyramid or a wedge");
    EXPECT_NO_TOOL(striae_tool_pyramid(0, 136.0, 1.0, &tool), "sides", "0");
    EXPECT_NO_TOOL(striae_tool_pyramid(2, 136.0, 1.0, &tool), "sides", "2");
    EXPECT_NO_TOOL(striae_tool_pyramid(4000000000u, 136.0, 1.0, &tool), "sides", "4000000000");
    EXPECT_NO_TOOL(striae_tool_pyramid(4, NAN, 1.0, &tool), "angle_deg", "NaN");
    EXPECT_NO_TOOL(striae_tool_pyramid(4, -136.0, 1.0, &tool), "angle_deg", "-136");
    EXPECT_NO_TOOL(striae_tool_pyramid(4, 180.0, 1.0, &tool), "angle_deg", "180");
    EXPECT_NO_TOOL(striae_tool_pyramid(4, 136.0, -1.0, &tool), "height_mm", "-1");
    EXPECT_NO_TOOL(striae_tool_pyramid(4, 136.0, INFINITY, &tool), "height_mm", "inf");
    EXPECT_REFUSED(striae_tool_pyramid(4, 136.0, 1.0, NULL), "tool", "NULL");
    EXPECT_NO_TOOL(striae_tool_wedge(NAN, 60.0, 1.0, &tool), "width_mm", "NaN");
    EXPECT_NO_TOOL(striae_tool_wedge(0.0, 60.0, 1.0, &tool), "width_mm", "0");
    EXPECT_NO_TOOL(striae_tool_wedge(-3.0, 60.0, 1.0, &tool), "width_mm", "-3");
    EXPECT_NO_TOOL(striae_tool_wedge(3.0, INFINITY, 1.0, &tool), "angle_deg", "inf");
    EXPECT_NO_TOOL(striae_tool_wedge(3.0, 0.0, 1.0, &tool), "angle_deg", "0");
    EXPECT_NO_TOOL(striae_tool_wedge(3.0, 60.0, NAN, &tool), "height_mm", "NaN");
    EXPECT_REFUSED(striae_tool_wedge(3.0, 60.0, 1.0, NULL), "tool", "NULL");
    EXPECT_NO_TOOL(striae_tool_preset(99, &tool), "preset", "99");
    EXPECT_REFUSED(striae_tool_preset(STRIAE_TOOL_PRESET_NAIL, NULL), "tool", "NULL");
}

static void base_brdfs(void) {
    protects("base BRDFs refuse unphysical numbers and leave the caller's struct alone");
    StriaeBrdf brdf, before;
    memset(&brdf, 7, sizeof brdf);
    before = brdf;
    const float nan_albedo[3] = {0.5f, NAN, 0.5f}, negative[3] = {-0.25f, 0.5f, 0.5f},
                bright[3] = {0.5f, 0.5f, 1.5f};
    const float infinite[3] = {0.5f, 0.5f, INFINITY}, grey[3] = {0.5f, 0.5f, 0.5f};
    EXPECT_REFUSED(striae_brdf_lambert(nan_albedo, &brdf), "albedo", "NaN");
    EXPECT_REFUSED(striae_brdf_lambert(negative, &brdf), "albedo", "-0.25");
    EXPECT_REFUSED(striae_brdf_lambert(bright, &brdf), "albedo", "1.5");
    EXPECT_REFUSED(striae_brdf_lambert(infinite, &brdf), "albedo", "inf");
    EXPECT_REFUSED(striae_brdf_lambert(NULL, &brdf), "albedo", "NULL");
    EXPECT_REFUSED(striae_brdf_lambert(grey, NULL), "brdf", "NULL");
    EXPECT_REFUSED(striae_brdf_oren_nayar(bright, 0.5f, &brdf), "albedo", "1.5");
    EXPECT_REFUSED(striae_brdf_oren_nayar(grey, 1.5f, &brdf), "roughness", "1.5");
    EXPECT_REFUSED(striae_brdf_oren_nayar(NULL, 0.5f, &brdf), "albedo", "NULL");
    EXPECT_REFUSED(striae_brdf_oren_nayar(grey, 0.5f, NULL), "brdf", "NULL");
    EXPECT_REFUSED(striae_brdf_phong(negative, 20.0f, &brdf), "specular", "-0.25");
    EXPECT_REFUSED(striae_brdf_phong(grey, 0.5f, &brdf), "exponent", "0.5");
    EXPECT_REFUSED(striae_brdf_phong(grey, INFINITY, &brdf), "exponent", "inf");
    EXPECT_REFUSED(striae_brdf_phong(NULL, 20.0f, &brdf), "specular", "NULL");
    EXPECT_REFUSED(striae_brdf_phong(grey, 20.0f, NULL), "brdf", "NULL");
    EXPECT_REFUSED(striae_brdf_schlick(bright, 0.2f, &brdf), "f0", "1.5");
    EXPECT_REFUSED(striae_brdf_schlick(grey, 2.0f, &brdf), "alpha", "2");
    EXPECT_REFUSED(striae_brdf_schlick(NULL, 0.2f, &brdf), "f0", "NULL");
    EXPECT_REFUSED(striae_brdf_schlick(grey, 0.2f, NULL), "brdf", "NULL");
    EXPECT_REFUSED(striae_brdf_metal(99, 0.2f, &brdf), "metal", "99");
    EXPECT_REFUSED(striae_brdf_metal(STRIAE_METAL_STEEL, -0.5f, &brdf), "alpha", "-0.5");
    EXPECT_REFUSED(striae_brdf_metal(STRIAE_METAL_STEEL, 0.0f, &brdf), "alpha", "0");
    EXPECT_REFUSED(striae_brdf_metal(STRIAE_METAL_STEEL, NAN, &brdf), "alpha", "NaN");
    EXPECT_REFUSED(striae_brdf_metal(STRIAE_METAL_STEEL, 7.5f, &brdf), "alpha", "7.5");
    EXPECT_REFUSED(striae_brdf_metal(STRIAE_METAL_STEEL, 0.2f, NULL), "brdf", "NULL");
    EXPECT(memcmp(&brdf, &before, sizeof brdf) == 0);
}

static void materials(void) {
    protects("a material's struct_size and metal are checked");
    StriaeMaterial material = {.struct_size = sizeof material};
    EXPECT_REFUSED(striae_material_metal(99, &material), "metal", "99");
    EXPECT_REFUSED(striae_material_metal(STRIAE_METAL_TITANIUM, NULL), "material", "NULL");
    material.struct_size = 0;
    EXPECT_REFUSED(striae_material_metal(STRIAE_METAL_TITANIUM, &material), "struct_size", "0");
    material.struct_size = 3;
    EXPECT_REFUSED(striae_material_metal(STRIAE_METAL_TITANIUM, &material), "struct_size", "3");
}

int main(void) {
    cones();
    pyramids_and_wedges();
    base_brdfs();
    materials();
    return expect_summary();
}
