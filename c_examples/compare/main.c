/* Compares the library, one sample per pixel, with the relief's triangles, many samples per pixel: the same plates, camera
   and lamps. Writes a table, compare.json and pictures. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cases.h"
#include "differences.h"
#include "progress.h"
#include "render.h"
#include "sheets.h"
#include "tiles.h"
#include "truth.h"

enum { PATH_SIZE = 4096, PATH_LENGTH = 24, USUAL_SAMPLES = 4096, EXIT_WRONG_OPTIONS = 2 };

/* Light that comes straight from a lamp, and all that does in the end. */
enum { DIRECT, ALL, KIND_COUNT };
static const char *const KIND_NAMES[KIND_COUNT] = {"direct", "all"};
static const uint32_t KIND_BOUNCES[KIND_COUNT] = {STRIAE_BOUNCES_ONE, STRIAE_BOUNCES_ALL};

/* Brute force takes so many times as many samples where pixels hold more. */
static const uint32_t SAMPLES_TIMES[DISTANCE_COUNT] = {1, 2, 4};

/* The largest mean absolute difference of each kind: without crossings and ends, with them, of matte plates, and what chance
   may have a part in. */
typedef struct Worst {
    double plain[KIND_COUNT], crossed[KIND_COUNT], matte[KIND_COUNT], noise[KIND_COUNT];
} Worst;

typedef struct Comparison {
    const char *folder;
    const char *only;  /* plates whose names hold this */
    uint32_t samples;  /* of brute force per pixel in the nearest view, half of them in each of two pictures */
    int threads;
    Worst worst;
} Comparison;

/* One row of the table. */
typedef struct Row {
    int distance, elevation, kind;
} Row;

static bool complain(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return false;
}

typedef struct LibraryPicture {
    const Stage *stage;
    Film *film;
} LibraryPicture;

static void render_tile(const Tile *tile, void *user) {
    const LibraryPicture *picture = user;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            double radiance[3];
            float *pixel = picture->film->rgb[(size_t)y * (size_t)picture->film->width + (size_t)x];
            render_pixel(picture->stage, x, y, 1, radiance);
            for (int c = 0; c < 3; c++) pixel[c] = (float)radiance[c];
        }
    }
}

static void library_render(const Stage *stage, int threads, Film *film) {
    LibraryPicture picture = {stage, film};
    const TileJob job = {.width = film->width,
                         .height = film->height,
                         .threads = threads,
                         .work = render_tile,
                         .work_user = &picture};
    tiles_run(&job);
}

static const Film *film_of(const TruthFilms *films, const Row *row) {
    return row->kind == DIRECT ? &films->direct[row->elevation] : &films->all[row->elevation];
}

/* The library's picture against two of brute force, whose own difference tells how far chance goes. */
static bool compare_row(Comparison *all, const Sight *sight, const TruthFilms halves[2], const Row *row, Film *library) {
    const Film *first = film_of(&halves[0], row), *second = film_of(&halves[1], row);
    Stage stage = sight->stage;
    stage.lights = (Lights){.patches = {stage.lights.patches[row->elevation]}, .count = 1};
    stage.bounces = KIND_BOUNCES[row->kind];
    library_render(&stage, all->threads, library);

    Film truth;
    if (!film_mean(first, second, &truth)) return complain(sight->plate->name, "out of memory");
    const double noise = 0.5 * difference(first, second).mean_absolute;
    const Difference apart = difference(library, &truth);
    printf("%-14s %-7s %4.1f px %3.0f deg  %8.4f  %6.2f %% %+6.2f %% %7.1f %%   %5.2f %%\n", sight->plate->name,
           KIND_NAMES[row->kind], DISTANCE_PIXELS[row->distance], ELEVATION_DEG[row->elevation], apart.mean,
           100.0 * apart.mean_absolute, 100.0 * apart.signed_mean, 100.0 * apart.worst, 100.0 * noise);
    fflush(stdout);
    double *worst = sight->plate->is_crossed ? all->worst.crossed : all->worst.plain;
    worst[row->kind] = fmax(worst[row->kind], apart.mean_absolute);
    if (sight->plate->is_matte) all->worst.matte[row->kind] = fmax(all->worst.matte[row->kind], apart.mean_absolute);
    all->worst.noise[row->kind] = fmax(all->worst.noise[row->kind], noise);

    char name[PATH_SIZE];
    snprintf(name, sizeof name, "%s-%s-%.1fpx-%.0fdeg", sight->plate->name, KIND_NAMES[row->kind],
             DISTANCE_PIXELS[row->distance], ELEVATION_DEG[row->elevation]);
    const char *failure = sheet_write(library, &truth, apart.mean, all->folder, name);
    film_free(&truth);
    return failure ? complain(name, failure) : true;
}

static bool compare_rows(Comparison *all, const Sight *sight, const TruthFilms halves[2], int distance) {
    Film library;
    bool done = film_init(&library, PICTURE_WIDTH, PICTURE_HEIGHT) || complain(sight->plate->name, "out of memory");
    for (int i = 0; i < ELEVATION_COUNT * KIND_COUNT && done; i++) {
        const Row row = {.distance = distance, .elevation = i / KIND_COUNT, .kind = i % KIND_COUNT};
        done = compare_row(all, sight, halves, &row, &library);
    }
    film_free(&library);
    return done;
}

static bool compare_truth(Comparison *all, const Sight *sight, const Truth *truth, int distance) {
    TruthFilms halves[2] = {{.lamps = 0}};
    const uint32_t samples = all->samples * SAMPLES_TIMES[distance] / 2;
    bool done = true;
    for (uint32_t i = 0; i < 2 && done; i++) {
        done = truth_films_init(&halves[i], ELEVATION_COUNT, PICTURE_WIDTH, PICTURE_HEIGHT) ||
               complain(sight->plate->name, "out of memory");
        const size_t missed = done ? truth_render(truth, &sight->stage, samples, PATH_LENGTH, 1000u * (i + 1),
                                                  all->threads, &halves[i])
                                   : 0;
        done = done && (missed == 0 || complain(sight->plate->name, "samples fell through the relief"));
    }
    done = done && compare_rows(all, sight, halves, distance);
    for (int i = 0; i < 2; i++) truth_films_free(&halves[i]);
    return done;
}

static bool compare_distance(Comparison *all, const Plate *plate, int distance) {
    char error[SCENE_ERROR_SIZE] = "";
    Sight sight;
    Truth truth = {0};
    bool done = sight_init(&sight, plate, distance, error);
    const double started = seconds_now();
    done = done && truth_init(&truth, plate->pattern, &sight.region, 1e-4 * plate->width_mm, error);
    if (done) {
        sight.stage.lights = sight_lamps(&sight);
        const double meshed = seconds_now();
        done = compare_truth(all, &sight, &truth, distance);
        fprintf(stderr, "%s, %.1f px: %zu triangles in %.1f s, compared in %.1f s\n", plate->name,
                DISTANCE_PIXELS[distance], truth.arrays.triangle_count, meshed - started, seconds_now() - meshed);
    } else {
        complain(plate->name, error);
    }
    truth_free(&truth);
    sight_free(&sight);
    return done;
}

static bool write_json(const Comparison *all) {
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s.json", all->folder);
    FILE *file = fopen(path, "w");
    if (!file) return complain(path, strerror(errno));
    const Worst *worst = &all->worst;
    fprintf(file, "{\n");
    fprintf(file, "  \"geometry_worst\": %.6f,\n", worst->plain[DIRECT]);
    fprintf(file, "  \"geometry_crossings_worst\": %.6f,\n", worst->crossed[DIRECT]);
    fprintf(file, "  \"geometry_noise\": %.6f,\n", worst->noise[DIRECT]);
    fprintf(file, "  \"interreflection_worst\": %.6f,\n", worst->plain[ALL]);
    fprintf(file, "  \"interreflection_crossings_worst\": %.6f,\n", worst->crossed[ALL]);
    fprintf(file, "  \"interreflection_matte_worst\": %.6f,\n", worst->matte[ALL]);
    fprintf(file, "  \"interreflection_noise\": %.6f\n}\n", worst->noise[ALL]);
    return fclose(file) == 0 || complain(path, strerror(errno));
}

static bool compare_all(Comparison *all) {
    Plate plates[PLATE_COUNT];
    bool done = plates_build(plates) || complain("plates", striae_last_error());
    printf("mean absolute, mean and worst difference of library and relief, and what of it may be chance, over the mean "
           "radiance\nplate          light   scratch  lamp         mean  absolute     mean     worst    chance\n");
    for (int i = 0; i < PLATE_COUNT * DISTANCE_COUNT && done; i++) {
        const Plate *plate = &plates[i / DISTANCE_COUNT];
        if (strstr(plate->name, all->only)) done = compare_distance(all, plate, i % DISTANCE_COUNT);
    }
    plates_free(plates);
    return done && write_json(all);
}

static bool make_folder(const char *path) {
    return mkdir(path, 0777) == 0 || errno == EEXIST || complain(path, strerror(errno));
}

static bool parse(int argc, char **argv, Comparison *all) {
    if (argc < 2 || argc > 4) {
        fprintf(stderr, "usage: striae_compare FOLDER [SAMPLES [PLATE]]\n"
                        "  FOLDER   where pictures go; the worst differences go to FOLDER.json\n"
                        "  SAMPLES  of brute force per pixel of the nearest view, 2 to 1000000 (default %d)\n"
                        "  PLATE    only plates whose names hold this\n",
                USUAL_SAMPLES);
        return false;
    }
    const long samples = argc > 2 ? strtol(argv[2], NULL, 10) : USUAL_SAMPLES;
    if (samples < 2 || samples > 1000000) {
        fprintf(stderr, "SAMPLES is \"%s\"; accepted: a whole number from 2 to 1000000\n", argv[2]);
        return false;
    }
    *all = (Comparison){.folder = argv[1],
                        .only = argc > 3 ? argv[3] : "",
                        .samples = (uint32_t)samples,
                        .threads = tiles_default_threads()};
    return true;
}

int main(int argc, char **argv) {
    Comparison all;
    if (!parse(argc, argv, &all)) return EXIT_WRONG_OPTIONS;
    if (!make_folder(all.folder) || !compare_all(&all)) return EXIT_FAILURE;
    const Worst *worst = &all.worst;
    printf("worst: %.2f %% without crossings and ends, %.2f %% with them; all bounces %.2f %% and %.2f %%\n",
           100.0 * worst->plain[DIRECT], 100.0 * worst->crossed[DIRECT], 100.0 * worst->plain[ALL],
           100.0 * worst->crossed[ALL]);
    return EXIT_SUCCESS;
}
