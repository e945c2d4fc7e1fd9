/* A cell's cross-section, drawn. */
#ifndef FIGURE9_SECTION_H
#define FIGURE9_SECTION_H
#include "scratched_plate.h"

/* Writes the PNG strip that goes under the shot, `height` pixels high and as wide as the shot, and the whole plot as
   SVG. Fills in the shot's middle_mm. NULL, or why not. */
const char *section_plot(Shot *shot, int height, const char *strip_path, const char *whole_path);
#endif
