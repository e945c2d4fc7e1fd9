#include "figures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tiles.h"

void figures_set(Figures *figures, const char *name, double value) {
    int i = 0;
    while (i < figures->count && strcmp(figures->all[i].name, name) != 0) i++;
    if (i == FIGURES_MAX) return;
    if (i == figures->count) snprintf(figures->all[figures->count++].name, sizeof figures->all[i].name, "%s", name);
    figures->all[i].value = value;
}

/* One name and number to a line, as all benches write it. */
static void read_known(Figures *figures, const char *path) {
    FILE *file = fopen(path, "r");
    if (!file) return;
    char line[256], name[64];
    double value;
    while (fgets(line, sizeof line, file))
        if (sscanf(line, " \"%63[^\"]\": %lf", name, &value) == 2) figures_set(figures, name, value);
    fclose(file);
}

static int by_name(const void *a, const void *b) {
    return strcmp(((const Figure *)a)->name, ((const Figure *)b)->name);
}

bool figures_merge(const Figures *figures, const char *path) {
    Figures *all = calloc(1, sizeof *all);
    if (!all) return false;
    read_known(all, path);
    for (int i = 0; i < figures->count; i++) figures_set(all, figures->all[i].name, figures->all[i].value);
    qsort(all->all, (size_t)all->count, sizeof all->all[0], by_name);
    FILE *file = fopen(path, "w");
    if (file) {
        fprintf(file, "{\n");
        for (int i = 0; i < all->count; i++)
            fprintf(file, "  \"%s\": %.17g%s\n", all->all[i].name, all->all[i].value,
                    i + 1 < all->count ? "," : "");
        fprintf(file, "}\n");
    }
    const bool written = file && fclose(file) == 0;
    if (!written) fprintf(stderr, "%s cannot be written\n", path);
    free(all);
    return written;
}

void machine_name(char *name, int size) {
    char line[256], model[200] = "an unknown processor";
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file && fgets(line, sizeof line, file)) {
        if (sscanf(line, "model name : %199[^\n]", model) == 1) break;
    }
    if (file) fclose(file);
    snprintf(name, (size_t)size, "%s, %d cores", model, tiles_default_threads());
}
