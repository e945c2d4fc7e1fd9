#include "tiles.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#include "trace.h"

enum { MAX_THREADS = 256 };

typedef struct Queue {
    const TileJob *job;
    int columns, past, total;
    atomic_int next;
    int done;
    pthread_mutex_t report_lock;
} Queue;

static int min_int(int a, int b) { return a < b ? a : b; }

static int tiles_across(int pixels) { return (pixels + TILE_SIZE - 1) / TILE_SIZE; }

int tiles_count(int width, int height) { return tiles_across(width) * tiles_across(height); }

static void *work_through(void *user) {
    Queue *queue = user;
    const TileJob *job = queue->job;
    trace_prepare_thread();
    for (int i = atomic_fetch_add(&queue->next, 1); i < queue->past; i = atomic_fetch_add(&queue->next, 1)) {
        const int x0 = i % queue->columns * TILE_SIZE, y0 = i / queue->columns * TILE_SIZE;
        const Tile tile = {x0, y0, min_int(x0 + TILE_SIZE, job->width), min_int(y0 + TILE_SIZE, job->height)};
        job->work(&tile, job->work_user);
        pthread_mutex_lock(&queue->report_lock);
        queue->done++;
        if (job->report) job->report(queue->done, queue->total, job->report_user);
        pthread_mutex_unlock(&queue->report_lock);
    }
    return NULL;
}

void tiles_run(const TileJob *job) {
    const int all = tiles_count(job->width, job->height), past = job->past > 0 ? min_int(job->past, all) : all;
    Queue queue = {.job = job, .columns = tiles_across(job->width), .past = past, .total = past - job->first};
    atomic_init(&queue.next, job->first);
    pthread_mutex_init(&queue.report_lock, NULL);

    pthread_t threads[MAX_THREADS];
    int started = 0;
    const int wanted = min_int(job->threads, MAX_THREADS);
    while (started < wanted && pthread_create(&threads[started], NULL, work_through, &queue) == 0) started++;
    if (started == 0) work_through(&queue);
    for (int i = 0; i < started; i++) pthread_join(threads[i], NULL);
    pthread_mutex_destroy(&queue.report_lock);
}

int tiles_default_threads(void) {
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores < 1 ? 1 : min_int((int)cores, MAX_THREADS);
}
