/* A scene: meshes, and the views from which it is to be seen. */
#ifndef RENDERER_SCENE_H
#define RENDERER_SCENE_H
#include "mesh.h"

enum { SCENE_MAX_MESHES = 8, SCENE_MAX_VIEWS = 8, SCENE_ERROR_SIZE = 512 };

/* A camera on a sphere about the scene's target, the scene's "up" being +z. */
typedef struct View {
    const char *name;     /* of the pictures' files */
    double heading_deg;   /* where the camera stands, counter-clockwise from +x seen from above */
    double elevation_deg; /* above the horizon */
    double roll_deg;      /* about the camera's axis, clockwise: the picture turns the other way */
    double distance;      /* scene units */
    double width_deg;     /* horizontal field of view */
} View;

typedef struct Scene {
    const char *name;
    double mm_per_unit;
    Vec target; /* what every view looks at */
    Mesh meshes[SCENE_MAX_MESHES];
    size_t mesh_count;
    unsigned judged_face; /* the face by which --check judges the pictures */
    View views[SCENE_MAX_VIEWS];
    size_t view_count;
    double exposure; /* of the PNG pictures; the EXR ones are scene-linear */
} Scene;

/* Builds a scene by name; on failure says why in `error` and leaves nothing behind. */
bool scene_build(Scene *scene, const char *name, char error[SCENE_ERROR_SIZE]);
void scene_free(Scene *scene);

/* Names that scene_build knows, with commas. */
const char *scene_names(void);

/* The scenes, each in a file of its own. */
bool scene_plate(Scene *scene, char error[SCENE_ERROR_SIZE]);
#endif
