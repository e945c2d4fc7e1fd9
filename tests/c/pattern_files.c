/* Pattern files: one that is read makes a builder that goes on, one that is refused makes none and is told by place. */
#include "plate_fixture.h"

static const char *const PATH = "pattern-files-test.striae.json";
static const char *const TEXT =
    "{ \"striae_pattern\": 1,\n"
    "  \"scale\": { \"mm_per_scene_unit\": 1.0, \"units_per_uv\": [60.0, 40.0] },\n"
    "  \"surface\": \"plate\", \"materials\": { \"plate\": { \"like\": \"titanium\" } },\n"
    "  \"tools\": { \"diamond\": { \"preset\": \"rockwell_c\" } },\n"
    "  \"scratches\": [{ \"tool\": \"diamond\", \"points_uv\": [[0.1, 0.5], [0.9, 0.5]],\n"
    "    \"keys\": [{ \"at\": 0.0, \"force_kgf\": 4.0 }, { \"at\": 1.0, \"force_kgf\": 1.0 }] }] }\n";

static Plate plate;

/* Coverage of a pixel in the middle of the plate. */
static float covered(const StriaePattern *pattern) { return plate_shading(pattern, 0.5, 0.5).coverage; }

static void loads(void) {
    protects("a file's pattern is the one that the same scratches make by hand, and its builder takes more");
    StriaePatternBuilder *builder = NULL;
    StriaePattern *loaded = NULL, *grown = NULL, *made = plate_pattern(&plate);
    write_text(PATH, TEXT);
    EXPECT_OK(striae_pattern_builder_load(PATH, &builder));
    EXPECT_OK(striae_pattern_builder_build(builder, &loaded));
    EXPECT(covered(loaded) == covered(made) && covered(made) > 0.0f);
    plate.path_uv[0][1] = plate.path_uv[1][1] = 0.51;
    EXPECT_OK(striae_pattern_builder_add_scratch(builder, &plate.scratch));
    EXPECT_OK(striae_pattern_builder_build(builder, &grown));
    EXPECT(covered(grown) > covered(loaded));
    striae_pattern_release(grown);
    striae_pattern_release(loaded);
    striae_pattern_release(made);
    striae_pattern_builder_free(builder);
}

static void expect_file_refused(const char *path, const char *text) {
    StriaePatternBuilder *builder = (StriaePatternBuilder *)(void *)&plate;
    EXPECT(striae_pattern_builder_load(path, &builder) == STRIAE_STATUS_FILE);
    EXPECT(builder == NULL);
    if (!EXPECT(strstr(striae_last_error(), text) && strstr(striae_last_error(), "accepted")))
        printf("    the text is \"%s\"\n", striae_last_error());
}

static void refusals(void) {
    protects("arguments and files are told apart, and the place in a file is named");
    StriaePatternBuilder *builder = NULL;
    EXPECT_REFUSED(striae_pattern_builder_load(NULL, &builder), "path", "NULL");
    EXPECT_REFUSED(striae_pattern_builder_load(PATH, NULL), "builder", "NULL");
    expect_file_refused("no/such/pattern.json", "no/such/pattern.json: is not there");
    write_text(PATH, "{ \"striae_pattern\": 2 }");
    expect_file_refused(PATH, "striae_pattern: version 2; accepted: 1");
    write_text(PATH, "{ \"striae_pattern\": 1,\n \"surface\": 3 }");
    expect_file_refused(PATH, "line 2, column 13: surface: invalid type");
    char wrong[1024];
    strcpy(wrong, TEXT);
    memcpy(strstr(wrong, "\"force_kgf\": 4.0"), "\"force_kgf\": -40", 16);
    write_text(PATH, wrong);
    expect_file_refused(PATH, "scratches[0]: keys[0].force_kgf is -40");
}

int main(void) {
    plate_init(&plate);
    loads();
    refusals();
    remove(PATH);
    striae_tool_release(plate.tool);
    return expect_summary();
}
