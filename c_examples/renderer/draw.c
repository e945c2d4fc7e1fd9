#include "draw.h"

#include <pthread.h>

#include "progress.h"
#include "tiles.h"

static const double SECONDS_BETWEEN_FILES = 60.0;

typedef struct Drawing {
    const Stage *stage;
    const DrawSettings *settings;
    Picture *picture;
    pthread_mutex_t lock; /* of the picture: tiles enter it whole, so that no file holds half of one */
    Progress progress;
    double kept_at;
    const char *failure;
} Drawing;

static PicturePixel draw_pixel(const Drawing *drawing, int x, int y) {
    const PathSettings *settings = &drawing->settings->paths;
    const double share = 1.0 / settings->samples;
    double rgb[3] = {0}, direct[3] = {0}, distance = 0.0;
    Vec normal = {0.0, 0.0, 0.0};
    int met = 0;
    for (int i = 0; i < settings->samples; i++) {
        const PathLight light = path_follow(drawing->stage, settings, x, y, (uint32_t)i);
        for (int c = 0; c < 3; c++) {
            rgb[c] += share * (light.direct[c] + light.indirect[c]);
            direct[c] += share * light.direct[c];
        }
        normal = vec_along(normal, share, light.normal);
        distance += light.distance;
        met += light.distance > 0.0;
    }
    PicturePixel pixel = {.distance = met ? (float)(distance / met) : 0.0f, .samples = (float)settings->samples};
    for (int c = 0; c < 3; c++) {
        pixel.rgb[c] = (float)rgb[c];
        pixel.direct[c] = (float)direct[c];
    }
    vec_to_floats(normal, pixel.normal);
    return pixel;
}

static void draw_tile(const Tile *tile, void *user) {
    Drawing *drawing = user;
    PicturePixel pixels[TILE_SIZE][TILE_SIZE];
    pthread_mutex_lock(&drawing->lock);
    const bool done = picture_pixel(drawing->picture, tile->x0, tile->y0)->samples > 0.0f;
    pthread_mutex_unlock(&drawing->lock);
    if (done) return;
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++) pixels[y - tile->y0][x - tile->x0] = draw_pixel(drawing, x, y);
    pthread_mutex_lock(&drawing->lock);
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++)
            *picture_pixel(drawing->picture, x, y) = pixels[y - tile->y0][x - tile->x0];
    pthread_mutex_unlock(&drawing->lock);
}

static void keep(Drawing *drawing) {
    pthread_mutex_lock(&drawing->lock);
    if (!drawing->failure) drawing->failure = picture_write(drawing->picture, NULL, drawing->settings->kept);
    pthread_mutex_unlock(&drawing->lock);
    drawing->kept_at = seconds_now();
}

static void report(int done, int total, void *user) {
    Drawing *drawing = user;
    progress_report(done, total, &drawing->progress);
    if (drawing->settings->kept && seconds_now() - drawing->kept_at > SECONDS_BETWEEN_FILES) keep(drawing);
}

const char *draw_paths(const Stage *stage, const DrawSettings *settings, Picture *picture) {
    Drawing drawing = {.stage = stage,
                       .settings = settings,
                       .picture = picture,
                       .lock = PTHREAD_MUTEX_INITIALIZER,
                       .progress = progress_start(stage->view->name),
                       .kept_at = seconds_now()};
    const TileJob job = {.width = picture->width,
                         .height = picture->height,
                         .threads = settings->threads,
                         .first = settings->first_tile,
                         .past = settings->past_tile,
                         .work = draw_tile,
                         .work_user = &drawing,
                         .report = report,
                         .report_user = &drawing};
    tiles_run(&job);
    progress_end(&drawing.progress);
    if (settings->kept) keep(&drawing);
    pthread_mutex_destroy(&drawing.lock);
    return drawing.failure;
}
