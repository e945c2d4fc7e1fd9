/* The paper's Figure 9: how scratches change with the tool, the hardness, the force and the tool's orientation. Each
 * is rendered over its cross-section, to one scale within a group.
 *
 *     striae_figure9 [FOLDER [WIDTH]]    FOLDER (default out) receives the pictures, WIDTH pixels (default 320) a cell
 */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "close_up.h"
#include "section.h"
#include "sheet.h"
#include "tiles.h"

enum { LEAST_WIDTH = 128, MOST_WIDTH = 1024, PATH_SIZE = 4096, EXIT_WRONG_OPTIONS = 2 };

/* One for all cells, so that they can be compared. */
static const double EXPOSURE = 1.7;

/* Pixels of the figure's parts, all in proportion to a cell's width. */
typedef struct Layout {
    int width;               /* of a cell */
    int picture, strip;      /* heights */
    int gap, group_gap, rim; /* between cells, between groups, around the sheet */
} Layout;

static Layout layout_of(int width) {
    return (Layout){.width = width,
                    .picture = width * 5 / 4,
                    .strip = width * 5 / 8,
                    .gap = width / 40,
                    .group_gap = width / 8,
                    .rim = width / 12};
}

static int group_width(const Layout *layout) {
    return CELLS_IN_GROUP * layout->width + (CELLS_IN_GROUP - 1) * layout->gap;
}

static bool make_sheet(Sheet *sheet, const Layout *layout) {
    const int across = 2 * group_width(layout), down = 2 * (layout->picture + layout->strip);
    const int around = 2 * layout->rim + layout->group_gap;
    return sheet_init(sheet, across + around, down + around);
}

static bool complain(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return false;
}

/* FOLDER/figure-9/NAME.SUFFIX */
static void cell_path(char path[PATH_SIZE], const char *folder, const Cell *cell, const char *suffix) {
    snprintf(path, PATH_SIZE, "%s/figure-9/%s.%s", folder, cell->name, suffix);
}

/* The rendered picture into its file and onto the sheet, the plot's strip under it. */
static bool put_cell(const Shot *shot, const Layout *layout, const char *folder, Sheet *sheet, int x, int y) {
    char path[PATH_SIZE];
    Film film = {0};
    const char *failure = close_up(shot, tiles_default_threads(), &film);
    if (!failure) {
        sheet_put_film(sheet, &film, EXPOSURE, x, y);
        cell_path(path, folder, shot->cell, "exr");
        failure = film_write_exr(&film, path);
    }
    film_free(&film);
    if (!failure) {
        cell_path(path, folder, shot->cell, "png");
        failure = sheet_put_png(sheet, path, x, y + layout->picture);
    }
    return !failure || complain(shot->cell->name, failure);
}

static bool draw_cell(int group, int cell, const Layout *layout, const char *folder, Sheet *sheet) {
    Shot shot = {.group = &figure_groups[group],
                 .cell = &figure_groups[group].cells[cell],
                 .width = layout->width,
                 .height = layout->picture};
    const int x =
        layout->rim + group % 2 * (group_width(layout) + layout->group_gap) + cell * (layout->width + layout->gap);
    const int y = layout->rim + group / 2 * (layout->picture + layout->strip + layout->group_gap);
    char strip[PATH_SIZE], whole[PATH_SIZE];
    cell_path(strip, folder, shot.cell, "png");
    cell_path(whole, folder, shot.cell, "svg");
    const char *failure = section_plot(&shot, layout->strip, strip, whole);
    if (failure) return complain(shot.cell->name, failure);
    return put_cell(&shot, layout, folder, sheet, x, y);
}

static bool draw_all(const Layout *layout, const char *folder, Sheet *sheet) {
    for (int i = 0; i < GROUP_COUNT * CELLS_IN_GROUP; i++)
        if (!draw_cell(i / CELLS_IN_GROUP, i % CELLS_IN_GROUP, layout, folder, sheet)) return false;
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/figure-9.png", folder);
    const char *failure = sheet_write_png(sheet, path);
    if (failure) return complain(path, failure);
    printf("picture: %s; its parts, as EXR, SVG and PNG, are in %s/figure-9/\n", path, folder);
    return true;
}

static bool make_folder(const char *path) {
    return mkdir(path, 0777) == 0 || errno == EEXIST || complain(path, strerror(errno));
}

static bool make_folders(const char *folder) {
    char path[PATH_SIZE];
    const int length = snprintf(path, sizeof path, "%s/figure-9", folder);
    if (length < 0 || length > PATH_SIZE - 64) return complain("FOLDER", "the path is too long");
    return make_folder(folder) && make_folder(path);
}

/* 0 for what is no number in range. */
static int parse_width(const char *text) {
    char *end = NULL;
    const long width = strtol(text, &end, 10);
    return *end == '\0' && width >= LEAST_WIDTH && width <= MOST_WIDTH ? (int)width : 0;
}

int main(int argc, char **argv) {
    const char *folder = argc > 1 ? argv[1] : "out";
    const int width = argc > 2 ? parse_width(argv[2]) : 320;
    if (argc > 3 || folder[0] == '\0' || folder[0] == '-' || width == 0) {
        fprintf(stderr, "usage: striae_figure9 [FOLDER [WIDTH]], WIDTH from %d to %d\n", LEAST_WIDTH, MOST_WIDTH);
        return EXIT_WRONG_OPTIONS;
    }
    const Layout layout = layout_of(width);
    Sheet sheet = {0};
    const bool done = make_folders(folder) && (make_sheet(&sheet, &layout) || complain("sheet", "out of memory")) &&
                      draw_all(&layout, folder, &sheet);
    sheet_free(&sheet);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
