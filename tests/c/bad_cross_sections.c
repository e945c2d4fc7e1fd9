/* Processes from which no cross-section follows. */
#include <math.h>
#include <stdint.h>

#include "expect.h"

#define STALE ((StriaeCrossSection *)(void *)&expect_count)

static StriaeTool *cone;
static StriaeMaterial titanium = {.struct_size = sizeof titanium};
static const StriaeProcess good = {
    .struct_size = sizeof good, .depth_law = STRIAE_DEPTH_LAW_BOSCH2004, .force_kgf = 2.0};

static void expect_no_section(const StriaeTool *tool, const StriaeMaterial *material, const StriaeProcess *process,
                              const char *argument, const char *value) {
    StriaeCrossSection *section = STALE;
    EXPECT_REFUSED(striae_cross_section(tool, material, process, &section), argument, value);
    EXPECT(section == NULL);
}

#define EXPECT_BAD_PROCESS(field, bad, value)                                                                      \
    do {                                                                                                           \
        StriaeProcess process = good;                                                                              \
        process.field = (bad);                                                                                     \
        expect_no_section(cone, &titanium, &process, #field, value);                                               \
    } while (0)

static void processes(void) {
    protects("absurd forces, angles, laws and sizes are refused, and no cross-section is left half built");
    EXPECT_BAD_PROCESS(force_kgf, NAN, "NaN");
    EXPECT_BAD_PROCESS(force_kgf, INFINITY, "inf");
    EXPECT_BAD_PROCESS(force_kgf, -4.0, "-4");
    EXPECT_BAD_PROCESS(force_kgf, 1e30, "");
    EXPECT_BAD_PROCESS(spin_deg, NAN, "NaN");
    EXPECT_BAD_PROCESS(spin_deg, INFINITY, "inf");
    EXPECT_BAD_PROCESS(tilt_deg, NAN, "NaN");
    EXPECT_BAD_PROCESS(tilt_deg, -10.0, "-10");
    EXPECT_BAD_PROCESS(tilt_deg, 120.0, "120");
    EXPECT_BAD_PROCESS(azimuth_deg, NAN, "NaN");
    EXPECT_BAD_PROCESS(azimuth_deg, -INFINITY, "-inf");
    EXPECT_BAD_PROCESS(depth_law, 77u, "77");
    EXPECT_BAD_PROCESS(struct_size, 0, "0");
    EXPECT_BAD_PROCESS(struct_size, 1, "1");
}

static void hardness(void) {
    protects("absurd hardness is refused");
    const double bad[] = {NAN, INFINITY, 0.0, -150.0, 1e9};
    const char *const text[] = {"NaN", "inf", "0", "-150", "1000000000"};
    for (int i = 0; i < 5; i++) {
        StriaeMaterial material = titanium;
        material.hardness_hv = bad[i];
        expect_no_section(cone, &material, &good, "hardness_hv", text[i]);
    }
    StriaeMaterial unsized = titanium;
    unsized.struct_size = 2;
    expect_no_section(cone, &unsized, &good, "struct_size", "2");
    StriaeMaterial odd = titanium;
    odd.surface.kind = 42;
    expect_no_section(cone, &odd, &good, "kind", "42");
}

static void short_tool(void) {
    protects("a tool shorter than the scratch is deep is refused, not clipped in silence");
    StriaeTool *stub = NULL;
    EXPECT_OK(striae_tool_sphero_cone(60.0, 0.005, 0.001, &stub));
    StriaeProcess process = good;
    process.force_kgf = 4.0;
    expect_no_section(stub, &titanium, &process, "force_kgf", "4");
    EXPECT(strstr(striae_last_error(), "height_mm") != NULL);
    striae_tool_release(stub);
}

static void null_arguments(void) {
    protects("NULL is answered, never followed");
    expect_no_section(NULL, &titanium, &good, "tool", "NULL");
    expect_no_section(cone, NULL, &good, "material", "NULL");
    expect_no_section(cone, &titanium, NULL, "process", "NULL");
    EXPECT_REFUSED(striae_cross_section(cone, &titanium, &good, NULL), "cross_section", "NULL");
}

static void reading(void) {
    protects("reading a cross-section checks its arguments, and copies no more than there is room for");
    StriaeCrossSection *section = NULL;
    StriaeCrossSectionInfo info = {.struct_size = sizeof info};
    double beyond[1][2] = {{-77.0, -77.0}};
    size_t count = 0;
    EXPECT_OK(striae_cross_section(cone, &titanium, &good, &section));
    EXPECT_OK(striae_cross_section_info(section, &info));
    EXPECT(info.vertex_count >= 5 && info.depth_mm > 0.0 && info.crest_width_mm > info.groove_width_mm);

    EXPECT_REFUSED(striae_cross_section_info(NULL, &info), "cross_section", "NULL");
    EXPECT_REFUSED(striae_cross_section_info(section, NULL), "info", "NULL");
    StriaeCrossSectionInfo unsized = {.struct_size = 0};
    EXPECT_REFUSED(striae_cross_section_info(section, &unsized), "struct_size", "0");

    double (*vertices)[2] = calloc(info.vertex_count, sizeof *vertices);
    EXPECT_OK(striae_cross_section_vertices(section, vertices, info.vertex_count, &count));
    EXPECT(count == info.vertex_count);
    for (size_t i = 1; i < count; i++) EXPECT(vertices[i][0] >= vertices[i - 1][0]);
    free(vertices);

    count = 0;
    EXPECT_OK(striae_cross_section_vertices(section, beyond, 0, &count));
    EXPECT(beyond[0][0] == -77.0 && beyond[0][1] == -77.0 && count == info.vertex_count);
    count = 0;
    EXPECT_OK(striae_cross_section_vertices(section, NULL, 5, &count));
    EXPECT(count == info.vertex_count);
    EXPECT_OK(striae_cross_section_vertices(section, beyond, 1, NULL));
    EXPECT_REFUSED(striae_cross_section_vertices(NULL, beyond, 1, &count), "cross_section", "NULL");
    striae_cross_section_release(section);
}

int main(void) {
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &cone));
    EXPECT_OK(striae_material_metal(STRIAE_METAL_TITANIUM, &titanium));
    processes();
    hardness();
    short_tool();
    null_arguments();
    reading();
    striae_tool_release(cone);
    return expect_summary();
}
