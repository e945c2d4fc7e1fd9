#include "options.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene.h"
#include "tiles.h"

enum { MOST_SPP = 65536, MOST_FRAMES = 9999, MOST_TILES = 65535 };

static void print_help(void) {
    printf("usage: striae_render [options]\n"
           "  --scene NAME     what to render: %s\n"
           "                   (default plate)\n"
           "  --out FOLDER     where the pictures go (default out)\n"
           "  --width N        pixels of a view, 16 to 8192 (default 960)\n"
           "  --height N       likewise (default 540)\n"
           "  --integrator I   direct: each lamp counted as a point, no chance; paths: all light; default: as suits the\n"
           "                   scene\n"
           "  --spp N          samples per pixel, 1 to 65536; of direct ones a square number (default: as suits the scene,\n"
           "                   1 of direct ones)\n"
           "  --reflections N  that a path may have, 1 to 64 (paths; default 4)\n"
           "  --walls          light also goes from wall to wall within scratches\n"
           "  --environment F  an EXR file of all directions in place of the scene's surroundings (paths)\n"
           "  --threads N      1 to 256 (default: as many as there are cores)\n"
           "  --check          also compare one direct sample per pixel with 256; fail above 1 %% RMS\n"
           "  --aov            also what each pixel shows of scratches: the layers scratch.* of each view's EXR, and\n"
           "                   pictures of them, NAME-id.png and NAME-coverage.png. Channels: id (from 1 in order\n"
           "                   of adding, of the scratch that covers most; 0: none), coverage (of all, 0 to 1), and of\n"
           "                   that scratch direction.X .Y .Z (of travel, scene axes, unit length), depth_mm (below\n"
           "                   the surface at the pixel's middle; rims negative), deepest_mm, arc_length (scene units).\n"
           "                   By paths each EXR has also: direct.R .G .B, normal.X .Y .Z, distance, samples\n"
           "to split a job:\n"
           "  --frames A-B     only these views of the scene, from 1\n"
           "  --tiles A-B      only these tiles of each view (paths), 32 pixels square, from 0, row by row from the top;\n"
           "                   into NAME.tiles-A-B.exr\n"
           "  --resume         first take over what lies in FOLDER of NAME.exr and NAME.tiles-*.exr, then render what is\n"
           "                   lacking (paths). A job that was stopped goes on; after all tiles it joins them\n"
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

/* "A-B", or "A" for A-A. */
static bool parse_range(const char *name, const char *text, int least, int most, int *first, int *last) {
    int used = 0, from, to;
    bool good = sscanf(text, "%d%n", &from, &used) == 1;
    to = from;
    if (good && text[used] == '-') {
        const char *rest = text + used + 1;
        good = sscanf(rest, "%d%n", &to, &used) == 1 && rest[used] == '\0';
    } else {
        good = good && text[used] == '\0';
    }
    if (!good || from < least || to < from || to > most) {
        fprintf(stderr, "%s is \"%s\"; accepted: two whole numbers from %d to %d, as in 3-7\n", name, text, least, most);
        return false;
    }
    *first = from;
    *last = to;
    return true;
}

static bool parse_text(const char *name, const char *text, const char **value) {
    *value = text;
    if (*text != '\0') return true;
    fprintf(stderr, "%s is empty; accepted: a name\n", name);
    return false;
}

static bool parse_integrator(const char *text, Integrator *integrator) {
    *integrator = strcmp(text, "paths") == 0 ? INTEGRATOR_PATHS : INTEGRATOR_DIRECT;
    if (*integrator == INTEGRATOR_PATHS || strcmp(text, "direct") == 0) return true;
    fprintf(stderr, "--integrator is \"%s\"; accepted: direct, paths\n", text);
    return false;
}

static bool parse_value(const char *name, const char *text, Options *options) {
    if (strcmp(name, "--scene") == 0) return parse_text(name, text, &options->scene);
    if (strcmp(name, "--out") == 0) return parse_text(name, text, &options->out);
    if (strcmp(name, "--environment") == 0) return parse_text(name, text, &options->environment);
    if (strcmp(name, "--integrator") == 0) return parse_integrator(text, &options->integrator);
    if (strcmp(name, "--width") == 0) return parse_integer(name, text, 16, 8192, &options->width);
    if (strcmp(name, "--height") == 0) return parse_integer(name, text, 16, 8192, &options->height);
    if (strcmp(name, "--spp") == 0) return parse_integer(name, text, 1, MOST_SPP, &options->spp);
    if (strcmp(name, "--reflections") == 0) return parse_integer(name, text, 1, 64, &options->reflections);
    if (strcmp(name, "--frames") == 0)
        return parse_range(name, text, 1, MOST_FRAMES, &options->first_frame, &options->last_frame);
    if (strcmp(name, "--tiles") == 0)
        return parse_range(name, text, 0, MOST_TILES, &options->first_tile, &options->last_tile);
    return parse_integer(name, text, 1, 256, &options->threads);
}

static bool is_among(const char *name, const char *const *names, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

static bool takes_value(const char *name) {
    static const char *const names[] = {"--scene", "--out",         "--width",       "--height", "--spp",   "--threads",
                                        "--integrator", "--reflections", "--environment", "--frames", "--tiles"};
    return is_among(name, names, sizeof names / sizeof *names);
}

static bool *find_flag(const char *name, Options *options) {
    if (strcmp(name, "--check") == 0) return &options->check;
    if (strcmp(name, "--aov") == 0) return &options->aov;
    if (strcmp(name, "--walls") == 0) return &options->walls;
    return strcmp(name, "--resume") == 0 ? &options->resume : NULL;
}

OptionsOutcome options_parse(int argc, char **argv, Options *options) {
    *options = (Options){.scene = "plate",
                         .out = "out",
                         .width = 960,
                         .height = 540,
                         .last_tile = -1,
                         .threads = tiles_default_threads()};
    for (int i = 1; i < argc; i++) {
        const char *name = argv[i];
        bool *flag = find_flag(name, options);
        if (strcmp(name, "--help") == 0) {
            print_help();
            return OPTIONS_HELP;
        }
        if (flag) {
            *flag = true;
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
