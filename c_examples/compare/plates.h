/* The plates that are compared: flat, scratched, u and v their x and y in mm, the middle at (0, 0). */
#ifndef COMPARE_PLATES_H
#define COMPARE_PLATES_H
#include <stdbool.h>
#include <striae.h>

typedef struct Plate {
    const char *name;
    bool is_crossed; /* scratches cross and end in view; otherwise they do neither */
    bool is_matte;   /* Lambert, otherwise GGX */
    double width_mm; /* of a scratch of middling force, with its rims */
    StriaePattern *pattern;
} Plate;

enum { PLATE_COUNT = 4 };

/* Sets what each is; false, with striae_last_error(), where one cannot be made. */
bool plates_build(Plate plates[PLATE_COUNT]);
void plates_free(Plate plates[PLATE_COUNT]);
#endif
