/* One line on stderr that says how far the work is and how long it will still take. */
#ifndef RENDERER_PROGRESS_H
#define RENDERER_PROGRESS_H
#include <stdbool.h>

typedef struct Progress {
    const char *title;
    double started, shown; /* seconds */
    bool terminal;         /* where stderr is a file, only the end is reported */
} Progress;

Progress progress_start(const char *title);

/* In the form that tiles_run calls. */
void progress_report(int done, int total, void *progress);

void progress_end(const Progress *progress);

double seconds_now(void);
#endif
