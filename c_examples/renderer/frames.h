/* A scene's views rendered one after another, by either integrator, into files. */
#ifndef RENDERER_FRAMES_H
#define RENDERER_FRAMES_H
#include "options.h"
#include "output.h"

typedef struct FrameJob {
    const Scene *scene;
    const Tracer *tracer;
    const Options *options;
    Environment environment; /* empty: the scene's own */
    bool by_paths;
    int samples;        /* per pixel */
    int samples_across; /* their square root, where not by paths */
    double worst_rms;   /* of all views that were checked */
} FrameJob;

/* Sees that the options go together and with the scene; explains on stderr what does not. */
bool frames_plan(FrameJob *job, const Scene *scene, const Options *options);

/* One view into its files; of the finished picture the film. False, and told on stderr, if it failed. */
bool frames_render(FrameJob *job, const View *view, Film *film);
#endif
