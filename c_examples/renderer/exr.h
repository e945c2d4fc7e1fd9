/* Scene-linear EXR through OpenEXR's C core: 32-bit float channels, ZIP compression. */
#ifndef RENDERER_EXR_H
#define RENDERER_EXR_H
#include <stdbool.h>
#include <stddef.h>

/* Values of one channel: the first one's place, and how many bytes it is to the next, in a row and in a column. */
typedef struct ExrChannel {
    const char *name;
    float *first;
    size_t pixel_stride, line_stride;
} ExrChannel;

/* NULL if the file was written, otherwise why not. It takes the place of an older one all at once. */
const char *exr_write(const char *path, int width, int height, const ExrChannel *channels, int count);

/* NULL if all channels were found in the file and read, otherwise why not. The file has the size told by exr_size(). */
const char *exr_size(const char *path, int *width, int *height);
const char *exr_read(const char *path, const ExrChannel *channels, int count);
#endif
