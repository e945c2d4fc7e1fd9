/* PNG through libpng. */
#include <png.h>
#include <stdlib.h>

#include "film.h"

const char *png_write(int width, int height, const unsigned char *bytes, const char *path) {
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)width,
                       .height = (png_uint_32)height,
                       .format = PNG_FORMAT_RGB};
    const int written = png_image_write_to_file(&image, path, 0, bytes, 0, NULL);
    return written ? NULL : "the PNG file cannot be written";
}

const char *film_write_png(const Film *film, double exposure, const char *path) {
    const size_t count = (size_t)film->width * (size_t)film->height;
    unsigned char (*bytes)[3] = malloc(count * sizeof *bytes);
    if (!bytes) return "out of memory";
    for (size_t i = 0; i < count; i++) film_tone(film->rgb[i], exposure, bytes[i]);
    const char *failure = png_write(film->width, film->height, (const unsigned char *)bytes, path);
    free(bytes);
    return failure;
}
