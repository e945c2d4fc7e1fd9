#include "environment.h"

#include <stdlib.h>

/* The part of a texel's chance that is the same for all, so that dark ones between bright ones are met too. */
static const double EVEN_SHARE = 0.1;

static int clamp_int(int value, int most) { return value < 0 ? 0 : value > most ? most : value; }

static const float *texel(const Environment *environment, int column, int row) {
    const Film *map = &environment->map;
    const int x = (column % map->width + map->width) % map->width, y = clamp_int(row, map->height - 1);
    return map->rgb[(size_t)y * (size_t)map->width + (size_t)x];
}

static double luminance(const float rgb[3]) {
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

/* The solid angle of a row's texels over that of the sphere: exact between its two polar angles. */
static double row_share(const Environment *environment, int row) {
    const double step = PI / environment->map.height;
    return 0.5 * (cos(row * step) - cos((row + 1) * step));
}

/* Running sums that end at 1; returns what they ended at before. */
static double accumulate(double *shares, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; i++) shares[i] = sum += shares[i];
    for (int i = 0; i < count; i++) shares[i] /= sum;
    return sum;
}

static void mean_of_all(Environment *environment) {
    const Film *map = &environment->map;
    environment->mean_radiance = 0.0;
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++)
            environment->mean_radiance +=
                luminance(texel(environment, x, y)) * row_share(environment, y) / map->width;
}

bool environment_init(Environment *environment, Film *map) {
    const size_t width = (size_t)map->width, height = (size_t)map->height;
    *environment = (Environment){.map = *map,
                                 .columns = malloc(width * height * sizeof *environment->columns),
                                 .rows = malloc(height * sizeof *environment->rows)};
    *map = (Film){0, 0, NULL};
    if (!environment->columns || !environment->rows) {
        environment_free(environment);
        return false;
    }
    mean_of_all(environment);
    const double even = EVEN_SHARE * environment->mean_radiance + 1e-12;
    for (int y = 0; y < environment->map.height; y++) {
        double *row = &environment->columns[(size_t)y * width];
        for (int x = 0; x < environment->map.width; x++) row[x] = luminance(texel(environment, x, y)) + even;
        environment->rows[y] = accumulate(row, environment->map.width) * row_share(environment, y);
    }
    accumulate(environment->rows, environment->map.height);
    return true;
}

void environment_free(Environment *environment) {
    film_free(&environment->map);
    free(environment->columns);
    free(environment->rows);
    *environment = (Environment){.columns = NULL};
}

/* A place of the map, in texels from its upper left corner, and the direction seen there. */
static Vec direction_at(const Environment *environment, double x, double y) {
    const double azimuth = 2.0 * PI * (0.5 - x / environment->map.width), polar = PI * y / environment->map.height;
    return vec(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
}

static void place_of(const Environment *environment, Vec direction, double *x, double *y) {
    *x = (0.5 - atan2(direction.y, direction.x) / (2.0 * PI)) * environment->map.width;
    *y = acos(fmax(-1.0, fmin(1.0, direction.z))) / PI * environment->map.height;
}

bool environment_paint(Environment *environment, int height, Sky *sky) {
    Film map;
    *environment = (Environment){.columns = NULL};
    if (!film_init(&map, 2 * height, height)) return false;
    environment->map = map;
    for (int i = 0; i < map.width * height; i++) {
        double radiance[3];
        sky(direction_at(environment, i % map.width + 0.5, i / map.width + 0.5), radiance);
        for (int c = 0; c < 3; c++) map.rgb[i][c] = (float)radiance[c];
    }
    return environment_init(environment, &map);
}

void environment_radiance(const Environment *environment, Vec direction, double radiance[3]) {
    double x, y;
    place_of(environment, direction, &x, &y);
    const int column = (int)floor(x - 0.5), row = (int)floor(y - 0.5);
    const double right = x - 0.5 - column, below = y - 0.5 - row;
    for (int c = 0; c < 3; c++) radiance[c] = 0.0;
    for (int k = 0; k < 4; k++) {
        const float *rgb = texel(environment, column + k % 2, row + k / 2);
        const double weight = (k % 2 ? right : 1.0 - right) * (k / 2 ? below : 1.0 - below);
        for (int c = 0; c < 3; c++) radiance[c] += weight * (double)rgb[c];
    }
}

/* The first running sum above u, and how far u lies between it and the one before, in [0,1). */
static int find_share(const double *sums, int count, double u, double *within) {
    int low = 0, high = count - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (sums[middle] > u)
            high = middle;
        else
            low = middle + 1;
    }
    const double before = low > 0 ? sums[low - 1] : 0.0;
    *within = (u - before) / (sums[low] - before);
    return low;
}

Vec environment_sample(const Environment *environment, const double u[2]) {
    double across, down;
    const int row = find_share(environment->rows, environment->map.height, u[1], &down);
    const double *columns = &environment->columns[(size_t)row * (size_t)environment->map.width];
    const int column = find_share(columns, environment->map.width, u[0], &across);
    /* Evenly over the row's solid angle, not over its height. */
    const double step = PI / environment->map.height, top = cos(row * step), bottom = cos((row + 1) * step);
    const double polar = acos(fmax(-1.0, fmin(1.0, top + down * (bottom - top))));
    return direction_at(environment, column + across, polar / step);
}

double environment_pdf(const Environment *environment, Vec direction) {
    double x, y;
    place_of(environment, direction, &x, &y);
    const int column = clamp_int((int)x, environment->map.width - 1),
              row = clamp_int((int)y, environment->map.height - 1);
    const double *columns = &environment->columns[(size_t)row * (size_t)environment->map.width];
    const double in_row = columns[column] - (column > 0 ? columns[column - 1] : 0.0);
    const double of_row = environment->rows[row] - (row > 0 ? environment->rows[row - 1] : 0.0);
    return in_row * of_row * environment->map.width / (4.0 * PI * row_share(environment, row));
}
