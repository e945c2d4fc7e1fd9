#include "facet.h"

bool facet_knows(const StriaeBrdf *brdf) {
    return brdf->kind == STRIAE_BRDF_KIND_LAMBERT ||
           (brdf->kind == STRIAE_BRDF_KIND_GGX && brdf->fresnel == STRIAE_FRESNEL_KIND_SCHLICK);
}

/* Walter et al. 2007, equation 33. */
static double ggx_density(double alpha, double cosine) {
    const double square = cosine * cosine, t = square * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (PI * t * t);
}

/* Heitz 2014, equations 72 and 99: what microfacets hide of view and light, told by their heights together. */
static double smith_lambda(double alpha, double cosine) {
    const double tan2 = 1.0 / (cosine * cosine) - 1.0;
    return 0.5 * (sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

static double schlick(double f0, double cosine) { return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0); }

void facet_reflects(const StriaeBrdf *brdf, Vec normal, Vec view, Vec light, double f_cos[3]) {
    const double n_v = vec_dot(normal, view), n_l = vec_dot(normal, light);
    for (int c = 0; c < 3; c++) f_cos[c] = 0.0;
    if (n_v <= 0.0 || n_l <= 0.0) return;
    if (brdf->kind == STRIAE_BRDF_KIND_LAMBERT) {
        for (int c = 0; c < 3; c++) f_cos[c] = (double)brdf->albedo[c] * n_l / PI;
        return;
    }
    const double alpha = (double)brdf->alpha;
    const Vec half = vec_unit(vec_add(view, light));
    const double shown = 1.0 / (1.0 + smith_lambda(alpha, n_v) + smith_lambda(alpha, n_l));
    const double lobe = ggx_density(alpha, vec_dot(normal, half)) * shown / (4.0 * n_v);
    for (int c = 0; c < 3; c++) f_cos[c] = lobe * schlick((double)brdf->f0[c], vec_dot(view, half));
}

/* Any two unit vectors at right angles to a third and to each other. */
static void tangents(Vec normal, Vec *x, Vec *y) {
    const Vec aside = fabs(normal.z) < 0.9 ? vec(0.0, 0.0, 1.0) : vec(1.0, 0.0, 0.0);
    *x = vec_unit(vec_cross(aside, normal));
    *y = vec_cross(normal, *x);
}

static Vec about(Vec normal, double cosine, double azimuth) {
    Vec x, y;
    tangents(normal, &x, &y);
    const double sine = sqrt(fmax(0.0, 1.0 - cosine * cosine));
    return vec_along(vec_along(vec_scale(normal, cosine), sine * cos(azimuth), x), sine * sin(azimuth), y);
}

bool facet_sample(const StriaeBrdf *brdf, Vec normal, Vec view, double a, double b, Vec *light, double weight[3]) {
    const double azimuth = 2.0 * PI * b;
    double density;
    if (brdf->kind == STRIAE_BRDF_KIND_LAMBERT) {
        *light = about(normal, sqrt(1.0 - a), azimuth);
        density = vec_dot(normal, *light) / PI;
    } else {
        const double alpha = (double)brdf->alpha;
        const Vec half = about(normal, sqrt((1.0 - a) / (1.0 + (alpha * alpha - 1.0) * a)), azimuth);
        const double v_h = vec_dot(view, half), n_h = vec_dot(normal, half);
        if (v_h <= 0.0) return false;
        *light = vec_sub(vec_scale(half, 2.0 * v_h), view);
        density = ggx_density(alpha, n_h) * n_h / (4.0 * v_h);
    }
    if (vec_dot(normal, *light) <= 1e-9 || density <= 0.0) return false;
    facet_reflects(brdf, normal, view, *light, weight);
    for (int c = 0; c < 3; c++) weight[c] /= density;
    return true;
}
