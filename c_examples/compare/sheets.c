#include "sheets.h"

#include <math.h>
#include <stdio.h>

enum { GUTTER = 2, ENLARGED = 5, PATH_SIZE = 4096 };

/* The mean radiance becomes a middling grey. */
static const double MEAN_EXPOSED = 0.25;

static bool enlarge(const Film *film, Film *large) {
    if (!film_init(large, ENLARGED * film->width, ENLARGED * film->height)) return false;
    for (int y = 0; y < large->height; y++) {
        for (int x = 0; x < large->width; x++) {
            const float *from = film->rgb[(size_t)(y / ENLARGED) * (size_t)film->width + (size_t)(x / ENLARGED)];
            float *to = large->rgb[(size_t)y * (size_t)large->width + (size_t)x];
            for (int c = 0; c < 3; c++) to[c] = from[c];
        }
    }
    return true;
}

static const char *write_both(const Film *sheet, double mean, const char *folder, const char *name) {
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s.exr", folder, name);
    const char *failure = film_write_exr(sheet, path);
    Film large = {0};
    if (!failure && !enlarge(sheet, &large)) failure = "out of memory";
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    if (!failure) failure = film_write_png(&large, MEAN_EXPOSED / mean, path);
    film_free(&large);
    return failure;
}

const char *sheet_write(const Film *library, const Film *truth, double mean, const char *folder, const char *name) {
    Film panels[3] = {*library, *truth, {0}}, sheet = {0};
    const char *failure = "out of memory";
    if (film_init(&panels[2], truth->width, truth->height)) {
        const size_t pixels = (size_t)truth->width * (size_t)truth->height;
        for (size_t i = 0; i < pixels; i++)
            for (int c = 0; c < 3; c++) panels[2].rgb[i][c] = 10.0f * fabsf(library->rgb[i][c] - truth->rgb[i][c]);
        if (film_side_by_side(panels, 3, GUTTER, &sheet)) failure = write_both(&sheet, mean, folder, name);
    }
    film_free(&panels[2]);
    film_free(&sheet);
    return failure;
}
