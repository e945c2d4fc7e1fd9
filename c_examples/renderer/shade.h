/* From a place in the picture to the light that is seen there. */
#ifndef RENDERER_SHADE_H
#define RENDERER_SHADE_H
#include "lights.h"
#include "trace.h"

/* All that the samples of one view share; nothing in it changes while they run. */
typedef struct Stage {
    const Scene *scene;
    const View *view;
    const Tracer *tracer;
    Camera camera;
    Lights lights;
} Stage;

/* A square of the picture: its middle, and its side in pixels. */
typedef struct Sample {
    double x, y, size;
} Sample;

/* The mean radiance of the sample's square, red, green and blue. Returns the face hit, 0 for none. */
unsigned shade_sample(const Stage *stage, const Sample *sample, double radiance[3]);
#endif
