#include "sheet.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

bool sheet_init(Sheet *sheet, int width, int height) {
    const size_t count = (size_t)width * (size_t)height;
    *sheet = (Sheet){width, height, malloc(count * sizeof *sheet->rgb)};
    if (sheet->rgb) memset(sheet->rgb, 255, count * sizeof *sheet->rgb);
    return sheet->rgb != NULL;
}

void sheet_free(Sheet *sheet) {
    free(sheet->rgb);
    *sheet = (Sheet){0, 0, NULL};
}

/* NULL beyond the sheet's edges. */
static unsigned char *pixel(const Sheet *sheet, int x, int y) {
    if (x < 0 || y < 0 || x >= sheet->width || y >= sheet->height) return NULL;
    return sheet->rgb[(size_t)y * (size_t)sheet->width + (size_t)x];
}

void sheet_put_film(Sheet *sheet, const Film *film, double exposure, int x, int y) {
    for (int j = 0; j < film->height; j++) {
        for (int i = 0; i < film->width; i++) {
            unsigned char *to = pixel(sheet, x + i, y + j);
            if (to) film_tone(film->rgb[(size_t)j * (size_t)film->width + (size_t)i], exposure, to);
        }
    }
}

static void put_bytes(Sheet *sheet, const unsigned char (*rgb)[3], int width, int height, int x, int y) {
    for (int j = 0; j < height; j++) {
        for (int i = 0; i < width; i++) {
            unsigned char *to = pixel(sheet, x + i, y + j);
            if (to) memcpy(to, rgb[(size_t)j * (size_t)width + (size_t)i], 3);
        }
    }
}

const char *sheet_put_png(Sheet *sheet, const char *path, int x, int y) {
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) return "the PNG file cannot be read";
    image.format = PNG_FORMAT_RGB;
    unsigned char (*rgb)[3] = malloc(PNG_IMAGE_SIZE(image));
    const bool read = rgb && png_image_finish_read(&image, NULL, rgb, 0, NULL);
    if (read) put_bytes(sheet, (const unsigned char (*)[3])rgb, (int)image.width, (int)image.height, x, y);
    png_image_free(&image);
    free(rgb);
    return read ? NULL : "the PNG file cannot be read";
}

const char *sheet_write_png(const Sheet *sheet, const char *path) {
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)sheet->width,
                       .height = (png_uint_32)sheet->height,
                       .format = PNG_FORMAT_RGB};
    return png_image_write_to_file(&image, path, 0, sheet->rgb, 0, NULL) ? NULL : "the PNG file cannot be written";
}
