/* One renderer, several ways to have a scratched plate in it. All trace the same rays from the camera and to the lamp. */
#ifndef BENCH_METHODS_H
#define BENCH_METHODS_H
#include "film.h"
#include "relief.h"

typedef struct Method Method;

/* A square of the picture: its middle, and its side in pixels. */
typedef struct Square {
    double x, y, size;
} Square;

struct Method {
    /* What the square's middle, or all of it, shows; black beside the plate. */
    void (*shade)(const Method *method, const Square *square, double radiance[3]);
    bool filters;  /* it knows what a square shows, not only its middle */
    bool asks_near; /* it shades what no scratch is near like the plain one */
    const Plate *plate;
    const StriaePattern *pattern;
    const StriaeBaseline *baseline;
    const Relief *relief;
    const NormalMap *map;
};

Method method_plain(const Plate *plate);
/* Where the library says that no scratch is near, the renderer's own base BRDF; or the library's at every point. */
Method method_library(const Plate *plate);
Method method_library_everywhere(const Plate *plate);
Method method_baseline(const Plate *plate, const StriaeBaseline *baseline);
Method method_geometry(const Plate *plate, const Relief *relief);
Method method_normal_map(const Plate *plate, const NormalMap *map);

/* The mean of so many samples per pixel; seconds that it took. A film smaller than the plate's picture is its middle. Of a method
   that filters, samples are the pixel's n by n equal squares; others are spread evenly, by another shift in each pixel and for
   each seed. */
double render(const Method *method, unsigned samples, unsigned seed, Film *film);
#endif
