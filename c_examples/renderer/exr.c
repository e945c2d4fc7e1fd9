#include "exr.h"

#include <openexr.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 4200 };

/* Colours, as against coordinates and counts, are told apart by their last letter. */
static exr_perceptual_treatment_t treatment(const char *name) {
    const char last = name[strlen(name) - 1];
    return last == 'R' || last == 'G' || last == 'B' ? EXR_PERCEPTUALLY_LOGARITHMIC : EXR_PERCEPTUALLY_LINEAR;
}

static const ExrChannel *find_channel(const ExrChannel *channels, int count, const char *name) {
    for (int i = 0; i < count; i++)
        if (strcmp(channels[i].name, name) == 0) return &channels[i];
    return NULL;
}

/* Tells OpenEXR where a row of one of its channels lies among ours; NULL: nowhere. */
static void point_channel(exr_coding_channel_info_t *coding, const ExrChannel *own, int y) {
    uint8_t *row = own ? (uint8_t *)own->first + (size_t)y * own->line_stride : NULL;
    coding->decode_to_ptr = row;
    coding->user_pixel_stride = own ? (int32_t)own->pixel_stride : 0;
    coding->user_line_stride = own ? (int32_t)own->line_stride : 0;
    coding->user_bytes_per_element = (int16_t)sizeof(float);
    coding->user_data_type = EXR_PIXEL_FLOAT;
}

static exr_result_t describe(exr_context_t file, int width, int height, const ExrChannel *channels, int count) {
    int part = 0;
    exr_result_t result = exr_add_part(file, "rgb", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(file, part, width, height, EXR_COMPRESSION_ZIP);
    for (int c = 0; c < count && result == EXR_ERR_SUCCESS; c++)
        result = exr_add_channel(file, part, channels[c].name, EXR_PIXEL_FLOAT, treatment(channels[c].name), 1, 1);
    return result == EXR_ERR_SUCCESS ? exr_write_header(file) : result;
}

/* One chunk of scan lines; the encoder is set up by the first and reused by the rest. */
static exr_result_t write_chunk(exr_context_t file, exr_encode_pipeline_t *encoder, const ExrChannel *channels,
                                int count, int y) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_write_scanline_chunk_info(file, 0, y, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result =
        y == 0 ? exr_encoding_initialize(file, 0, &chunk, encoder) : exr_encoding_update(file, 0, &chunk, encoder);
    if (result != EXR_ERR_SUCCESS) return result;
    for (int i = 0; i < encoder->channel_count; i++)
        point_channel(&encoder->channels[i], find_channel(channels, count, encoder->channels[i].channel_name), y);
    if (y == 0) result = exr_encoding_choose_default_routines(file, 0, encoder);
    return result == EXR_ERR_SUCCESS ? exr_encoding_run(file, 0, encoder) : result;
}

static exr_result_t write_pixels(exr_context_t file, int height, const ExrChannel *channels, int count) {
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(file, 0, &lines);
    for (int y = 0; y < height && result == EXR_ERR_SUCCESS; y += lines)
        result = write_chunk(file, &encoder, channels, count, y);
    exr_encoding_destroy(file, &encoder);
    return result;
}

const char *exr_write(const char *path, int width, int height, const ExrChannel *channels, int count) {
    char beside[PATH_SIZE];
    exr_context_t file = NULL;
    snprintf(beside, sizeof beside, "%s.tmp", path);
    exr_result_t result = exr_start_write(&file, beside, EXR_WRITE_FILE_DIRECTLY, NULL);
    if (result == EXR_ERR_SUCCESS) result = describe(file, width, height, channels, count);
    if (result == EXR_ERR_SUCCESS) result = write_pixels(file, height, channels, count);
    const exr_result_t closed = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
    if (result == EXR_ERR_SUCCESS) result = closed;
    if (result == EXR_ERR_SUCCESS) return rename(beside, path) == 0 ? NULL : "the file cannot be put in its place";
    remove(beside);
    return exr_get_default_error_message(result);
}

static exr_result_t read_chunk(exr_context_t file, exr_decode_pipeline_t *decoder, const ExrChannel *channels,
                               int count, int top, int y) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_read_scanline_chunk_info(file, 0, top + y, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result =
        y == 0 ? exr_decoding_initialize(file, 0, &chunk, decoder) : exr_decoding_update(file, 0, &chunk, decoder);
    if (result != EXR_ERR_SUCCESS) return result;
    int found = 0;
    for (int i = 0; i < decoder->channel_count; i++) {
        const ExrChannel *own = find_channel(channels, count, decoder->channels[i].channel_name);
        found += own != NULL;
        point_channel(&decoder->channels[i], own, y);
    }
    if (found != count) return EXR_ERR_MISSING_REQ_ATTR;
    if (y == 0) result = exr_decoding_choose_default_routines(file, 0, decoder);
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(file, 0, decoder) : result;
}

static exr_result_t read_pixels(exr_context_t file, const ExrChannel *channels, int count) {
    exr_attr_box2i_t box;
    int32_t lines = 0;
    exr_result_t result = exr_get_data_window(file, 0, &box);
    if (result == EXR_ERR_SUCCESS) result = exr_get_scanlines_per_chunk(file, 0, &lines);
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    for (int y = 0; result == EXR_ERR_SUCCESS && y <= box.max.y - box.min.y; y += lines)
        result = read_chunk(file, &decoder, channels, count, box.min.y, y);
    exr_decoding_destroy(file, &decoder);
    return result;
}

const char *exr_size(const char *path, int *width, int *height) {
    exr_context_t file = NULL;
    exr_attr_box2i_t box;
    exr_result_t result = exr_start_read(&file, path, NULL);
    if (result == EXR_ERR_SUCCESS) result = exr_get_data_window(file, 0, &box);
    if (file) exr_finish(&file);
    if (result != EXR_ERR_SUCCESS) return exr_get_default_error_message(result);
    *width = box.max.x - box.min.x + 1;
    *height = box.max.y - box.min.y + 1;
    return NULL;
}

const char *exr_read(const char *path, const ExrChannel *channels, int count) {
    exr_context_t file = NULL;
    exr_result_t result = exr_start_read(&file, path, NULL);
    if (result == EXR_ERR_SUCCESS) result = read_pixels(file, channels, count);
    if (file) exr_finish(&file);
    return result == EXR_ERR_SUCCESS ? NULL : exr_get_default_error_message(result);
}
