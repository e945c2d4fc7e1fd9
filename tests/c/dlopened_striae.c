/* The calls that the renderer makes, and all questions to a shading point, passed on to a library that was opened at run time. */
#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <striae.h>

static void *library;

bool dlopened_striae_open(const char *path);

bool dlopened_striae_open(const char *path) {
    library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) printf("%s\n", dlerror());
    return library != NULL;
}

/* Defines a function that looks up its namesake once and passes on its arguments. */
#define FORWARD(result, name, parameters, arguments)                                                               \
    result name parameters {                                                                                       \
        static result(*call) parameters;                                                                           \
        if (!call) *(void **)(&call) = dlsym(library, #name);                                                      \
        return call arguments;                                                                                     \
    }
#define FORWARD_RELEASE(name, type)                                                                                \
    void name(type *object) {                                                                                      \
        static void (*call)(type *);                                                                               \
        if (!call) *(void **)(&call) = dlsym(library, #name);                                                      \
        call(object);                                                                                              \
    }

FORWARD(const char *, striae_last_error, (void), ())
FORWARD(StriaeStatus, striae_material_metal, (uint32_t metal, StriaeMaterial *material), (metal, material))
FORWARD(StriaeStatus, striae_tool_preset, (uint32_t preset, StriaeTool **tool), (preset, tool))
FORWARD(StriaeStatus, striae_pattern_builder_new,
        (const StriaeMaterial *surface, const StriaePatternOptions *options, StriaePatternBuilder **builder),
        (surface, options, builder))
FORWARD(StriaeStatus, striae_pattern_builder_add_scratch,
        (StriaePatternBuilder * builder, const StriaeScratch *scratch), (builder, scratch))
FORWARD(StriaeStatus, striae_pattern_builder_build, (const StriaePatternBuilder *builder, StriaePattern **pattern),
        (builder, pattern))
FORWARD(StriaeStatus, striae_frame, (const StriaePoint *point, StriaeFrame *frame), (point, frame))
FORWARD(StriaeStatus, striae_frame_to_local, (const StriaeFrame *frame, const float world[3], float local[3]),
        (frame, world, local))
FORWARD(StriaeStatus, striae_near,
        (const StriaePattern *pattern, const StriaePoint *point, const float view[3], uint32_t *is_near),
        (pattern, point, view, is_near))
FORWARD(StriaeStatus, striae_shade,
        (const StriaePattern *pattern, const StriaePoint *point, const float view[3], StriaeShading *shading),
        (pattern, point, view, shading))
FORWARD(StriaeStatus, striae_shade_world,
        (const StriaePattern *pattern, const StriaePoint *point, const float view[3], StriaeFrame *frame,
         StriaeShading *shading),
        (pattern, point, view, frame, shading))
FORWARD(StriaeStatus, striae_set_bounces, (StriaeShading * shading, uint32_t bounces), (shading, bounces))
FORWARD(StriaeStatus, striae_zones,
        (const StriaeShading *shading, const float light[3], StriaeZone *zones, size_t capacity, size_t *count),
        (shading, light, zones, capacity, count))
FORWARD(StriaeStatus, striae_eval, (const StriaeShading *shading, const float light[3], uint32_t flags, float f[3]),
        (shading, light, flags, f))
FORWARD(StriaeStatus, striae_eval_world,
        (const StriaeShading *shading, const StriaeFrame *frame, const float light[3], uint32_t flags, float f[3]),
        (shading, frame, light, flags, f))
FORWARD(StriaeStatus, striae_frame_to_world, (const StriaeFrame *frame, const float local[3], float world[3]),
        (frame, local, world))
FORWARD(StriaeStatus, striae_pattern_query,
        (const StriaePattern *pattern, const StriaePoint *point, StriaeHit *hits, size_t capacity,
         StriaeHitCount *count),
        (pattern, point, hits, capacity, count))
FORWARD(StriaeStatus, striae_brdf_host, (const StriaeHostBrdf *host, StriaeBrdf *brdf), (host, brdf))
FORWARD(StriaeStatus, striae_sample, (const StriaeShading *shading, const float u[3], StriaeSample *sample),
        (shading, u, sample))
FORWARD(StriaeStatus, striae_sample_world,
        (const StriaeShading *shading, const StriaeFrame *frame, const float u[3], StriaeSample *sample),
        (shading, frame, u, sample))
FORWARD(StriaeStatus, striae_pdf, (const StriaeShading *shading, const float light[3], float *pdf),
        (shading, light, pdf))
FORWARD(StriaeStatus, striae_pdf_reverse, (const StriaeShading *shading, const float light[3], float *pdf),
        (shading, light, pdf))
FORWARD(StriaeStatus, striae_eval_pdf,
        (const StriaeShading *shading, const float light[3], StriaeEvaluated *evaluated),
        (shading, light, evaluated))
FORWARD(StriaeStatus, striae_eval_pdf_world,
        (const StriaeShading *shading, const StriaeFrame *frame, const float light[3], StriaeEvaluated *evaluated),
        (shading, frame, light, evaluated))
FORWARD(StriaeStatus, striae_zone_brdf, (const StriaeShading *shading, uint32_t number, StriaeBrdf *brdf),
        (shading, number, brdf))
FORWARD(StriaeStatus, striae_parameters, (const StriaeShading *shading, StriaeParameters *parameters),
        (shading, parameters))
FORWARD(StriaeStatus, striae_roughness, (const StriaeShading *shading, float *roughness), (shading, roughness))
FORWARD(StriaeStatus, striae_albedo, (const StriaeShading *shading, float albedo[3]), (shading, albedo))
FORWARD(StriaeStatus, striae_lobes, (const StriaeShading *shading, uint32_t *lobes), (shading, lobes))
FORWARD_RELEASE(striae_tool_release, const StriaeTool)
FORWARD_RELEASE(striae_pattern_release, const StriaePattern)
FORWARD_RELEASE(striae_pattern_builder_free, StriaePatternBuilder)
