#include "ggx.h"

#include <math.h>

static const float PI_F = 3.14159265f;

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static float lambda(float alpha2, float cosine) {
    const float square = cosine * cosine;
    return 0.5f * (sqrtf(1.0f + alpha2 * (1.0f - square) / square) - 1.0f);
}

void ggx_reflects(const StriaeBrdf *brdf, const float normal[3], const float view[3], const float light[3],
                  float f_cos[3]) {
    const float n_v = dot(normal, view), n_l = dot(normal, light);
    if (n_v <= 0.0f || n_l <= 0.0f) {
        f_cos[0] = f_cos[1] = f_cos[2] = 0.0f;
        return;
    }
    const float half[3] = {view[0] + light[0], view[1] + light[1], view[2] + light[2]};
    const float length = sqrtf(dot(half, half)), n_h = (n_v + n_l) / length, v_h = 0.5f * length;
    const float alpha2 = brdf->alpha * brdf->alpha, t = n_h * n_h * (alpha2 - 1.0f) + 1.0f;
    const float shown = 1.0f / (1.0f + lambda(alpha2, n_v) + lambda(alpha2, n_l));
    const float lobe = alpha2 / (PI_F * t * t) * shown / (4.0f * n_v);
    const float away = fmaxf(0.0f, 1.0f - v_h), square = away * away, fifth = square * square * away;
    for (int c = 0; c < 3; c++) f_cos[c] = lobe * (brdf->f0[c] + (1.0f - brdf->f0[c]) * fifth);
}
