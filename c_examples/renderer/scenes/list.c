#include <stdio.h>
#include <string.h>

#include "scenes.h"

static const struct {
    const char *name;
    SceneBuilder *build;
} scenes[] = {
    {"plate", scene_plate},
    {"crossing", scene_crossing},
    {"aluminium", scene_aluminium},
    {"car", scene_car},
    {"ring", scene_ring},
};

enum { SCENE_COUNT = sizeof scenes / sizeof *scenes };

const char *scene_names(void) {
    static char names[256];
    names[0] = '\0';
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        if (i > 0) strcat(names, ", ");
        strcat(names, scenes[i].name);
    }
    return names;
}

bool scene_build(Scene *scene, const char *name, char error[SCENE_ERROR_SIZE]) {
    *scene = (Scene){.name = name};
    snprintf(error, SCENE_ERROR_SIZE, "--scene is \"%s\"; accepted: %s", name, scene_names());
    bool built = false;
    for (size_t i = 0; i < SCENE_COUNT; i++)
        if (strcmp(name, scenes[i].name) == 0) built = scenes[i].build(scene, error);
    if (!built) scene_free(scene);
    return built;
}
