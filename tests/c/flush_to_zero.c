/* Embree asks its hosts to count denormal numbers as zero. Results must not change by it. */
#include <math.h>

#include "plate_fixture.h"

enum { SKIPPED = 77, POINTS = 24, VIEWS = 5, LIGHTS = 7, PER_LIGHT = 10,
       VALUES = POINTS * VIEWS * LIGHTS * PER_LIGHT };

#ifdef __SSE2__
#include <xmmintrin.h>

static void set_flush_to_zero(bool on) {
    const unsigned bits = 0x8040u; /* flush-to-zero and denormals-are-zero */
    _mm_setcsr(on ? _mm_getcsr() | bits : _mm_getcsr() & ~bits);
}

static void mode_works(void) {
    protects("the test's own switch: a denormal number vanishes");
    volatile float tiny = 1e-39f, one = 1.0f; /* volatile, or the compiler does the sums */
    set_flush_to_zero(true);
    volatile float flushed = tiny * one;
    set_flush_to_zero(false);
    volatile float kept = tiny * one;
    EXPECT(flushed == 0.0f && kept > 0.0f);
}

static void direction(int index, int count, float tilt_deg, double length, float out[3]) {
    const double azimuth = 6.283185307 * index / count, tilt = (double)tilt_deg * 3.14159265 / 180.0;
    out[0] = (float)(length * sin(tilt) * cos(azimuth));
    out[1] = (float)(length * sin(tilt) * sin(azimuth));
    out[2] = (float)(length * cos(tilt));
}

/* A light chosen: where, how often, and what it counts. */
static void sample(const StriaeShading *shading, int index, float values[5]) {
    const float u[3] = {(float)index / LIGHTS, 0.3f, 0.07f * (float)index};
    StriaeSample chosen;
    EXPECT_OK(striae_sample(shading, u, &chosen));
    for (int i = 0; i < 3; i++) values[i] = 1.0f + chosen.light[i]; /* 0 to 2: a component near 0 has few digits */
    values[3] = chosen.pdf;
    values[4] = chosen.weight[0];
}

/* Across the scratch and beyond its end, with footprints from a thousandth of its width to a hundred times it.
   `length` is that of the directions and the normal: any will do, even one whose square is no float. */
static void shade_all(const StriaePattern *pattern, double length, float values[VALUES]) {
    size_t next = 0;
    for (int p = 0; p < POINTS; p++) {
        const double side_mm = pow(10.0, -4.0 + p % 6);
        StriaePoint point = plate_point(0.1 + 0.05 * (p / 6), 0.5 + 0.0004 * (p % 5), side_mm);
        point.footprint = p % 4 == 3   ? STRIAE_FOOTPRINT_POINT
                          : p % 4 == 2 ? STRIAE_FOOTPRINT_RADIUS
                                       : STRIAE_FOOTPRINT_DIFFERENTIALS;
        point.normal[2] = (float)length;
        for (int v = 0; v < VIEWS; v++) {
            float view[3];
            StriaeShading shading;
            direction(v, VIEWS, 17.0f * (float)v, length, view);
            EXPECT_OK(striae_shade(pattern, &point, view, &shading));
            for (int l = 0; l < LIGHTS; l++, next += PER_LIGHT) {
                float light[3];
                direction(l, LIGHTS, 13.0f * (float)l, length, light);
                EXPECT_OK(striae_eval(&shading, light, 0, &values[next]));
                EXPECT_OK(striae_pdf(&shading, light, &values[next + 3]));
                EXPECT_OK(striae_pdf_reverse(&shading, light, &values[next + 4]));
                sample(&shading, l, &values[next + 5]);
            }
        }
    }
}

static void expect_same(const float *normal, const float *flushed) {
    double worst = 0.0;
    for (int i = 0; i < VALUES; i++) {
        const double a = (double)normal[i], b = (double)flushed[i];
        EXPECT(isfinite(a) && isfinite(b));
        worst = fmax(worst, fabs(a - b) / fmax(fabs(a), 1e-6));
    }
    printf("  worst relative difference of %d values: %.2g\n", VALUES, worst);
    EXPECT(worst <= 1e-4);
}

/* Every kind, as sharp as it may be, on the surface and in the scratch. */
static void all_base_brdfs(Plate *plate, float normal[VALUES], float flushed[VALUES]) {
    protects("so do sharp base BRDFs of every kind");
    const StriaeMaterial titanium = plate->titanium;
    const float white[3] = {1.0f, 1.0f, 1.0f};
    for (uint32_t kind = STRIAE_BRDF_KIND_LAMBERT; kind <= STRIAE_BRDF_KIND_ANISOTROPIC_GGX; kind++) {
        StriaeBrdf *brdf = &plate->titanium.scratched;
        if (kind == STRIAE_BRDF_KIND_LAMBERT) {
            EXPECT_OK(striae_brdf_lambert(white, brdf));
        } else if (kind == STRIAE_BRDF_KIND_OREN_NAYAR) {
            EXPECT_OK(striae_brdf_oren_nayar(white, 1.0f, brdf));
        } else if (kind == STRIAE_BRDF_KIND_PHONG) {
            EXPECT_OK(striae_brdf_phong(white, 100000.0f, brdf));
        } else {
            EXPECT_OK(striae_brdf_schlick(white, 0.001f, brdf));
            EXPECT(brdf->kind == STRIAE_BRDF_KIND_GGX && brdf->alpha_along == 0.001f);
            brdf->kind = kind;
            brdf->alpha_across = 0.5f;
        }
        EXPECT(brdf->kind == kind);
        plate->titanium.surface = *brdf;
        StriaePattern *pattern = plate_pattern(plate);
        shade_all(pattern, 1.0, normal);
        set_flush_to_zero(true);
        shade_all(pattern, 1.0, flushed);
        set_flush_to_zero(false);
        expect_same(normal, flushed);
        striae_pattern_release(pattern);
    }
    plate->titanium = titanium;
}

int main(void) {
    static float normal[VALUES], flushed[VALUES];
    Plate plate;
    plate_init(&plate);
    mode_works();

    protects("shading a pattern gives the same with denormals flushed");
    StriaePattern *pattern = plate_pattern(&plate);
    shade_all(pattern, 1.0, normal);
    set_flush_to_zero(true);
    shade_all(pattern, 1.0, flushed);
    expect_same(normal, flushed);
    striae_pattern_release(pattern);

    protects("so does a pattern that was built with denormals flushed");
    pattern = plate_pattern(&plate);
    shade_all(pattern, 1.0, flushed);
    expect_same(normal, flushed);

    protects("so do directions and normals of any length");
    shade_all(pattern, 1e-25, flushed);
    expect_same(normal, flushed);
    shade_all(pattern, 1e25, flushed);
    set_flush_to_zero(false);
    expect_same(normal, flushed);
    striae_pattern_release(pattern);

    all_base_brdfs(&plate, normal, flushed);
    striae_tool_release(plate.tool);
    return expect_summary();
}
#else
int main(void) {
    printf("this processor's switch is not known here\n");
    return SKIPPED;
}
#endif
