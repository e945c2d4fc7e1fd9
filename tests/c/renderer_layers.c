/* The layers that striae_render --aov writes, read back from its EXR. */
#include <math.h>
#include <openexr.h>

#include "expect.h"
#include "labels.h"

enum { MOST_PIXELS = 128 * 72 };

static float values[LABEL_CHANNELS + 3][MOST_PIXELS];

/* Decodes a file's channels, in the order of the alphabet; the number of pixels, 0 on failure. */
static int read_layers(const char *path) {
    exr_context_t file = NULL;
    exr_attr_box2i_t window;
    const exr_attr_chlist_t *channels = NULL;
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t lines = 0;
    if (!EXPECT(exr_start_read(&file, path, NULL) == EXR_ERR_SUCCESS)) return 0;
    EXPECT(exr_get_data_window(file, 0, &window) == EXR_ERR_SUCCESS);
    EXPECT(exr_get_channels(file, 0, &channels) == EXR_ERR_SUCCESS);
    EXPECT(exr_get_scanlines_per_chunk(file, 0, &lines) == EXR_ERR_SUCCESS);
    const int width = window.max.x + 1, height = window.max.y + 1;
    bool good = EXPECT(channels && channels->num_channels == LABEL_CHANNELS + 3) && EXPECT(width * height <= MOST_PIXELS);
    for (int c = 0; good && c < LABEL_CHANNELS; c++)
        EXPECT(strcmp(channels->entries[3 + c].name.str, label_channels[c].name) == 0);
    for (int y = 0; good && y < height; y += lines) {
        exr_chunk_info_t chunk;
        good = exr_read_scanline_chunk_info(file, 0, y, &chunk) == EXR_ERR_SUCCESS;
        good = good && (y == 0 ? exr_decoding_initialize(file, 0, &chunk, &decoder)
                               : exr_decoding_update(file, 0, &chunk, &decoder)) == EXR_ERR_SUCCESS;
        for (int c = 0; good && c < decoder.channel_count; c++) {
            decoder.channels[c].decode_to_ptr = (uint8_t *)&values[c][y * width];
            decoder.channels[c].user_pixel_stride = sizeof(float);
            decoder.channels[c].user_line_stride = width * (int32_t)sizeof(float);
            decoder.channels[c].user_bytes_per_element = sizeof(float);
            decoder.channels[c].user_data_type = EXR_PIXEL_FLOAT;
        }
        if (good && y == 0) good = exr_decoding_choose_default_routines(file, 0, &decoder) == EXR_ERR_SUCCESS;
        good = good && exr_decoding_run(file, 0, &decoder) == EXR_ERR_SUCCESS;
    }
    EXPECT(good);
    exr_decoding_destroy(file, &decoder);
    exr_finish(&file);
    return good ? width * height : 0;
}

/* The plate's five scratches run along x from u = 13/60, 34 mm long; a scene unit is 10 mm. */
int main(void) {
    char path[4096];
    const char *folder = getenv("PICTURES");
    if (!EXPECT(folder != NULL)) return expect_summary();
    protects("each view's EXR has the scratch layers, and they say what the plate is scratched with");
    for (int view = 1; view <= 3; view++) {
        snprintf(path, sizeof path, "%s/plate-%d.exr", folder, view);
        const int count = read_layers(path);
        int pixels[6] = {0};
        bool sound = true;
        float deepest[6] = {0}, longest = 0.0f;
        for (int i = 0; i < count; i++) {
            const float *layer[LABEL_CHANNELS];
            for (int c = 0; c < LABEL_CHANNELS; c++) layer[c] = &values[3 + c][i];
            const float arc_length = *layer[0], coverage = *layer[1], depth = *layer[3], id = *layer[7];
            const int number = id >= 0.0f && id <= 5.0f ? (int)id : 0;
            sound = sound && (float)number == id && coverage >= 0.0f && coverage <= 1.0f;
            sound = sound && (number > 0) == (coverage > 0.0f) && depth <= *layer[2];
            if (number > 0)
                sound = sound && fabsf(*layer[4] - 1.0f) < 1e-5f && fabsf(*layer[5]) < 1e-5f && fabsf(*layer[6]) < 1e-5f;
            pixels[number]++;
            deepest[number] = fmaxf(deepest[number], *layer[2]);
            longest = fmaxf(longest, arc_length);
        }
        EXPECT(sound);
        printf("  view %d: %d pixels bare; of each scratch %d %d %d %d %d; longest %.3f\n", view, pixels[0], pixels[1],
               pixels[2], pixels[3], pixels[4], pixels[5], (double)longest);
        for (int k = 1; k <= 5; k++) EXPECT(pixels[k] > 10 && pixels[k] < count / 20);
        for (int k = 1; k < 5; k++) EXPECT(deepest[k] > deepest[k + 1]);
        EXPECT(deepest[5] > 0.0f && deepest[1] < 0.1f && longest > 2.5f && longest <= 3.4f);
    }
    return expect_summary();
}
