/* Scene-linear EXR through OpenEXR's C core: 32-bit float channels, ZIP compression. */
#include <openexr.h>
#include <string.h>

#include "labels.h"

/* Values of one channel: the first one's place, and how far it is to the next, in a row and in a column. */
typedef struct Channel {
    const char *name;
    const char *first;
    size_t pixel_stride, line_stride;
} Channel;

enum { RGB = 3, MOST_CHANNELS = RGB + LABEL_CHANNELS };

typedef struct Layers {
    int width, height, count;
    Channel channels[MOST_CHANNELS]; /* in the order of the alphabet, as EXR has them */
} Layers;

static Layers layers_of(const Film *film, const LabelMap *map) {
    static const char *const names[RGB] = {"B", "G", "R"};
    Layers layers = {.width = film->width, .height = film->height};
    for (int c = 0; c < RGB; c++)
        layers.channels[layers.count++] = (Channel){names[c], (const char *)&film->rgb[0][RGB - 1 - c],
                                                    sizeof *film->rgb, (size_t)film->width * sizeof *film->rgb};
    for (int c = 0; map && c < LABEL_CHANNELS; c++)
        layers.channels[layers.count++] =
            (Channel){label_channels[c].name, (const char *)map->labels + label_channels[c].offset,
                      sizeof *map->labels, (size_t)map->width * sizeof *map->labels};
    return layers;
}

/* Tells the encoder where each of its channels lies among our interleaved values. */
static void point_channels(exr_encode_pipeline_t *encoder, const Layers *layers, int y) {
    for (int i = 0; i < encoder->channel_count; i++) {
        exr_coding_channel_info_t *channel = &encoder->channels[i];
        const Channel *own = layers->channels;
        while (strcmp(own->name, channel->channel_name) != 0) own++;
        channel->encode_from_ptr = (const uint8_t *)(own->first + (size_t)y * own->line_stride);
        channel->user_pixel_stride = (int32_t)own->pixel_stride;
        channel->user_line_stride = (int32_t)own->line_stride;
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t describe(exr_context_t file, const Layers *layers, int *part) {
    exr_result_t result = exr_add_part(file, "rgb", EXR_STORAGE_SCANLINE, part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(file, *part, layers->width, layers->height, EXR_COMPRESSION_ZIP);
    for (int c = 0; c < layers->count && result == EXR_ERR_SUCCESS; c++) {
        const exr_perceptual_treatment_t kind = c < RGB ? EXR_PERCEPTUALLY_LOGARITHMIC : EXR_PERCEPTUALLY_LINEAR;
        result = exr_add_channel(file, *part, layers->channels[c].name, EXR_PIXEL_FLOAT, kind, 1, 1);
    }
    return result == EXR_ERR_SUCCESS ? exr_write_header(file) : result;
}

/* One chunk of scan lines; the encoder is set up by the first and reused by the rest. */
static exr_result_t write_chunk(exr_context_t file, int part, exr_encode_pipeline_t *encoder, const Layers *layers,
                                int y) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_write_scanline_chunk_info(file, part, y, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result = y == 0 ? exr_encoding_initialize(file, part, &chunk, encoder)
                    : exr_encoding_update(file, part, &chunk, encoder);
    if (result != EXR_ERR_SUCCESS) return result;
    point_channels(encoder, layers, y);
    if (y == 0) result = exr_encoding_choose_default_routines(file, part, encoder);
    return result == EXR_ERR_SUCCESS ? exr_encoding_run(file, part, encoder) : result;
}

static exr_result_t write_pixels(exr_context_t file, int part, const Layers *layers) {
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(file, part, &lines);
    for (int y = 0; y < layers->height && result == EXR_ERR_SUCCESS; y += lines)
        result = write_chunk(file, part, &encoder, layers, y);
    exr_encoding_destroy(file, &encoder);
    return result;
}

const char *exr_write_layers(const Film *film, const LabelMap *map, const char *path) {
    const Layers layers = layers_of(film, map);
    exr_context_t file = NULL;
    int part = 0;
    exr_result_t result = exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, NULL);
    if (result == EXR_ERR_SUCCESS) result = describe(file, &layers, &part);
    if (result == EXR_ERR_SUCCESS) result = write_pixels(file, part, &layers);
    const exr_result_t closed = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
    if (result == EXR_ERR_SUCCESS) result = closed;
    return result == EXR_ERR_SUCCESS ? NULL : exr_get_default_error_message(result);
}

const char *film_write_exr(const Film *film, const char *path) { return exr_write_layers(film, NULL, path); }

/* Tells the decoder where each of its channels goes; those that are no colours go nowhere. */
static void point_colours(exr_decode_pipeline_t *decoder, const Film *film, int y) {
    for (int i = 0; i < decoder->channel_count; i++) {
        exr_coding_channel_info_t *channel = &decoder->channels[i];
        const char *const found = channel->channel_name[1] == '\0' ? strchr("RGB", channel->channel_name[0]) : NULL;
        const size_t row = (size_t)y * (size_t)film->width;
        channel->decode_to_ptr = found ? (uint8_t *)&film->rgb[row][found[0] == 'R' ? 0 : found[0] == 'G' ? 1 : 2] : NULL;
        channel->user_pixel_stride = (int32_t)sizeof *film->rgb;
        channel->user_line_stride = (int32_t)((size_t)film->width * sizeof *film->rgb);
        channel->user_bytes_per_element = (int16_t)sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static exr_result_t read_chunk(exr_context_t file, exr_decode_pipeline_t *decoder, const Film *film, int top, int y) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_read_scanline_chunk_info(file, 0, top + y, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result = y == 0 ? exr_decoding_initialize(file, 0, &chunk, decoder) : exr_decoding_update(file, 0, &chunk, decoder);
    if (result != EXR_ERR_SUCCESS) return result;
    point_colours(decoder, film, y);
    if (y == 0) result = exr_decoding_choose_default_routines(file, 0, decoder);
    return result == EXR_ERR_SUCCESS ? exr_decoding_run(file, 0, decoder) : result;
}

static exr_result_t read_pixels(exr_context_t file, Film *film) {
    exr_attr_box2i_t box;
    exr_result_t result = exr_get_data_window(file, 0, &box);
    if (result != EXR_ERR_SUCCESS) return result;
    if (!film_init(film, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1)) return EXR_ERR_OUT_OF_MEMORY;
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t lines = 0;
    result = exr_get_scanlines_per_chunk(file, 0, &lines);
    for (int y = 0; y < film->height && result == EXR_ERR_SUCCESS; y += lines)
        result = read_chunk(file, &decoder, film, box.min.y, y);
    exr_decoding_destroy(file, &decoder);
    return result;
}

const char *film_read_exr(Film *film, const char *path) {
    *film = (Film){0, 0, NULL};
    exr_context_t file = NULL;
    exr_result_t result = exr_start_read(&file, path, NULL);
    if (result == EXR_ERR_SUCCESS) result = read_pixels(file, film);
    if (file) exr_finish(&file);
    if (result == EXR_ERR_SUCCESS) return NULL;
    film_free(film);
    return exr_get_default_error_message(result);
}
