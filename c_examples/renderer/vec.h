/* Vectors in double precision: a pixel's footprint is a small difference of large positions. */
#ifndef RENDERER_VEC_H
#define RENDERER_VEC_H
#include <math.h>

#define PI 3.14159265358979323846

typedef struct Vec {
    double x, y, z;
} Vec;

static inline Vec vec(double x, double y, double z) { return (Vec){x, y, z}; }
static inline Vec vec_add(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec vec_sub(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec vec_scale(Vec a, double s) { return vec(a.x * s, a.y * s, a.z * s); }
/* a + s b */
static inline Vec vec_along(Vec a, double s, Vec b) { return vec_add(a, vec_scale(b, s)); }
static inline double vec_dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double vec_length(Vec a) { return sqrt(vec_dot(a, a)); }
static inline Vec vec_unit(Vec a) { return vec_scale(a, 1.0 / vec_length(a)); }
static inline Vec vec_cross(Vec a, Vec b) {
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
/* What of a is at right angles to the unit vector b. */
static inline Vec vec_across(Vec a, Vec b) { return vec_along(a, -vec_dot(a, b), b); }
static inline double radians(double degrees) { return degrees * (PI / 180.0); }

/* Any unit vector at right angles to the unit vector a. */
static inline Vec vec_aside(Vec a) {
    return vec_unit(vec_across(fabs(a.z) < 0.8 ? vec(0.0, 0.0, 1.0) : vec(1.0, 0.0, 0.0), a));
}

/* For the float arrays that Embree and striae take. */
static inline void vec_to_floats(Vec a, float out[3]) {
    out[0] = (float)a.x;
    out[1] = (float)a.y;
    out[2] = (float)a.z;
}
static inline Vec vec_from_floats(const float a[3]) { return vec((double)a[0], (double)a[1], (double)a[2]); }
#endif
