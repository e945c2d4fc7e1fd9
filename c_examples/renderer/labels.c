#include "labels.h"

#include <stdlib.h>

#include "progress.h"
#include "tiles.h"

const struct LabelChannel label_channels[LABEL_CHANNELS] = {
    {"scratch.arc_length", offsetof(Label, arc_length)},
    {"scratch.coverage", offsetof(Label, coverage)},
    {"scratch.deepest_mm", offsetof(Label, deepest_mm)},
    {"scratch.depth_mm", offsetof(Label, depth_mm)},
    {"scratch.direction.X", offsetof(Label, direction[0])},
    {"scratch.direction.Y", offsetof(Label, direction[1])},
    {"scratch.direction.Z", offsetof(Label, direction[2])},
    {"scratch.id", offsetof(Label, id)},
};

bool label_map_init(LabelMap *map, int width, int height) {
    *map = (LabelMap){width, height, calloc((size_t)width * (size_t)height, sizeof *map->labels)};
    return map->labels != NULL;
}

void label_map_free(LabelMap *map) {
    free(map->labels);
    *map = (LabelMap){0, 0, NULL};
}

void label_map_channels(const LabelMap *map, ExrChannel channels[LABEL_CHANNELS]) {
    for (int c = 0; c < LABEL_CHANNELS; c++)
        channels[c] = (ExrChannel){label_channels[c].name, (float *)((char *)map->labels + label_channels[c].offset),
                                   sizeof *map->labels, (size_t)map->width * sizeof *map->labels};
}

typedef struct Labelling {
    const Stage *stage;
    LabelMap *map;
} Labelling;

static void label_tile(const Tile *tile, void *user) {
    const Labelling *labelling = user;
    LabelMap *map = labelling->map;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            const Sample pixel = {x + 0.5, y + 0.5, 1.0};
            shade_label(labelling->stage, &pixel, &map->labels[(size_t)y * (size_t)map->width + (size_t)x]);
        }
    }
}

void label_map_render(LabelMap *map, const Stage *stage, int threads) {
    Labelling labelling = {stage, map};
    Progress progress = progress_start("  labels");
    const TileJob job = {.width = map->width,
                         .height = map->height,
                         .threads = threads,
                         .work = label_tile,
                         .work_user = &labelling,
                         .report = progress_report,
                         .report_user = &progress};
    tiles_run(&job);
    progress_end(&progress);
}

static unsigned char byte(double value) { return (unsigned char)(255.0 * fmin(1.0, fmax(0.0, value)) + 0.5); }

/* A golden ratio of the colour circle from each scratch to the next: the first ones look the least alike. */
static void id_color(const Label *label, unsigned char color[3]) {
    static const double third[3] = {0.0, 2.0 / 3.0, 1.0 / 3.0};
    for (int c = 0; c < 3; c++) {
        const double hue = fmod((double)label->id * 0.6180339887498949 + third[c], 1.0);
        color[c] = label->id > 0.0f ? byte(0.25 + fabs(6.0 * hue - 3.0) - 1.0) : 0;
    }
}

static void coverage_color(const Label *label, unsigned char color[3]) {
    for (int c = 0; c < 3; c++) color[c] = byte(3.0 * (double)label->coverage - c);
}

static const char *write_colors(const LabelMap *map, void (*color)(const Label *, unsigned char *), const char *path) {
    const size_t count = (size_t)map->width * (size_t)map->height;
    unsigned char (*bytes)[3] = malloc(count * sizeof *bytes);
    if (!bytes) return "out of memory";
    for (size_t i = 0; i < count; i++) color(&map->labels[i], bytes[i]);
    const char *failure = png_write(map->width, map->height, (const unsigned char *)bytes, path);
    free(bytes);
    return failure;
}

const char *label_map_write_ids(const LabelMap *map, const char *path) { return write_colors(map, id_color, path); }

const char *label_map_write_coverage(const LabelMap *map, const char *path) {
    return write_colors(map, coverage_color, path);
}
