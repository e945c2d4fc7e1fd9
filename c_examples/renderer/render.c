#include "render.h"

#include <stdlib.h>

#include "progress.h"
#include "tiles.h"

/* Samples per pixel and direction where faces meet. */
enum { EDGE_SAMPLES_ACROSS = 8 };

typedef struct Picture {
    const Stage *stage;
    const RenderSettings *settings;
    Film *film;
    unsigned *faces; /* what each pixel shows */
} Picture;

unsigned render_pixel(const Stage *stage, int x, int y, int n, double radiance[3]) {
    unsigned face = 0;
    for (int c = 0; c < 3; c++) radiance[c] = 0.0;
    for (int i = 0; i < n * n; i++) {
        const Sample sample = {x + (i % n + 0.5) / n, y + (i / n + 0.5) / n, 1.0 / n};
        double part[3];
        const unsigned hit = shade_sample(stage, &sample, part);
        face = i == 0 || hit == face ? hit : (unsigned)FACE_MIXED;
        for (int c = 0; c < 3; c++) radiance[c] += part[c] / (n * n);
    }
    return face;
}

static size_t pixel_index(const Picture *picture, int x, int y) {
    return (size_t)y * (size_t)picture->film->width + (size_t)x;
}

static unsigned put_pixel(const Picture *picture, int x, int y, int samples_across) {
    double radiance[3];
    const unsigned face = render_pixel(picture->stage, x, y, samples_across, radiance);
    for (int c = 0; c < 3; c++) picture->film->rgb[pixel_index(picture, x, y)][c] = (float)radiance[c];
    return face;
}

static void first_pass(const Tile *tile, void *user) {
    const Picture *picture = user;
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++)
            picture->faces[pixel_index(picture, x, y)] =
                put_pixel(picture, x, y, picture->settings->samples_across);
}

/* Whether a pixel near by shows another face: then an edge, or the thin shadow along one, may pass through. */
static bool near_edge(const Picture *picture, int x, int y) {
    const unsigned face = picture->faces[pixel_index(picture, x, y)];
    for (int j = y - 2; j <= y + 2; j++)
        for (int i = x - 2; i <= x + 2; i++)
            if (i >= 0 && j >= 0 && i < picture->film->width && j < picture->film->height &&
                picture->faces[pixel_index(picture, i, j)] != face)
                return true;
    return false;
}

static void second_pass(const Tile *tile, void *user) {
    const Picture *picture = user;
    const int first = picture->settings->samples_across;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            if (first < EDGE_SAMPLES_ACROSS && near_edge(picture, x, y))
                put_pixel(picture, x, y, EDGE_SAMPLES_ACROSS);
        }
    }
}

bool render_view(const Stage *stage, const RenderSettings *settings, Film *film) {
    const size_t count = (size_t)film->width * (size_t)film->height;
    Picture picture = {stage, settings, film, malloc(count * sizeof *picture.faces)};
    if (!picture.faces) return false;
    Progress progress = progress_start(stage->view->name);
    TileJob job = {.width = film->width,
                   .height = film->height,
                   .threads = settings->threads,
                   .work = first_pass,
                   .work_user = &picture,
                   .report = progress_report,
                   .report_user = &progress};
    tiles_run(&job);
    job.work = second_pass;
    job.report = NULL;
    tiles_run(&job);
    progress_end(&progress);
    free(picture.faces);
    return true;
}
