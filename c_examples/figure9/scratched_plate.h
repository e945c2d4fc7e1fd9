/* The plate of one cell, with its scratch. Scene units are millimetres, the plate's middle is the origin. */
#ifndef FIGURE9_SCRATCHED_PLATE_H
#define FIGURE9_SCRATCHED_PLATE_H
#include "cells.h"
#include "scene.h"

typedef struct Shot {
    const Group *group;
    const Cell *cell;
    double middle_mm; /* what of the cross-section lies in the picture's middle */
    int width, height;
} Shot;

/* Fills in the scene; NULL, or why not. */
const char *scratched_plate(const Shot *shot, Scene *scene);
#endif
