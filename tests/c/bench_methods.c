/* What the benches compare shows the same plate, and figures that other benches wrote stay. */
#include "errors.h"
#include "expect.h"
#include "figures.h"
#include "methods.h"

enum { WIDTH = 96, SCRATCHES = 40 };
static const double WIDTH_MM = 20.0;

static Plate plate;
static Relief relief;
static Film film, other, reference;

static double error_of(const Method *method, unsigned samples) {
    render(method, samples, 1, &film);
    return relative_rms(&film, &reference);
}

static void unscratched_agrees(void) {
    protects("the renderer's own GGX is the library's: what the overhead is measured against shows the same");
    EXPECT(plate_scratch(&plate, 0));
    const Method plain = method_plain(&plate), empty = method_library_everywhere(&plate);
    render(&empty, 64, 1, &reference);
    EXPECT(reference.rgb[0][0] > 0.01f);
    EXPECT(error_of(&plain, 256) < 1e-3);
    plate_light(&plate, 4);
    render(&empty, 64, 1, &reference);
    EXPECT(error_of(&plain, 256) < 1e-3);
    plate_light(&plate, 1);
}

static void geometry_agrees(void) {
    protects(
        "explicit geometry, and normal maps the finer the better, come to the picture that the library filters");
    char error[SCENE_ERROR_SIZE];
    EXPECT(plate_scratch(&plate, SCRATCHES));
    if (!EXPECT(relief_init(&relief, &plate, error))) return;
    const Method library = method_library(&plate), geometry = method_geometry(&plate, &relief);
    const Method plain = method_plain(&plate), everywhere = method_library_everywhere(&plate);
    render(&library, 64, 0, &reference);
    EXPECT(error_of(&everywhere, 64) < 1e-4);
    EXPECT(error_of(&plain, 16) > 0.05);
    EXPECT(error_of(&library, 1) < 0.01);
    EXPECT(error_of(&geometry, 1) > 0.05);
    EXPECT(error_of(&geometry, 256) < 0.02);
    render(&geometry, 64, 2, &film);
    render(&geometry, 64, 3, &other);
    EXPECT(fabs(relative_bias(&film, &other, &reference)) < 0.01);
    double errors[2];
    for (int i = 0; i < 2; i++) {
        NormalMap map;
        EXPECT(normal_map_init(&map, &relief, i ? 4096 : 256));
        const Method mapped = method_normal_map(&plate, &map);
        errors[i] = error_of(&mapped, 256);
        normal_map_free(&map);
    }
    EXPECT(errors[1] < 0.04 && errors[0] > 2.0 * errors[1]);
    relief_free(&relief);
}

static void middle_agrees(void) {
    protects("a small film is the middle of the picture, sample by sample");
    const Method library = method_library(&plate);
    Film crop;
    EXPECT(film_init(&crop, 32, 24));
    render(&library, 1, 1, &film);
    render(&library, 1, 1, &crop);
    int apart = 0;
    for (int i = 0; i < 32 * 24; i++) {
        const int x = i % 32 + (film.width - 32) / 2, y = i / 32 + (film.height - 24) / 2;
        apart += memcmp(crop.rgb[i], film.rgb[y * film.width + x], sizeof crop.rgb[i]) != 0;
    }
    EXPECT(apart == 0);
    film_free(&crop);
}

static void figures_stay(void) {
    protects("figures are set in a file beside those of other benches, which stay as they are");
    static const char *const path = "bench_methods.json";
    write_text(path, "{\n  \"build_1m_s\": 7.468534461,\n  \"overhead_5\": 3.0\n}\n");
    static Figures figures;
    figures_set(&figures, "overhead_5", 1.25);
    figures_set(&figures, "a_new_one", 1e-7);
    EXPECT(figures_merge(&figures, path));
    char text[512] = "";
    FILE *file = fopen(path, "r");
    if (!EXPECT(file != NULL)) return;
    const size_t length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = '\0';
    double kept = 0.0, added = 0.0;
    EXPECT(sscanf(text, "{\n  \"a_new_one\": %lf,\n  \"build_1m_s\": %lf,\n  \"overhead_5\": 1.25\n}\n", &added,
                  &kept) == 2);
    EXPECT(kept == 7.468534461 && added == 1e-7);
    EXPECT(!figures_merge(&figures, "/proc/nowhere/bench.json"));
    remove(path);
}

int main(void) {
    char error[SCENE_ERROR_SIZE];
    if (!EXPECT(plate_init(&plate, WIDTH_MM, WIDTH, error))) return expect_summary();
    EXPECT(film_init(&film, plate.width, plate.height) && film_init(&other, plate.width, plate.height));
    EXPECT(film_init(&reference, plate.width, plate.height));
    unscratched_agrees();
    geometry_agrees();
    middle_agrees();
    figures_stay();
    film_free(&film);
    film_free(&other);
    film_free(&reference);
    plate_free(&plate);
    return expect_summary();
}
