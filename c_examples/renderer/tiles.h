/* Work on a picture, shared out in square tiles over the processor's cores. */
#ifndef RENDERER_TILES_H
#define RENDERER_TILES_H
#include <stdbool.h>

enum { TILE_SIZE = 32 }; /* pixels of a side, less at the right and lower borders */

typedef struct Tile {
    int x0, y0, x1, y1; /* x1 and y1 are past the end */
} Tile;

/* Tiles are numbered from 0, row by row from the top. */
int tiles_count(int width, int height);

typedef void TileWork(const Tile *tile, void *user);
/* Called after each tile, by one thread at a time. */
typedef void TilesDone(int done, int total, void *user);

typedef struct TileJob {
    int width, height, threads;
    int first, past; /* the tiles to be done, `past` being past the end; 0 and 0: all */
    TileWork *work; /* on several threads at once */
    void *work_user;
    TilesDone *report; /* may be NULL */
    void *report_user;
} TileJob;

/* Returns when every tile is done. Where fewer threads can be started than asked for, those do all the work. */
void tiles_run(const TileJob *job);

/* The number of cores that may be used. */
int tiles_default_threads(void);
#endif
