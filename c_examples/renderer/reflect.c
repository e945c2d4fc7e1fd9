#include "reflect.h"

/* A round shape's normal may look away from who sees one of its triangles: then the triangle's own counts. */
static const double LEAST_COSINE = 0.02;

static StriaePoint striae_point(const Surface *surface, Vec normal, const Ray *ray) {
    StriaePoint point = {.uv = {surface->uv[0], surface->uv[1]}, .footprint = STRIAE_FOOTPRINT_DIFFERENTIALS};
    Vec offsets[2];
    double across[2], down[2];
    vec_to_floats(surface->dp_du, point.dp_du);
    vec_to_floats(surface->dp_dv, point.dp_dv);
    vec_to_floats(normal, point.normal);
    ray_footprint(ray, surface, offsets);
    surface_to_uv(surface, offsets[0], across);
    surface_to_uv(surface, offsets[1], down);
    for (int axis = 0; axis < 2; axis++) {
        point.duv_dx[axis] = (float)across[axis];
        point.duv_dy[axis] = (float)down[axis];
    }
    return point;
}

void reflect_prepare(Reflector *reflector, const Surface *surface, const Ray *ray, uint32_t bounces) {
    const Vec view = vec_scale(ray->direction, -1.0);
    reflector->pattern = surface->mesh->pattern;
    reflector->geometric = surface->geometric;
    reflector->normal = vec_dot(view, surface->normal) > LEAST_COSINE ? surface->normal : surface->geometric;
    for (int c = 0; c < 3; c++) reflector->albedo[c] = surface->mesh->albedo[c];
    if (!reflector->pattern) return;
    const StriaePoint point = striae_point(surface, reflector->normal, ray);
    float world[3], local[3];
    vec_to_floats(view, world);
    striae_frame(&point, &reflector->frame);
    striae_frame_to_local(&reflector->frame, world, local);
    striae_shade(reflector->pattern, &point, local, &reflector->shading);
    striae_set_bounces(&reflector->shading, bounces);
}

static void matte_eval(const Reflector *reflector, Vec light, double f[3], double *pdf) {
    *pdf = fmax(0.0, vec_dot(reflector->normal, light)) / PI;
    for (int c = 0; c < 3; c++) f[c] = reflector->albedo[c] * *pdf;
}

void reflect_eval(const Reflector *reflector, Vec light, double f[3], double *pdf) {
    *pdf = f[0] = f[1] = f[2] = 0.0;
    if (vec_dot(reflector->geometric, light) <= 0.0) return;
    if (!reflector->pattern) {
        matte_eval(reflector, light, f, pdf);
        return;
    }
    StriaeEvaluated evaluated = {.pdf = 0.0f};
    float world[3];
    vec_to_floats(light, world);
    striae_eval_pdf_world(&reflector->shading, &reflector->frame, world, &evaluated);
    for (int c = 0; c < 3; c++) f[c] = (double)evaluated.f[c];
    *pdf = (double)evaluated.pdf;
}

/* As often as the cosine says: a point of the disc below the hemisphere, lifted up to it. */
static Vec matte_sample(const Reflector *reflector, double a, double b) {
    const Vec x = vec_aside(reflector->normal), y = vec_cross(reflector->normal, x);
    const double radius = sqrt(a), turn = 2.0 * PI * b;
    const Vec across = vec_along(vec_scale(x, radius * cos(turn)), radius * sin(turn), y);
    return vec_unit(vec_along(across, sqrt(1.0 - a), reflector->normal));
}

bool reflect_sample(const Reflector *reflector, const double u[3], Vec *light, double weight[3], double *pdf) {
    if (reflector->pattern) {
        const float numbers[3] = {(float)u[0], (float)u[1], (float)u[2]};
        StriaeSample sample = {.pdf = 0.0f};
        striae_sample_world(&reflector->shading, &reflector->frame, numbers, &sample);
        *light = vec_from_floats(sample.light);
        *pdf = (double)sample.pdf;
        for (int c = 0; c < 3; c++) weight[c] = (double)sample.weight[c];
    } else {
        double f[3];
        *light = matte_sample(reflector, u[1], u[2]);
        matte_eval(reflector, *light, f, pdf);
        for (int c = 0; c < 3; c++) weight[c] = reflector->albedo[c];
    }
    return *pdf > 0.0 && vec_dot(reflector->geometric, *light) > 0.0;
}
