#include "progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double seconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

Progress progress_start(const char *title) {
    return (Progress){.title = title, .started = seconds_now(), .terminal = isatty(STDERR_FILENO) == 1};
}

void progress_report(int done, int total, void *user) {
    Progress *progress = user;
    const double now = seconds_now(), elapsed = now - progress->started;
    if (!progress->terminal || now - progress->shown < 0.1) return;
    progress->shown = now;
    fprintf(stderr, "\r%-24s %3d %%, %.0f s left ", progress->title, 100 * done / total,
            elapsed * (total - done) / done);
    fflush(stderr);
}

void progress_end(const Progress *progress) {
    fprintf(stderr, "%s%-24s %.1f s           \n", progress->terminal ? "\r" : "", progress->title,
            seconds_now() - progress->started);
}
