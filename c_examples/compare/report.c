#include "report.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "differences.h"
#include "sheets.h"

enum { PATH_SIZE = 4096 };

static const char *const KIND_NAMES[KIND_COUNT] = {"direct", "all", "povray-lambert", "povray-gloss"};

bool complain(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return false;
}

void row_name(const Plate *plate, const Row *row, char *name, size_t size) {
    snprintf(name, size, "%s-%s-%.1fpx-%.0fdeg", plate->name, KIND_NAMES[row->kind], DISTANCE_PIXELS[row->distance],
             ELEVATION_DEG[row->elevation]);
}

bool report_row(Report *report, const Plate *plate, const Row *row, const Film *library, const Film *judge, double noise) {
    const Difference apart = difference(library, judge);
    printf("%-14s %-15s %4.1f px %3.0f deg  %8.4f  %6.2f %% %+6.2f %% %7.1f %%   %5.2f %%\n", plate->name,
           KIND_NAMES[row->kind], DISTANCE_PIXELS[row->distance], ELEVATION_DEG[row->elevation], apart.mean,
           100.0 * apart.mean_absolute, 100.0 * apart.signed_mean, 100.0 * apart.worst, 100.0 * noise);
    fflush(stdout);
    Worst *worst = &report->worst[row->kind];
    double *of_plate = plate->is_crossed ? &worst->crossed : &worst->plain;
    *of_plate = fmax(*of_plate, apart.mean_absolute);
    if (plate->is_matte) worst->matte = fmax(worst->matte, apart.mean_absolute);
    worst->noise = fmax(worst->noise, noise);

    char name[PATH_SIZE];
    row_name(plate, row, name, sizeof name);
    const char *failure = sheet_write(library, judge, apart.mean, report->folder, name);
    return failure ? complain(name, failure) : true;
}

void report_head(void) {
    printf("mean absolute, mean and worst difference of library and judge, and what of it may be chance, over the mean "
           "radiance\nplate          judge           scratch  lamp         mean  absolute     mean     worst    chance\n");
}

static void put(FILE *file, const char *name, double value) { fprintf(file, "  \"%s\": %.6f,\n", name, value); }

static bool write_json(const Report *report) {
    const Worst *direct = &report->worst[DIRECT], *all = &report->worst[ALL_LIGHT];
    const Worst *lambert = &report->worst[POVRAY_LAMBERT], *gloss = &report->worst[POVRAY_GLOSS];
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s.json", report->folder);
    FILE *file = fopen(path, "w");
    if (!file) return complain(path, strerror(errno));
    fprintf(file, "{\n");
    put(file, "geometry_worst", direct->plain);
    put(file, "geometry_crossings_worst", direct->crossed);
    put(file, "geometry_noise", direct->noise);
    put(file, "interreflection_worst", all->plain);
    put(file, "interreflection_crossings_worst", all->crossed);
    put(file, "interreflection_matte_worst", all->matte);
    put(file, "povray_lambert_worst", lambert->plain);
    put(file, "povray_lambert_crossings_worst", lambert->crossed);
    put(file, "povray_worst", fmax(lambert->plain, gloss->plain));
    put(file, "povray_crossings_worst", fmax(lambert->crossed, gloss->crossed));
    fprintf(file, "  \"interreflection_noise\": %.6f\n}\n", all->noise);
    return fclose(file) == 0 || complain(path, strerror(errno));
}

bool report_end(const Report *report, bool all_plates) {
    printf("worst without crossings and ends, and with them:\n");
    for (int kind = 0; kind < KIND_COUNT; kind++)
        printf("  %-15s %5.2f %% %5.2f %%\n", KIND_NAMES[kind], 100.0 * report->worst[kind].plain,
               100.0 * report->worst[kind].crossed);
    return !all_plates || write_json(report);
}
