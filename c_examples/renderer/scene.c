#include "scene.h"

#include <stdio.h>
#include <string.h>

const char *scene_names(void) { return "plate"; }

bool scene_build(Scene *scene, const char *name, char error[SCENE_ERROR_SIZE]) {
    *scene = (Scene){.name = name};
    error[0] = '\0';
    bool built = false;
    if (strcmp(name, "plate") == 0) {
        built = scene_plate(scene, error);
    } else {
        snprintf(error, SCENE_ERROR_SIZE, "--scene is \"%s\"; accepted: %s", name, scene_names());
    }
    if (!built) scene_free(scene);
    return built;
}

void scene_free(Scene *scene) {
    for (size_t i = 0; i < scene->mesh_count; i++) mesh_free(&scene->meshes[i]);
    *scene = (Scene){0};
}
