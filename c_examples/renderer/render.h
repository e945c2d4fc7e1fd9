/* A view's picture: one sample per pixel where the library filters, several where an edge passes. */
#ifndef RENDERER_RENDER_H
#define RENDERER_RENDER_H
#include "film.h"
#include "shade.h"

typedef struct RenderSettings {
    int samples_across; /* per pixel and direction: its square is the number of samples */
    int threads;
} RenderSettings;

/* False where memory is short. The film has the size of the picture. */
bool render_view(const Stage *stage, const RenderSettings *settings, Film *film);

/* The mean over a pixel's n x n equal squares, each a sample with a footprint of its own. Returns the face that
   all of them hit, FACE_MIXED if they differ. */
enum { FACE_MIXED = ~0 };
unsigned render_pixel(const Stage *stage, int x, int y, int n, double radiance[3]);
#endif
