/* Renders a scene with striae: EXR and PNG for each view, and a contact sheet of all. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "check.h"
#include "labels.h"
#include "options.h"
#include "render.h"

enum { EXIT_WRONG_OPTIONS = 2, PATH_SIZE = 4096, SHEET_GUTTER = 8 };

/* RMS difference that one sample per pixel may have from 256, relative to the mean radiance. */
static const double CHECK_LIMIT = 0.01;

static bool complain(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return false;
}

static bool path_to(char path[PATH_SIZE], const char *folder, const char *name, const char *ending) {
    const int length = snprintf(path, PATH_SIZE, "%s/%s%s", folder, name, ending);
    return (length >= 0 && length < PATH_SIZE) || complain("--out", "the path is too long");
}

/* `labels` may be NULL. */
static bool write_picture(const Film *film, const LabelMap *labels, const char *folder, const char *name,
                          double exposure) {
    char path[PATH_SIZE];
    if (!path_to(path, folder, name, ".exr")) return false;
    const char *failure = exr_write_layers(film, labels, path);
    if (failure) return complain(path, failure);
    if (!path_to(path, folder, name, ".png")) return false;
    failure = film_write_png(film, exposure, path);
    return failure ? complain(path, failure) : true;
}

static bool write_label_pictures(const LabelMap *labels, const char *folder, const char *name) {
    char path[PATH_SIZE];
    if (!path_to(path, folder, name, "-id.png")) return false;
    const char *failure = label_map_write_ids(labels, path);
    if (failure) return complain(path, failure);
    if (!path_to(path, folder, name, "-coverage.png")) return false;
    failure = label_map_write_coverage(labels, path);
    return failure ? complain(path, failure) : true;
}

/* A view's EXR with the labels' layers, and pictures of these. */
static bool write_labelled(const Stage *stage, const Film *film, const Options *options) {
    LabelMap labels;
    if (!label_map_init(&labels, film->width, film->height)) return complain(stage->view->name, "out of memory");
    label_map_render(&labels, stage, options->threads);
    const bool written = write_picture(film, &labels, options->out, stage->view->name, stage->scene->exposure) &&
                         write_label_pictures(&labels, options->out, stage->view->name);
    label_map_free(&labels);
    return written;
}

/* All views side by side, at half size. */
static bool write_sheet(const Film *films, size_t count, const char *folder, double exposure) {
    Film full = {0}, half = {0};
    const bool made = film_side_by_side(films, count, SHEET_GUTTER, &full) && film_half(&full, &half);
    const bool written =
        made ? write_picture(&half, NULL, folder, "contact-sheet", exposure) : complain("contact sheet", "out of memory");
    film_free(&full);
    film_free(&half);
    return written;
}

static bool check(const Stage *stage, const Options *options, double *worst_rms) {
    /* Large pictures are compared at some 16000 of their pixels, evenly spread: enough for three digits. */
    const int stride = 1 + options->width * options->height / 16000;
    const CheckResult result = check_view(stage, options->width, options->height, stride, options->threads);
    if (result.pixels == 0) return complain(stage->view->name, "no pixel to check; try a larger --width");
    printf("%s: 1 against 256 samples per pixel: RMS %.3f %% of the mean radiance %.4f (worst pixel %.2f %%, "
           "%zu pixels compared)\n",
           stage->view->name, 100.0 * result.rms, result.mean_radiance, 100.0 * result.worst, result.pixels);
    if (!(result.rms <= *worst_rms)) *worst_rms = result.rms;
    return true;
}

static bool render_all(const Scene *scene, const Tracer *tracer, const Options *options, Film *films) {
    const RenderSettings settings = {options->samples_across, options->threads};
    double worst_rms = 0.0;
    for (size_t i = 0; i < scene->view_count; i++) {
        Stage stage = {.scene = scene, .view = &scene->views[i], .tracer = tracer};
        stage.camera = camera_for_view(scene, stage.view, options->width, options->height);
        stage.lights = lights_for_view(scene, &stage.camera);
        if (!film_init(&films[i], options->width, options->height) || !render_view(&stage, &settings, &films[i]))
            return complain(stage.view->name, "out of memory");
        const bool written = options->aov
                                 ? write_labelled(&stage, &films[i], options)
                                 : write_picture(&films[i], NULL, options->out, stage.view->name, scene->exposure);
        if (!written) return false;
        if (options->check && !check(&stage, options, &worst_rms)) return false;
    }
    if (!write_sheet(films, scene->view_count, options->out, scene->exposure)) return false;
    printf("pictures: %s/contact-sheet.png and, each with an .exr beside it,", options->out);
    for (size_t i = 0; i < scene->view_count; i++) printf(" %s.png", scene->views[i].name);
    printf("\n");
    if (options->check) printf("worst view: RMS %.3f %%, limit %.0f %%\n", 100.0 * worst_rms, 100.0 * CHECK_LIMIT);
    return worst_rms <= CHECK_LIMIT;
}

int main(int argc, char **argv) {
    Options options;
    const OptionsOutcome outcome = options_parse(argc, argv, &options);
    if (outcome != OPTIONS_RUN) return outcome == OPTIONS_HELP ? EXIT_SUCCESS : EXIT_WRONG_OPTIONS;
    if (mkdir(options.out, 0777) != 0 && errno != EEXIST) {
        complain(options.out, strerror(errno));
        return EXIT_FAILURE;
    }

    char error[SCENE_ERROR_SIZE];
    Scene scene;
    if (!scene_build(&scene, options.scene, error)) {
        fprintf(stderr, "%s\n", error);
        return EXIT_FAILURE;
    }
    Film films[SCENE_MAX_VIEWS] = {{0}};
    Tracer *tracer = tracer_new(&scene, error);
    const bool done = tracer ? render_all(&scene, tracer, &options, films) : complain("renderer", error);
    for (size_t i = 0; i < scene.view_count; i++) film_free(&films[i]);
    tracer_free(tracer);
    scene_free(&scene);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
