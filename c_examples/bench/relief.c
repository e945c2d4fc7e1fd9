#include "relief.h"

#include <stdio.h>
#include <stdlib.h>

#include "progress.h"

/* How far triangles may stray from the relief, mm: a thousandth of a scratch's width. */
static const double TOLERANCE_MM = 1e-4;

/* Resident memory of this program, bytes: what Embree keeps for itself is told nowhere else. */
static size_t resident(void) {
    unsigned long all = 0, held = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%lu %lu", &all, &held) != 2) held = 0;
    fclose(file);
    return held * 4096u;
}

static bool copy_mesh(Relief *relief, const StriaeMeshArrays *arrays) {
    Mesh *mesh = &relief->scene.meshes[0];
    mesh->positions = malloc(arrays->vertex_count * sizeof *mesh->positions);
    mesh->triangles = malloc(arrays->triangle_count * sizeof *mesh->triangles);
    relief->scene.mesh_count = 1;
    if (!mesh->positions || !mesh->triangles) return false;
    const double low[2] = {0.5 * relief->plate->width_mm, 0.5 * relief->plate->height_mm};
    for (size_t i = 0; i < arrays->vertex_count; i++) {
        const double *p = arrays->positions[i];
        mesh->positions[i] = vec(p[0] - low[0], p[1] - low[1], p[2]);
        relief->top = fmax(relief->top, p[2]);
    }
    for (size_t i = 0; i < arrays->triangle_count; i++)
        for (int k = 0; k < 3; k++) mesh->triangles[i][k] = arrays->triangles[i][k];
    mesh->vertex_count = arrays->vertex_count;
    mesh->triangle_count = arrays->triangle_count;
    return true;
}

bool relief_init(Relief *relief, const Plate *plate, char error[SCENE_ERROR_SIZE]) {
    const double started = seconds_now();
    const StriaeMeshRegion region = {
        .struct_size = sizeof region, .high_uv = {1.0, 1.0}, .tolerance_mm = TOLERANCE_MM};
    StriaeMeshArrays arrays = {.struct_size = sizeof arrays};
    StriaeReliefMesh *mesh = NULL;
    *relief = (Relief){.plate = plate, .step = 1e-4};
    if (striae_relief_mesh(plate->pattern, &region, &mesh) != STRIAE_STATUS_OK ||
        striae_relief_mesh_arrays(mesh, &arrays) != STRIAE_STATUS_OK) {
        snprintf(error, SCENE_ERROR_SIZE, "%s", striae_last_error());
        striae_relief_mesh_release(mesh);
        return false;
    }
    const bool copied = copy_mesh(relief, &arrays);
    striae_relief_mesh_release(mesh);
    const size_t before = resident();
    snprintf(error, SCENE_ERROR_SIZE, "out of memory");
    relief->tracer = copied ? tracer_new(&relief->scene, error) : NULL;
    const size_t after = resident(), own = relief->scene.meshes[0].triangle_count * sizeof(unsigned[3]);
    relief->bytes =
        own + relief->scene.meshes[0].vertex_count * sizeof(Vec) + (after > before ? after - before : 0);
    relief->build_seconds = seconds_now() - started;
    return relief->tracer != NULL;
}

void relief_free(Relief *relief) {
    tracer_free(relief->tracer);
    for (size_t i = 0; i < relief->scene.mesh_count; i++) mesh_free(&relief->scene.meshes[i]);
    *relief = (Relief){0};
}

static Vec corner_of(const Mesh *mesh, size_t triangle, int k) {
    return mesh->positions[mesh->triangles[triangle][k]];
}

static Vec normal_of(const Mesh *mesh, size_t triangle) {
    const Vec a = corner_of(mesh, triangle, 0);
    const Vec ab = vec_sub(corner_of(mesh, triangle, 1), a), ac = vec_sub(corner_of(mesh, triangle, 2), a);
    return vec_unit(vec_cross(ab, ac));
}

bool relief_find(const Relief *relief, Vec origin, Vec direction, Vec *position, Vec *normal) {
    /* From right above the relief on: single precision then tells facets apart. */
    const double above = (relief->top + relief->step - origin.z) / direction.z;
    const Vec from = vec_along(origin, above, direction);
    Hit hit;
    if (!trace_closest(relief->tracer, from, direction, &hit)) return false;
    *normal = normal_of(hit.mesh, hit.triangle);
    /* In double precision, as Embree's own distance is not. */
    const Vec a = corner_of(hit.mesh, hit.triangle, 0);
    const double distance = vec_dot(vec_sub(a, from), *normal) / vec_dot(direction, *normal);
    *position = vec_along(from, distance, direction);
    return true;
}

bool relief_is_lit(const Relief *relief, Vec position, Vec normal, Vec lamp) {
    const Vec off = vec_along(position, relief->step, normal);
    return !trace_meets(relief->tracer, off, vec_sub(lamp, off));
}

/* Places on the plate in texels. */
static void place(const NormalMap *map, const Plate *plate, Vec p, double at[2]) {
    at[0] = (p.x / plate->width_mm + 0.5) * map->columns;
    at[1] = (p.y / plate->height_mm + 0.5) * map->rows;
}

static int clamp_int(double value, int least, int most) { return (int)fmin(fmax(value, least), most); }

/* Writes a facet's normal to the texels whose middles it covers, seen from above. */
static void bake_triangle(NormalMap *map, const Relief *relief, size_t triangle) {
    const Mesh *mesh = &relief->scene.meshes[0];
    const Vec normal = normal_of(mesh, triangle);
    if (normal.z < 1e-6 || normal.z > 1.0 - 1e-9) return; /* a wall; or flat, as all texels are at first */
    double at[3][2];
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        place(map, relief->plate, corner_of(mesh, triangle, k), at[k]);
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = fmin(low[axis], at[k][axis]);
            high[axis] = fmax(high[axis], at[k][axis]);
        }
    }
    const int last_row = clamp_int(ceil(high[1] - 0.5), -1, map->rows - 1);
    for (int y = clamp_int(ceil(low[1] - 0.5), 0, map->rows); y <= last_row; y++) {
        /* What of the row's middle line the triangle covers. */
        double from = INFINITY, to = -INFINITY;
        for (int k = 0; k < 3; k++) {
            const double *a = at[k], *b = at[(k + 1) % 3], share = (y + 0.5 - a[1]) / (b[1] - a[1]);
            if (!(share >= 0.0 && share <= 1.0)) continue;
            const double x = a[0] + share * (b[0] - a[0]);
            from = fmin(from, x);
            to = fmax(to, x);
        }
        const int last = clamp_int(floor(to - 0.5), -1, map->columns - 1);
        for (int x = clamp_int(ceil(from - 0.5), 0, map->columns); x <= last; x++) {
            int16_t *texel = map->xy[(size_t)y * (size_t)map->columns + (size_t)x];
            texel[0] = (int16_t)lrint(32767.0 * normal.x);
            texel[1] = (int16_t)lrint(32767.0 * normal.y);
        }
    }
}

bool normal_map_init(NormalMap *map, const Relief *relief, unsigned texels) {
    const double started = seconds_now();
    const StriaeCanvas canvas = plate_canvas(texels);
    *map = (NormalMap){.columns = (int)canvas.texels[0], .rows = (int)canvas.texels[1]};
    map->xy = calloc((size_t)map->columns * (size_t)map->rows, sizeof *map->xy);
    if (!map->xy) return false;
    for (size_t i = 0; i < relief->scene.meshes[0].triangle_count; i++) bake_triangle(map, relief, i);
    map->build_seconds = seconds_now() - started;
    return true;
}

void normal_map_free(NormalMap *map) {
    free(map->xy);
    *map = (NormalMap){0};
}

size_t normal_map_bytes(const NormalMap *map) { return (size_t)map->columns * (size_t)map->rows * sizeof *map->xy; }

void normal_map_at(const NormalMap *map, const double uv[2], float normal[3]) {
    const float x = (float)(uv[0] * map->columns - 0.5), y = (float)(uv[1] * map->rows - 0.5);
    const float floor_x = floorf(x), floor_y = floorf(y), share_x = x - floor_x, share_y = y - floor_y;
    const int x0 = clamp_int((double)floor_x, 0, map->columns - 2),
              y0 = clamp_int((double)floor_y, 0, map->rows - 2);
    const int16_t (*row)[2] = (const int16_t (*)[2]) & map->xy[(size_t)y0 * (size_t)map->columns + (size_t)x0];
    const int16_t (*next)[2] = row + map->columns;
    float square = 0.0f;
    for (int i = 0; i < 2; i++) {
        const float low = (float)row[0][i] + share_x * (float)(row[1][i] - row[0][i]);
        const float high = (float)next[0][i] + share_x * (float)(next[1][i] - next[0][i]);
        normal[i] = (low + share_y * (high - low)) / 32767.0f;
        square += normal[i] * normal[i];
    }
    normal[2] = sqrtf(fmaxf(0.0f, 1.0f - square));
}
