/* The paper's Figure 7: scratches along curves beside the same ones painted into an image, far and near; and how the systems
   before that had them. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "curves.h"
#include "methods.h"
#include "tiles.h"

enum {
    LEAST_WIDTH = 64,
    USUAL_WIDTH = 400,
    MOST_WIDTH = 2000,
    SAMPLES = 16,
    GUTTER = 6,
    ROWS = 2,
    COLUMNS = 4,
    PATH_SIZE = 4096,
    TEXELS = 1024,
    LAMPS_ACROSS = 4
};

static const double WIDTH_MM = 100.0, EXPOSURE = 2.0, LAMP_ELEVATION_DEG = 28.0;
/* How much nearer the second view is, and what it looks at: a place where loops cross, mm from the plate's middle. */
static const double NEARER = 9.0, DETAIL_MM[2] = {-25.1, -0.3};

static const char *const NAMES[COLUMNS] = {"curves", "mdg01", "bl99", "bb90"};
static const char *const VIEWS[ROWS] = {"far", "near"};

static bool complain(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return false;
}

/* The earlier systems, each with an image or lists of so many texels across. */
static bool make_systems(const Plate *plate, StriaeBaseline *systems[COLUMNS]) {
    static const float specular[3] = {0.2f, 0.2f, 0.2f};
    const StriaeCanvas canvas = plate_canvas(TEXELS);
    StriaeTwoAngles scratch;
    return plate_two_angles(&scratch) &&
           striae_baseline_mdg01(plate->pattern, &canvas, &scratch, &systems[1]) == STRIAE_STATUS_OK &&
           striae_baseline_bl99(plate->pattern, &canvas, specular, 60.0f, &systems[2]) == STRIAE_STATUS_OK &&
           striae_baseline_bb90(plate->pattern, &canvas, 0.2f, 0.9f, 7, &systems[3]) == STRIAE_STATUS_OK;
}

static void go_near(Plate *plate) {
    plate->scene.target = vec(DETAIL_MM[0], DETAIL_MM[1], 0.0);
    plate->view.distance /= NEARER;
    plate->camera = camera_for_view(&plate->scene, &plate->view, plate->width, plate->height);
}

static void put(const Film *film, Film *sheet, int left, int above) {
    for (int y = 0; y < film->height; y++)
        memcpy(sheet->rgb[(size_t)(above + y) * (size_t)sheet->width + (size_t)left],
               film->rgb[(size_t)y * (size_t)film->width], (size_t)film->width * sizeof film->rgb[0]);
}

static bool draw_row(const Plate *plate, StriaeBaseline *systems[COLUMNS], int row, const char *folder, Film *film,
                     Film *sheet) {
    for (int column = 0; column < COLUMNS; column++) {
        const Method method = column == 0 ? method_library(plate) : method_baseline(plate, systems[column]);
        char path[PATH_SIZE];
        render(&method, SAMPLES, 0, film);
        put(film, sheet, column * (film->width + GUTTER), row * (film->height + GUTTER));
        snprintf(path, sizeof path, "%s/figure-7/%s-%s.exr", folder, NAMES[column], VIEWS[row]);
        const char *failure = film_write_exr(film, path);
        if (failure) return complain(path, failure);
    }
    return true;
}

static bool draw_all(Plate *plate, const char *folder, Film *film, Film *sheet) {
    StriaeBaseline *systems[COLUMNS] = {NULL};
    bool drawn = make_systems(plate, systems) || complain("earlier systems", striae_last_error());
    for (int row = 0; row < ROWS && drawn; row++) {
        if (row == 1) go_near(plate);
        drawn = draw_row(plate, systems, row, folder, film, sheet);
    }
    for (int i = 0; i < COLUMNS; i++) striae_baseline_release(systems[i]);
    if (!drawn) return false;
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/figure-7.png", folder);
    const char *failure = film_write_png(sheet, EXPOSURE, path);
    if (failure) return complain(path, failure);
    printf("picture: %s: far and near, from left to right curves, MDG01 (an image of %d texels across), BL99 and "
           "BB90\n"
           "(straight lines from end to end); as EXR in %s/figure-7/\n",
           path, TEXELS, folder);
    return true;
}

static bool make_folder(const char *path) {
    return mkdir(path, 0777) == 0 || errno == EEXIST || complain(path, strerror(errno));
}

static bool make_folders(const char *folder) {
    char path[PATH_SIZE];
    const int length = snprintf(path, sizeof path, "%s/figure-7", folder);
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
    const int width = argc > 2 ? parse_width(argv[2]) : USUAL_WIDTH;
    char error[SCENE_ERROR_SIZE];
    if (argc > 3 || folder[0] == '\0' || folder[0] == '-' || width == 0) {
        fprintf(stderr, "usage: striae_figure7 [FOLDER [WIDTH]], WIDTH of each picture from %d to %d\n",
                LEAST_WIDTH, MOST_WIDTH);
        return 2;
    }
    if (!make_folders(folder)) return EXIT_FAILURE;
    Plate plate;
    Film film = {0}, sheet = {0};
    bool done = plate_init(&plate, WIDTH_MM, width, error) || complain("plate", error);
    if (done) {
        plate.lamp_elevation_deg = LAMP_ELEVATION_DEG;
        plate_light(&plate, LAMPS_ACROSS);
        const int wide = COLUMNS * (plate.width + GUTTER) - GUTTER, high = ROWS * (plate.height + GUTTER) - GUTTER;
        done = (curves_scratch(&plate) || complain("curves", striae_last_error())) &&
               ((film_init(&film, plate.width, plate.height) && film_init(&sheet, wide, high)) ||
                complain("picture", "out of memory")) &&
               draw_all(&plate, folder, &film, &sheet);
    }
    film_free(&film);
    film_free(&sheet);
    plate_free(&plate);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
