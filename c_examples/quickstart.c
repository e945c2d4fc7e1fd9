/* One scratch, one shading point, a few lights.
 *
 *     cc -std=c11 quickstart.c $(pkg-config --cflags --libs striae) -lm -o quickstart
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <striae.h>

/* Every fallible call returns a status; the text says which argument, what was given, what is accepted. */
static void check(StriaeStatus status) {
    if (status != STRIAE_STATUS_OK) {
        fprintf(stderr, "striae: %s\n", striae_last_error());
        exit(EXIT_FAILURE);
    }
}

/* A diamond cone drawn once across a titanium plate, pressing less and less: 4 kgf down to 0.5 kgf. */
static StriaePattern *scratched_plate(void) {
    StriaeTool *tool = NULL;
    StriaeMaterial titanium = {.struct_size = sizeof titanium};
    StriaePatternOptions options = {sizeof options, 1.0, {60.0, 40.0}}; /* 1 unit = 1 mm, 60 x 40 mm */
    StriaePatternBuilder *builder = NULL;
    StriaePattern *pattern = NULL;

    check(striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &tool));
    check(striae_material_metal(STRIAE_METAL_TITANIUM, &titanium));

    const double path_uv[2][2] = {{0.1, 0.5}, {0.9, 0.5}};
    const StriaeKey keys[2] = {{.at = 0.0, .force_kgf = 4.0}, {.at = 1.0, .force_kgf = 0.5}};
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = tool,
                                   .curve = STRIAE_CURVE_POLYLINE,
                                   .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                                   .points_uv = path_uv,
                                   .point_count = 2,
                                   .keys = keys,
                                   .key_count = 2};
    check(striae_pattern_builder_new(&titanium, &options, &builder));
    check(striae_pattern_builder_add_scratch(builder, &scratch));
    check(striae_pattern_builder_build(builder, &pattern));
    striae_pattern_builder_free(builder);
    striae_tool_release(tool); /* the pattern keeps what it needs */
    return pattern;
}

int main(void) {
    StriaePattern *pattern = scratched_plate();

    /* A pixel 0.5 mm wide on the scratch, near its strong end. The plate lies in the world's x-y plane. */
    const StriaePoint point = {.uv = {0.15, 0.5},
                               .dp_du = {60.0f, 0.0f, 0.0f},
                               .dp_dv = {0.0f, 40.0f, 0.0f},
                               .normal = {0.0f, 0.0f, 1.0f},
                               .footprint = STRIAE_FOOTPRINT_DIFFERENTIALS,
                               .duv_dx = {0.5f / 60.0f, 0.0f},
                               .duv_dy = {0.0f, 0.5f / 40.0f}};
    /* Local frame: x along dP/du, z the normal. Both directions point away from the surface. */
    const float view[3] = {0.0f, 0.0f, 1.0f};
    StriaeShading shading; /* plain data on this stack: nothing to free, and nothing below can fail */
    check(striae_shade(pattern, &point, view, &shading));
    printf("%u scratch in the pixel, covering %.0f %% of it\n", (unsigned)shading.scratch_count,
           100.0 * (double)shading.coverage);

    for (int degrees = -60; degrees <= 60; degrees += 30) {
        const double angle = degrees * 3.14159265358979 / 180.0;
        const float light[3] = {0.0f, (float)sin(angle), (float)cos(angle)};
        float f[3]; /* BRDF times the light's cosine, red, green and blue */
        check(striae_eval(&shading, light, 0, f));
        printf("light at %+3d degrees: %.4f %.4f %.4f\n", degrees, (double)f[0], (double)f[1], (double)f[2]);
    }
    striae_pattern_release(pattern);
    return EXIT_SUCCESS;
}
