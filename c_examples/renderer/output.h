/* A view's files: NAME.exr and NAME.png in a folder, and what is made of labels. Failures are told on stderr. */
#ifndef RENDERER_OUTPUT_H
#define RENDERER_OUTPUT_H
#include "picture.h"

enum { OUTPUT_PATH_SIZE = 4096 };

typedef char OutputPath[OUTPUT_PATH_SIZE];

/* Says so on stderr; returns false. */
bool complain(const char *what, const char *why);

bool output_path(OutputPath path, const char *folder, const char *name, const char *ending);

/* `labels` may be NULL. */
bool output_film(const Film *film, const LabelMap *labels, const char *folder, const char *name, double exposure);
bool output_picture(const Picture *picture, const LabelMap *labels, const char *folder, const char *name,
                    double exposure);

/* Takes over what the folder has of NAME.exr and NAME.tiles-*.exr. */
bool output_take_parts(Picture *picture, const char *folder, const char *name, int samples);
#endif
