/* GGX microfacets in a renderer's own single precision: what an unscratched metal costs. */
#ifndef BENCH_GGX_H
#define BENCH_GGX_H
#include <striae.h>

/* BRDF times the light's cosine: Smith's masking by the heights of both (Heitz 2014), Schlick's Fresnel reflectance. 0 where
   either direction is below the surface. Unit vectors away from it, in any one frame. */
void ggx_reflects(const StriaeBrdf *brdf, const float normal[3], const float view[3], const float light[3],
                  float f_cos[3]);
#endif
