/* What each pixel shows of scratches, beside light: layers of the EXR pictures, to train and to judge whatever looks for
   scratches in the pictures themselves. */
#ifndef RENDERER_LABELS_H
#define RENDERER_LABELS_H
#include "exr.h"
#include "film.h"
#include "shade.h"

typedef struct LabelMap {
    int width, height;
    Label *labels; /* row by row from the top */
} LabelMap;

bool label_map_init(LabelMap *map, int width, int height);
void label_map_free(LabelMap *map);

/* One query per pixel, with the whole pixel as footprint. */
void label_map_render(LabelMap *map, const Stage *stage, int threads);

/* The EXR channels, and where in a label each is. In the order of the alphabet, as EXR has them. */
enum { LABEL_CHANNELS = 8 };
extern const struct LabelChannel {
    const char *name;
    size_t offset;
} label_channels[LABEL_CHANNELS];

/* Where a map's channels lie, for exr_write(). */
void label_map_channels(const LabelMap *map, ExrChannel channels[LABEL_CHANNELS]);

/* For people to look at: a colour for each scratch; coverage from black over red and yellow to white. */
const char *label_map_write_ids(const LabelMap *map, const char *path);
const char *label_map_write_coverage(const LabelMap *map, const char *path);
#endif
