/* The demo's own shading, over its own plate, allocates nothing, and no question to a shading point does: in a thread
   that has shaded before and in one that has not. Built twice: linked with the library, and with the library opened at run time, where a thread's
   first use of thread-local storage would allocate. */
#include <pthread.h>

#include "allocation_counter.h"
#include "matt_host.h"
#include "plate_fixture.h"
#include "scenes/scenes.h"
#include "shade.h"

#ifdef STRIAE_LIBRARY
bool dlopened_striae_open(const char *path);
#endif

enum { WIDTH = 320, HEIGHT = 180, MOST_ZONES = 64 };

static Stage stage;

static void counter_counts(void) {
    protects("the counter itself: it sees malloc, calloc, realloc, posix_memalign, aligned_alloc and free");
    void *volatile memory; /* volatile, or the compiler may see that nobody needs them */
    void *aligned = NULL;
    allocation_counter_start();
    memory = malloc(10);
    memory = realloc(memory, 1000);
    free(memory);
    memory = calloc(10, 10);
    free(memory);
    const int failed = posix_memalign(&aligned, 64, 128);
    memory = aligned;
    free(memory);
    memory = aligned_alloc(64, 128);
    free(memory);
    EXPECT(allocation_counter_stop() == 9);
    EXPECT(!failed);

    protects("and the library's allocations too: building a tool counts");
    StriaeTool *tool = NULL;
    allocation_counter_start();
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, &tool));
    striae_tool_release(tool);
    EXPECT(allocation_counter_stop() >= 2);
}

typedef struct Shaded {
    size_t allocations, on_plate, lit, scratched;
} Shaded;

/* One view, every pixel's middle. */
static void *shade_view(void *user) {
    Shaded *shaded = user;
    *shaded = (Shaded){0, 0, 0, 0};
    allocation_counter_start();
    trace_prepare_thread();
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const Sample sample = {x + 0.5, y + 0.5, 1.0};
            double radiance[3];
            if (shade_sample(&stage, &sample, radiance) != stage.scene->judged_face) continue;
            shaded->on_plate++;
            shaded->lit += radiance[0] > 0.0;
            Label label;
            shade_label(&stage, &sample, &label);
            shaded->scratched += label.id > 0.0f;
        }
    }
    shaded->allocations = allocation_counter_stop();
    return NULL;
}

/* To be refused is an answer too. Where the library was opened at run time, the system makes room for a thread's first text. */
static size_t refusals(const StriaeShading *shading) {
#ifdef STRIAE_LIBRARY
    (void)shading;
    return 1;
#else
    StriaeBrdf brdf;
    return striae_zone_brdf(shading, 99, &brdf) == STRIAE_STATUS_INVALID_ARGUMENT;
#endif
}

/* Every question to a prepared point: how many answers there were, and light among them. */
static size_t ask(const StriaePoint *point, StriaeShading *shading) {
    const float aside[3] = {0.5f, -0.3f, 0.8f}, u[3] = {0.3f, 0.6f, 0.9f};
    StriaeFrame frame;
    StriaeSample sample, in_world;
    StriaeEvaluated both, both_in_world;
    StriaeZone zones[MOST_ZONES];
    StriaeBrdf brdf;
    StriaeParameters parameters;
    float f[3], pdf, reverse, roughness, albedo[3];
    uint32_t lobes;
    size_t count, answers = 0;
    answers += striae_frame(point, &frame) == STRIAE_STATUS_OK;
    for (uint32_t bounces = STRIAE_BOUNCES_ONE; bounces <= STRIAE_BOUNCES_ALL; bounces++) {
        answers += striae_set_bounces(shading, bounces) == STRIAE_STATUS_OK;
        answers += striae_eval(shading, aside, STRIAE_EVAL_BRDF_ONLY, f) == STRIAE_STATUS_OK && f[0] > 0.0f;
        answers += striae_eval_world(shading, &frame, aside, 0, f) == STRIAE_STATUS_OK;
        answers += striae_sample(shading, u, &sample) == STRIAE_STATUS_OK;
        answers += striae_sample_world(shading, &frame, u, &in_world) == STRIAE_STATUS_OK;
        answers += striae_eval_pdf(shading, aside, &both) == STRIAE_STATUS_OK && both.pdf > 0.0f;
        answers += striae_eval_pdf_world(shading, &frame, aside, &both_in_world) == STRIAE_STATUS_OK;
    }
    answers += striae_pdf(shading, aside, &pdf) == STRIAE_STATUS_OK && pdf > 0.0f;
    answers += striae_pdf_reverse(shading, aside, &reverse) == STRIAE_STATUS_OK && reverse > 0.0f;
    answers += striae_zones(shading, aside, zones, MOST_ZONES, &count) == STRIAE_STATUS_OK && count > 0;
    answers += striae_zone_brdf(shading, zones[0].brdf, &brdf) == STRIAE_STATUS_OK;
    answers += striae_parameters(shading, &parameters) == STRIAE_STATUS_OK;
    answers += striae_roughness(shading, &roughness) == STRIAE_STATUS_OK && roughness > 0.0f;
    answers += striae_albedo(shading, albedo) == STRIAE_STATUS_OK && albedo[0] > 0.0f;
    answers += striae_lobes(shading, &lobes) == STRIAE_STATUS_OK && lobes != 0;
    return answers + refusals(shading);
}

enum { ANSWERS = 24 };

/* One scratch of the library's own base BRDFs, and one of the host's. */
static StriaePattern *asked[2];

typedef struct Asked {
    size_t allocations, points, answers;
} Asked;

/* Points on the scratch and beside it, from pixels within it to such as hold it whole. */
static void *ask_everything(void *user) {
    Asked *sum = user;
    *sum = (Asked){0, 0, 0};
    allocation_counter_start();
    for (int i = 0; i < 60; i++) {
        const StriaePoint point = plate_point(0.15, 0.5 + 0.0005 * (i % 6), 0.02 * (1 + i % 10));
        const float view[3] = {0.1f * (float)(i % 7), 0.2f, 1.0f};
        StriaeShading shading;
        sum->points += striae_shade(asked[i % 2], &point, view, &shading) == STRIAE_STATUS_OK;
        sum->answers += ask(&point, &shading);
    }
    sum->allocations = allocation_counter_stop();
    return NULL;
}

static void in_fresh_thread(void *(*run)(void *), void *user) {
    pthread_t thread;
    EXPECT(pthread_create(&thread, NULL, run, user) == 0);
    pthread_join(thread, NULL);
}

static void expect_only_answers(const Asked *sum) {
    printf("  %zu points, %zu answers, %zu allocations\n", sum->points, sum->answers, sum->allocations);
    EXPECT(sum->points == 60 && sum->answers == 60 * ANSWERS);
    EXPECT(sum->allocations == 0);
}

static void every_question(void) {
    static float albedo[3] = {0.8f, 0.5f, 0.2f};
    const StriaeHostBrdf host = matt(albedo);
    Plate plate;
    Asked sum = {0, 0, 0};
    plate_init(&plate);
    asked[0] = plate_pattern(&plate);
    EXPECT_OK(striae_brdf_host(&host, &plate.titanium.scratched));
    plate.titanium.surface = plate.titanium.scratched;
    asked[1] = plate_pattern(&plate);
    protects("a fresh thread asks prepared points for all that they can tell without an allocation");
    in_fresh_thread(ask_everything, &sum);
    expect_only_answers(&sum);
    protects("so does the main thread");
    ask_everything(&sum);
    expect_only_answers(&sum);
    for (int i = 0; i < 2; i++) striae_pattern_release(asked[i]);
    striae_tool_release(plate.tool);
}

static void expect_no_allocation(const Shaded *shaded) {
    printf("  %zu points on the plate, %zu lit, %zu scratched, %zu allocations\n", shaded->on_plate, shaded->lit,
           shaded->scratched, shaded->allocations);
    EXPECT(shaded->on_plate > WIDTH * HEIGHT / 10);
    EXPECT(shaded->lit == shaded->on_plate);
    EXPECT(shaded->scratched > 100);
    EXPECT(shaded->allocations == 0);
}

int main(void) {
    char error[SCENE_ERROR_SIZE];
    Scene scene = {.name = "plate"};
    Shaded shaded = {0, 0, 0, 0};
#ifdef STRIAE_LIBRARY
    if (!EXPECT(dlopened_striae_open(STRIAE_LIBRARY))) return expect_summary();
#endif
    counter_counts();
    every_question();
    if (!EXPECT(scene_plate(&scene, error))) return expect_summary();
    Tracer *tracer = tracer_new(&scene, error);
    if (!EXPECT(tracer != NULL)) return expect_summary();
    stage = (Stage){.scene = &scene, .view = &scene.views[0], .tracer = tracer};
    stage.camera = camera_for_view(&scene, stage.view, WIDTH, HEIGHT);
    stage.lights = scene_lights(&scene, &stage.camera);

    protects("a fresh thread shades the demo's plate without an allocation");
    in_fresh_thread(shade_view, &shaded);
    expect_no_allocation(&shaded);
    protects("so does the main thread");
    shade_view(&shaded);
    expect_no_allocation(&shaded);
    protects("and a second fresh thread");
    in_fresh_thread(shade_view, &shaded);
    expect_no_allocation(&shaded);

    tracer_free(tracer);
    scene_free(&scene);
    return expect_summary();
}
