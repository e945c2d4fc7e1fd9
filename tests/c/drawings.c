/* SVG drawings: strokes scratch the plate, as wide as they are drawn or as hard as told; what is no drawing is refused. */
#include <math.h>

#include "plate_fixture.h"

static const char *const PATH = "drawings-test.svg";
static const char *const TEXT = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 60 40'>\n"
                                "<path stroke='black' stroke-width='0.3' d='M 6 20 L 54 20'/></svg>\n";

static Plate plate;

static float drawn(const StriaeSvgOptions *options) {
    StriaePatternBuilder *builder = plate_builder(&plate);
    EXPECT_OK(striae_pattern_builder_add_svg(builder, PATH, options));
    const float coverage = plate_built_shading(builder, 0.5, 0.5).coverage;
    striae_pattern_builder_free(builder);
    return coverage;
}

static void widths(void) {
    protects("a stroke 0.3 mm wide leaves crests 0.3 mm apart, and the same scratch as the force that does so");
    StriaeProcess process = {.struct_size = sizeof process};
    EXPECT_OK(striae_process_for(plate.tool, &plate.titanium, STRIAE_WANTED_CREST_WIDTH, 0.3, &process));
    StriaeSvgOptions options = {.struct_size = sizeof options, .tool = plate.tool};
    const float by_width = drawn(&options);
    options.force_kgf = process.force_kgf;
    EXPECT(by_width > 0.3f && fabsf(drawn(&options) - by_width) < 1e-4f);
    options.depth_law = STRIAE_DEPTH_LAW_STATED;
    EXPECT(fabsf(drawn(&options) - by_width) < 1e-4f);
    options.depth_mm = process.depth_mm;
    EXPECT(fabsf(drawn(&options) - by_width) < 1e-4f);
    options.depth_mm *= 0.5;
    EXPECT(drawn(&options) < 0.9f * by_width);
    options.area_uv[1][0] = options.area_uv[1][1] = 0.25;
    EXPECT(drawn(&options) == 0.0f);
}

#define EXPECT_BAD(field, bad, argument, value)                                                                    \
    do {                                                                                                           \
        StriaeSvgOptions options = good;                                                                           \
        options.field = (bad);                                                                                     \
        EXPECT_REFUSED(striae_pattern_builder_add_svg(builder, PATH, &options), argument, value);                  \
    } while (0)

static void arguments(void) {
    protects("absurd arguments are refused by name, and the builder stays empty");
    const StriaeSvgOptions good = {.struct_size = sizeof good, .tool = plate.tool};
    StriaePatternBuilder *builder = plate_builder(&plate);
    EXPECT_REFUSED(striae_pattern_builder_add_svg(NULL, PATH, &good), "builder", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_add_svg(builder, NULL, &good), "path", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_add_svg(builder, PATH, NULL), "options", "NULL");
    EXPECT_BAD(struct_size, 0, "struct_size", "0");
    EXPECT_BAD(tool, NULL, "tool", "NULL");
    EXPECT_BAD(area_uv[0][0], 2.0, "area_uv", "2");
    EXPECT_BAD(area_uv[1][1], NAN, "area_uv", "NaN");
    EXPECT_BAD(depth_law, 7, "depth_law", "7");
    EXPECT_BAD(held, 7, "held", "7");
    EXPECT_BAD(force_kgf, -2.0, "force_kgf", "-2");
    EXPECT_BAD(taper[0], 1.5, "taper", "1.5");
    EXPECT_BAD(tilt_deg, 88.0, "tilt_deg", "88");
    EXPECT(plate_built_shading(builder, 0.5, 0.5).coverage == 0.0f);
    striae_pattern_builder_free(builder);
}

static void expect_file_refused(const char *path, const char *text) {
    const StriaeSvgOptions options = {.struct_size = sizeof options, .tool = plate.tool};
    StriaePatternBuilder *builder = plate_builder(&plate);
    EXPECT(striae_pattern_builder_add_svg(builder, path, &options) == STRIAE_STATUS_FILE);
    if (!EXPECT(strstr(striae_last_error(), text) && strstr(striae_last_error(), "accepted")))
        printf("    the text is \"%s\"\n", striae_last_error());
    EXPECT(plate_built_shading(builder, 0.5, 0.5).coverage == 0.0f);
    striae_pattern_builder_free(builder);
}

static void files(void) {
    protects("files that are no drawing, or draw what no tool can scratch, are told by name and place");
    expect_file_refused("no/such/drawing.svg", "no/such/drawing.svg: is not there");
    write_text(PATH, "solid tool\nendsolid tool\n");
    expect_file_refused(PATH, "drawings-test.svg: line 1, column 1: ");
    write_text(PATH, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 60 40'><path d='M 6 20 L 54 20'/></svg>");
    expect_file_refused(PATH, "drawings-test.svg: holds no stroked path");
    write_text(PATH, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 60 40'>"
               "<path id='wide' stroke='red' stroke-width='30' d='M 6 20 L 54 20'/></svg>");
    expect_file_refused(PATH, "drawings-test.svg: paths[0] (\"wide\"): crest_width_mm is 30");
}

int main(void) {
    plate_init(&plate);
    write_text(PATH, TEXT);
    widths();
    arguments();
    files();
    remove(PATH);
    striae_tool_release(plate.tool);
    return expect_summary();
}
