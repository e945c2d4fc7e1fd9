/* The scenes, each in a file of its own. */
#ifndef RENDERER_SCENES_H
#define RENDERER_SCENES_H
#include "camera.h"

typedef bool SceneBuilder(Scene *scene, char error[SCENE_ERROR_SIZE]);
SceneBuilder scene_plate, scene_crossing, scene_aluminium, scene_car, scene_ring;
#endif
