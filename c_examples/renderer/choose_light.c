#include "choose_light.h"

/* One per lamp, then one for the environment. */
enum { MOST_LIGHTS = LIGHTS_MAX_PATCHES + LIGHTS_MAX_POINTS + LIGHTS_MAX_SUNS + 1 };

typedef struct Chances {
    double chance[MOST_LIGHTS];
    size_t count;
} Chances;

static double sum(const double rgb[3]) { return rgb[0] + rgb[1] + rgb[2]; }

/* Each light's chance: what it would send to a surface that faces it, were nothing in between. */
static Chances chances_at(const Lights *lights, Vec from) {
    Chances chances = {.count = lights_lamp_count(lights)};
    double total = 0.0;
    for (size_t i = 0; i < chances.count; i++) {
        double irradiance[3];
        lights_arrival(lights, i, 0.5, 0.5, from, irradiance);
        /* What is near or large does not fill more than half the sky. */
        const double most = i < lights->count ? 2.0 * PI * sum(lights->patches[i].radiance) : HUGE_VAL;
        total += chances.chance[i] = fmin(sum(irradiance), most);
    }
    if (lights->environment)
        total += chances.chance[chances.count++] = 3.0 * PI * lights->environment->mean_radiance;
    for (size_t i = 0; i < chances.count; i++) chances.chance[i] = total > 0.0 ? chances.chance[i] / total : 0.0;
    return chances;
}

/* Per steradian: the patch's points are chosen evenly by area. */
static double patch_pdf(const Patch *patch, Vec direction, double distance) {
    return distance * distance / (patch->area * -vec_dot(direction, patch->normal));
}

static bool choose_patch(const Patch *patch, Vec from, const double u[2], double chance, ChosenLight *chosen) {
    const Vec path = vec_sub(patch_point(patch, u[0], u[1]), from);
    chosen->distance = vec_length(path);
    chosen->direction = vec_scale(path, 1.0 / chosen->distance);
    if (vec_dot(chosen->direction, patch->normal) >= 0.0) return false;
    chosen->pdf = chance * patch_pdf(patch, chosen->direction, chosen->distance);
    for (int c = 0; c < 3; c++) chosen->value[c] = patch->radiance[c] / chosen->pdf;
    return true;
}

static bool choose_environment(const Environment *environment, const double u[2], double chance,
                               ChosenLight *chosen) {
    chosen->direction = environment_sample(environment, u);
    chosen->distance = HUGE_VAL;
    chosen->pdf = chance * environment_pdf(environment, chosen->direction);
    environment_radiance(environment, chosen->direction, chosen->value);
    for (int c = 0; c < 3; c++) chosen->value[c] /= chosen->pdf;
    return chosen->pdf > 0.0;
}

/* Points and suns: all of it comes from one place. */
static bool choose_place(const Lights *lights, size_t lamp, Vec from, double chance, ChosenLight *chosen) {
    const Vec path = vec_sub(lights_arrival(lights, lamp, 0.0, 0.0, from, chosen->value), from);
    chosen->distance = vec_length(path);
    chosen->direction = vec_scale(path, 1.0 / chosen->distance);
    chosen->pdf = 0.0;
    for (int c = 0; c < 3; c++) chosen->value[c] /= chance;
    return true;
}

bool choose_light(const Lights *lights, Vec from, double which, const double u[2], ChosenLight *chosen) {
    const Chances chances = chances_at(lights, from);
    for (size_t i = 0; i < chances.count; i++) {
        const double chance = chances.chance[i];
        if (which >= chance) {
            which -= chance;
            continue;
        }
        if (i < lights->count) return choose_patch(&lights->patches[i], from, u, chance, chosen);
        if (i < lights_lamp_count(lights)) return choose_place(lights, i, from, chance, chosen);
        return choose_environment(lights->environment, u, chance, chosen);
    }
    return false;
}

/* How far along the ray its plane is met within the patch, from its bright side; no number where it is not. */
static double patch_distance(const Patch *patch, const Ray *ray) {
    const double toward = -vec_dot(ray->direction, patch->normal);
    const double distance = vec_dot(vec_sub(ray->origin, patch->position), patch->normal) / toward;
    const Vec offset = vec_sub(vec_along(ray->origin, distance, ray->direction), patch->position);
    const double a = vec_dot(offset, patch->edge_a) / vec_dot(patch->edge_a, patch->edge_a);
    const double b = vec_dot(offset, patch->edge_b) / vec_dot(patch->edge_b, patch->edge_b);
    return toward > 0.0 && distance > 0.0 && fabs(a) <= 0.5 && fabs(b) <= 0.5 ? distance : NAN;
}

void meet_lights(const Lights *lights, const Ray *ray, double distance, LightMet *met, void *user) {
    const Chances chances = chances_at(lights, ray->origin);
    for (size_t i = 0; i < lights->count; i++) {
        const Patch *patch = &lights->patches[i];
        const double at = patch_distance(patch, ray);
        if (at < distance) met(patch->radiance, chances.chance[i] * patch_pdf(patch, ray->direction, at), user);
    }
    if (!lights->environment || distance < HUGE_VAL) return;
    double radiance[3];
    environment_radiance(lights->environment, ray->direction, radiance);
    met(radiance, chances.chance[chances.count - 1] * environment_pdf(lights->environment, ray->direction), user);
}
