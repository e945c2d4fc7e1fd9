#include "judges.h"

#include <stdio.h>

#include "differences.h"
#include "povray.h"
#include "render.h"
#include "tiles.h"

enum { PATH_SIZE = 4096, PATH_LENGTH = 24 };

/* POV-Ray knows no more than 81 samples per pixel: its pictures are so many times larger. */
static const int POVRAY_TIMES[DISTANCE_COUNT] = {4, 8, 16};

/* Each base BRDF's finish, the surface's first. */
static const Finish GLOSS[2] = {{{0.22, 0.23, 0.28}, 0.5, 12.0, 0.0, 1.0}, {{0.45, 0.42, 0.38}, 0.0, 1.0, 0.6, 0.05}};

typedef struct LibraryPicture {
    const Stage *stage;
    const Finish *finishes; /* in place of the plate's own, by number of base BRDF; NULL for those */
    Film *film;
} LibraryPicture;

/* One sample with finishes of the renderer's own: the library tells of each zone how much of it is seen lit. */
static void shade_finished(const Stage *stage, const Finish *finishes, const Sample *sample, double radiance[3]) {
    const Patch *patch = &stage->lights.patches[0];
    LitZones lit;
    double irradiance[3];
    for (int c = 0; c < 3; c++) radiance[c] = 0.0;
    if (!shade_zones(stage, sample, patch->position, &lit)) return;
    patch_irradiance(patch, patch->position, lit.position, irradiance);
    const Vec view = vec((double)lit.view[0], (double)lit.view[1], (double)lit.view[2]);
    const Vec light = vec((double)lit.light[0], (double)lit.light[1], (double)lit.light[2]);
    for (size_t i = 0; i < lit.count; i++) {
        const StriaeZone *zone = &lit.zones[i];
        const Vec normal = vec((double)zone->normal[0], (double)zone->normal[1], (double)zone->normal[2]);
        double one[3];
        finish_reflects(&finishes[zone->brdf > 0], normal, view, light, one);
        for (int c = 0; c < 3; c++) radiance[c] += (double)zone->lit * one[c] * irradiance[c] / PI;
    }
}

static void render_tile(const Tile *tile, void *user) {
    const LibraryPicture *picture = user;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            const Sample sample = {x + 0.5, y + 0.5, 1.0};
            double radiance[3];
            float *pixel = picture->film->rgb[(size_t)y * (size_t)picture->film->width + (size_t)x];
            if (picture->finishes) {
                shade_finished(picture->stage, picture->finishes, &sample, radiance);
            } else {
                shade_sample(picture->stage, &sample, radiance);
            }
            for (int c = 0; c < 3; c++) pixel[c] = (float)radiance[c];
        }
    }
}

/* The library's picture under the lamp of a row, one sample per pixel. */
static bool library_render(const Bench *bench, const Row *row, const Finish *finishes, Film *film) {
    Stage stage = bench->sight->stage;
    stage.lights = (Lights){.patches = {stage.lights.patches[row->elevation]}, .count = 1};
    stage.bounces = row->kind == ALL_LIGHT ? STRIAE_BOUNCES_ALL : STRIAE_BOUNCES_ONE;
    LibraryPicture picture = {&stage, finishes, film};
    if (!film_init(film, PICTURE_WIDTH, PICTURE_HEIGHT)) return complain(bench->sight->plate->name, "out of memory");
    const TileJob job = {.width = film->width,
                         .height = film->height,
                         .threads = bench->threads,
                         .work = render_tile,
                         .work_user = &picture};
    tiles_run(&job);
    return true;
}

static const Film *film_of(const TruthFilms *films, const Row *row) {
    return row->kind == DIRECT ? &films->direct[row->elevation] : &films->all[row->elevation];
}

/* Two pictures of brute force: their own difference tells how far chance goes. */
static bool judge_row(Report *report, const Bench *bench, const TruthFilms halves[2], const Row *row) {
    const Film *first = film_of(&halves[0], row), *second = film_of(&halves[1], row);
    Film library = {0}, truth = {0};
    bool done = library_render(bench, row, NULL, &library) &&
                (film_mean(first, second, &truth) || complain(bench->sight->plate->name, "out of memory"));
    const double noise = done ? 0.5 * difference(first, second).mean_absolute : 0.0;
    done = done && report_row(report, bench->sight->plate, row, &library, &truth, noise);
    film_free(&library);
    film_free(&truth);
    return done;
}

static bool render_half(const Bench *bench, uint32_t samples, uint32_t seed, TruthFilms *half) {
    const char *name = bench->sight->plate->name;
    if (!truth_films_init(half, ELEVATION_COUNT, PICTURE_WIDTH, PICTURE_HEIGHT)) return complain(name, "out of memory");
    const size_t missed =
        truth_render(bench->truth, &bench->sight->stage, samples, PATH_LENGTH, seed, bench->threads, half);
    return missed == 0 || complain(name, "samples fell through the relief");
}

bool judge_by_force(Report *report, const Bench *bench, uint32_t samples) {
    TruthFilms halves[2] = {{.lamps = 0}};
    bool done = render_half(bench, samples / 2, 1000, &halves[0]) && render_half(bench, samples / 2, 2000, &halves[1]);
    for (int i = 0; i < 2 * ELEVATION_COUNT && done; i++) {
        const Row row = {.distance = bench->distance, .elevation = i / 2, .kind = i % 2 ? ALL_LIGHT : DIRECT};
        done = judge_row(report, bench, halves, &row);
    }
    for (int i = 0; i < 2; i++) truth_films_free(&halves[i]);
    return done;
}

/* What POV-Ray calls Lambert's. */
static Finish lambert(const StriaeBrdf *brdf) {
    return (Finish){.diffuse = {(double)brdf->albedo[0], (double)brdf->albedo[1], (double)brdf->albedo[2]}};
}

static bool judge_povray_row(Report *report, const Bench *bench, const Row *row) {
    const Plate *plate = bench->sight->plate;
    const Finish own[2] = {lambert(&bench->truth->brdfs[0]), lambert(&bench->truth->brdfs[1])};
    const bool is_gloss = row->kind == POVRAY_GLOSS;
    char name[PATH_SIZE / 2], base[PATH_SIZE];
    row_name(plate, row, name, sizeof name);
    snprintf(base, sizeof base, "%s/%s-scene", report->folder, name);
    Film library = {0}, judge = {0};
    const char *failure = povray_render(bench->truth, &bench->sight->stage, row->elevation, is_gloss ? GLOSS : own,
                                        PICTURE_WIDTH, PICTURE_HEIGHT, POVRAY_TIMES[row->distance], base, &judge);
    bool done = failure ? complain(name, failure) : library_render(bench, row, is_gloss ? GLOSS : NULL, &library);
    done = done && report_row(report, plate, row, &library, &judge, 0.0);
    film_free(&library);
    film_free(&judge);
    return done;
}

bool judge_by_povray(Report *report, const Bench *bench) {
    bool done = true;
    for (int i = 0; i < 2 * ELEVATION_COUNT && done; i++) {
        const Row row = {
            .distance = bench->distance, .elevation = i / 2, .kind = i % 2 ? POVRAY_GLOSS : POVRAY_LAMBERT};
        done = judge_povray_row(report, bench, &row);
    }
    return done;
}
