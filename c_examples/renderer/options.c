#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene.h"
#include "tiles.h"

static void print_help(void) {
    printf("usage: striae_render [options]\n"
           "  --scene NAME     what to render: %s (default plate)\n"
           "  --out FOLDER     where the pictures go (default out)\n"
           "  --width N        pixels of a view, 16 to 8192 (default 960)\n"
           "  --height N       likewise (default 540)\n"
           "  --spp N          samples per pixel, a square number from 1 to 1024 (default 1)\n"
           "  --threads N      1 to 256 (default: as many as there are cores)\n"
           "  --check          also compare one sample per pixel with 256; fail above 1 %% RMS\n"
           "  --aov            also what each pixel shows of scratches: the layers scratch.* of each view's EXR, and\n"
           "                   pictures of them, NAME-id.png and NAME-coverage.png. Channels: id (from 1 in order\n"
           "                   of adding, of the scratch that covers most; 0: none), coverage (of all, 0 to 1), and of\n"
           "                   that scratch direction.X .Y .Z (of travel, scene axes, unit length), depth_mm (below\n"
           "                   the surface at the pixel's middle; rims negative), deepest_mm, arc_length (scene units)\n"
           "  --help           this text\n",
           scene_names());
}

/* An integer in a range, the whole text. */
static bool parse_integer(const char *name, const char *text, int least, int most, int *value) {
    char *end = NULL;
    errno = 0;
    const long parsed = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || parsed < least || parsed > most) {
        fprintf(stderr, "%s is \"%s\"; accepted: a whole number from %d to %d\n", name, text, least, most);
        return false;
    }
    *value = (int)parsed;
    return true;
}

static bool parse_samples(const char *text, int *across) {
    int samples = 0;
    if (!parse_integer("--spp", text, 1, 1024, &samples)) return false;
    *across = 1;
    while (*across * *across < samples) ++*across;
    if (*across * *across == samples) return true;
    fprintf(stderr, "--spp is \"%s\"; accepted: a square number from 1 to 1024 (1, 4, 9, 16, ...)\n", text);
    return false;
}

static bool parse_text(const char *name, const char *text, const char **value) {
    *value = text;
    if (*text != '\0') return true;
    fprintf(stderr, "%s is empty; accepted: a name\n", name);
    return false;
}

static bool parse_value(const char *name, const char *text, Options *options) {
    if (strcmp(name, "--scene") == 0) return parse_text(name, text, &options->scene);
    if (strcmp(name, "--out") == 0) return parse_text(name, text, &options->out);
    if (strcmp(name, "--width") == 0) return parse_integer(name, text, 16, 8192, &options->width);
    if (strcmp(name, "--height") == 0) return parse_integer(name, text, 16, 8192, &options->height);
    if (strcmp(name, "--spp") == 0) return parse_samples(text, &options->samples_across);
    return parse_integer(name, text, 1, 256, &options->threads);
}

static bool takes_value(const char *name) {
    static const char *const names[] = {"--scene", "--out", "--width", "--height", "--spp", "--threads"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

OptionsOutcome options_parse(int argc, char **argv, Options *options) {
    *options = (Options){.scene = "plate",
                         .out = "out",
                         .width = 960,
                         .height = 540,
                         .samples_across = 1,
                         .threads = tiles_default_threads()};
    for (int i = 1; i < argc; i++) {
        const char *name = argv[i];
        if (strcmp(name, "--help") == 0) {
            print_help();
            return OPTIONS_HELP;
        }
        if (strcmp(name, "--check") == 0) {
            options->check = true;
        } else if (strcmp(name, "--aov") == 0) {
            options->aov = true;
        } else if (!takes_value(name)) {
            fprintf(stderr, "\"%s\" is not an option; --help lists them\n", name);
            return OPTIONS_WRONG;
        } else if (i + 1 == argc) {
            fprintf(stderr, "%s needs a value after it; --help says which\n", name);
            return OPTIONS_WRONG;
        } else if (!parse_value(name, argv[++i], options)) {
            return OPTIONS_WRONG;
        }
    }
    return OPTIONS_RUN;
}
