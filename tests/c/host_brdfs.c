/* Base BRDFs of the host's own: three functions that the library calls wherever a zone has them. */
#include "matt_host.h"
#include "plate_fixture.h"

static const char *const PATH = "host-brdfs-test.striae.cache";
static const float above[3] = {0.0f, 0.0f, 1.0f}, aside[3] = {0.5f, -0.3f, 0.8f};

static Plate plate;

static void no_sample(void *user, const float *u, const float *view, float *light) {
    (void)user, (void)u, (void)view, (void)light;
}

static float red[3] = {0.8f, 0.2f, 0.1f}, green[3] = {0.1f, 0.7f, 0.3f}, blue[3] = {0.1f, 0.2f, 0.6f};

/* A plate painted red, its paint green in section and the ground blue: the library's own, or the host's. */
static StriaePattern *painted(bool own) {
    Plate copy = plate;
    const float *colours[3] = {red, green, blue};
    StriaeBrdf brdfs[3];
    for (int i = 0; i < 3; i++) {
        if (own) {
            /* gone after the call: what was filled in stays */
            const StriaeHostBrdf host = matt((float *[]){red, green, blue}[i]);
            EXPECT_OK(striae_brdf_host(&host, &brdfs[i]));
        } else {
            EXPECT_OK(striae_brdf_lambert(colours[i], &brdfs[i]));
        }
    }
    const StriaeLayer paint = {.thickness_mm = 0.005, .scratched = brdfs[1]};
    copy.titanium.surface = brdfs[0];
    copy.titanium.scratched = brdfs[2];
    copy.titanium.layers = &paint;
    copy.titanium.layer_count = 1;
    copy.scratch.points_uv = (const double (*)[2])copy.path_uv;
    copy.scratch.keys = copy.keys;
    return plate_pattern(&copy);
}

static void expect_near(const float *a, const float *b, int count) {
    for (int i = 0; i < count; i++) {
        if (!EXPECT(fabsf(a[i] - b[i]) <= 1e-5f * fmaxf(1.0f, fabsf(b[i]))))
            printf("    %g, not %g\n", (double)a[i], (double)b[i]);
    }
}

static void same_as_built_in(void) {
    protects("Lambert's base BRDF as the host's reflects, is chosen and has densities as the library's own");
    StriaePattern *theirs = painted(false), *ours = painted(true);
    for (int i = 0; i < 8; i++) {
        const double v = 0.5 + 0.002 * (i % 4);
        StriaeShading a = plate_shading(theirs, 0.15, v), b = plate_shading(ours, 0.15, v);
        for (uint32_t bounces = STRIAE_BOUNCES_ONE; bounces <= STRIAE_BOUNCES_ALL; bounces++) {
            StriaeEvaluated told[2];
            StriaeSample samples[2];
            float reverse[2], albedo[2][3];
            const float u[3] = {0.11f * (float)i, 0.37f, 0.73f};
            EXPECT_OK(striae_set_bounces(&a, bounces));
            EXPECT_OK(striae_set_bounces(&b, bounces));
            EXPECT_OK(striae_eval_pdf(&a, aside, &told[0]));
            EXPECT_OK(striae_eval_pdf(&b, aside, &told[1]));
            EXPECT(told[1].f[0] > 0.0f && told[1].f[2] > 0.0f);
            expect_near(told[1].f, told[0].f, 3);
            expect_near(&told[1].pdf, &told[0].pdf, 1);
            EXPECT_OK(striae_pdf_reverse(&a, aside, &reverse[0]));
            EXPECT_OK(striae_pdf_reverse(&b, aside, &reverse[1]));
            expect_near(&reverse[1], &reverse[0], 1);
            EXPECT_OK(striae_sample(&a, u, &samples[0]));
            EXPECT_OK(striae_sample(&b, u, &samples[1]));
            expect_near(samples[1].light, samples[0].light, 3);
            expect_near(samples[1].weight, samples[0].weight, 3);
            EXPECT(samples[1].lobe == samples[0].lobe && (samples[1].lobe & STRIAE_LOBE_DIFFUSE));
            EXPECT_OK(striae_albedo(&a, albedo[0]));
            EXPECT_OK(striae_albedo(&b, albedo[1]));
            for (int c = 0; c < 3; c++) EXPECT(fabsf(albedo[1][c] - albedo[0][c]) < 1e-3f);
        }
    }
    striae_pattern_release(theirs);
    striae_pattern_release(ours);
}

static void zones_name_it(void) {
    protects("zones tell the table that they reflect by, and all three are there");
    StriaePattern *pattern = painted(true);
    const StriaeShading shading = plate_shading(pattern, 0.15, 0.5);
    bool found[3] = {false, false, false};
    for (uint32_t i = 0; i < 3; i++) {
        StriaeBrdf brdf;
        EXPECT_OK(striae_zone_brdf(&shading, i, &brdf));
        EXPECT(brdf.kind == STRIAE_BRDF_KIND_HOST && brdf.host != NULL);
        EXPECT(brdf.host->eval == matt_eval && brdf.host->struct_size == sizeof(StriaeHostBrdf));
        const float *users[3] = {red, green, blue};
        for (int k = 0; k < 3; k++) found[k] |= brdf.host->user == users[k];
        /* what is told can be given again */
        Plate copy = plate;
        copy.titanium.surface = brdf;
        striae_pattern_builder_free(plate_builder(&copy));
    }
    EXPECT(found[0] && found[1] && found[2]);
    striae_pattern_release(pattern);
}

static void saved(void) {
    protects("a saved pattern is opened with the tables, and refused without");
    StriaePattern *pattern = painted(true), *opened = NULL;
    const StriaeShading before = plate_shading(pattern, 0.15, 0.5);
    float truth[3];
    EXPECT_OK(striae_eval(&before, aside, 0, truth));
    if (EXPECT(striae_pattern_save(pattern, PATH) == STRIAE_STATUS_OK)) {
        const StriaeHostBrdf hosts[3] = {matt(red), matt(blue), matt(green)};
        StriaeHostBrdf bad[3] = {matt(red), matt(blue), matt(green)};
        EXPECT(striae_pattern_open(PATH, 0, &opened) == STRIAE_STATUS_FILE && opened == NULL);
        EXPECT(strstr(striae_last_error(), "has 3 base BRDFs of the host's own") != NULL);
        EXPECT(striae_pattern_open_with(PATH, 0, hosts, 2, &opened) == STRIAE_STATUS_FILE && opened == NULL);
        bad[1].pdf = NULL;
        EXPECT_REFUSED(striae_pattern_open_with(PATH, 0, bad, 3, &opened), "hosts[1].pdf", "NULL");
        EXPECT_REFUSED(striae_pattern_open_with(PATH, 0, NULL, 3, &opened), "hosts", "NULL");
        for (uint32_t verify = 0; verify < 2; verify++) {
            float f[3];
            EXPECT_OK(striae_pattern_open_with(PATH, verify, hosts, 3, &opened));
            const StriaeShading after = plate_shading(opened, 0.15, 0.5);
            EXPECT_OK(striae_eval(&after, aside, 0, f));
            EXPECT(f[0] == truth[0] && f[1] == truth[1] && f[2] == truth[2]);
            striae_pattern_release(opened);
        }
        remove(PATH);
    }
    striae_pattern_release(pattern);
}

static void samples_may_fail(void) {
    protects("a sample that chooses no light is black");
    StriaeHostBrdf host = matt(red);
    host.sample = no_sample;
    Plate copy = plate;
    EXPECT_OK(striae_brdf_host(&host, &copy.titanium.surface));
    StriaePattern *pattern = plate_pattern(&copy);
    const StriaeShading shading = plate_shading(pattern, 0.5, 0.9);
    StriaeSample sample;
    EXPECT_OK(striae_sample(&shading, (const float[3]){0.5f, 0.5f, 0.5f}, &sample));
    EXPECT(sample.pdf == 0.0f && sample.weight[0] == 0.0f);
    striae_pattern_release(pattern);
}

#define EXPECT_BAD_TABLE(change, argument, value)                                                                  \
    do {                                                                                                           \
        StriaeHostBrdf host = matt(red);                                                                           \
        StriaeBrdf brdf;                                                                                           \
        change;                                                                                                    \
        EXPECT_REFUSED(striae_brdf_host(&host, &brdf), argument, value);                                           \
        Plate copy = plate;                                                                                        \
        StriaePatternBuilder *builder = NULL;                                                                      \
        copy.titanium.scratched.kind = STRIAE_BRDF_KIND_HOST;                                                      \
        copy.titanium.scratched.host = &host;                                                                      \
        EXPECT_REFUSED(striae_pattern_builder_new(&copy.titanium, &copy.options, &builder), argument, value);      \
    } while (0)

static void refused(void) {
    protects("tables without their functions, or with numbers out of range, are refused by name");
    EXPECT_BAD_TABLE(host.eval = NULL, "eval", "NULL");
    EXPECT_BAD_TABLE(host.sample = NULL, "sample", "NULL");
    EXPECT_BAD_TABLE(host.pdf = NULL, "pdf", "NULL");
    EXPECT_BAD_TABLE(host.struct_size = 8, "struct_size", "8");
    EXPECT_BAD_TABLE(host.lobe = STRIAE_LOBE_SHARP, "lobe", "8");
    EXPECT_BAD_TABLE(host.alpha_across = 0.0f, "alpha_across", "0");
    EXPECT_BAD_TABLE(host.alpha_along = NAN, "alpha_along", "NaN");
    StriaeBrdf brdf;
    const StriaeHostBrdf host = matt(red);
    EXPECT_REFUSED(striae_brdf_host(NULL, &brdf), "host", "NULL");
    EXPECT_REFUSED(striae_brdf_host(&host, NULL), "brdf", "NULL");
    Plate copy = plate;
    StriaePatternBuilder *builder = NULL;
    copy.titanium.surface.kind = STRIAE_BRDF_KIND_HOST;
    EXPECT_REFUSED(striae_pattern_builder_new(&copy.titanium, &copy.options, &builder), "brdf.host", "NULL");
}

static void below_is_black(void) {
    protects("views from below ask the host nothing, and are black");
    StriaePattern *pattern = painted(true);
    const StriaePoint point = plate_point(0.15, 0.5, 0.2);
    const float below[3] = {0.0f, 0.3f, -0.9f};
    StriaeShading shading;
    float f[3];
    EXPECT_OK(striae_shade(pattern, &point, below, &shading));
    EXPECT_OK(striae_eval(&shading, above, 0, f));
    EXPECT(f[0] == 0.0f && f[1] == 0.0f && f[2] == 0.0f);
    striae_pattern_release(pattern);
}

int main(void) {
    plate_init(&plate);
    same_as_built_in();
    zones_name_it();
    saved();
    samples_may_fail();
    refused();
    below_is_black();
    striae_tool_release(plate.tool);
    return expect_summary();
}
