#include "shade.h"

#include "random.h"

/* What striae wants to know about a surface point, with the sample's square as footprint. */
static StriaePoint striae_point(const Stage *stage, const Surface *surface, const Sample *sample) {
    StriaePoint point = {.uv = {surface->uv[0], surface->uv[1]}};
    vec_to_floats(surface->dp_du, point.dp_du);
    vec_to_floats(surface->dp_dv, point.dp_dv);
    vec_to_floats(surface->normal, point.normal);
    const bool projected =
        camera_footprint(&stage->camera, surface, sample->x, sample->y, sample->size, point.duv_dx, point.duv_dy);
    point.footprint = projected ? STRIAE_FOOTPRINT_DIFFERENTIALS : STRIAE_FOOTPRINT_POINT;
    return point;
}

static void to_local(const StriaeFrame *frame, Vec from, Vec to, float local[3]) {
    float world[3];
    vec_to_floats(vec_unit(vec_sub(to, from)), world);
    striae_frame_to_local(frame, world, local);
}

/* A scratched surface: one query for the viewer, then one evaluation for each light. What shades the scratches
   within themselves is in f; the shadow ray finds what stands between lamp and surface. A patch of a lamp counts as
   a point at its middle. */
static void shade_scratched(const Stage *stage, const Surface *surface, const Sample *sample, double radiance[3]) {
    const StriaePoint point = striae_point(stage, surface, sample);
    StriaeFrame frame;
    StriaeShading shading;
    float view[3];
    striae_frame(&point, &frame);
    to_local(&frame, surface->position, stage->camera.position, view);
    striae_shade(surface->mesh->pattern, &point, view, &shading);
    striae_set_bounces(&shading, stage->bounces);

    for (size_t i = 0; i < lights_lamp_count(&stage->lights); i++) {
        double irradiance[3];
        float light[3], f[3];
        const Vec from = lights_arrival(&stage->lights, i, 0.5, 0.5, surface->position, irradiance);
        to_local(&frame, surface->position, from, light);
        striae_eval(&shading, light, 0, f);
        if (f[0] + f[1] + f[2] <= 0.0f || trace_blocked(stage->tracer, surface, from)) continue;
        for (int c = 0; c < 3; c++) radiance[c] += irradiance[c] * (double)f[c];
    }
}

/* A matte surface, for what lies about: each lamp's patches are met at random points, for soft shadows. */
static void shade_matte(const Stage *stage, const Surface *surface, const Sample *sample, double radiance[3]) {
    uint32_t random = (uint32_t)(sample->x * 4096.0) * 73856093u ^ (uint32_t)(sample->y * 4096.0) * 19349663u;
    for (size_t i = 0; i < lights_lamp_count(&stage->lights); i++) {
        const double a = next_random(&random), b = next_random(&random);
        double irradiance[3];
        const Vec from = lights_arrival(&stage->lights, i, a, b, surface->position, irradiance);
        const double cosine = vec_dot(vec_unit(vec_sub(from, surface->position)), surface->normal);
        if (cosine <= 0.0 || trace_blocked(stage->tracer, surface, from)) continue;
        for (int c = 0; c < 3; c++) radiance[c] += irradiance[c] * cosine * surface->mesh->albedo[c] / PI;
    }
}

unsigned shade_sample(const Stage *stage, const Sample *sample, double radiance[3]) {
    const Vec direction = camera_direction(&stage->camera, sample->x, sample->y);
    Hit hit;
    for (int c = 0; c < 3; c++) radiance[c] = 0.0;
    if (!trace_closest(stage->tracer, stage->camera.position, direction, &hit)) return 0;
    const Surface surface = mesh_surface(hit.mesh, hit.triangle, stage->camera.position, direction);
    if (surface.mesh->pattern) {
        shade_scratched(stage, &surface, sample, radiance);
    } else {
        shade_matte(stage, &surface, sample, radiance);
    }
    return surface.face;
}

bool shade_zones(const Stage *stage, const Sample *sample, Vec lamp, LitZones *lit) {
    const Vec direction = camera_direction(&stage->camera, sample->x, sample->y);
    Hit hit;
    if (!trace_closest(stage->tracer, stage->camera.position, direction, &hit) || !hit.mesh->pattern) return false;
    const Surface surface = mesh_surface(hit.mesh, hit.triangle, stage->camera.position, direction);
    const StriaePoint point = striae_point(stage, &surface, sample);
    StriaeFrame frame;
    StriaeShading shading;
    striae_frame(&point, &frame);
    lit->position = surface.position;
    to_local(&frame, surface.position, stage->camera.position, lit->view);
    to_local(&frame, surface.position, lamp, lit->light);
    striae_shade(hit.mesh->pattern, &point, lit->view, &shading);
    return striae_zones(&shading, lit->light, lit->zones, SHADE_MAX_ZONES, &lit->count) == STRIAE_STATUS_OK &&
           lit->count <= SHADE_MAX_ZONES;
}

void shade_label(const Stage *stage, const Sample *sample, Label *label) {
    enum { MOST_HITS = 16 };
    const Vec direction = camera_direction(&stage->camera, sample->x, sample->y);
    Hit hit;
    *label = (Label){.id = 0.0f};
    if (!trace_closest(stage->tracer, stage->camera.position, direction, &hit) || !hit.mesh->pattern) return;
    const Surface surface = mesh_surface(hit.mesh, hit.triangle, stage->camera.position, direction);
    const StriaePoint point = striae_point(stage, &surface, sample);
    StriaeFrame frame;
    StriaeHit hits[MOST_HITS];
    StriaeHitCount count = {.written = 0};
    striae_frame(&point, &frame);
    striae_pattern_query(hit.mesh->pattern, &point, hits, MOST_HITS, &count);
    if (count.written == 0) return;
    for (size_t i = 0; i < count.written; i++) label->coverage += hits[i].coverage;
    label->coverage = fminf(label->coverage, 1.0f);
    label->id = (float)(hits[0].scratch + 1);
    striae_frame_to_world(&frame, hits[0].travel, label->direction);
    label->depth_mm = hits[0].depth_mm;
    label->deepest_mm = hits[0].deepest_mm;
    label->arc_length = (float)hits[0].arc_length;
}
