#include "tiles.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#include "trace.h"

enum { TILE_SIZE = 32, MAX_THREADS = 256 };

typedef struct Queue {
    const TileJob *job;
    int columns, total;
    atomic_int next;
    int done;
    pthread_mutex_t report_lock;
} Queue;

static int min_int(int a, int b) { return a < b ? a : b; }

static void *work_through(void *user) {
    Queue *queue = user;
    const TileJob *job = queue->job;
    trace_prepare_thread();
    for (int i = atomic_fetch_add(&queue->next, 1); i < queue->total; i = atomic_fetch_add(&queue->next, 1)) {
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
    const int columns = (job->width + TILE_SIZE - 1) / TILE_SIZE, rows = (job->height + TILE_SIZE - 1) / TILE_SIZE;
    Queue queue = {.job = job, .columns = columns, .total = columns * rows};
    atomic_init(&queue.next, 0);
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
