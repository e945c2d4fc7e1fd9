/* A view's picture by paths: tile after tile on all cores, kept on disk meanwhile. */
#ifndef RENDERER_DRAW_H
#define RENDERER_DRAW_H
#include "picture.h"

typedef struct DrawSettings {
    PathSettings paths;
    int threads;
    int first_tile, past_tile; /* as in TileJob */
    const char *kept;          /* EXR file that is written now and then, and at the end; NULL: none */
} DrawSettings;

/* Draws what the picture lacks of these tiles. NULL, or why `kept` could not be written. */
const char *draw_paths(const Stage *stage, const DrawSettings *settings, Picture *picture);
#endif
