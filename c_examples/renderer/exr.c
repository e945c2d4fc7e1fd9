/* Scene-linear EXR through OpenEXR's C core: 32-bit float channels, ZIP compression. */
#include <openexr.h>

#include "film.h"

/* Tells the encoder where each of its channels lies among our interleaved red, green and blue. */
static void point_channels(exr_encode_pipeline_t *encoder, const Film *film, int y) {
    const float (*line)[3] = (const float (*)[3])(film->rgb + (size_t)y * (size_t)film->width);
    for (int i = 0; i < encoder->channel_count; i++) {
        exr_coding_channel_info_t *channel = &encoder->channels[i];
        const char name = channel->channel_name[0];
        channel->encode_from_ptr = (const uint8_t *)&line[0][name == 'R' ? 0 : name == 'G' ? 1 : 2];
        channel->user_pixel_stride = (int32_t)sizeof *line;
        channel->user_line_stride = film->width * (int32_t)sizeof *line;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t describe(exr_context_t file, const Film *film, int *part) {
    exr_result_t result = exr_add_part(file, "rgb", EXR_STORAGE_SCANLINE, part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(file, *part, film->width, film->height, EXR_COMPRESSION_ZIP);
    for (const char *name = "B\0G\0R\0"; *name && result == EXR_ERR_SUCCESS; name += 2)
        result = exr_add_channel(file, *part, name, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return result == EXR_ERR_SUCCESS ? exr_write_header(file) : result;
}

/* One chunk of scan lines; the encoder is set up by the first and reused by the rest. */
static exr_result_t write_chunk(exr_context_t file, int part, exr_encode_pipeline_t *encoder, const Film *film,
                                int y) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_write_scanline_chunk_info(file, part, y, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result = y == 0 ? exr_encoding_initialize(file, part, &chunk, encoder)
                    : exr_encoding_update(file, part, &chunk, encoder);
    if (result != EXR_ERR_SUCCESS) return result;
    point_channels(encoder, film, y);
    if (y == 0) result = exr_encoding_choose_default_routines(file, part, encoder);
    return result == EXR_ERR_SUCCESS ? exr_encoding_run(file, part, encoder) : result;
}

static exr_result_t write_pixels(exr_context_t file, int part, const Film *film) {
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(file, part, &lines);
    for (int y = 0; y < film->height && result == EXR_ERR_SUCCESS; y += lines)
        result = write_chunk(file, part, &encoder, film, y);
    exr_encoding_destroy(file, &encoder);
    return result;
}

const char *film_write_exr(const Film *film, const char *path) {
    exr_context_t file = NULL;
    int part = 0;
    exr_result_t result = exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, NULL);
    if (result == EXR_ERR_SUCCESS) result = describe(file, film, &part);
    if (result == EXR_ERR_SUCCESS) result = write_pixels(file, part, film);
    const exr_result_t closed = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
    if (result == EXR_ERR_SUCCESS) result = closed;
    return result == EXR_ERR_SUCCESS ? NULL : exr_get_default_error_message(result);
}
