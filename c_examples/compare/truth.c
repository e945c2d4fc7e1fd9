#include "truth.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "facet.h"
#include "random.h"
#include "tiles.h"

/* A place where a ray met the relief. */
typedef struct Place {
    Vec position, normal;
    const StriaeBrdf *brdf;
} Place;

typedef struct Picture {
    const Truth *truth;
    const Stage *stage;
    TruthFilms *films;
    uint32_t paths, seed;
    int length;
    atomic_size_t missed;
} Picture;

/* What one path brings, lamp by lamp, along with where it goes on. */
typedef struct Path {
    Vec origin, direction;
    double weight[3];
    uint32_t random;
} Path;

typedef double Radiance[3];

static bool copy_mesh(Truth *truth) {
    const StriaeMeshArrays *arrays = &truth->arrays;
    Mesh *mesh = &truth->scene.meshes[0];
    mesh->positions = malloc(arrays->vertex_count * sizeof *mesh->positions);
    mesh->triangles = malloc(arrays->triangle_count * sizeof *mesh->triangles);
    truth->scene.mesh_count = 1;
    if (!mesh->positions || !mesh->triangles) return false;
    for (size_t i = 0; i < arrays->vertex_count; i++) {
        const double *p = arrays->positions[i];
        mesh->positions[i] = vec(p[0], p[1], p[2]);
        truth->top = fmax(truth->top, p[2]);
    }
    for (size_t i = 0; i < arrays->triangle_count; i++)
        for (int k = 0; k < 3; k++) mesh->triangles[i][k] = arrays->triangles[i][k];
    mesh->vertex_count = arrays->vertex_count;
    mesh->triangle_count = arrays->triangle_count;
    return true;
}

static bool copy_brdfs(Truth *truth) {
    if (truth->arrays.brdf_count > TRUTH_MAX_BRDFS) return false;
    for (size_t i = 0; i < truth->arrays.brdf_count; i++) {
        if (striae_relief_mesh_brdf(truth->mesh, (uint32_t)i, &truth->brdfs[i]) != STRIAE_STATUS_OK) return false;
        if (!facet_knows(&truth->brdfs[i])) return false;
    }
    return true;
}

bool truth_init(Truth *truth, const StriaePattern *pattern, const StriaeMeshRegion *region, double step,
                char error[SCENE_ERROR_SIZE]) {
    *truth = (Truth){.arrays = {.struct_size = sizeof truth->arrays}, .step = step};
    if (striae_relief_mesh(pattern, region, &truth->mesh) != STRIAE_STATUS_OK ||
        striae_relief_mesh_arrays(truth->mesh, &truth->arrays) != STRIAE_STATUS_OK) {
        snprintf(error, SCENE_ERROR_SIZE, "%s", striae_last_error());
        return false;
    }
    const bool copied = copy_mesh(truth) && copy_brdfs(truth);
    if (!copied) snprintf(error, SCENE_ERROR_SIZE, "out of memory, or a base BRDF that is not known here");
    truth->tracer = copied ? tracer_new(&truth->scene, error) : NULL;
    return truth->tracer != NULL;
}

void truth_free(Truth *truth) {
    tracer_free(truth->tracer);
    for (size_t i = 0; i < truth->scene.mesh_count; i++) mesh_free(&truth->scene.meshes[i]);
    striae_relief_mesh_release(truth->mesh);
}

static bool find(const Truth *truth, Vec origin, Vec direction, Place *place) {
    Hit hit;
    if (!trace_closest(truth->tracer, origin, direction, &hit)) return false;
    const unsigned *corner = hit.mesh->triangles[hit.triangle];
    const Vec a = hit.mesh->positions[corner[0]];
    const Vec ab = vec_sub(hit.mesh->positions[corner[1]], a), ac = vec_sub(hit.mesh->positions[corner[2]], a);
    const Vec normal = vec_unit(vec_cross(ab, ac));
    /* In double precision, as Embree's own distance is not. */
    const double distance = vec_dot(vec_sub(a, origin), normal) / vec_dot(direction, normal);
    *place = (Place){.position = vec_along(origin, distance, direction),
                     .normal = normal,
                     .brdf = &truth->brdfs[truth->arrays.zones[hit.triangle].brdf]};
    return true;
}

/* Off the facet, into the air. */
static Vec off(const Truth *truth, const Place *place) {
    return vec_along(place->position, truth->step, place->normal);
}

/* What comes straight from each lamp. */
static void add_light(const Picture *picture, const Place *place, const Path *path, Radiance *of_lamps) {
    const Lights *lights = &picture->stage->lights;
    const Vec view = vec_scale(path->direction, -1.0);
    for (size_t i = 0; i < lights->count; i++) {
        const Patch *patch = &lights->patches[i];
        const Vec light = vec_unit(vec_sub(patch->position, place->position));
        double f_cos[3], irradiance[3];
        facet_reflects(place->brdf, place->normal, view, light, f_cos);
        if (f_cos[0] + f_cos[1] + f_cos[2] <= 0.0) continue;
        if (trace_meets(picture->truth->tracer, off(picture->truth, place), light)) continue;
        patch_irradiance(patch, patch->position, place->position, irradiance);
        for (int c = 0; c < 3; c++) of_lamps[i][c] += path->weight[c] * f_cos[c] * irradiance[c];
    }
}

/* A path from the camera, from right above the relief on: single precision then tells facets apart. */
static Path begin(const Picture *picture, double x, double y, uint32_t random) {
    const Camera *camera = &picture->stage->camera;
    const Truth *truth = picture->truth;
    const Vec direction = vec_unit(camera_direction(camera, x, y));
    const double above = (truth->top + truth->step - camera->position.z) / direction.z;
    return (Path){.origin = vec_along(camera->position, above, direction),
                  .direction = direction,
                  .weight = {1.0, 1.0, 1.0},
                  .random = random};
}

/* Reflects a path; false where it ends. */
static bool reflect(const Truth *truth, const Place *place, Path *path) {
    const double a = next_random(&path->random), b = next_random(&path->random);
    const Vec view = vec_scale(path->direction, -1.0);
    double factor[3];
    if (!facet_sample(place->brdf, place->normal, view, a, b, &path->direction, factor)) return false;
    for (int c = 0; c < 3; c++) path->weight[c] *= factor[c];
    path->origin = off(truth, place);
    return true;
}

/* Follows a path to its end: adds what it finds at once, and after further reflections. */
static void follow(Picture *picture, Path *path, Radiance *direct, Radiance *further) {
    for (int reflections = 0; reflections < picture->length; reflections++) {
        Place place;
        if (!find(picture->truth, path->origin, path->direction, &place)) {
            if (reflections == 0) atomic_fetch_add(&picture->missed, 1);
            return;
        }
        if (vec_dot(path->direction, place.normal) >= 0.0) return;
        add_light(picture, &place, path, reflections == 0 ? direct : further);
        if (!reflect(picture->truth, &place, path)) return;
    }
}

static void render_pixel_of(Picture *picture, int x, int y) {
    Radiance direct[LIGHTS_MAX_PATCHES] = {{0}}, further[LIGHTS_MAX_PATCHES] = {{0}};
    uint32_t random = picture->seed ^ ((uint32_t)x * 73856093u) ^ ((uint32_t)y * 19349663u);
    for (int i = 0; i < 4; i++) next_random(&random);
    /* Roberts's sequence (2018), shifted at random: it fills the pixel evenly in whatever direction scratches run. */
    double a = next_random(&random), b = next_random(&random);
    for (uint32_t i = 0; i < picture->paths; i++) {
        a = fmod(a + 0.7548776662466927, 1.0);
        b = fmod(b + 0.5698402909980532, 1.0);
        Path path = begin(picture, x + a, y + b, random);
        follow(picture, &path, direct, further);
        random = path.random;
    }
    TruthFilms *films = picture->films;
    for (size_t i = 0; i < films->lamps; i++) {
        const size_t at = (size_t)y * (size_t)films->all[i].width + (size_t)x;
        for (int c = 0; c < 3; c++) {
            films->direct[i].rgb[at][c] = (float)(direct[i][c] / picture->paths);
            films->all[i].rgb[at][c] = (float)((direct[i][c] + further[i][c]) / picture->paths);
        }
    }
}

static void render_tile(const Tile *tile, void *user) {
    for (int y = tile->y0; y < tile->y1; y++)
        for (int x = tile->x0; x < tile->x1; x++) render_pixel_of(user, x, y);
}

bool truth_films_init(TruthFilms *films, size_t lamps, int width, int height) {
    bool made = true;
    *films = (TruthFilms){.lamps = lamps};
    for (size_t i = 0; i < lamps && made; i++)
        made = film_init(&films->direct[i], width, height) && film_init(&films->all[i], width, height);
    return made;
}

void truth_films_free(TruthFilms *films) {
    for (size_t i = 0; i < films->lamps; i++) {
        film_free(&films->direct[i]);
        film_free(&films->all[i]);
    }
}

size_t truth_render(const Truth *truth, const Stage *stage, uint32_t paths, int length, uint32_t seed, int threads,
                    TruthFilms *films) {
    Picture picture = {
        .truth = truth, .stage = stage, .films = films, .paths = paths, .length = length, .seed = seed};
    atomic_init(&picture.missed, 0);
    const TileJob job = {.width = films->all[0].width,
                         .height = films->all[0].height,
                         .threads = threads,
                         .work = render_tile,
                         .work_user = &picture};
    tiles_run(&job);
    return atomic_load(&picture.missed);
}
