#include "paths.h"

#include "choose_light.h"
#include "reflect.h"

/* From here on paths are ended by chance, as often as they carry less than all light. */
static const int CERTAIN_REFLECTIONS = 3;

typedef struct Path {
    const Stage *stage;
    const PathSettings *settings;
    Sampler sampler;
    Ray ray;
    double weight[3];
    double pdf;      /* of the last reflection; 0 straight from the camera */
    int reflections; /* so far */
    PathLight found;
} Path;

static void add(Path *path, const double radiance[3], double share, int reflections) {
    double part[3], most = 0.0;
    for (int c = 0; c < 3; c++) most = fmax(most, part[c] = path->weight[c] * radiance[c] * share);
    if (!(most > 0.0)) return;
    const double bound = path->settings->most_indirect;
    const double kept = reflections > 1 && bound > 0.0 && most > bound ? bound / most : 1.0;
    for (int c = 0; c < 3; c++) (reflections > 1 ? path->found.indirect : path->found.direct)[c] += kept * part[c];
}

/* What one of two ways to find the same light counts: by the square of its density (Veach's power heuristic). */
static double shared(double pdf, double other) {
    const double ratio = other / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}

/* How often light is looked for after so many reflections. */
static int looks(const Path *path, int reflections) { return reflections == 0 ? path->settings->looks : 1; }

/* A light that the path ran into by itself. */
static void light_met(const double radiance[3], double pdf, void *user) {
    Path *path = user;
    double share = 1.0;
    if (path->reflections > 0) {
        if (path->settings->strategy == PATHS_SHARED)
            share = shared(path->pdf, looks(path, path->reflections - 1) * pdf);
        if (path->settings->strategy == PATHS_BY_LIGHTS) share = 0.0;
    }
    add(path, radiance, share, path->reflections);
}

static bool is_hidden(const Path *path, const Surface *surface, const ChosenLight *light) {
    const Tracer *tracer = path->stage->tracer;
    if (light->distance == HUGE_VAL) return trace_meets(tracer, trace_off(surface), light->direction);
    return trace_blocked(tracer, surface, vec_along(surface->position, light->distance, light->direction));
}

/* A light looked for from where the path has come to, one of so many. */
static void look_once(Path *path, const Surface *surface, const Reflector *reflector, double which, int count) {
    double u[2], f[3], pdf;
    ChosenLight chosen;
    sampler_next(&path->sampler, u);
    if (!choose_light(&path->stage->lights, surface->position, which, u, &chosen)) return;
    if (path->settings->strategy == PATHS_BY_SURFACES && chosen.pdf > 0.0) return;
    reflect_eval(reflector, chosen.direction, f, &pdf);
    if (!(f[0] + f[1] + f[2] > 0.0) || is_hidden(path, surface, &chosen)) return;
    for (int c = 0; c < 3; c++) f[c] *= chosen.value[c] / count;
    const bool both = chosen.pdf > 0.0 && path->settings->strategy == PATHS_SHARED;
    add(path, f, both ? shared(count * chosen.pdf, pdf) : 1.0, path->reflections + 1);
}

/* Looks follow each other at even steps through all lights. */
static void look_for_light(Path *path, const Surface *surface, const Reflector *reflector) {
    const int count = looks(path, path->reflections);
    double which[2];
    sampler_next(&path->sampler, which);
    for (int i = 0; i < count; i++) look_once(path, surface, reflector, (i + which[0]) / count, count);
}

/* False where the path ends. */
static bool go_on(Path *path, const Surface *surface, const Reflector *reflector) {
    double a[2], b[2], weight[3];
    Vec direction;
    sampler_next(&path->sampler, a);
    sampler_next(&path->sampler, b);
    const double u[3] = {a[0], b[0], b[1]};
    if (!reflect_sample(reflector, u, &direction, weight, &path->pdf)) return false;
    double most = 0.0;
    for (int c = 0; c < 3; c++) most = fmax(most, path->weight[c] *= weight[c]);
    if (++path->reflections >= CERTAIN_REFLECTIONS) {
        const double survival = fmin(1.0, most);
        if (!(a[1] < survival)) return false;
        for (int c = 0; c < 3; c++) path->weight[c] /= survival;
    }
    path->ray = ray_onwards(&path->ray, surface, direction, path->pdf, path->settings->samples);
    path->ray.origin = trace_off(surface);
    return true;
}

/* One surface further; false where the path ends. */
static bool step(Path *path) {
    const Stage *stage = path->stage;
    const Vec origin = path->ray.origin, direction = path->ray.direction;
    Hit hit;
    if (!trace_closest(stage->tracer, origin, direction, &hit)) {
        meet_lights(&stage->lights, &path->ray, HUGE_VAL, light_met, path);
        return false;
    }
    const Surface surface = mesh_surface(hit.mesh, hit.triangle, origin, direction);
    const double distance = vec_dot(vec_sub(surface.position, origin), direction);
    meet_lights(&stage->lights, &path->ray, distance, light_met, path);
    if (path->reflections == 0) {
        path->found.normal = surface.normal;
        path->found.distance = distance;
    }
    if (path->reflections == path->settings->reflections || vec_dot(direction, surface.geometric) >= 0.0)
        return false;
    Reflector reflector;
    reflect_prepare(&reflector, &surface, &path->ray, stage->bounces);
    look_for_light(path, &surface, &reflector);
    return go_on(path, &surface, &reflector);
}

/* How far from its pixel's middle a sample may lie, pixels: as a tent says, which spares thin bright lines the steps that a
   box gives them. `u` is one number in [0,1). */
static double tent(double u) { return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u); }

PathLight path_follow(const Stage *stage, const PathSettings *settings, int x, int y, uint32_t index) {
    Path path = {
        .stage = stage, .settings = settings, .sampler = sampler_start(x, y, index), .weight = {1.0, 1.0, 1.0}};
    double place[2], lens[2];
    sampler_next(&path.sampler, place);
    sampler_next(&path.sampler, lens);
    const Sample sample = {x + 0.5 + tent(place[0]), y + 0.5 + tent(place[1]), sqrt(1.0 / settings->samples)};
    path.ray = camera_ray(&stage->camera, &sample, lens);
    while (step(&path)) continue;
    return path.found;
}
