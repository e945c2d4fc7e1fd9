/* POV-Ray's finishes, for zones of the library and for scenes of POV-Ray's own. */
#ifndef COMPARE_FINISH_H
#define COMPARE_FINISH_H
#include "vec.h"

typedef struct Finish {
    double diffuse[3];            /* colour */
    double phong, phong_size;     /* a highlight about the mirrored view */
    double specular, roughness;   /* a highlight about the half vector */
} Finish;

/* What a surface under a lamp of brightness 1 sends to the view; nothing unless it faces both. Unit vectors. */
void finish_reflects(const Finish *finish, Vec normal, Vec view, Vec light, double radiance[3]);
#endif
