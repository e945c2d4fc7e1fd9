/* Car paint, as a base BRDF of the renderer's own: a colour that scatters evenly under a smooth clear coat. */
#ifndef RENDERER_PAINT_H
#define RENDERER_PAINT_H
#include <striae.h>

typedef struct Paint {
    float albedo[3];
    float alpha; /* of the coat: GGX */
} Paint;

/* Must stay as long as any pattern that has it. */
StriaeHostBrdf paint_host(Paint *paint);
#endif
