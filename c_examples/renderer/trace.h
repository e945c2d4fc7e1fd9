/* Rays against a scene, by Embree 3 or 4. */
#ifndef RENDERER_TRACE_H
#define RENDERER_TRACE_H
#include "scene.h"

typedef struct Tracer Tracer;

typedef struct Hit {
    const Mesh *mesh;
    size_t triangle;
} Hit;

/* Keeps a pointer to the scene. NULL on failure, with the reason in `error`. */
Tracer *tracer_new(const Scene *scene, char error[SCENE_ERROR_SIZE]);
void tracer_free(Tracer *tracer);

bool trace_closest(const Tracer *tracer, Vec origin, Vec direction, Hit *hit);

/* Where rays leave a surface: a little off it. */
Vec trace_off(const Surface *surface);

/* Whether something lies between a surface point and a light. */
bool trace_blocked(const Tracer *tracer, const Surface *surface, Vec light);

/* Whether a ray meets anything at all. */
bool trace_meets(const Tracer *tracer, Vec origin, Vec direction);

/* Embree asks for it, once per thread that traces: numbers too small to be normal count as zero. */
void trace_prepare_thread(void);
#endif
