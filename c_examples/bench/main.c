/* Measures what scratches cost in a renderer, beside the systems before this one and beside explicit geometry. */
#include <stdio.h>
#include <stdlib.h>

#include "equal_error.h"
#include "overhead.h"

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s FOLDER (an existing one)\n", argv[0]);
        return 2;
    }
    char path[4096];
    Figures *figures = calloc(1, sizeof *figures);
    if (!figures) return EXIT_FAILURE;
    bool done = overhead_run(figures, argv[1]) && equal_error_run(figures, argv[1]);
    snprintf(path, sizeof path, "%s/bench.json", argv[1]);
    done = done && figures_merge(figures, path);
    free(figures);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
