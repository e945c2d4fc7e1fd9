/* A picture that paths are drawing: its radiance and what else is known of each pixel, as layers of one EXR file. Pixels that
   are not done yet have 0 samples, so that a file of some tiles can be finished by adding the rest. */
#ifndef RENDERER_PICTURE_H
#define RENDERER_PICTURE_H
#include "labels.h"
#include "paths.h"

typedef struct PicturePixel {
    float rgb[3];
    float direct[3]; /* of it: lamps themselves, and their light reflected once */
    float normal[3]; /* mean, scene axes; 0 for the surroundings */
    float distance;  /* from the camera, mean over what was met; 0 for the surroundings */
    float samples;   /* paths; 0: not done */
} PicturePixel;

typedef struct Picture {
    int width, height;
    PicturePixel *pixels; /* row by row from the top */
} Picture;

bool picture_init(Picture *picture, int width, int height);
void picture_free(Picture *picture);
PicturePixel *picture_pixel(const Picture *picture, int x, int y);

/* Pixels that are not done yet. */
size_t picture_lacking(const Picture *picture);

/* Takes over a file's pixels that are done, and not here yet. NULL, or why the file is not a part of the same picture. */
const char *picture_take(Picture *picture, const char *path, int samples);

/* `labels` may be NULL. NULL if the file was written, otherwise why not. */
const char *picture_write(const Picture *picture, const LabelMap *labels, const char *path);

/* The colours alone. False where memory is short. */
bool picture_film(const Picture *picture, Film *film);
#endif
