/* PNG through libpng. */
#include <png.h>
#include <stdlib.h>

#include "film.h"

const char *film_write_png(const Film *film, double exposure, const char *path) {
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)film->width,
                       .height = (png_uint_32)film->height,
                       .format = PNG_FORMAT_RGB};
    const size_t count = (size_t)film->width * (size_t)film->height;
    unsigned char (*bytes)[3] = malloc(count * sizeof *bytes);
    if (!bytes) return "out of memory";
    for (size_t i = 0; i < count; i++) film_tone(film->rgb[i], exposure, bytes[i]);
    const int written = png_image_write_to_file(&image, path, 0, bytes, 0, NULL);
    free(bytes);
    return written ? NULL : "the PNG file cannot be written";
}
