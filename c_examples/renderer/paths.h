/* Light that comes by any number of reflections: one path from the camera, meeting at each surface a light by chance, and
   going on as the surface reflects; where both ways might have found the same light they share it out by their densities
   (E. Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997). */
#ifndef RENDERER_PATHS_H
#define RENDERER_PATHS_H
#include "sampler.h"
#include "shade.h"

/* How direct light is found. The last two are for tests: all three have the same mean. */
typedef enum PathStrategy { PATHS_SHARED, PATHS_BY_LIGHTS, PATHS_BY_SURFACES } PathStrategy;

typedef struct PathSettings {
    int samples; /* paths per pixel */
    int looks;   /* for light from what the camera sees, 1 or more: each for another of the lights that matter */
    int reflections; /* that a path may have, 1 or more: 1 is light straight from the lamps */
    /* Most that a path may bring by more than one reflection, in the film's radiance: what exceeds it are a few bright dots,
       which is all that chance leaves of light thrown by a polished thing onto another. 0: no bound, and no bias. */
    double most_indirect;
    PathStrategy strategy;
} PathSettings;

/* What a path found, and what it met first. */
typedef struct PathLight {
    double direct[3]; /* lamps and surroundings themselves, and their light reflected once */
    double indirect[3];
    Vec normal; /* 0 where nothing was met */
    double distance;
} PathLight;

/* One path through a pixel's square. Its numbers come from pixel and index alone. */
PathLight path_follow(const Stage *stage, const PathSettings *settings, int x, int y, uint32_t index);
#endif
