/* Saved patterns: opened, they shade like what was saved; what is no saved pattern is refused by name. */
#include "plate_fixture.h"

static const char *const PATH = "cache-test.striae.cache";

static Plate plate;

/* Coverage of a pixel in the middle of the plate. */
static float covered(const StriaePattern *pattern) { return plate_shading(pattern, 0.5, 0.5).coverage; }

static void opens(void) {
    protects("an opened pattern shades like the one that was saved, which may be gone");
    StriaePattern *opened = NULL, *made = plate_pattern(&plate);
    const float before = covered(made);
    EXPECT_OK(striae_pattern_save(made, PATH));
    striae_pattern_release(made);
    for (uint32_t verify = 0; verify < 2; verify++) {
        EXPECT_OK(striae_pattern_open(PATH, verify, &opened));
        EXPECT(before > 0.0f && covered(opened) == before);
        striae_pattern_release(opened);
    }
}

static void expect_file_refused(const char *path, const char *text) {
    StriaePattern *pattern = (StriaePattern *)(void *)&plate;
    EXPECT(striae_pattern_open(path, 0, &pattern) == STRIAE_STATUS_FILE);
    EXPECT(pattern == NULL);
    if (!EXPECT(strstr(striae_last_error(), text) && strstr(striae_last_error(), "accepted")))
        printf("    the text is \"%s\"\n", striae_last_error());
}

static void refusals(void) {
    protects("arguments and files are told apart");
    StriaePattern *pattern = NULL, *made = plate_pattern(&plate);
    EXPECT_REFUSED(striae_pattern_save(NULL, PATH), "pattern", "NULL");
    EXPECT_REFUSED(striae_pattern_save(made, NULL), "path", "NULL");
    EXPECT_REFUSED(striae_pattern_open(NULL, 0, &pattern), "path", "NULL");
    EXPECT_REFUSED(striae_pattern_open(PATH, 0, NULL), "pattern", "NULL");
    EXPECT_REFUSED(striae_pattern_open(PATH, 2, &pattern), "verify", "2");
    EXPECT(striae_pattern_save(made, "no/such/folder/a.cache") == STRIAE_STATUS_FILE);
    expect_file_refused("no/such/pattern.cache", "no/such/pattern.cache: is not there");
    FILE *file = fopen(PATH, "w");
    if (EXPECT(file != NULL)) {
        fputs("{ \"striae_pattern\": 1 }", file);
        fclose(file);
    }
    expect_file_refused(PATH, "is no saved pattern");
    striae_pattern_release(made);
}

int main(void) {
    plate_init(&plate);
    opens();
    refusals();
    remove(PATH);
    striae_tool_release(plate.tool);
    return expect_summary();
}
