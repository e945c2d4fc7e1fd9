#include "povray.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <sys/wait.h>

extern char **environ;

enum { PATH_SIZE = 4096, ARGUMENT_SIZE = PATH_SIZE + 16 };

/* A scratch is to be some hundred units wide: POV-Ray takes no shadow from what is nearer than a thousandth of a unit. */
static const double UNITS_PER_WIDTH = 100.0;

/* Truth steps off a facet by a ten thousandth of a scratch's width. */
static double units_per_mm(const Truth *truth) { return UNITS_PER_WIDTH * 1e-4 / truth->step; }

static void put(FILE *file, const char *name, Vec v, double scale) {
    fprintf(file, "%s<%.9g, %.9g, %.9g>\n", name, scale * v.x, scale * v.y, scale * v.z);
}

/* All three vectors are stated, so that the frame is the scene's own: right-handed, and POV-Ray's left one has no say. */
static void put_camera(FILE *file, const Camera *camera, double scale, int width, int height) {
    fprintf(file, "camera { perspective\n");
    put(file, "location ", camera->position, scale);
    put(file, "direction ", camera->forward, 1.0);
    put(file, "right ", camera->right, width);
    put(file, "up ", camera->down, -height);
    fprintf(file, "}\n");
}

/* POV-Ray's lamps fade as 2 / (1 + (distance / fade_distance)^2): far beyond that, by the square. */
static void put_lamp(FILE *file, const Patch *patch, double scale) {
    const double distance = vec_length(patch->position), near = 1e-3 * distance;
    const double brightness = 0.5 * (1.0 + 1e6) * patch->radiance[0] * patch->area / (PI * distance * distance);
    put(file, "light_source { ", patch->position, scale);
    fprintf(file, "rgb %.12g fade_distance %.12g fade_power 2 }\n", brightness, near * scale);
}

static void put_finish(FILE *file, const Finish *finish) {
    fprintf(file, "texture { pigment { rgb <%.9g, %.9g, %.9g> } finish { ambient 0 diffuse 1", finish->diffuse[0],
            finish->diffuse[1], finish->diffuse[2]);
    if (finish->phong > 0.0) fprintf(file, " phong %.9g phong_size %.9g", finish->phong, finish->phong_size);
    if (finish->specular > 0.0) fprintf(file, " specular %.9g roughness %.9g", finish->specular, finish->roughness);
    fprintf(file, " } }\n");
}

static void put_mesh(FILE *file, const Truth *truth, const Finish *finishes, double scale) {
    const StriaeMeshArrays *arrays = &truth->arrays;
    fprintf(file, "mesh2 {\nvertex_vectors { %zu", arrays->vertex_count);
    for (size_t i = 0; i < arrays->vertex_count; i++) {
        const double *p = arrays->positions[i];
        fprintf(file, ",\n<%.9g,%.9g,%.9g>", scale * p[0], scale * p[1], scale * p[2]);
    }
    fprintf(file, " }\ntexture_list { %zu,\n", arrays->brdf_count);
    for (size_t i = 0; i < arrays->brdf_count; i++) put_finish(file, &finishes[i]);
    fprintf(file, "}\nface_indices { %zu", arrays->triangle_count);
    for (size_t i = 0; i < arrays->triangle_count; i++) {
        const uint32_t *t = arrays->triangles[i];
        fprintf(file, ",\n<%u,%u,%u>,%u", t[0], t[1], t[2], arrays->zones[i].brdf);
    }
    fprintf(file, " }\n}\n");
}

static bool write_scene(const Truth *truth, const Stage *stage, int lamp, const Finish *finishes, int width, int height,
                        const char *path) {
    FILE *file = fopen(path, "w");
    if (!file) return false;
    const double scale = units_per_mm(truth);
    fprintf(file, "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 1 }\n");
    put_camera(file, &stage->camera, scale, width, height);
    put_lamp(file, &stage->lights.patches[lamp], scale);
    put_mesh(file, truth, finishes, scale);
    return fclose(file) == 0;
}

/* Runs a program, its output to a file; whether it ended well. */
static bool run(char *const *arguments, const char *log) {
    posix_spawn_file_actions_t actions;
    pid_t child;
    int status = 1;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    const bool started = posix_spawnp(&child, arguments[0], &actions, NULL, arguments, environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static bool run_povray(const char *scene, const char *picture, const char *log, int width, int height) {
    char in[ARGUMENT_SIZE], out[ARGUMENT_SIZE], columns[32], rows[32];
    snprintf(in, sizeof in, "+I%s", scene);
    snprintf(out, sizeof out, "+O%s", picture);
    snprintf(columns, sizeof columns, "+W%d", width);
    snprintf(rows, sizeof rows, "+H%d", height);
    /* Linear EXR; 25 samples in each pixel, in even rows. */
    char program[] = "povray", exr[] = "+FE", method[] = "+AM1", depth[] = "+R5", threshold[] = "+A0.0", even[] = "-J",
         hidden[] = "-D", quiet[] = "-V";
    char *const arguments[] = {program, in, out, columns, rows, exr, method, depth, threshold, even, hidden, quiet, NULL};
    return run(arguments, log);
}

const char *povray_render(const Truth *truth, const Stage *stage, int lamp, const Finish *finishes, int width, int height,
                          int times, const char *base, Film *film) {
    char scene[PATH_SIZE], picture[PATH_SIZE], log[PATH_SIZE];
    snprintf(scene, sizeof scene, "%s.pov", base);
    snprintf(picture, sizeof picture, "%s.exr", base);
    snprintf(log, sizeof log, "%s.log", base);
    *film = (Film){0, 0, NULL};
    if (!write_scene(truth, stage, lamp, finishes, width, height, scene)) return "the scene cannot be written";
    if (!run_povray(scene, picture, log, times * width, times * height)) return "povray failed: see its .log";
    Film large;
    const char *failure = film_read_exr(&large, picture);
    if (!failure && (large.width != times * width || large.height != times * height))
        failure = "povray's picture has another size";
    if (!failure && !film_shrink(&large, times, film)) failure = "out of memory";
    film_free(&large);
    return failure;
}
