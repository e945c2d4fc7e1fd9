/* From a place in the picture to the light of all lamps that is seen there, each counted as a point: no chance, no noise. */
#ifndef RENDERER_SHADE_H
#define RENDERER_SHADE_H
#include "camera.h"
#include "trace.h"

/* All that the samples of one view share; nothing in it changes while they run. */
typedef struct Stage {
    const Scene *scene;
    const View *view;
    const Tracer *tracer;
    Camera camera;
    Lights lights;
    uint32_t bounces; /* within scratches: STRIAE_BOUNCES_ONE or STRIAE_BOUNCES_ALL */
} Stage;

/* The mean radiance of the sample's square, red, green and blue. Returns the face hit, 0 for none. */
unsigned shade_sample(const Stage *stage, const Sample *sample, double radiance[3]);

/* The zones of a scratched surface that a sample shows lit from a place; directions and normals in the surface's local frame. */
enum { SHADE_MAX_ZONES = 256 };
typedef struct LitZones {
    StriaeZone zones[SHADE_MAX_ZONES];
    size_t count;
    Vec position; /* the sample's middle on the surface */
    float view[3], light[3];
} LitZones;

/* False where the sample shows something else. Shadows between surfaces are not looked for. */
bool shade_zones(const Stage *stage, const Sample *sample, Vec lamp, LitZones *lit);

/* What a pixel shows of scratches: all 0 where there are none. But for coverage it is told of the scratch that covers
   the largest part of the pixel, and there of the place nearest to the pixel's middle. */
typedef struct Label {
    float id;           /* number in order of adding, from 1 */
    float coverage;     /* the share of the pixel that scratches cover, 0 to 1 */
    float direction[3]; /* of travel, unit length, the scene's x, y and z */
    float depth_mm;     /* below the unscratched surface at the pixel's middle, negative on piled-up rims */
    float deepest_mm;   /* of the cross-section there */
    float arc_length;   /* from the scratch's start, scene units */
} Label;

void shade_label(const Stage *stage, const Sample *sample, Label *label);
#endif
