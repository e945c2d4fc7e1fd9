/* A camera, and what of a surface one of its pixels sees. */
#ifndef RENDERER_CAMERA_H
#define RENDERER_CAMERA_H
#include "ray.h"
#include "scene.h"

typedef struct Camera {
    Vec position;
    Vec forward;     /* unit */
    Vec right, down; /* as long as one pixel is wide, one unit in front of the camera */
    double centre_x, centre_y;
    double lens_radius; /* scene units; 0 for a pinhole */
    double focus;       /* where the lens draws sharply, in front of the camera, scene units */
} Camera;

/* A square of the picture: its middle, and its side in pixels. */
typedef struct Sample {
    double x, y, size;
} Sample;

Camera camera_for_view(const Scene *scene, const View *view, int width, int height);

/* Through a place of the picture; pixel (0,0) covers [0,1]x[0,1], y downwards. Not of unit length. */
Vec camera_direction(const Camera *camera, double x, double y);

/* A ray from a point of the lens (two numbers in [0,1)) through the middle of a square of the picture, that spreads like the
   square's sides. */
Ray camera_ray(const Camera *camera, const Sample *sample, const double lens[2]);

/* The square of `size` pixels about (x, y), projected on the surface's tangent plane: its edges in texture
   coordinates. False where a side of the square looks past the plane, as at grazing angles. */
bool camera_footprint(const Camera *camera, const Surface *surface, double x, double y, double size,
                      float duv_dx[2], float duv_dy[2]);
#endif
