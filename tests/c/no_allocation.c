/* The demo's own shading, over its own plate, allocates nothing: in a thread that has shaded before and in one
   that has not. Built twice: linked with the library, and with the library opened at run time, where a thread's
   first use of thread-local storage would allocate. */
#include <pthread.h>

#include "allocation_counter.h"
#include "expect.h"
#include "shade.h"

#ifdef STRIAE_LIBRARY
bool dlopened_striae_open(const char *path);
#endif

enum { WIDTH = 320, HEIGHT = 180 };

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

static void shade_in_fresh_thread(Shaded *shaded) {
    pthread_t thread;
    EXPECT(pthread_create(&thread, NULL, shade_view, shaded) == 0);
    pthread_join(thread, NULL);
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
    Scene scene;
    Shaded shaded = {0, 0, 0, 0};
#ifdef STRIAE_LIBRARY
    if (!EXPECT(dlopened_striae_open(STRIAE_LIBRARY))) return expect_summary();
#endif
    counter_counts();
    if (!EXPECT(scene_build(&scene, "plate", error))) return expect_summary();
    Tracer *tracer = tracer_new(&scene, error);
    if (!EXPECT(tracer != NULL)) return expect_summary();
    stage = (Stage){.scene = &scene, .view = &scene.views[0], .tracer = tracer};
    stage.camera = camera_for_view(&scene, stage.view, WIDTH, HEIGHT);
    stage.lights = lights_for_view(&scene, &stage.camera);

    protects("a fresh thread shades the demo's plate without an allocation");
    shade_in_fresh_thread(&shaded);
    expect_no_allocation(&shaded);
    protects("so does the main thread");
    shade_view(&shaded);
    expect_no_allocation(&shaded);
    protects("and a second fresh thread");
    shade_in_fresh_thread(&shaded);
    expect_no_allocation(&shaded);

    tracer_free(tracer);
    scene_free(&scene);
    return expect_summary();
}
