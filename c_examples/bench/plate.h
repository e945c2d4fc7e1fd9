/* The plate of all measurements: metal, flat, u and v from 0 to 1 over it, with any number of scratches alike. */
#ifndef BENCH_PLATE_H
#define BENCH_PLATE_H
#include <striae.h>

#include "camera.h"
#include "trace.h"

enum { PLATE_MAX_LAMPS = 16 };

typedef struct Plate {
    double width_mm, height_mm; /* four to three */
    StriaePattern *pattern;     /* the flat mesh's own; NULL without one */
    StriaeBrdf metal;
    double build_seconds;
    Scene scene; /* the flat plate, in mm, its middle at the origin */
    Tracer *tracer;
    View view;
    Camera camera;
    int width, height;          /* of the picture */
    double lamp_elevation_deg;  /* above the plate: counts when a lamp is put up */
    Vec lamps[PLATE_MAX_LAMPS]; /* points */
    int lamp_count;
    double intensity; /* of each */
} Plate;

/* How hard all scratches are pressed. */
extern const double PLATE_FORCE_KGF;

/* What is scratched. Surface and scratches have one finish, which a normal map can have too. */
StriaeMaterial plate_material(void);

/* A flat plate so wide that has no pattern yet, and a picture of it, so many pixels wide, which shows nothing else. */
bool plate_init(Plate *plate, double width_mm, int width, char error[SCENE_ERROR_SIZE]);

/* Puts up a square lamp as so many points each way, 4 at most: 1 (as it is at first) for a single point. It is as bright with any. */
void plate_light(Plate *plate, int across);

/* Takes a pattern over; the one before it is released. */
void plate_set_pattern(Plate *plate, StriaePattern *pattern);

/* So many straight scratches at random, all pressed alike. */
bool plate_scratch(Plate *plate, unsigned count);
void plate_free(Plate *plate);

/* MDG01's cross-section for them: as wide, its two slopes those of the peaks' outer sides and of the groove. */
bool plate_two_angles(StriaeTwoAngles *scratch);

/* All of the plate's texture space in so many texels across. */
StriaeCanvas plate_canvas(unsigned texels);
#endif
