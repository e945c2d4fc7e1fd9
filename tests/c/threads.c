/* One pattern, many threads: retained and released by all, shaded, sampled and queried by all, the same numbers in each; its
   scratch reflects by a base BRDF of the host's own, which all call at once.
   Takes the number of rounds; fewer do where a race detector watches. */
#include <pthread.h>

#include "matt_host.h"
#include "plate_fixture.h"

enum { THREADS = 4 };

static StriaePattern *pattern;
static int rounds = 2000;

static void *shade_often(void *user) {
    float *sum = user;
    for (int i = 0; i < rounds; i++) {
        striae_pattern_retain(pattern);
        const StriaePoint point = plate_point(0.1 + 0.8 * i / rounds, 0.5, 0.2);
        const float view[3] = {0.0f, 0.6f, 0.8f}, light[3] = {0.0f, -0.28f, 0.96f};
        StriaeShading shading;
        float f[3] = {0.0f, 0.0f, 0.0f};
        if (striae_shade(pattern, &point, view, &shading) == STRIAE_STATUS_OK &&
            striae_eval(&shading, light, 0, f) == STRIAE_STATUS_OK)
            *sum += f[0];
        const float u[3] = {(float)i / (float)rounds, 0.4f, 0.7f};
        StriaeSample sample;
        if (striae_sample(&shading, u, &sample) == STRIAE_STATUS_OK) *sum += sample.weight[0] + sample.pdf;
        StriaeHit hits[2];
        StriaeHitCount count;
        if (striae_pattern_query(pattern, &point, hits, 2, &count) == STRIAE_STATUS_OK && count.written == 1)
            *sum += hits[0].coverage + (float)hits[0].arc_length;
        striae_pattern_release(pattern);
    }
    return NULL;
}

static void *fail_with_minus_three(void *user) {
    StriaeTool *tool = NULL;
    EXPECT_REFUSED(striae_tool_wedge(-3.0, 60.0, 1.0, &tool), "width_mm", "-3");
    (void)user;
    return NULL;
}

int main(int argc, char **argv) {
    Plate plate;
    pthread_t threads[THREADS];
    float sums[THREADS] = {0}, alone = 0.0f;
    if (argc > 1) rounds = atoi(argv[1]);
    plate_init(&plate);
    float albedo[3] = {0.7f, 0.5f, 0.3f};
    const StriaeHostBrdf host = matt(albedo);
    EXPECT_OK(striae_brdf_host(&host, &plate.titanium.scratched));
    StriaePattern *built = plate_pattern(&plate);
    striae_tool_release(plate.tool);
    /* Shared as it is opened: memory that no thread of the build has written, whose order a race detector cannot see. */
    char path[64];
    snprintf(path, sizeof path, "threads-%d.cache", rounds); /* the race detector runs beside the plain test */
    EXPECT_OK(striae_pattern_save(built, path));
    striae_pattern_release(built);
    EXPECT_OK(striae_pattern_open_with(path, 0, &host, 1, &pattern));

    protects("threads that share a pattern get what one thread gets alone");
    shade_often(&alone);
    bool started = true;
    for (int i = 0; i < THREADS; i++)
        started = pthread_create(&threads[i], NULL, shade_often, &sums[i]) == 0 && started;
    for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
    EXPECT(started);
    for (int i = 0; i < THREADS; i++) EXPECT(sums[i] == alone && alone > 0.0f);
    striae_pattern_release(pattern);
    remove(path);

    protects("an error text belongs to the thread that made the error");
    StriaeTool *tool = NULL;
    EXPECT_REFUSED(striae_tool_wedge(-5.0, 60.0, 1.0, &tool), "width_mm", "-5");
    /* That thread expects, too: not while this one does. */
    started = pthread_create(&threads[0], NULL, fail_with_minus_three, NULL) == 0;
    pthread_join(threads[0], NULL);
    EXPECT(started);
    EXPECT(strstr(striae_last_error(), "-5") != NULL);
    return expect_summary();
}
