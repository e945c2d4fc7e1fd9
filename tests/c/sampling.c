/* Choosing lights, asking for densities, zones and a point's few numbers: as a renderer's author would, and as one who
   errs would. */
#include <math.h>

#include "plate_fixture.h"

enum { SAMPLES = 400, MOST_ZONES = 256 };

static StriaePattern *pattern;
static const float above[3] = {0.0f, 0.0f, 1.0f}, aside[3] = {0.5f, -0.3f, 0.8f};

/* A pixel three times as wide as the scratch in it, of a plate that stands upright in the world. */
static StriaePoint upright(void) {
    StriaePoint point = plate_point(0.15, 0.5, 0.6);
    const float u[3] = {0.0f, 60.0f, 0.0f}, v[3] = {0.0f, 0.0f, 40.0f}, n[3] = {1.0f, 0.0f, 0.0f};
    memcpy(point.dp_du, u, sizeof u);
    memcpy(point.dp_dv, v, sizeof v);
    memcpy(point.normal, n, sizeof n);
    return point;
}

static StriaeShading shaded(const StriaePoint *point, const float view[3]) {
    StriaeShading shading;
    EXPECT_OK(striae_shade(pattern, point, view, &shading));
    return shading;
}

static bool near(double a, double b, double tolerance) {
    return fabs(a - b) <= tolerance * fmax(fmax(fabs(a), fabs(b)), 1e-6);
}

static void numbers(int i, float u[3]) {
    const double steps[3] = {0.8191725, 0.6710436, 0.5497005};
    for (int k = 0; k < 3; k++) u[k] = (float)fmod(0.5 + i * steps[k], 1.0);
}

static void triple(void) {
    protects("a sample's density and weight are those that striae_pdf and striae_eval tell, in the world's frame too");
    const StriaePoint point = upright();
    const StriaeShading shading = shaded(&point, aside);
    StriaeFrame frame;
    EXPECT_OK(striae_frame(&point, &frame));
    int scratched = 0, chosen = 0;
    for (int i = 0; i < SAMPLES; i++) {
        float u[3], f[3], pdf, world[3];
        StriaeSample local, in_world;
        StriaeEvaluated both, both_in_world;
        numbers(i, u);
        EXPECT_OK(striae_sample(&shading, u, &local));
        EXPECT_OK(striae_sample_world(&shading, &frame, u, &in_world));
        if (local.pdf <= 0.0f) {
            EXPECT(in_world.pdf == local.pdf && local.weight[0] == 0.0f);
            continue;
        }
        chosen++;
        scratched += (local.lobe & STRIAE_LOBE_SCRATCH) != 0;
        EXPECT((local.lobe & STRIAE_LOBE_REFLECTION) && (local.lobe & STRIAE_LOBE_GLOSSY));
        EXPECT_OK(striae_pdf(&shading, local.light, &pdf));
        EXPECT_OK(striae_eval(&shading, local.light, 0, f));
        EXPECT_OK(striae_eval_pdf(&shading, local.light, &both));
        EXPECT_OK(striae_eval_pdf_world(&shading, &frame, in_world.light, &both_in_world));
        EXPECT_OK(striae_frame_to_world(&frame, local.light, world));
        EXPECT(near((double)pdf, (double)local.pdf, 1e-4) && near((double)both.pdf, (double)pdf, 1e-6));
        EXPECT(near((double)both_in_world.pdf, (double)pdf, 1e-3));
        for (int c = 0; c < 3; c++) {
            EXPECT(near((double)f[c], (double)local.weight[c] * (double)pdf, 1e-4));
            EXPECT(near((double)both.f[c], (double)f[c], 1e-6));
            EXPECT(fabsf(world[c] - in_world.light[c]) < 1e-6f);
        }
    }
    printf("  %d of %d numbers choose a light, %d from the scratch\n", chosen, SAMPLES, scratched);
    EXPECT(chosen > SAMPLES * 9 / 10 && scratched > SAMPLES / 10 && scratched < chosen);
}

static void in_world(void) {
    protects("shaded and evaluated in the world's frame a point is what it is in its own, and one without a normal is black");
    StriaePoint point = upright();
    const StriaeShading local = shaded(&point, aside);
    StriaeShading shading;
    StriaeFrame frame, same;
    float view[3], f[3], f_world[3];
    EXPECT_OK(striae_frame(&point, &frame));
    EXPECT_OK(striae_frame_to_world(&frame, aside, view));
    EXPECT_OK(striae_shade_world(pattern, &point, view, &same, &shading));
    EXPECT(memcmp(&frame, &same, sizeof frame) == 0);
    EXPECT(near((double)shading.coverage, (double)local.coverage, 1e-5) && shading.coverage > 0.1f);
    for (int i = 0; i < SAMPLES; i++) {
        float light[3], light_world[3];
        numbers(i, light);
        EXPECT_OK(striae_frame_to_world(&frame, light, light_world));
        EXPECT_OK(striae_eval(&local, light, 0, f));
        EXPECT_OK(striae_eval_world(&shading, &same, light_world, 0, f_world));
        for (int c = 0; c < 3; c++) EXPECT(near((double)f_world[c], (double)f[c], 1e-4));
    }
    memset(point.normal, 0, sizeof point.normal);
    EXPECT_REFUSED(striae_shade_world(pattern, &point, view, &same, &shading), "normal", "0");
    EXPECT_OK(striae_eval_world(&shading, &same, view, 0, f_world));
    EXPECT(f_world[0] == 0.0f && f_world[1] == 0.0f && f_world[2] == 0.0f && shading.coverage == 0.0f);
}

static void reverse(void) {
    protects("the reverse density is what the point prepared from the light's side says");
    const StriaePoint point = plate_point(0.15, 0.5, 0.2);
    const StriaeShading there = shaded(&point, aside), back = shaded(&point, above);
    float ours, truth;
    EXPECT_OK(striae_pdf_reverse(&there, above, &ours));
    EXPECT_OK(striae_pdf(&back, aside, &truth));
    EXPECT(truth > 0.0f && near((double)ours, (double)truth, 1e-3));
}

static void bounces(void) {
    protects("light from zone to zone is switched on and off, and adds what it should: a little");
    const StriaePoint point = plate_point(0.15, 0.5, 0.2);
    StriaeShading shading = shaded(&point, above);
    float one[3], all[3], again[3];
    EXPECT_OK(striae_eval(&shading, aside, 0, one));
    EXPECT_OK(striae_set_bounces(&shading, STRIAE_BOUNCES_ALL));
    EXPECT_OK(striae_eval(&shading, aside, 0, all));
    EXPECT_OK(striae_set_bounces(&shading, STRIAE_BOUNCES_ONE));
    EXPECT_OK(striae_eval(&shading, aside, 0, again));
    EXPECT(all[0] > one[0] && all[0] < 2.0f * one[0] + 0.1f && again[0] == one[0]);
    EXPECT_REFUSED(striae_set_bounces(&shading, 2), "bounces", "2");
}

static void zones(void) {
    protects("zones are counted, and name base BRDFs that are the material's");
    const StriaePoint point = plate_point(0.15, 0.5, 0.2);
    const StriaeShading shading = shaded(&point, above);
    static StriaeZone found[MOST_ZONES];
    size_t count = 0, few = 0;
    EXPECT_OK(striae_zones(&shading, aside, found, MOST_ZONES, &count));
    EXPECT(count > 4 && count < MOST_ZONES);
    EXPECT_OK(striae_zones(&shading, aside, NULL, 0, &few));
    EXPECT(few == count);
    double seen = 0.0;
    for (size_t i = 0; i < count; i++) {
        StriaeBrdf brdf;
        seen += (double)found[i].seen;
        EXPECT(found[i].lit >= 0.0f && found[i].lit <= found[i].seen * 1.0001f);
        EXPECT_OK(striae_zone_brdf(&shading, found[i].brdf, &brdf));
        EXPECT(brdf.kind == STRIAE_BRDF_KIND_GGX && brdf.fresnel == STRIAE_FRESNEL_KIND_CONDUCTOR);
        /* the scratch runs along u */
        if (i + 1 < count) EXPECT(fabsf(found[i].tangent[0]) > 0.999f);
    }
    EXPECT(near(seen, 1.0, 1e-4));
    EXPECT(found[count - 1].normal[2] == 1.0f);
    StriaeBrdf brdf;
    EXPECT_REFUSED(striae_zone_brdf(&shading, 99, &brdf), "number", "99");
}

static void numbers_of_a_point(void) {
    protects("a scratch along u looks like polishing lines along u, as rough along them as its zones; the plate is even");
    const StriaePoint point = plate_point(0.15, 0.5, 0.2), plain = plate_point(0.15, 0.2, 0.2);
    const StriaeShading shading = shaded(&point, above), unscratched = shaded(&plain, above);
    StriaeParameters parameters, even;
    StriaeBrdf brdf;
    float roughness, albedo[3];
    uint32_t lobes;
    EXPECT_OK(striae_parameters(&shading, &parameters));
    EXPECT_OK(striae_zone_brdf(&shading, 1, &brdf));
    EXPECT(parameters.coverage == shading.coverage);
    EXPECT(fminf(parameters.tangent_deg, 180.0f - parameters.tangent_deg) < 0.1f);
    EXPECT(near((double)parameters.alpha_along, (double)brdf.alpha, 1e-3));
    EXPECT(parameters.alpha_across > 2.0f * parameters.alpha_along && parameters.anisotropy > 0.5f);
    EXPECT_OK(striae_parameters(&unscratched, &even));
    EXPECT_OK(striae_zone_brdf(&unscratched, 0, &brdf));
    EXPECT(even.coverage == 0.0f && even.anisotropy < 1e-4f && near((double)even.roughness, (double)brdf.alpha, 1e-4));
    EXPECT_OK(striae_roughness(&unscratched, &roughness));
    EXPECT(near((double)roughness, (double)brdf.alpha, 1e-4));
    EXPECT_OK(striae_albedo(&unscratched, albedo));
    /* titanium: about a half */
    EXPECT(albedo[0] > 0.4f && albedo[0] < 0.7f);
    EXPECT_OK(striae_lobes(&shading, &lobes));
    EXPECT(lobes & STRIAE_LOBE_SCRATCH);
    EXPECT_OK(striae_lobes(&unscratched, &lobes));
    EXPECT((lobes & STRIAE_LOBE_REFLECTION) && !(lobes & STRIAE_LOBE_SCRATCH));
}

static void dark_sides(void) {
    protects("a view from below chooses nothing, and lights that are none have no density");
    const StriaePoint point = plate_point(0.15, 0.5, 0.2);
    const float below[3] = {0.0f, 0.6f, -0.8f}, nan_light[3] = {NAN, 0.0f, 1.0f}, u[3] = {0.2f, 0.4f, 0.6f};
    const StriaeShading dark = shaded(&point, below), shading = shaded(&point, above);
    StriaeSample sample;
    StriaeParameters parameters;
    StriaeEvaluated both;
    size_t count = 9;
    float pdf = -1.0f;
    uint32_t lobes = 9;
    EXPECT_OK(striae_sample(&dark, u, &sample));
    EXPECT(sample.pdf == 0.0f && sample.weight[0] == 0.0f && sample.lobe == 0);
    EXPECT_OK(striae_zones(&dark, above, NULL, 0, &count));
    EXPECT_OK(striae_lobes(&dark, &lobes));
    EXPECT(count == 0 && lobes == 0);
    EXPECT_OK(striae_parameters(&dark, &parameters));
    EXPECT(isfinite(parameters.roughness));
    EXPECT_OK(striae_eval_pdf(&shading, nan_light, &both));
    EXPECT_OK(striae_pdf_reverse(&shading, below, &pdf));
    EXPECT(both.pdf == 0.0f && both.f[1] == 0.0f && pdf == 0.0f);
    const float odd[3] = {NAN, INFINITY, -5.0f};
    EXPECT_OK(striae_sample(&shading, odd, &sample));
    EXPECT(isfinite(sample.pdf) && isfinite(sample.weight[0]));
}

static void null_arguments(void) {
    protects("NULL is answered in every place");
    const StriaePoint point = plate_point(0.15, 0.5, 0.2);
    StriaeShading shading = shaded(&point, above);
    StriaeFrame frame;
    StriaeSample sample;
    StriaeEvaluated both;
    StriaeZone zone;
    StriaeBrdf brdf;
    StriaeParameters parameters;
    size_t count;
    float out[3];
    uint32_t lobes;
    EXPECT_OK(striae_frame(&point, &frame));
    EXPECT_REFUSED(striae_set_bounces(NULL, 0), "shading", "NULL");
    EXPECT_REFUSED(striae_sample(NULL, above, &sample), "shading", "NULL");
    EXPECT_REFUSED(striae_sample(&shading, NULL, &sample), "u", "NULL");
    EXPECT_REFUSED(striae_sample(&shading, above, NULL), "sample", "NULL");
    EXPECT_REFUSED(striae_sample_world(NULL, &frame, above, &sample), "shading", "NULL");
    EXPECT_REFUSED(striae_sample_world(&shading, NULL, above, &sample), "frame", "NULL");
    EXPECT_REFUSED(striae_sample_world(&shading, &frame, NULL, &sample), "u", "NULL");
    EXPECT_REFUSED(striae_sample_world(&shading, &frame, above, NULL), "sample", "NULL");
    EXPECT_REFUSED(striae_pdf(NULL, above, out), "shading", "NULL");
    EXPECT_REFUSED(striae_pdf(&shading, NULL, out), "light", "NULL");
    EXPECT_REFUSED(striae_pdf(&shading, above, NULL), "pdf", "NULL");
    EXPECT_REFUSED(striae_pdf_reverse(NULL, above, out), "shading", "NULL");
    EXPECT_REFUSED(striae_pdf_reverse(&shading, NULL, out), "light", "NULL");
    EXPECT_REFUSED(striae_pdf_reverse(&shading, above, NULL), "pdf", "NULL");
    EXPECT_REFUSED(striae_eval_pdf(NULL, above, &both), "shading", "NULL");
    EXPECT_REFUSED(striae_eval_pdf(&shading, NULL, &both), "light", "NULL");
    EXPECT_REFUSED(striae_eval_pdf(&shading, above, NULL), "evaluated", "NULL");
    EXPECT_REFUSED(striae_eval_pdf_world(NULL, &frame, above, &both), "shading", "NULL");
    EXPECT_REFUSED(striae_eval_pdf_world(&shading, NULL, above, &both), "frame", "NULL");
    EXPECT_REFUSED(striae_eval_pdf_world(&shading, &frame, NULL, &both), "light", "NULL");
    EXPECT_REFUSED(striae_eval_pdf_world(&shading, &frame, above, NULL), "evaluated", "NULL");
    EXPECT_REFUSED(striae_zones(NULL, above, &zone, 1, &count), "shading", "NULL");
    EXPECT_REFUSED(striae_zones(&shading, NULL, &zone, 1, &count), "light", "NULL");
    EXPECT_REFUSED(striae_zones(&shading, above, NULL, 1, &count), "zones", "NULL");
    EXPECT_REFUSED(striae_zones(&shading, above, &zone, 1, NULL), "count", "NULL");
    EXPECT_REFUSED(striae_zone_brdf(NULL, 0, &brdf), "shading", "NULL");
    EXPECT_REFUSED(striae_zone_brdf(&shading, 0, NULL), "brdf", "NULL");
    EXPECT_REFUSED(striae_parameters(NULL, &parameters), "shading", "NULL");
    EXPECT_REFUSED(striae_parameters(&shading, NULL), "parameters", "NULL");
    EXPECT_REFUSED(striae_roughness(NULL, out), "shading", "NULL");
    EXPECT_REFUSED(striae_roughness(&shading, NULL), "roughness", "NULL");
    EXPECT_REFUSED(striae_albedo(NULL, out), "shading", "NULL");
    EXPECT_REFUSED(striae_albedo(&shading, NULL), "albedo", "NULL");
    EXPECT_REFUSED(striae_lobes(NULL, &lobes), "shading", "NULL");
    EXPECT_REFUSED(striae_lobes(&shading, NULL), "lobes", "NULL");
}

int main(void) {
    Plate plate;
    plate_init(&plate);
    pattern = plate_pattern(&plate);
    triple();
    in_world();
    reverse();
    bounces();
    zones();
    numbers_of_a_point();
    dark_sides();
    null_arguments();
    striae_pattern_release(pattern);
    striae_tool_release(plate.tool);
    return expect_summary();
}
