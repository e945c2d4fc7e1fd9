#include "frames.h"

#include <stdio.h>

#include "check.h"
#include "draw.h"
#include "render.h"
#include "tiles.h"

/* Where nothing is said. */
static const int USUAL_REFLECTIONS = 4;

static bool refuse_range(const char *name, int last, int most, const char *what) {
    fprintf(stderr, "%s goes to %d; accepted: up to %d, the scene has no more %s\n", name, last, most, what);
    return false;
}

static bool plan_samples(FrameJob *job, const Options *options) {
    job->samples = options->spp > 0 ? options->spp : job->by_paths ? job->scene->paths : 1;
    if (job->by_paths) {
        if (job->samples == 0) job->samples = 64;
        return true;
    }
    while (job->samples_across * job->samples_across < job->samples) job->samples_across++;
    if (job->samples_across * job->samples_across == job->samples && job->samples <= 1024) return true;
    fprintf(stderr,
            "--spp is \"%d\"; accepted: a square number from 1 to 1024 (1, 4, 9, 16, ...), or --integrator paths\n",
            job->samples);
    return false;
}

bool frames_plan(FrameJob *job, const Scene *scene, const Options *options) {
    const bool split = options->last_tile >= 0 || options->resume;
    *job = (FrameJob){.scene = scene, .options = options, .by_paths = options->integrator == INTEGRATOR_PATHS};
    if (options->integrator == INTEGRATOR_OF_SCENE) job->by_paths = scene->paths > 0;
    if (!job->by_paths && (split || options->environment || options->reflections > 0))
        return complain("--tiles, --resume, --environment and --reflections",
                        "accepted with --integrator paths only");
    if (job->by_paths && options->check) return complain("--check", "accepted with --integrator direct only");
    if (options->last_frame > (int)scene->view_count)
        return refuse_range("--frames", options->last_frame, (int)scene->view_count, "views");
    const int tiles = tiles_count(options->width, options->height);
    if (options->last_tile >= tiles) return refuse_range("--tiles", options->last_tile, tiles - 1, "tiles");
    return plan_samples(job, options);
}

static bool check(FrameJob *job, const Stage *stage) {
    const Options *options = job->options;
    /* Large pictures are compared at some 16000 of their pixels, evenly spread: enough for three digits. */
    const int stride = 1 + options->width * options->height / 16000;
    const CheckResult result = check_view(stage, options->width, options->height, stride, options->threads);
    if (result.pixels == 0) return complain(stage->view->name, "no pixel to check; try a larger --width");
    printf("%s: 1 against 256 samples per pixel: RMS %.3f %% of the mean radiance %.4f (worst pixel %.2f %%, "
           "%zu pixels compared)\n",
           stage->view->name, 100.0 * result.rms, result.mean_radiance, 100.0 * result.worst, result.pixels);
    if (!(result.rms <= job->worst_rms)) job->worst_rms = result.rms;
    return true;
}

static bool render_direct(FrameJob *job, const Stage *stage, LabelMap *labels, Film *film) {
    const RenderSettings settings = {job->samples_across, job->options->threads};
    if (!film_init(film, job->options->width, job->options->height) || !render_view(stage, &settings, film))
        return complain(stage->view->name, "out of memory");
    return output_film(film, labels, job->options->out, stage->view->name, job->scene->exposure) &&
           (!job->options->check || check(job, stage));
}

/* All that is lacking, or of it a range of tiles into a file of their own. */
static bool render_paths(const FrameJob *job, const Stage *stage, const LabelMap *labels, Picture *picture,
                         Film *film) {
    const Options *options = job->options;
    const char *name = stage->view->name;
    const int reflections = options->reflections > 0 ? options->reflections : USUAL_REFLECTIONS;
    OutputPath kept;
    char ending[64] = ".exr";
    const bool part = options->last_tile >= 0;
    if (part) snprintf(ending, sizeof ending, ".tiles-%d-%d.exr", options->first_tile, options->last_tile);
    if (!output_path(kept, options->out, name, ending)) return false;
    if (options->resume && !output_take_parts(picture, options->out, name, job->samples)) return false;
    const DrawSettings settings = {.paths = {.samples = job->samples,
                                             .looks = 4,
                                             .reflections = reflections,
                                             .most_indirect = job->scene->most_indirect},
                                   .threads = options->threads,
                                   .first_tile = options->first_tile,
                                   .past_tile = options->last_tile + 1,
                                   .kept = kept};
    const char *failure = draw_paths(stage, &settings, picture);
    if (failure) return complain(kept, failure);
    if (!picture_film(picture, film)) return complain(name, "out of memory");
    return part || output_picture(picture, labels, options->out, name, job->scene->exposure);
}

static bool render_by_paths(const FrameJob *job, const Stage *stage, const LabelMap *labels, Film *film) {
    Picture picture;
    if (!picture_init(&picture, job->options->width, job->options->height))
        return complain(stage->view->name, "out of memory");
    const bool done = render_paths(job, stage, labels, &picture, film);
    picture_free(&picture);
    return done;
}

bool frames_render(FrameJob *job, const View *view, Film *film) {
    const Options *options = job->options;
    Stage stage = {.scene = job->scene,
                   .view = view,
                   .tracer = job->tracer,
                   .camera = camera_for_view(job->scene, view, options->width, options->height),
                   .bounces = options->walls ? STRIAE_BOUNCES_ALL : STRIAE_BOUNCES_ONE};
    stage.lights = scene_lights(job->scene, &stage.camera);
    if (job->environment.columns) stage.lights.environment = &job->environment;

    LabelMap map = {0, 0, NULL}, *labels = NULL;
    if (options->aov) {
        labels = &map;
        if (!label_map_init(labels, options->width, options->height)) return complain(view->name, "out of memory");
        label_map_render(labels, &stage, options->threads);
    }
    const bool done =
        job->by_paths ? render_by_paths(job, &stage, labels, film) : render_direct(job, &stage, labels, film);
    label_map_free(&map);
    return done;
}
