#include "finish.h"

/* As POV-Ray's documentation has them: only the diffuse part knows how obliquely light falls. */
void finish_reflects(const Finish *finish, Vec normal, Vec view, Vec light, double radiance[3]) {
    const double n_v = vec_dot(normal, view), n_l = vec_dot(normal, light);
    for (int c = 0; c < 3; c++) radiance[c] = 0.0;
    if (n_v <= 0.0 || n_l <= 0.0) return;
    const Vec mirrored = vec_sub(vec_scale(normal, 2.0 * n_v), view);
    const double r_l = fmax(0.0, vec_dot(mirrored, light));
    const double n_h = fmax(0.0, vec_dot(normal, vec_unit(vec_add(view, light))));
    double highlight = 0.0;
    if (finish->phong > 0.0) highlight += finish->phong * pow(r_l, finish->phong_size);
    if (finish->specular > 0.0) highlight += finish->specular * pow(n_h, 1.0 / finish->roughness);
    for (int c = 0; c < 3; c++) radiance[c] = finish->diffuse[c] * n_l + highlight;
}
