#include "trace.h"

#include <rtcore.h>
#include <stdio.h>
#include <stdlib.h>
#ifdef __SSE2__
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

struct Tracer {
    const Scene *scene;
    RTCDevice device;
    RTCScene geometry;
};

/* The two versions differ in what goes with a ray. */
static void intersect(RTCScene geometry, struct RTCRayHit *query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(geometry, query, NULL);
#else
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(geometry, &context, query);
#endif
}

static void occluded(RTCScene geometry, struct RTCRay *ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(geometry, ray, NULL);
#else
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(geometry, &context, ray);
#endif
}

/* One geometry per mesh, its number in Embree being the mesh's. */
static bool attach_mesh(Tracer *tracer, const Mesh *mesh, unsigned number) {
    RTCGeometry geometry = rtcNewGeometry(tracer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float (*vertices)[3] = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof *vertices, mesh->vertex_count);
    unsigned (*triangles)[3] = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       sizeof *triangles, mesh->triangle_count);
    if (vertices && triangles) {
        for (size_t i = 0; i < mesh->vertex_count; i++) vec_to_floats(mesh->positions[i], vertices[i]);
        for (size_t i = 0; i < mesh->triangle_count; i++)
            for (int k = 0; k < 3; k++) triangles[i][k] = mesh->triangles[i][k];
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(tracer->geometry, geometry, number);
    }
    rtcReleaseGeometry(geometry);
    return vertices && triangles;
}

Tracer *tracer_new(const Scene *scene, char error[SCENE_ERROR_SIZE]) {
    Tracer *tracer = calloc(1, sizeof *tracer);
    bool ready = tracer != NULL;
    if (ready) {
        *tracer = (Tracer){.scene = scene, .device = rtcNewDevice(NULL)};
        ready = tracer->device != NULL;
    }
    if (ready) {
        tracer->geometry = rtcNewScene(tracer->device);
        rtcSetSceneFlags(tracer->geometry, RTC_SCENE_FLAG_ROBUST);
        for (size_t i = 0; ready && i < scene->mesh_count; i++)
            ready = attach_mesh(tracer, &scene->meshes[i], (unsigned)i);
        rtcCommitScene(tracer->geometry);
        ready = ready && rtcGetDeviceError(tracer->device) == RTC_ERROR_NONE;
    }
    if (ready) return tracer;
    snprintf(error, SCENE_ERROR_SIZE, "Embree could not be set up");
    tracer_free(tracer);
    return NULL;
}

void tracer_free(Tracer *tracer) {
    if (!tracer) return;
    if (tracer->geometry) rtcReleaseScene(tracer->geometry);
    if (tracer->device) rtcReleaseDevice(tracer->device);
    free(tracer);
}

static struct RTCRay ray_along(Vec origin, Vec direction, float far) {
    return (struct RTCRay){.org_x = (float)origin.x,
                           .org_y = (float)origin.y,
                           .org_z = (float)origin.z,
                           .dir_x = (float)direction.x,
                           .dir_y = (float)direction.y,
                           .dir_z = (float)direction.z,
                           .tfar = far,
                           .mask = ~0u};
}

bool trace_closest(const Tracer *tracer, Vec origin, Vec direction, Hit *hit) {
    struct RTCRayHit query = {.ray = ray_along(origin, direction, INFINITY)};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(tracer->geometry, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    *hit = (Hit){&tracer->scene->meshes[query.hit.geomID], query.hit.primID};
    return true;
}

Vec trace_off(const Surface *surface) {
    /* More than single precision can lose, and far less than anything that casts a shadow. */
    return vec_along(surface->position, 1e-4, surface->geometric);
}

bool trace_blocked(const Tracer *tracer, const Surface *surface, Vec light) {
    const Vec origin = trace_off(surface);
    struct RTCRay ray = ray_along(origin, vec_sub(light, origin), 0.999f);
    occluded(tracer->geometry, &ray);
    return ray.tfar < 0.0f;
}

bool trace_meets(const Tracer *tracer, Vec origin, Vec direction) {
    struct RTCRay ray = ray_along(origin, direction, INFINITY);
    occluded(tracer->geometry, &ray);
    return ray.tfar < 0.0f;
}

void trace_prepare_thread(void) {
#ifdef __SSE2__
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}
