/* What is compared: each plate from three distances under three lights. */
#ifndef COMPARE_CASES_H
#define COMPARE_CASES_H
#include "plates.h"
#include "shade.h"

enum { PICTURE_WIDTH = 48, PICTURE_HEIGHT = 36, DISTANCE_COUNT = 3, ELEVATION_COUNT = 3 };

/* How many pixels a scratch of middling force is wide. */
extern const double DISTANCE_PIXELS[DISTANCE_COUNT];
/* Of lamps above the plate. */
extern const double ELEVATION_DEG[ELEVATION_COUNT];

/* A plate from one distance. The stage points into it: keep it where it is. */
typedef struct Sight {
    const Plate *plate;
    Scene scene; /* the flat plate that the library scratches */
    Tracer *tracer;
    View view;
    Stage stage;
    StriaeMeshRegion region; /* all that the camera sees, and some more around it */
} Sight;

bool sight_init(Sight *sight, const Plate *plate, int distance, char error[SCENE_ERROR_SIZE]);
void sight_free(Sight *sight);

/* Small lamps far away, one for each elevation, each as bright as to give the flat plate an irradiance of pi when overhead. */
Lights sight_lamps(const Sight *sight);
#endif
