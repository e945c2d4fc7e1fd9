/* How a facet reflects, in formulas of this program's own: the library's are what is to be compared with. */
#ifndef COMPARE_FACET_H
#define COMPARE_FACET_H
#include <stdbool.h>
#include <striae.h>

#include "vec.h"

/* False for a base BRDF that this program does not know: it has Lambert, and GGX with Schlick's Fresnel reflectance. */
bool facet_knows(const StriaeBrdf *brdf);

/* BRDF times the light's cosine; 0 where either direction is below the facet. Unit vectors away from the facet. */
void facet_reflects(const StriaeBrdf *brdf, Vec normal, Vec view, Vec light, double f_cos[3]);

/* A direction to go on in, by two numbers in [0,1), and what BRDF times cosine is over its density. False where it
   leads below the facet. */
bool facet_sample(const StriaeBrdf *brdf, Vec normal, Vec view, double a, double b, Vec *light, double weight[3]);
#endif
