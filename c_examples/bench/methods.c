#include "methods.h"

#include "ggx.h"
#include "progress.h"
#include "random.h"
#include "tiles.h"

/* What the camera sees through the middle of a square; false beside the plate. */
static bool look(const Plate *plate, const Square *square, Vec *direction, Surface *surface) {
    *direction = camera_direction(&plate->camera, square->x, square->y);
    Hit hit;
    if (!trace_closest(plate->tracer, plate->camera.position, *direction, &hit)) return false;
    *surface = mesh_surface(hit.mesh, hit.triangle, plate->camera.position, *direction);
    return true;
}

static double irradiance(const Plate *plate, Vec position, int lamp) {
    const Vec way = vec_sub(plate->lamps[lamp], position);
    return plate->intensity / vec_dot(way, way);
}

/* Adds a lamp's light, unless something is in its way. */
static void add_lamp(const Plate *plate, const Surface *surface, int lamp, const float f_cos[3],
                     double radiance[3]) {
    if (trace_blocked(plate->tracer, surface, plate->lamps[lamp])) return;
    const double light = irradiance(plate, surface->position, lamp);
    for (int c = 0; c < 3; c++) radiance[c] += (double)f_cos[c] * light;
}

static void view_of(Vec direction, float view[3]) { vec_to_floats(vec_unit(vec_scale(direction, -1.0)), view); }

static void light_of(const Plate *plate, Vec position, int lamp, float light[3]) {
    vec_to_floats(vec_unit(vec_sub(plate->lamps[lamp], position)), light);
}

/* A surface whose base BRDF is the renderer's own. */
static void add_lamps(const Plate *plate, const Surface *surface, const float normal[3], Vec direction,
                      double radiance[3]) {
    float view[3], light[3], f_cos[3];
    view_of(direction, view);
    for (int i = 0; i < plate->lamp_count; i++) {
        light_of(plate, surface->position, i, light);
        ggx_reflects(&plate->metal, normal, view, light, f_cos);
        add_lamp(plate, surface, i, f_cos, radiance);
    }
}

static void shade_plain(const Method *method, const Square *square, double radiance[3]) {
    Surface surface;
    Vec direction;
    float normal[3];
    if (!look(method->plate, square, &direction, &surface)) return;
    vec_to_floats(surface.normal, normal);
    add_lamps(method->plate, &surface, normal, direction, radiance);
}

static void shade_normal_map(const Method *method, const Square *square, double radiance[3]) {
    Surface surface;
    Vec direction;
    float normal[3];
    if (!look(method->plate, square, &direction, &surface)) return;
    normal_map_at(method->map, surface.uv, normal);
    add_lamps(method->plate, &surface, normal, direction, radiance);
}

/* The point as the library asks for it: the square's edges in texture space are its footprint. */
static StriaePoint point_of(const Plate *plate, const Square *square, const Surface *surface) {
    StriaePoint point = {.uv = {surface->uv[0], surface->uv[1]}, .footprint = STRIAE_FOOTPRINT_DIFFERENTIALS};
    vec_to_floats(surface->dp_du, point.dp_du);
    vec_to_floats(surface->dp_dv, point.dp_dv);
    vec_to_floats(surface->normal, point.normal);
    if (!camera_footprint(&plate->camera, surface, square->x, square->y, square->size, point.duv_dx, point.duv_dy))
        point.footprint = STRIAE_FOOTPRINT_POINT;
    return point;
}

/* All lamps by one call: as many as there are, a structure of arrays. */
static void evaluate(const Plate *plate, const StriaeShading *shading, const StriaeFrame *frame, Vec position,
                     float f_cos[PLATE_MAX_LAMPS][3]) {
    float lights[PLATE_MAX_LAMPS][3];
    for (int i = 0; i < plate->lamp_count; i++) light_of(plate, position, i, lights[i]);
    if (plate->lamp_count == 1) {
        striae_eval_world(shading, frame, lights[0], 0, f_cos[0]);
        return;
    }
    for (int i = 0; i < plate->lamp_count; i++) striae_frame_to_local(frame, lights[i], lights[i]);
    const StriaeVectors light = {lights[0], lights[0] + 1, lights[0] + 2, 3};
    const StriaeVectorsOut out = {f_cos[0], f_cos[0] + 1, f_cos[0] + 2, 3};
    striae_eval_many(shading, (size_t)plate->lamp_count, &light, (size_t)plate->lamp_count, 0, &out);
}

static bool is_near(const Method *method, const StriaePoint *point, Vec direction) {
    float view[3];
    uint32_t near_any = 1;
    vec_to_floats(vec_scale(direction, -1.0), view);
    striae_near(method->pattern, point, view, &near_any);
    return near_any != 0;
}

/* Here the library and the earlier systems differ. What is refused reflects nothing, or as if there were no scratch. */
static void prepare(const Method *method, const StriaePoint *point, Vec direction, StriaeFrame *frame,
                    StriaeShading *shading) {
    float view[3];
    view_of(direction, view);
    if (method->pattern) {
        striae_shade_world(method->pattern, point, view, frame, shading);
        return;
    }
    if (striae_frame(point, frame) != STRIAE_STATUS_OK) *frame = (StriaeFrame){.z = {0.0f}};
    striae_frame_to_local(frame, view, view);
    striae_baseline_shade(method->baseline, point, view, shading);
}

static void shade_scratched(const Method *method, const Square *square, double radiance[3]) {
    const Plate *plate = method->plate;
    Surface surface;
    Vec direction;
    if (!look(plate, square, &direction, &surface)) return;
    const StriaePoint point = point_of(plate, square, &surface);
    if (method->asks_near && !is_near(method, &point, direction)) {
        add_lamps(plate, &surface, point.normal, direction, radiance);
        return;
    }
    StriaeFrame frame;
    StriaeShading shading;
    float f_cos[PLATE_MAX_LAMPS][3];
    prepare(method, &point, direction, &frame, &shading);
    evaluate(plate, &shading, &frame, surface.position, f_cos);
    for (int i = 0; i < plate->lamp_count; i++) add_lamp(plate, &surface, i, f_cos[i], radiance);
}

static void shade_geometry(const Method *method, const Square *square, double radiance[3]) {
    const Plate *plate = method->plate;
    const Relief *relief = method->relief;
    const Vec direction = camera_direction(&plate->camera, square->x, square->y);
    Vec position, normal;
    if (!relief_find(relief, plate->camera.position, direction, &position, &normal)) return;
    float view[3], light[3], up[3], f_cos[3];
    view_of(direction, view);
    vec_to_floats(normal, up);
    for (int i = 0; i < plate->lamp_count; i++) {
        light_of(plate, position, i, light);
        ggx_reflects(&plate->metal, up, view, light, f_cos);
        if (f_cos[0] <= 0.0f || !relief_is_lit(relief, position, normal, plate->lamps[i])) continue;
        const double brightness = irradiance(plate, position, i);
        for (int c = 0; c < 3; c++) radiance[c] += (double)f_cos[c] * brightness;
    }
}

Method method_plain(const Plate *plate) { return (Method){.shade = shade_plain, .plate = plate}; }

Method method_library(const Plate *plate) {
    Method method = method_library_everywhere(plate);
    method.asks_near = true;
    return method;
}

Method method_library_everywhere(const Plate *plate) {
    return (Method){.shade = shade_scratched, .filters = true, .plate = plate, .pattern = plate->pattern};
}

Method method_baseline(const Plate *plate, const StriaeBaseline *baseline) {
    return (Method){.shade = shade_scratched, .filters = true, .plate = plate, .baseline = baseline};
}

Method method_geometry(const Plate *plate, const Relief *relief) {
    return (Method){.shade = shade_geometry, .plate = plate, .relief = relief};
}

Method method_normal_map(const Plate *plate, const NormalMap *map) {
    return (Method){.shade = shade_normal_map, .plate = plate, .map = map};
}

typedef struct Render {
    const Method *method;
    unsigned samples, across, seed;
    Film *film;
    int left, above; /* of the film in the picture */
} Render;

static void add(const Render *picture, const Square *square, double sum[3]) {
    double radiance[3] = {0.0, 0.0, 0.0};
    picture->method->shade(picture->method, square, radiance);
    for (int c = 0; c < 3; c++) sum[c] += radiance[c];
}

/* The pixel's equal squares. */
static void add_squares(const Render *picture, int x, int y, double sum[3]) {
    const double size = 1.0 / picture->across;
    for (unsigned i = 0; i < picture->samples; i++) {
        const Square square = {x + (i % picture->across + 0.5) * size, y + (i / picture->across + 0.5) * size,
                               size};
        add(picture, &square, sum);
    }
}

/* Points of Roberts's sequence (2018), shifted at random: it fills the pixel evenly in whatever direction scratches run. */
static void add_points(const Render *picture, int x, int y, double sum[3]) {
    uint32_t random = (picture->seed * 2654435761u) ^ ((uint32_t)x * 73856093u) ^ ((uint32_t)y * 19349663u);
    for (int i = 0; i < 4; i++) next_random(&random);
    double a = next_random(&random), b = next_random(&random);
    for (unsigned i = 0; i < picture->samples; i++) {
        a += 0.7548776662466927;
        b += 0.5698402909980532;
        a -= a >= 1.0;
        b -= b >= 1.0;
        const Square square = {x + a, y + b, 0.0};
        add(picture, &square, sum);
    }
}

static void render_tile(const Tile *tile, void *user) {
    const Render *picture = user;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            double sum[3] = {0.0, 0.0, 0.0};
            if (picture->method->filters) {
                add_squares(picture, x + picture->left, y + picture->above, sum);
            } else {
                add_points(picture, x + picture->left, y + picture->above, sum);
            }
            float *pixel = picture->film->rgb[(size_t)y * (size_t)picture->film->width + (size_t)x];
            for (int c = 0; c < 3; c++) pixel[c] = (float)(sum[c] / picture->samples);
        }
    }
}

double render(const Method *method, unsigned samples, unsigned seed, Film *film) {
    const unsigned across = (unsigned)lround(sqrt(samples));
    Render picture = {.method = method,
                      .samples = method->filters ? across * across : samples,
                      .across = across,
                      .seed = seed,
                      .film = film,
                      .left = (method->plate->width - film->width) / 2,
                      .above = (method->plate->height - film->height) / 2};
    const TileJob job = {.width = film->width,
                         .height = film->height,
                         .threads = tiles_default_threads(),
                         .work = render_tile,
                         .work_user = &picture};
    const double started = seconds_now();
    tiles_run(&job);
    return seconds_now() - started;
}
