/* Pictures: scene-linear in memory and as EXR, for the screen as PNG. */
#ifndef RENDERER_FILM_H
#define RENDERER_FILM_H
#include <stdbool.h>
#include <stddef.h>

#include "exr.h"

typedef struct Film {
    int width, height;
    float (*rgb)[3]; /* row by row from the top, linear, sRGB's primaries */
} Film;

bool film_init(Film *film, int width, int height);
void film_free(Film *film);

/* At half the width and height. */
bool film_half(const Film *film, Film *half);

/* Pictures of one size side by side, with gaps of `gutter` black pixels. */
bool film_side_by_side(const Film *films, size_t count, int gutter, Film *sheet);

/* Each pixel the mean of a square of `times` by `times`. */
bool film_shrink(const Film *film, int times, Film *small);

/* A screen's three bytes for a radiance: exposure, film's curve, the sRGB curve. */
void film_tone(const float rgb[3], double exposure, unsigned char bytes[3]);

/* Where the film's channels lie, for exr_write() and exr_read(). */
void film_channels(const Film *film, ExrChannel channels[3]);

/* NULL if the EXR file's channels R, G and B were read into a new film, otherwise why not. */
const char *film_read_exr(Film *film, const char *path);

/* NULL if the file was written, otherwise why not. The last writes bytes as they are: red, green, blue. */
const char *film_write_exr(const Film *film, const char *path);
const char *film_write_png(const Film *film, double exposure, const char *path);
const char *png_write(int width, int height, const unsigned char *bytes, const char *path);
#endif
