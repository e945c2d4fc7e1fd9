#include "check.h"

#include <pthread.h>

#include "progress.h"
#include "render.h"
#include "tiles.h"

/* The reference's samples per pixel and direction. */
enum { REFERENCE_ACROSS = 16 };

typedef struct Comparison {
    const Stage *stage;
    int stride;
    pthread_mutex_t lock;
    size_t pixels;
    double sum, squared_difference, worst;
} Comparison;

/* A face's own pixels, away from its border: the eight neighbours' middles show it too. */
static bool shows_only_judged_face(const Stage *stage, int x, int y) {
    for (int k = 0; k < 9; k++) {
        const Vec direction = camera_direction(&stage->camera, x + k % 3 - 0.5, y + k / 3 - 0.5);
        Hit hit;
        if (!trace_closest(stage->tracer, stage->camera.position, direction, &hit)) return false;
        if (hit.mesh->faces[hit.triangle] != stage->scene->judged_face) return false;
    }
    return true;
}

static void compare_pixel(const Stage *stage, int x, int y, Comparison *sums) {
    double once[3], often[3];
    if (!shows_only_judged_face(stage, x, y)) return;
    render_pixel(stage, x, y, 1, once);
    if (render_pixel(stage, x, y, REFERENCE_ACROSS, often) != stage->scene->judged_face) return;
    sums->pixels++;
    for (int c = 0; c < 3; c++) {
        const double difference = once[c] - often[c];
        sums->sum += often[c];
        sums->squared_difference += difference * difference;
        sums->worst = fmax(sums->worst, fabs(difference));
    }
}

static void compare_tile(const Tile *tile, void *user) {
    Comparison *all = user;
    Comparison here = {.stage = all->stage};
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++)
            if ((x + 5 * y) % all->stride == 0) compare_pixel(all->stage, x, y, &here);
    pthread_mutex_lock(&all->lock);
    all->pixels += here.pixels;
    all->sum += here.sum;
    all->squared_difference += here.squared_difference;
    all->worst = fmax(all->worst, here.worst);
    pthread_mutex_unlock(&all->lock);
}

CheckResult check_view(const Stage *stage, int width, int height, int stride, int threads) {
    Comparison sums = {.stage = stage, .stride = stride, .lock = PTHREAD_MUTEX_INITIALIZER};
    Progress progress = progress_start("  check");
    const TileJob job = {.width = width,
                         .height = height,
                         .threads = threads,
                         .work = compare_tile,
                         .work_user = &sums,
                         .report = progress_report,
                         .report_user = &progress};
    tiles_run(&job);
    progress_end(&progress);
    pthread_mutex_destroy(&sums.lock);

    const double count = 3.0 * (double)sums.pixels, mean = sums.sum / count;
    return (CheckResult){.pixels = sums.pixels,
                         .mean_radiance = mean,
                         .rms = sqrt(sums.squared_difference / count) / mean,
                         .worst = sums.worst / mean};
}
