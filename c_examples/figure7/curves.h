/* Scratches whose paths are curves drawn by hand: loops, bows, and strokes across them. */
#ifndef FIGURE7_CURVES_H
#define FIGURE7_CURVES_H
#include "plate.h"

/* False, with striae_last_error(), where it cannot be made. */
bool curves_scratch(Plate *plate);
#endif
