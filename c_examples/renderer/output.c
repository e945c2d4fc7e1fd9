#include "output.h"

#include <glob.h>
#include <stdio.h>

bool complain(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    return false;
}

bool output_path(OutputPath path, const char *folder, const char *name, const char *ending) {
    const int length = snprintf(path, OUTPUT_PATH_SIZE, "%s/%s%s", folder, name, ending);
    return (length >= 0 && length < OUTPUT_PATH_SIZE) || complain("--out", "the path is too long");
}

static bool is_written(const char *failure, const char *path) { return failure ? complain(path, failure) : true; }

static bool write_png(const Film *film, const char *folder, const char *name, double exposure) {
    OutputPath path;
    return output_path(path, folder, name, ".png") && is_written(film_write_png(film, exposure, path), path);
}

static bool write_labels(const LabelMap *labels, const char *folder, const char *name) {
    OutputPath path;
    return output_path(path, folder, name, "-id.png") && is_written(label_map_write_ids(labels, path), path) &&
           output_path(path, folder, name, "-coverage.png") &&
           is_written(label_map_write_coverage(labels, path), path);
}

bool output_film(const Film *film, const LabelMap *labels, const char *folder, const char *name, double exposure) {
    enum { RGB = 3 };
    OutputPath path;
    ExrChannel channels[RGB + LABEL_CHANNELS];
    film_channels(film, channels);
    if (labels) label_map_channels(labels, channels + RGB);
    return output_path(path, folder, name, ".exr") &&
           is_written(exr_write(path, film->width, film->height, channels, RGB + (labels ? LABEL_CHANNELS : 0)),
                      path) &&
           write_png(film, folder, name, exposure) && (!labels || write_labels(labels, folder, name));
}

bool output_picture(const Picture *picture, const LabelMap *labels, const char *folder, const char *name,
                    double exposure) {
    OutputPath path;
    Film film;
    if (!output_path(path, folder, name, ".exr") || !is_written(picture_write(picture, labels, path), path))
        return false;
    if (!picture_film(picture, &film)) return complain(name, "out of memory");
    const bool written =
        write_png(&film, folder, name, exposure) && (!labels || write_labels(labels, folder, name));
    film_free(&film);
    return written;
}

bool output_take_parts(Picture *picture, const char *folder, const char *name, int samples) {
    static const char *const endings[] = {".exr", ".tiles-*.exr"};
    bool taken = true;
    for (int i = 0; i < 2 && taken; i++) {
        OutputPath pattern;
        glob_t found;
        if (!output_path(pattern, folder, name, endings[i])) return false;
        if (glob(pattern, 0, NULL, &found) != 0) continue;
        for (size_t k = 0; k < found.gl_pathc && taken; k++) {
            const char *failure = picture_take(picture, found.gl_pathv[k], samples);
            taken = !failure || complain(found.gl_pathv[k], failure);
        }
        globfree(&found);
    }
    return taken;
}
