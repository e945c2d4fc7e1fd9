/* POV-Ray as a second judge: the relief as a scene of its own, rendered by the program `povray`. */
#ifndef COMPARE_POVRAY_H
#define COMPARE_POVRAY_H
#include "finish.h"
#include "truth.h"

/* The relief, seen by the stage's camera under one of its lamps, each base BRDF being one of the finishes. The picture is made
   so many times as large, and each pixel (of a film that is not yet initialised) is the mean of what it holds. Writes BASE.pov
   and BASE.exr. NULL if the film was filled, otherwise why not. */
const char *povray_render(const Truth *truth, const Stage *stage, int lamp, const Finish *finishes, int width, int height,
                          int times, const char *base, Film *film);
#endif
