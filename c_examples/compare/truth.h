/* Brute force: rays against every facet of a plate's relief, nothing filtered, nothing known of scratches. */
#ifndef COMPARE_TRUTH_H
#define COMPARE_TRUTH_H
#include "film.h"
#include "shade.h"

enum { TRUTH_MAX_BRDFS = 8 };

typedef struct Truth {
    StriaeReliefMesh *mesh;
    StriaeMeshArrays arrays;
    StriaeBrdf brdfs[TRUTH_MAX_BRDFS];
    Scene scene;
    Tracer *tracer;
    double top;  /* above all relief, scene units */
    double step; /* off a facet that a ray leaves */
} Truth;

/* A region's relief, in scene units of 1 mm; false, with a reason, where it cannot be made. */
bool truth_init(Truth *truth, const StriaePattern *pattern, const StriaeMeshRegion *region, double step,
                char error[SCENE_ERROR_SIZE]);
void truth_free(Truth *truth);

/* What brute force shows under each of a stage's lamps by itself: the light that comes straight from it, and all. */
typedef struct TruthFilms {
    Film direct[LIGHTS_MAX_PATCHES], all[LIGHTS_MAX_PATCHES];
    size_t lamps;
} TruthFilms;

/* Films of a stage's size; false where memory is short. */
bool truth_films_init(TruthFilms *films, size_t lamps, int width, int height);
void truth_films_free(TruthFilms *films);

/* Fills the films with the mean of so many paths per pixel, each followed for `length` reflections at most. Returns how
   many met nothing, which a watertight mesh does not let happen. */
size_t truth_render(const Truth *truth, const Stage *stage, uint32_t paths, int length, uint32_t seed, int threads,
                    TruthFilms *films);
#endif
