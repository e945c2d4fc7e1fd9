/* Plots: bad arguments are named, good ones write the file that the path's end asks for. */
#include <math.h>

#include "expect.h"

static StriaeCrossSection *section;
static const char *const PNG = "plots-test.png", *const SVG = "plots-test.svg";

static StriaeCrossSection *formed(void) {
    const StriaeProcess process = {
        .struct_size = sizeof process, .depth_law = STRIAE_DEPTH_LAW_BOSCH2004, .force_kgf = 2.0};
    StriaeMaterial steel = {.struct_size = sizeof steel};
    StriaeTool *tool = NULL;
    StriaeCrossSection *made = NULL;
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_NAIL, &tool));
    EXPECT_OK(striae_material_metal(STRIAE_METAL_STEEL, &steel));
    EXPECT_OK(striae_cross_section(tool, &steel, &process, &made));
    striae_tool_release(tool);
    return made;
}

/* The bytes of a file, at most as many as there is room for; their number, 0 where there is no file. */
static size_t read_file(const char *path, char *bytes, size_t room) {
    FILE *file = fopen(path, "rb");
    if (!file) return 0;
    const size_t count = fread(bytes, 1, room, file);
    fclose(file);
    return count;
}

static void arguments(void) {
    protects("absurd arguments are refused, and no file is written");
    remove(PNG);
    EXPECT_REFUSED(striae_plot_cross_section(NULL, PNG, 600, 400, NULL), "cross_section", "NULL");
    EXPECT_REFUSED(striae_plot_cross_section(section, NULL, 600, 400, NULL), "path", "NULL");
    EXPECT_REFUSED(striae_plot_cross_section(section, "", 600, 400, NULL), "path", "empty");
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 0, 400, NULL), "width_px", "0");
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 600, 8193, NULL), "height_px", "8193");

    StriaePlotOptions options = {.struct_size = 0};
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 600, 400, &options), "struct_size", "0");
    options = (StriaePlotOptions){.struct_size = sizeof options, .style = 77};
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 600, 400, &options), "style", "77");
    options = (StriaePlotOptions){.struct_size = sizeof options, .title = "\xff"};
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 600, 400, &options), "title", "UTF-8");
    options = (StriaePlotOptions){.struct_size = sizeof options, .x_mm = {NAN, 1.0}};
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 600, 400, &options), "x_mm", "NaN");
    options = (StriaePlotOptions){.struct_size = sizeof options, .z_mm = {2.0, 1.0}};
    EXPECT_REFUSED(striae_plot_cross_section(section, PNG, 600, 400, &options), "z_mm", "1");
    char byte[1];
    EXPECT(read_file(PNG, byte, sizeof byte) == 0);
}

static void expect_file_refused(const char *path, const char *text) {
    EXPECT(striae_plot_cross_section(section, path, 600, 400, NULL) == STRIAE_STATUS_FILE);
    if (!EXPECT(strstr(striae_last_error(), text) && strstr(striae_last_error(), "accepted")))
        printf("    the text is \"%s\"\n", striae_last_error());
}

static void files(void) {
    protects("a file that cannot be written is answered, by its name");
    expect_file_refused("plots-test.jpg", "plots-test.jpg");
    expect_file_refused("plots-test", ".png or .svg");
    expect_file_refused("no/such/folder/plot.png", "no/such/folder/plot.png: cannot be written");
}

static void pictures(void) {
    protects("a path's end says what is written: PNG of the size asked for, or SVG with its labels");
    static char bytes[1 << 16];
    EXPECT_OK(striae_plot_cross_section(section, PNG, 600, 400, NULL));
    EXPECT(read_file(PNG, bytes, sizeof bytes) > 1000);
    EXPECT(memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0);
    EXPECT(memcmp(bytes + 16, "\0\0\x02\x58\0\0\x01\x90", 8) == 0);

    const StriaePlotOptions options = {
        .struct_size = sizeof options, .title = "Nail & \"steel\"", .x_mm = {-0.2, 0.2}, .z_mm = {-0.05, 0.05}};
    EXPECT_OK(striae_plot_cross_section(section, SVG, 600, 400, &options));
    bytes[read_file(SVG, bytes, sizeof bytes - 1)] = '\0';
    EXPECT(strncmp(bytes, "<svg", 4) == 0 && strstr(bytes, "</svg>"));
    EXPECT(strstr(bytes, "Nail &amp; \"steel\"") && strstr(bytes, "µm between crests"));
    remove(PNG);
    remove(SVG);
}

int main(void) {
    section = formed();
    arguments();
    files();
    pictures();
    striae_cross_section_release(section);
    return expect_summary();
}
