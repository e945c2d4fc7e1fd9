#include "picture.h"

#include <stdlib.h>
#include <string.h>

enum { PICTURE_CHANNELS = 11 };

static const struct {
    const char *name;
    size_t offset;
} picture_channels[PICTURE_CHANNELS] = {
    {"R", offsetof(PicturePixel, rgb[0])},           {"G", offsetof(PicturePixel, rgb[1])},
    {"B", offsetof(PicturePixel, rgb[2])},           {"direct.R", offsetof(PicturePixel, direct[0])},
    {"direct.G", offsetof(PicturePixel, direct[1])}, {"direct.B", offsetof(PicturePixel, direct[2])},
    {"normal.X", offsetof(PicturePixel, normal[0])}, {"normal.Y", offsetof(PicturePixel, normal[1])},
    {"normal.Z", offsetof(PicturePixel, normal[2])}, {"distance", offsetof(PicturePixel, distance)},
    {"samples", offsetof(PicturePixel, samples)},
};

bool picture_init(Picture *picture, int width, int height) {
    *picture = (Picture){width, height, calloc((size_t)width * (size_t)height, sizeof *picture->pixels)};
    return picture->pixels != NULL;
}

void picture_free(Picture *picture) {
    free(picture->pixels);
    *picture = (Picture){0, 0, NULL};
}

static size_t pixel_count(const Picture *picture) { return (size_t)picture->width * (size_t)picture->height; }

PicturePixel *picture_pixel(const Picture *picture, int x, int y) {
    return &picture->pixels[(size_t)y * (size_t)picture->width + (size_t)x];
}

size_t picture_lacking(const Picture *picture) {
    size_t lacking = 0;
    for (size_t i = 0; i < pixel_count(picture); i++) lacking += picture->pixels[i].samples == 0.0f;
    return lacking;
}

static void channels_of(const Picture *picture, ExrChannel channels[PICTURE_CHANNELS]) {
    for (int c = 0; c < PICTURE_CHANNELS; c++)
        channels[c] =
            (ExrChannel){picture_channels[c].name, (float *)((char *)picture->pixels + picture_channels[c].offset),
                         sizeof *picture->pixels, (size_t)picture->width * sizeof *picture->pixels};
}

static const char *merge(Picture *picture, const Picture *part, int samples) {
    for (size_t i = 0; i < pixel_count(part); i++)
        if (part->pixels[i].samples != 0.0f && part->pixels[i].samples != (float)samples)
            return "has another number of samples per pixel than --spp";
    for (size_t i = 0; i < pixel_count(part); i++)
        if (picture->pixels[i].samples == 0.0f) picture->pixels[i] = part->pixels[i];
    return NULL;
}

const char *picture_take(Picture *picture, const char *path, int samples) {
    int width, height;
    ExrChannel channels[PICTURE_CHANNELS];
    Picture part;
    const char *failure = exr_size(path, &width, &height);
    if (failure) return failure;
    if (width != picture->width || height != picture->height)
        return "has another size than --width and --height say";
    if (!picture_init(&part, width, height)) return "out of memory";
    channels_of(&part, channels);
    failure = exr_read(path, channels, PICTURE_CHANNELS);
    if (!failure) failure = merge(picture, &part, samples);
    picture_free(&part);
    return failure;
}

const char *picture_write(const Picture *picture, const LabelMap *labels, const char *path) {
    ExrChannel channels[PICTURE_CHANNELS + LABEL_CHANNELS];
    channels_of(picture, channels);
    if (labels) label_map_channels(labels, channels + PICTURE_CHANNELS);
    return exr_write(path, picture->width, picture->height, channels,
                     PICTURE_CHANNELS + (labels ? LABEL_CHANNELS : 0));
}

bool picture_film(const Picture *picture, Film *film) {
    if (!film_init(film, picture->width, picture->height)) return false;
    for (size_t i = 0; i < pixel_count(picture); i++)
        memcpy(film->rgb[i], picture->pixels[i].rgb, sizeof film->rgb[i]);
    return true;
}
