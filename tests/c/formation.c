/* Formation from C: materials, tools from meshes and profiles, wanted sizes, hardness maps, the fixed hand. */
#include "expect.h"
#include <math.h>

static StriaeMaterial steel(void) {
    StriaeMaterial material = {.struct_size = sizeof material};
    EXPECT_OK(striae_material_metal(STRIAE_METAL_STEEL, &material));
    return material;
}

static StriaeCrossSectionInfo formed(const StriaeTool *tool, const StriaeMaterial *material,
                                     const StriaeProcess *process) {
    StriaeCrossSection *section = NULL;
    StriaeCrossSectionInfo info = {.struct_size = sizeof info};
    EXPECT_OK(striae_cross_section(tool, material, process, &section));
    EXPECT_OK(striae_cross_section_info(section, &info));
    striae_cross_section_release(section);
    return info;
}

static void tools(void) {
    protects("every named tool forms a scratch");
    const StriaeMaterial material = steel();
    for (uint32_t preset = 0; preset <= STRIAE_TOOL_PRESET_ABRASIVE_GRAIN; preset++) {
        StriaeTool *tool = NULL;
        EXPECT_OK(striae_tool_preset(preset, &tool));
        const StriaeProcess process = {.struct_size = sizeof process, .force_kgf = 0.3};
        EXPECT(formed(tool, &material, &process).depth_mm > 0.0);
        striae_tool_release(tool);
    }

    protects("a mesh and a profile are tools, in any unit");
    const double positions[4][3] = {{0, 0, 0}, {0, 1, 1}, {-0.9, -0.5, 1}, {0.9, -0.5, 1}};
    const uint32_t triangles[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    const double edge[3][2] = {{-1.0, 1.0}, {0.0, 0.0}, {1.0, 1.0}};
    const StriaeProcess process = {
        .struct_size = sizeof process, .depth_law = STRIAE_DEPTH_LAW_STATED, .depth_mm = 0.01};
    StriaeTool *mesh = NULL, *profile = NULL, *nothing = (StriaeTool *)&process;
    EXPECT_OK(striae_tool_mesh(positions, 4, triangles, 3, 1.0, &mesh));
    EXPECT(fabs(formed(mesh, &material, &process).groove_width_mm - 0.018) < 1e-9);
    EXPECT_OK(striae_tool_profile(edge, 3, &profile));
    EXPECT(fabs(formed(profile, &material, &process).groove_width_mm - 0.02) < 1e-9);
    EXPECT_REFUSED(striae_tool_mesh(positions, 3, triangles, 3, 1.0, &nothing), "triangles", "3");
    EXPECT(nothing == NULL);
    EXPECT(striae_tool_load("no-such-tool.stl", 1.0, &nothing) == STRIAE_STATUS_FILE);
    EXPECT(strstr(striae_last_error(), "no-such-tool.stl") != NULL);
    striae_tool_release(mesh);
    striae_tool_release(profile);
}

static void materials(void) {
    protects("pile-up, recovery, plasticity and layers are the material's, and checked");
    StriaeTool *tool = NULL;
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, &tool));
    const StriaeProcess process = {
        .struct_size = sizeof process, .depth_law = STRIAE_DEPTH_LAW_STATED, .depth_mm = 0.01};
    StriaeMaterial material = steel();
    const StriaeCrossSectionInfo full = formed(tool, &material, &process);
    EXPECT_OK(striae_material_set_plasticity(2e-3, 0.3, &material));
    const StriaeCrossSectionInfo hardened = formed(tool, &material, &process);
    EXPECT(hardened.left.height_mm < full.left.height_mm);
    EXPECT(hardened.depth_mm < 0.01 && hardened.depth_mm > 0.005);
    material.pile_up_law = STRIAE_PILE_UP_LAW_NONE;
    EXPECT(formed(tool, &material, &process).left.height_mm == 0.0);
    for (uint32_t preset = 0; preset <= STRIAE_MATERIAL_PRESET_CERAMIC; preset++)
        EXPECT_OK(striae_material_preset(preset, &material));
    EXPECT_REFUSED(striae_material_preset(99, &material), "preset", "99");
    StriaeCrossSection *section = NULL;
    StriaeLayer layer = {.thickness_mm = -1.0, .scratched = material.scratched};
    material.layers = &layer;
    material.layer_count = 1;
    EXPECT_REFUSED(striae_cross_section(tool, &material, &process, &section), "layers[0].thickness_mm", "-1");
    material.layer_count = 5;
    EXPECT_REFUSED(striae_cross_section(tool, &material, &process, &section), "layer_count", "5");
    striae_tool_release(tool);
}

static void wanted_sizes(void) {
    protects("from a wanted width to a force and back, exactly");
    StriaeTool *tool = NULL;
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &tool));
    const StriaeMaterial material = steel();
    for (uint32_t law = 0; law <= STRIAE_DEPTH_LAW_STATED; law++) {
        StriaeProcess process = {.struct_size = sizeof process, .depth_law = law, .tilt_deg = 10.0};
        EXPECT_OK(striae_process_for(tool, &material, STRIAE_WANTED_GROOVE_WIDTH, 0.1, &process));
        EXPECT(fabs(formed(tool, &material, &process).groove_width_mm - 0.1) < 1e-10);
    }
    StriaeProcess process = {.struct_size = sizeof process};
    EXPECT_REFUSED(striae_process_for(tool, &material, 7, 0.1, &process), "wanted", "7");
    EXPECT_REFUSED(striae_process_for(tool, &material, STRIAE_WANTED_DEPTH, -0.1, &process), "depth_mm", "-0.1");
    striae_tool_release(tool);
}

/* How much of a pixel in the middle of the plate a scratch over it covers. */
static float coverage(const StriaeHardnessMap *map, uint32_t held) {
    StriaeTool *tool = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaePattern *pattern = NULL;
    const StriaeMaterial material = steel();
    const StriaePatternOptions options = {.struct_size = sizeof options, .mm_per_scene_unit = 1.0, .units_per_uv = {10.0, 10.0}};
    const double path[2][2] = {{0.5, 0.1}, {0.5, 0.9}};
    const StriaeKey key = {.force_kgf = 1.0, .tilt_deg = 55.0, .azimuth_deg = 90.0};
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_NAIL, &tool));
    const StriaeScratch scratch = {.struct_size = sizeof scratch, .tool = tool, .held = held, .points_uv = path,
                                   .point_count = 2, .keys = &key, .key_count = 1};
    EXPECT_OK(striae_pattern_builder_new(&material, &options, &builder));
    if (map)
        EXPECT_OK(striae_pattern_builder_set_hardness(builder, map));
    EXPECT_OK(striae_pattern_builder_add_scratch(builder, &scratch));
    EXPECT_OK(striae_pattern_builder_build(builder, &pattern));
    const StriaePoint point = {.uv = {0.5, 0.5}, .dp_du = {10, 0, 0}, .dp_dv = {0, 10, 0}, .normal = {0, 0, 1},
                               .footprint = STRIAE_FOOTPRINT_RADIUS, .radius = 0.5f};
    const float view[3] = {0, 0, 1};
    StriaeShading shading;
    EXPECT_OK(striae_shade(pattern, &point, view, &shading));
    striae_pattern_release(pattern);
    striae_pattern_builder_free(builder);
    striae_tool_release(tool);
    return shading.coverage;
}

static void surfaces(void) {
    protects("a hardness map widens and narrows scratches; a hand held to the surface is another than one held to the path");
    const float soft[1] = {0.0f}, hard[1] = {1.0f};
    const StriaeReading readings[2] = {{{0.0, 0.5}, 40.0}, {{1.0, 0.5}, 60.0}};
    StriaeHardnessMap *map = NULL;
    const float plain = coverage(NULL, STRIAE_HELD_TO_PATH);
    EXPECT_OK(striae_hardness_map_texture(soft, 1, 1, 50.0, 500.0, &map));
    EXPECT(coverage(map, STRIAE_HELD_TO_PATH) > 1.2f * plain);
    striae_hardness_map_release(map);
    EXPECT_OK(striae_hardness_map_texture(hard, 1, 1, 50.0, 500.0, &map));
    EXPECT(coverage(map, STRIAE_HELD_TO_PATH) < 0.8f * plain);
    striae_hardness_map_release(map);
    EXPECT_OK(striae_hardness_map_readings(readings, 2, &map));
    EXPECT(coverage(map, STRIAE_HELD_TO_PATH) > 1.2f * plain);
    striae_hardness_map_release(map);
    EXPECT_REFUSED(striae_hardness_map_readings(NULL, 0, &map), "reading_count", "0");
    EXPECT(map == NULL);
    EXPECT(striae_hardness_map_load("no-such-map.png", 50.0, 500.0, &map) == STRIAE_STATUS_FILE);
    EXPECT(fabsf(coverage(NULL, STRIAE_HELD_TO_SURFACE) - plain) > 0.01f * plain);
    striae_hardness_map_release(NULL);
}

int main(void) {
    tools();
    materials();
    wanted_sizes();
    surfaces();
    return expect_summary();
}
