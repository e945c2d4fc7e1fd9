/* A scene: meshes, lights, and the views from which it is to be seen. */
#ifndef RENDERER_SCENE_H
#define RENDERER_SCENE_H
#include "lights.h"
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
    Vec aside;            /* what it looks at and draws sharply, from the scene's target */
    double lens_radius;   /* scene units; 0: all is sharp */
} View;

typedef struct Scene Scene;
struct Camera;

struct Scene {
    const char *name;
    double mm_per_unit;
    Vec target; /* what every view looks at */
    Mesh meshes[SCENE_MAX_MESHES];
    size_t mesh_count;
    unsigned judged_face; /* the face by which --check judges the pictures */
    View views[SCENE_MAX_VIEWS];
    size_t view_count;
    const char *sheet; /* name of the picture of all views side by side; NULL for none */
    double exposure;   /* of the PNG pictures; the EXR ones are scene-linear */
    int paths;         /* per pixel, that make a good picture; 0 where lamps counted as points do */
    double most_indirect; /* as in PathSettings */
    Environment environment; /* empty unless the scene has one */
    void (*add_lamps)(const Scene *scene, const struct Camera *camera, Lights *lights);
};

/* Builds a scene by name; on failure says why in `error` and leaves nothing behind. */
bool scene_build(Scene *scene, const char *name, char error[SCENE_ERROR_SIZE]);
void scene_free(Scene *scene);

/* The scene's lamps, which may go where the camera goes, and its environment. */
Lights scene_lights(const Scene *scene, const struct Camera *camera);

/* Names that scene_build knows, with commas. */
const char *scene_names(void);

#endif
