#include "equal_error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "chart.h"
#include "errors.h"
#include "methods.h"
#include "table.h"

enum { WIDTH = 320, SCRATCHES = 500, REFERENCE_SAMPLES = 256, MAPS = 3, MOST_SAMPLES = 256, ROUNDS = 5 };

static const double WIDTH_MM = 100.0;
static const unsigned MAP_TEXELS[MAPS] = {4096, 8192, 16384};
static const double WANTED = 0.01;

/* One way's error by time. */
typedef struct Course {
    Curve curve;
    unsigned samples[CHART_MAX_POINTS];
    double megabytes, seconds; /* until the error is as wanted; infinite where it never is */
    double least;              /* error of all */
} Course;

typedef struct Bench {
    Table table;
    Plate plate;
    Relief relief;
    Film reference, film, other;
} Bench;

/* Where the curve passes the wanted error, straight on logarithmic axes between two counts of samples. */
static double seconds_to(const Curve *curve, double wanted) {
    if (curve->y[0] <= wanted) return curve->x[0];
    for (int i = 1; i < curve->count; i++) {
        if (curve->y[i] > wanted) continue;
        const double share = log(curve->y[i - 1] / wanted) / log(curve->y[i - 1] / curve->y[i]);
        return curve->x[i - 1] * pow(curve->x[i] / curve->x[i - 1], share);
    }
    return INFINITY;
}

/* Renders with more and more samples. Where one picture is as quick as the library's, the quickest of several counts. */
static void follow(Bench *bench, const Method *method, const char *name, double megabytes, Course *course) {
    *course = (Course){.megabytes = megabytes, .least = INFINITY};
    Curve *curve = &course->curve;
    snprintf(curve->name, sizeof curve->name, "%s", name);
    for (unsigned samples = 1; samples <= MOST_SAMPLES; samples *= 4) {
        double seconds = INFINITY;
        for (int round = 0; round < (samples == 1 ? ROUNDS : 1); round++)
            seconds = fmin(seconds, render(method, samples, 1, &bench->film));
        const int i = curve->count++;
        course->samples[i] = samples;
        curve->x[i] = seconds;
        curve->y[i] = relative_rms(&bench->film, &bench->reference);
        course->least = fmin(course->least, curve->y[i]);
        /* The reference itself is not surer than that. */
        if (method->filters && samples >= REFERENCE_SAMPLES / 16) break;
    }
    course->seconds = seconds_to(curve, WANTED);
}

static void print_course(const Bench *bench, const Course *course) {
    table_say(&bench->table, "%-20s", course->curve.name);
    for (int i = 0; i < course->curve.count; i++)
        table_say(&bench->table, "  %4u: %7.3f s %6.2f %%", course->samples[i], course->curve.x[i],
                  100.0 * course->curve.y[i]);
    table_say(&bench->table, "\n%-20s  ", "");
    if (isfinite(course->seconds)) {
        table_say(&bench->table, "1 %% after %.3f s", course->seconds);
    } else {
        table_say(&bench->table, "1 %% is not reached; %.2f %% at best", 100.0 * course->least);
    }
    table_say(&bench->table, "; %.1f MB\n", course->megabytes);
}

/* What the reference misses of explicit geometry, beyond what chance does: two of its pictures know. Below 0 if that is
   less than chance tells. */
static double misses(Bench *bench, const Method *geometry) {
    render(geometry, MOST_SAMPLES, 2, &bench->film);
    render(geometry, MOST_SAMPLES, 3, &bench->other);
    return relative_bias(&bench->film, &bench->other, &bench->reference);
}

static bool draw(const Course *courses, int count, const char *folder) {
    Chart chart = {.title = "Equal error: 500 scratches, relative RMS error by time (the line: 1 %)",
                   .x_name = "seconds of rendering",
                   .y_name = "relative RMS error",
                   .x_range = {INFINITY, 0.0},
                   .y_range = {INFINITY, 1.0},
                   .y_mark = WANTED,
                   .count = count};
    for (int i = 0; i < count; i++) {
        chart.curves[i] = courses[i].curve;
        for (int k = 0; k < courses[i].curve.count; k++) {
            chart.x_range[0] = fmin(chart.x_range[0], courses[i].curve.x[k]);
            chart.x_range[1] = fmax(chart.x_range[1], courses[i].curve.x[k]);
            chart.y_range[0] = fmin(chart.y_range[0], courses[i].curve.y[k]);
        }
    }
    chart.x_range[0] = pow(10.0, floor(log10(chart.x_range[0])));
    chart.x_range[1] = pow(10.0, ceil(log10(chart.x_range[1])));
    chart.y_range[0] = pow(10.0, floor(log10(chart.y_range[0])));
    char path[4096];
    snprintf(path, sizeof path, "%s/equal-error.svg", folder);
    return chart_write(&chart, path);
}

/* The best normal map's time: to 1 %, or, where none is so good, to within a tenth of the least error that it comes to. */
static double map_seconds(const Course maps[MAPS]) {
    double least = INFINITY;
    int best = 0;
    for (int i = 0; i < MAPS; i++) {
        least = fmin(least, maps[i].seconds);
        if (maps[i].least < maps[best].least) best = i;
    }
    return isfinite(least) ? least : seconds_to(&maps[best].curve, 1.1 * maps[best].least);
}

static bool compare(Bench *bench, Figures *figures, const char *folder) {
    Course courses[2 + MAPS];
    size_t bytes = 0;
    const Method library = method_library(&bench->plate), geometry = method_geometry(&bench->plate, &bench->relief);
    striae_pattern_memory(bench->plate.pattern, &bytes);
    render(&library, REFERENCE_SAMPLES, 0, &bench->reference);
    const double missed = misses(bench, &geometry);
    table_say(&bench->table,
              "Equal error: %d scratches on a plate of %.0f by %.0f mm, %d by %d pixels, one lamp. Samples per "
              "pixel, seconds and\n"
              "relative RMS error against the library's own picture of %d samples per pixel, which misses %s%.2f %% "
              "(RMS) of what explicit geometry shows\n\n",
              SCRATCHES, bench->plate.width_mm, bench->plate.height_mm, bench->film.width, bench->film.height,
              REFERENCE_SAMPLES, missed > 0.0 ? "" : "less than ", 100.0 * fabs(missed));
    follow(bench, &library, "library", 1e-6 * (double)bytes, &courses[0]);
    print_course(bench, &courses[0]);
    follow(bench, &geometry, "explicit geometry", 1e-6 * (double)bench->relief.bytes, &courses[1]);
    print_course(bench, &courses[1]);
    for (int i = 0; i < MAPS; i++) {
        NormalMap map;
        char name[32];
        if (!normal_map_init(&map, &bench->relief, MAP_TEXELS[i])) return false;
        const Method method = method_normal_map(&bench->plate, &map);
        snprintf(name, sizeof name, "normal map %uk", MAP_TEXELS[i] / 1024);
        follow(bench, &method, name, 1e-6 * (double)normal_map_bytes(&map), &courses[2 + i]);
        print_course(bench, &courses[2 + i]);
        normal_map_free(&map);
    }
    const double own = courses[0].seconds, of_maps = map_seconds(&courses[2]);
    table_say(&bench->table, "explicit geometry takes %.0f times as long, the best normal map %.0f times\n",
              courses[1].seconds / own, of_maps / own);
    figures_set(figures, "equal_error_vs_geometry", courses[1].seconds / own);
    figures_set(figures, "equal_error_vs_normal_map", of_maps / own);
    figures_set(figures, "equal_error_normal_map_16k_least", courses[1 + MAPS].least);
    return draw(courses, 2 + MAPS, folder);
}

bool equal_error_run(Figures *figures, const char *folder) {
    char error[SCENE_ERROR_SIZE] = "out of memory";
    Bench *bench = calloc(1, sizeof *bench);
    bool done = bench && table_open(&bench->table, folder, "equal-error") &&
                plate_init(&bench->plate, WIDTH_MM, WIDTH, error) && plate_scratch(&bench->plate, SCRATCHES) &&
                relief_init(&bench->relief, &bench->plate, error);
    if (done) {
        const int width = bench->plate.width, height = bench->plate.height;
        done = film_init(&bench->reference, width, height) && film_init(&bench->film, width, height) &&
               film_init(&bench->other, width, height) && compare(bench, figures, folder);
    }
    /* A table that cannot be opened has said so. */
    if (!done && (!bench || bench->table.file)) fprintf(stderr, "equal error: %s\n", error);
    if (bench) {
        film_free(&bench->reference);
        film_free(&bench->film);
        film_free(&bench->other);
        relief_free(&bench->relief);
        plate_free(&bench->plate);
        done = table_close(&bench->table) && done;
    }
    free(bench);
    return done;
}
