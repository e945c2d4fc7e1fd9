/* What scenes share: tables, soft boxes. */
#ifndef RENDERER_PROPS_H
#define RENDERER_PROPS_H
#include "scene.h"

enum { FACE_TABLE = 1000 };

/* A level square table about the origin. False where memory is short. */
bool prop_table(Mesh *mesh, double half_width, double z);

/* A soft box at a place seen from the target, facing it. */
void prop_soft_box(Lights *lights, Vec target, double heading_deg, double elevation_deg, double distance,
                   double width, double height, const double radiance[3]);

/* Tells why the library refused, as scene builders do. */
bool prop_refused(char error[SCENE_ERROR_SIZE]);
#endif
