/* Compares the library, one sample per pixel, with judges that know nothing of scratches and are shown the relief's triangles:
   brute force, and POV-Ray. The same plates, camera and lamps. Writes a table, FOLDER.json and pictures. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "judges.h"
#include "progress.h"
#include "tiles.h"

enum { USUAL_SAMPLES = 4096, EXIT_WRONG_OPTIONS = 2 };

/* Brute force takes so many times as many samples where pixels hold more. */
static const uint32_t SAMPLES_TIMES[DISTANCE_COUNT] = {1, 2, 4};

/* POV-Ray reads its scenes as text: from farther away they would be a hundred megabytes each. */
enum { POVRAY_DISTANCES = 2 };

typedef struct Options {
    const char *folder;
    const char *only; /* plates whose names hold this */
    uint32_t samples;
} Options;

static bool compare_sight(Report *report, const Options *options, Sight *sight, int distance) {
    char error[SCENE_ERROR_SIZE] = "";
    Truth truth;
    const double started = seconds_now();
    const double step = 1e-4 * sight->plate->width_mm;
    bool done = truth_init(&truth, sight->plate->pattern, &sight->region, step, error) ||
                complain(sight->plate->name, error);
    const double meshed = seconds_now();
    const Bench bench = {sight, &truth, distance, tiles_default_threads()};
    sight->stage.lights = sight_lamps(sight);
    done = done && judge_by_force(report, &bench, options->samples * SAMPLES_TIMES[distance]);
    if (sight->plate->is_matte && distance < POVRAY_DISTANCES) done = done && judge_by_povray(report, &bench);
    fprintf(stderr, "%s, %.1f px: %zu triangles in %.1f s, compared in %.1f s\n", sight->plate->name,
            DISTANCE_PIXELS[distance], truth.arrays.triangle_count, meshed - started, seconds_now() - meshed);
    truth_free(&truth);
    return done;
}

static bool compare_plate(Report *report, const Options *options, const Plate *plate) {
    char error[SCENE_ERROR_SIZE] = "";
    bool done = true;
    for (int distance = 0; distance < DISTANCE_COUNT && done; distance++) {
        Sight sight;
        done = (sight_init(&sight, plate, distance, error) || complain(plate->name, error)) &&
               compare_sight(report, options, &sight, distance);
        sight_free(&sight);
    }
    return done;
}

static bool compare_all(Report *report, const Options *options) {
    Plate plates[PLATE_COUNT];
    bool done = plates_build(plates) || complain("plates", striae_last_error());
    int compared = 0;
    report_head();
    for (int i = 0; i < PLATE_COUNT && done; i++) {
        if (!strstr(plates[i].name, options->only)) continue;
        done = compare_plate(report, options, &plates[i]);
        compared++;
    }
    plates_free(plates);
    if (done && compared == 0) return complain("PLATE", "no plate's name holds this");
    return done && report_end(report, compared == PLATE_COUNT);
}

static bool make_folder(const char *path) {
    return mkdir(path, 0777) == 0 || errno == EEXIST || complain(path, strerror(errno));
}

static bool parse(int argc, char **argv, Options *options) {
    if (argc < 2 || argc > 4) {
        fprintf(stderr, "usage: striae_compare FOLDER [SAMPLES [PLATE]]\n"
                        "  FOLDER   where pictures go; the worst differences go to FOLDER.json\n"
                        "  SAMPLES  of brute force per pixel of the nearest view, 2 to 1000000 (default %d)\n"
                        "  PLATE    only plates whose names hold this, without FOLDER.json\n",
                USUAL_SAMPLES);
        return false;
    }
    const long samples = argc > 2 ? strtol(argv[2], NULL, 10) : USUAL_SAMPLES;
    if (samples < 2 || samples > 1000000) {
        fprintf(stderr, "SAMPLES is \"%s\"; accepted: a whole number from 2 to 1000000\n", argv[2]);
        return false;
    }
    *options = (Options){argv[1], argc > 3 ? argv[3] : "", (uint32_t)samples};
    return true;
}

int main(int argc, char **argv) {
    Options options;
    if (!parse(argc, argv, &options)) return EXIT_WRONG_OPTIONS;
    Report report = {.folder = options.folder};
    return make_folder(options.folder) && compare_all(&report, &options) ? EXIT_SUCCESS : EXIT_FAILURE;
}
