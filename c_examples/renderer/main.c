/* Renders a scene with striae: EXR and PNG for each view, and a contact sheet of all. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "frames.h"

enum { EXIT_WRONG_OPTIONS = 2, SHEET_GUTTER = 8 };

/* RMS difference that one sample per pixel may have from 256, relative to the mean radiance. */
static const double CHECK_LIMIT = 0.01;

/* All views side by side, at half size. */
static bool write_sheet(const Film *films, const Scene *scene, const char *folder) {
    Film full = {0}, half = {0};
    const bool made = film_side_by_side(films, scene->view_count, SHEET_GUTTER, &full) && film_half(&full, &half);
    const bool written = made ? output_film(&half, NULL, folder, scene->sheet, scene->exposure)
                              : complain("contact sheet", "out of memory");
    film_free(&full);
    film_free(&half);
    return written;
}

static bool render_all(FrameJob *job, Film *films) {
    const Scene *scene = job->scene;
    const Options *options = job->options;
    const bool all_frames = options->last_frame == 0, all_tiles = options->last_tile < 0;
    const size_t first = all_frames ? 0 : (size_t)options->first_frame - 1;
    const size_t past = all_frames ? scene->view_count : (size_t)options->last_frame;
    for (size_t i = first; i < past; i++)
        if (!frames_render(job, &scene->views[i], &films[i])) return false;
    const bool sheet = scene->sheet && all_frames && all_tiles;
    if (sheet && !write_sheet(films, scene, options->out)) return false;
    printf("pictures in %s, each with an .exr beside it:", options->out);
    for (size_t i = first; i < past && all_tiles; i++) printf(" %s.png", scene->views[i].name);
    printf(" %s%s\n", sheet ? scene->sheet : all_tiles ? "" : "none yet, but tiles", sheet ? ".png" : "");
    if (options->check)
        printf("worst view: RMS %.3f %%, limit %.0f %%\n", 100.0 * job->worst_rms, 100.0 * CHECK_LIMIT);
    return job->worst_rms <= CHECK_LIMIT;
}

static bool load_environment(const char *path, Environment *environment) {
    Film map;
    if (!path) return true;
    const char *failure = film_read_exr(&map, path);
    if (failure) return complain(path, failure);
    return environment_init(environment, &map) || complain(path, "out of memory");
}

static bool run(FrameJob *job, const Options *options) {
    char error[SCENE_ERROR_SIZE];
    Film films[SCENE_MAX_VIEWS] = {{0}};
    if (!load_environment(options->environment, &job->environment)) return false;
    Tracer *tracer = tracer_new(job->scene, error);
    job->tracer = tracer;
    const bool done = tracer ? render_all(job, films) : complain("renderer", error);
    for (size_t i = 0; i < job->scene->view_count; i++) film_free(&films[i]);
    tracer_free(tracer);
    environment_free(&job->environment);
    return done;
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
    FrameJob job;
    int code = EXIT_WRONG_OPTIONS;
    if (frames_plan(&job, &scene, &options)) code = run(&job, &options) ? EXIT_SUCCESS : EXIT_FAILURE;
    scene_free(&scene);
    return code;
}
