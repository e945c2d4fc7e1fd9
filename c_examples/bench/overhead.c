#include "overhead.h"

#include <stdio.h>
#include <stdlib.h>

#include "errors.h"
#include "methods.h"
#include "progress.h"
#include "table.h"

enum {
    WIDTH = 480,
    CROP_WIDTH = 96,
    CROP_HEIGHT = 64,
    MOST_ROUNDS = 9,
    LEAST_ROUNDS = 3,
    COUNTS = 7,
    SOFT_LAMPS_ACROSS = 4,
    REFERENCE_SAMPLES = 64
};

/* What is timed: each once per round, so that whatever else the machine does is shared out among all. */
enum { PLAIN, LIBRARY, EVERYWHERE, EMPTY, MDG01, BL99, BB90, GEOMETRY, KINDS };

/* A tray: a million scratches on it are 833 on a square centimetre. */
static const double WIDTH_MM = 400.0;

static const unsigned SCRATCHES[COUNTS] = {0, 5, 50, 500, 5000, 50000, 1000000};

/* Up to so many scratches each is tried: beyond, BL99's lists take gigabytes, and the relief's triangles minutes to be made. */
static const unsigned MOST[KINDS] = {1000000, 1000000, 1000000, 1000000, 1000000, 50000, 1000000, 500};

/* Of the earlier systems' images across, unless MDG01 is better off with another. */
static const unsigned USUAL_TEXELS = 4096;

/* So many scratches every system is judged by its picture too. */
static const unsigned JUDGED = 500;

/* From so many scratches on a part of the picture tells enough: they lie as densely everywhere. */
static const unsigned CROPPED = 5000;

/* Rounds end after so long. */
static const double MOST_SECONDS = 6.0;

typedef struct Bench {
    Table table;
    Plate plate, empty; /* with the scratches, and with a pattern of none */
    Relief relief;
    StriaeBaseline *systems[KINDS];
    Method methods[KINDS];
    bool is_there[KINDS];
    double seconds[KINDS], megabytes[KINDS]; /* to build, and what that takes */
    double plain_ns, ratios[KINDS];          /* a sample of the plain one; times over its */
    double soft_ratios[KINDS];               /* the same under a lamp of many points */
    unsigned texels;
    Film film, crop;
    bool is_cropped;
} Bench;

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count) {
    qsort(values, (size_t)count, sizeof values[0], ascending);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

/* Seconds per sample. */
static double sample_seconds(const Method *method, int round, Film *film) {
    return render(method, 1, (unsigned)round, film) / ((double)film->width * film->height);
}

/* The median over rounds of each method's time over the plain one's in the same round. */
static void time_all(Bench *bench, const bool chosen[KINDS], double ratios[KINDS], double *plain_ns) {
    double all[KINDS][MOST_ROUNDS], plain[MOST_ROUNDS];
    const double started = seconds_now();
    Film *film = bench->is_cropped ? &bench->crop : &bench->film;
    int rounds = 0;
    sample_seconds(&bench->methods[PLAIN], 0, &bench->film);
    while (rounds < MOST_ROUNDS && (rounds < LEAST_ROUNDS || seconds_now() - started < MOST_SECONDS)) {
        plain[rounds] = sample_seconds(&bench->methods[PLAIN], rounds, &bench->film);
        for (int k = LIBRARY; k < KINDS; k++)
            if (chosen[k]) all[k][rounds] = sample_seconds(&bench->methods[k], rounds, film) / plain[rounds];
        rounds++;
    }
    for (int k = LIBRARY; k < KINDS; k++) ratios[k] = chosen[k] ? median(all[k], rounds) : 0.0;
    *plain_ns = 1e9 * median(plain, rounds);
}

static bool make_system(Bench *bench, int kind, unsigned texels) {
    static const float specular[3] = {0.05f, 0.05f, 0.05f};
    const StriaePattern *pattern = bench->plate.pattern;
    const StriaeCanvas canvas = plate_canvas(texels);
    StriaeBaseline **system = &bench->systems[kind];
    StriaeTwoAngles scratch;
    const double started = seconds_now();
    StriaeStatus status = STRIAE_STATUS_INTERNAL;
    striae_baseline_release(*system);
    *system = NULL;
    if (kind == BB90) status = striae_baseline_bb90(pattern, &canvas, 0.1f, 0.9f, 1, system);
    if (kind == BL99) status = striae_baseline_bl99(pattern, &canvas, specular, 40.0f, system);
    if (kind == MDG01 && plate_two_angles(&scratch))
        status = striae_baseline_mdg01(pattern, &canvas, &scratch, system);
    if (status != STRIAE_STATUS_OK) {
        fprintf(stderr, "an earlier system: %s\n", striae_last_error());
        return false;
    }
    size_t bytes = 0;
    striae_baseline_memory(*system, &bytes);
    bench->seconds[kind] = seconds_now() - started;
    bench->megabytes[kind] = 1e-6 * (double)bytes;
    bench->methods[kind] = method_baseline(&bench->plate, *system);
    return true;
}

/* The least image of MDG01 that is within a twentieth of its best; `reference` is what the plate should look like. */
static bool choose_texels(Bench *bench, const Film *reference) {
    double errors[5], best = INFINITY;
    for (int i = 0; i < 5; i++) {
        if (!make_system(bench, MDG01, 1024u << i)) return false;
        render(&bench->methods[MDG01], 1, 0, &bench->film);
        errors[i] = relative_rms(&bench->film, reference);
        best = fmin(best, errors[i]);
        table_say(&bench->table, "    MDG01, %5u texels across: error %.1f %%", 1024u << i, 100.0 * errors[i]);
        render(&bench->methods[MDG01], 16, 0, &bench->film);
        table_say(&bench->table, ", of 16 samples per pixel %.1f %%; image %.1f s, %.0f MB\n",
                  100.0 * relative_rms(&bench->film, reference), bench->seconds[MDG01], bench->megabytes[MDG01]);
    }
    int i = 0;
    while (errors[i] > 1.05 * best) i++;
    bench->texels = 1024u << i;
    return make_system(bench, MDG01, bench->texels);
}

static double error_of(Bench *bench, int kind, const Film *reference) {
    render(&bench->methods[kind], 1, 0, &bench->film);
    return relative_rms(&bench->film, reference);
}

/* How near each comes to the plate's own picture by the samples that are timed. */
static bool judge(Bench *bench, Figures *figures) {
    Film reference;
    if (!film_init(&reference, bench->film.width, bench->film.height)) return false;
    render(&bench->methods[LIBRARY], REFERENCE_SAMPLES, 0, &reference);
    bool judged = choose_texels(bench, &reference);
    if (judged) {
        const double library = error_of(bench, LIBRARY, &reference), mdg01 = error_of(bench, MDG01, &reference);
        table_say(&bench->table,
                  "    one sample per pixel against %d of the library: library %.2f %%, MDG01 %.1f %%",
                  REFERENCE_SAMPLES, 100.0 * library, 100.0 * mdg01);
        if (bench->is_there[GEOMETRY])
            table_say(&bench->table, ", geometry %.1f %%", 100.0 * error_of(bench, GEOMETRY, &reference));
        table_say(&bench->table, "\n    MDG01 is timed at %u texels; equal quality is reached %s\n", bench->texels,
                  mdg01 <= library ? "there" : "at no size");
        figures_set(figures, "overhead_error_library_500", library);
        figures_set(figures, "overhead_error_mdg01_500", mdg01);
        figures_set(figures, "overhead_mdg01_texels_500", bench->texels);
    }
    film_free(&reference);
    return judged;
}

static bool make_all(Bench *bench, unsigned count, Figures *figures) {
    char error[SCENE_ERROR_SIZE];
    size_t bytes = 0;
    if (!plate_scratch(&bench->plate, count)) return false;
    striae_pattern_memory(bench->plate.pattern, &bytes);
    bench->seconds[LIBRARY] = bench->plate.build_seconds;
    bench->megabytes[LIBRARY] = 1e-6 * (double)bytes;
    bench->methods[PLAIN] = method_plain(&bench->plate);
    bench->methods[LIBRARY] = method_library(&bench->plate);
    bench->methods[EVERYWHERE] = method_library_everywhere(&bench->plate);
    bench->methods[EMPTY] = method_library(&bench->empty);
    for (int k = 0; k < KINDS; k++) bench->is_there[k] = count <= MOST[k] && (count > 0 || k <= EMPTY);
    if (bench->is_there[GEOMETRY]) {
        if (!relief_init(&bench->relief, &bench->plate, error)) {
            fprintf(stderr, "geometry: %s\n", error);
            return false;
        }
        bench->methods[GEOMETRY] = method_geometry(&bench->plate, &bench->relief);
        bench->seconds[GEOMETRY] = bench->relief.build_seconds;
        bench->megabytes[GEOMETRY] = 1e-6 * (double)bench->relief.bytes;
    }
    for (int k = MDG01; k <= BB90; k++)
        if (bench->is_there[k] && !make_system(bench, k, bench->texels)) return false;
    return count != JUDGED || judge(bench, figures);
}

static const char *const NAMES[KINDS] = {
    "unscratched", "library", "library, everywhere", "library, no scratch", "MDG01", "BL99", "BB90", "geometry"};

static void print_rows(const Bench *bench, unsigned count) {
    table_say(&bench->table, "%9u  %-20s %8.2f %10s   (%.0f ns a sample)\n", count, NAMES[PLAIN], 1.0, "1.00",
              bench->plain_ns);
    for (int k = LIBRARY; k < KINDS; k++) {
        if (!bench->is_there[k]) continue;
        table_say(&bench->table, "%9s  %-20s %8.2f", "", NAMES[k], bench->ratios[k]);
        if (bench->soft_ratios[k] > 0.0) table_say(&bench->table, " %10.2f", bench->soft_ratios[k]);
        if (k != EVERYWHERE && k != EMPTY)
            table_say(&bench->table, "%*s %9.2f %9.1f", bench->soft_ratios[k] > 0.0 ? 0 : 11, "", bench->seconds[k],
                      bench->megabytes[k]);
        table_say(&bench->table, "\n");
    }
    for (int k = MDG01; k < KINDS; k++)
        if (count > 0 && !bench->is_there[k])
            table_say(&bench->table, "%9s  %-20s left out: it would take gigabytes, or minutes to be made\n", "",
                      NAMES[k]);
}

static void note(Figures *figures, const char *name, unsigned count, double value) {
    char full[64];
    snprintf(full, sizeof full, "%s_%u", name, count);
    figures_set(figures, full, value);
}

static void note_row(Figures *figures, const Bench *bench, unsigned count) {
    static const char *const names[KINDS] = {
        NULL, "overhead", "overhead_everywhere", NULL, "overhead_mdg01", "overhead_bl99", "overhead_bb90", "overhead_geometry"};
    note(figures, "overhead_over_empty", count, bench->ratios[LIBRARY] / bench->ratios[EMPTY]);
    note(figures, "overhead_soft_lamp", count, bench->soft_ratios[LIBRARY]);
    note(figures, "overhead_soft_lamp_over_empty", count, bench->soft_ratios[LIBRARY] / bench->soft_ratios[EMPTY]);
    note(figures, "overhead_build_s", count, bench->seconds[LIBRARY]);
    note(figures, "overhead_megabytes", count, bench->megabytes[LIBRARY]);
    for (int k = LIBRARY; k < KINDS; k++)
        if (names[k] && bench->is_there[k]) note(figures, names[k], count, bench->ratios[k]);
}

/* The lamp that both plates have. */
static void light(Bench *bench, int across) {
    plate_light(&bench->plate, across);
    plate_light(&bench->empty, across);
}

static bool run_count(Bench *bench, unsigned count, Figures *figures) {
    static const bool soft[KINDS] = {[LIBRARY] = true, [EVERYWHERE] = true, [EMPTY] = true};
    double soft_ns;
    bench->is_cropped = count >= CROPPED;
    const bool made = make_all(bench, count, figures);
    if (made) {
        time_all(bench, bench->is_there, bench->ratios, &bench->plain_ns);
        light(bench, SOFT_LAMPS_ACROSS);
        time_all(bench, soft, bench->soft_ratios, &soft_ns);
        light(bench, 1);
        print_rows(bench, count);
        note_row(figures, bench, count);
    }
    relief_free(&bench->relief);
    for (int k = 0; k < KINDS; k++) {
        striae_baseline_release(bench->systems[k]);
        bench->systems[k] = NULL;
    }
    return made;
}

bool overhead_run(Figures *figures, const char *folder) {
    char error[SCENE_ERROR_SIZE] = "out of memory";
    Bench *bench = calloc(1, sizeof *bench);
    bool done = bench && table_open(&bench->table, folder, "overhead") &&
                plate_init(&bench->plate, WIDTH_MM, WIDTH, error) &&
                plate_init(&bench->empty, WIDTH_MM, WIDTH, error) && plate_scratch(&bench->empty, 0) &&
                film_init(&bench->film, bench->plate.width, bench->plate.height) &&
                film_init(&bench->crop, CROP_WIDTH, CROP_HEIGHT);
    /* A table that cannot be opened has said so. */
    if (!done && (!bench || bench->table.file)) fprintf(stderr, "overhead: %s\n", error);
    if (done) {
        table_say(&bench->table,
                  "What scratches add to a render of a plate of %.0f by %.0f mm: %d by %d pixels, one sample each, "
                  "lit by a point and\n"
                  "its shadow ray; and by a soft lamp, %d points with a shadow ray each (evaluated at once). Times "
                  "over that of the\n"
                  "same plate with the renderer's own GGX, which asks the library nothing: the median of rounds in "
                  "which all take\n"
                  "turns. With the library the renderer keeps its own GGX where no scratch is near; or it leaves all "
                  "points to the\n"
                  "library (everywhere). From %u scratches on, of the middle of the picture.\n\n"
                  "%9s  %-20s %8s %10s %9s %9s\n",
                  bench->plate.width_mm, bench->plate.height_mm, bench->film.width, bench->film.height,
                  SOFT_LAMPS_ACROSS * SOFT_LAMPS_ACROSS, CROPPED, "scratches", "", "a point", "soft lamp",
                  "build s", "MB");
        bench->texels = USUAL_TEXELS;
        for (int i = 0; i < COUNTS && done; i++) done = run_count(bench, SCRATCHES[i], figures);
    }
    if (bench) {
        film_free(&bench->film);
        film_free(&bench->crop);
        plate_free(&bench->plate);
        plate_free(&bench->empty);
        done = table_close(&bench->table) && done;
    }
    free(bench);
    return done;
}
