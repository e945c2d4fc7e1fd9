/* What surrounds a scene, infinitely far away: a picture of all directions, as EXR files of skies and studios have it. The
   zenith (+z) is its upper edge, +x its middle, +y a quarter of its width to the left of that. */
#ifndef RENDERER_ENVIRONMENT_H
#define RENDERER_ENVIRONMENT_H
#include "film.h"
#include "vec.h"

typedef struct Environment {
    Film map;
    double *columns; /* per row: the share of its light left of each texel's right edge */
    double *rows;    /* the share of all light above each row's lower edge */
    double mean_radiance;
} Environment;

/* Takes over the map, also on failure. False where memory is short. */
bool environment_init(Environment *environment, Film *map);
void environment_free(Environment *environment);

/* From a function of unit directions, `height` texels from zenith to nadir. */
typedef void Sky(Vec direction, double radiance[3]);
bool environment_paint(Environment *environment, int height, Sky *sky);

/* What is seen in a unit direction, linear between texels. */
void environment_radiance(const Environment *environment, Vec direction, double radiance[3]);

/* Chooses a direction about as often as light comes from there, and tells the density of doing so, per steradian. */
Vec environment_sample(const Environment *environment, const double u[2]);
double environment_pdf(const Environment *environment, Vec direction);
#endif
