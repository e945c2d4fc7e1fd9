/* A pinhole camera, and what of a surface one of its pixels sees. */
#ifndef RENDERER_CAMERA_H
#define RENDERER_CAMERA_H
#include "scene.h"

typedef struct Camera {
    Vec position;
    Vec forward;     /* unit */
    Vec right, down; /* as long as one pixel is wide, one unit in front of the camera */
    double centre_x, centre_y;
} Camera;

Camera camera_for_view(const Scene *scene, const View *view, int width, int height);

/* Through a place of the picture; pixel (0,0) covers [0,1]x[0,1], y downwards. Not of unit length. */
Vec camera_direction(const Camera *camera, double x, double y);

/* The square of `size` pixels about (x, y), projected on the surface's tangent plane: its edges in texture
   coordinates. False where a side of the square looks past the plane, as at grazing angles. */
bool camera_footprint(const Camera *camera, const Surface *surface, double x, double y, double size,
                      float duv_dx[2], float duv_dy[2]);
#endif
