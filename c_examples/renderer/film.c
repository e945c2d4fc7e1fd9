#include "film.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>


bool film_init(Film *film, int width, int height) {
    *film = (Film){width, height, calloc((size_t)width * (size_t)height, sizeof *film->rgb)};
    return film->rgb != NULL;
}

void film_free(Film *film) {
    free(film->rgb);
    *film = (Film){0, 0, NULL};
}

static float *pixel(const Film *film, int x, int y) {
    return film->rgb[(size_t)y * (size_t)film->width + (size_t)x];
}

static int clamp_int(int value, int most) { return value < 0 ? 0 : value > most ? most : value; }

bool film_half(const Film *film, Film *half) {
    /* Wider than the 2 x 2 pixels that become one, or thin bright lines would turn into dashes. */
    static const float weight[4] = {0.125f, 0.375f, 0.375f, 0.125f};
    if (!film_init(half, (film->width + 1) / 2, (film->height + 1) / 2)) return false;
    for (int y = 0; y < half->height; y++) {
        for (int x = 0; x < half->width; x++) {
            for (int k = 0; k < 16; k++) {
                const int from_x = clamp_int(2 * x - 1 + k % 4, film->width - 1);
                const int from_y = clamp_int(2 * y - 1 + k / 4, film->height - 1);
                for (int c = 0; c < 3; c++)
                    pixel(half, x, y)[c] += weight[k % 4] * weight[k / 4] * pixel(film, from_x, from_y)[c];
            }
        }
    }
    return true;
}

bool film_shrink(const Film *film, int times, Film *small) {
    if (!film_init(small, film->width / times, film->height / times)) return false;
    const float share = 1.0f / (float)(times * times);
    for (int y = 0; y < small->height * times; y++)
        for (int x = 0; x < small->width * times; x++)
            for (int c = 0; c < 3; c++) pixel(small, x / times, y / times)[c] += share * pixel(film, x, y)[c];
    return true;
}

bool film_side_by_side(const Film *films, size_t count, int gutter, Film *sheet) {
    const int step = films[0].width + gutter;
    if (!film_init(sheet, (int)count * step - gutter, films[0].height)) return false;
    for (size_t i = 0; i < count; i++)
        for (int y = 0; y < films[i].height; y++)
            memcpy(pixel(sheet, (int)i * step, y), pixel(&films[i], 0, y),
                   (size_t)films[i].width * sizeof *sheet->rgb);
    return true;
}

/* Narkowicz's fit (2015) of the film curve that the Academy's colour system uses: a toe for deep shadows, a long
   shoulder, so that a glint on a scratch keeps its shape. */
static double film_curve(double x) { return fmin(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)); }

static double srgb_curve(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }

void film_tone(const float rgb[3], double exposure, unsigned char bytes[3]) {
    for (int c = 0; c < 3; c++)
        bytes[c] = (unsigned char)(255.0 * srgb_curve(film_curve(exposure * (double)rgb[c])) + 0.5);
}

enum { RGB = 3 };

void film_channels(const Film *film, ExrChannel channels[3]) {
    static const char *const names[RGB] = {"R", "G", "B"};
    for (int c = 0; c < RGB; c++)
        channels[c] =
            (ExrChannel){names[c], &film->rgb[0][c], sizeof *film->rgb, (size_t)film->width * sizeof *film->rgb};
}

const char *film_write_exr(const Film *film, const char *path) {
    ExrChannel channels[RGB];
    film_channels(film, channels);
    return exr_write(path, film->width, film->height, channels, RGB);
}

const char *film_read_exr(Film *film, const char *path) {
    ExrChannel channels[RGB];
    int width, height;
    *film = (Film){0, 0, NULL};
    const char *failure = exr_size(path, &width, &height);
    if (failure) return failure;
    if (!film_init(film, width, height)) return "out of memory";
    film_channels(film, channels);
    failure = exr_read(path, channels, RGB);
    if (failure) film_free(film);
    return failure;
}
