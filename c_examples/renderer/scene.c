#include "scene.h"

void scene_free(Scene *scene) {
    for (size_t i = 0; i < scene->mesh_count; i++) mesh_free(&scene->meshes[i]);
    environment_free(&scene->environment);
    *scene = (Scene){.name = NULL};
}

Lights scene_lights(const Scene *scene, const struct Camera *camera) {
    Lights lights = {.count = 0};
    if (scene->add_lamps) scene->add_lamps(scene, camera, &lights);
    if (scene->environment.columns) lights.environment = &scene->environment;
    return lights;
}
