#include "section.h"

static StriaeStatus form(const Shot *shot, StriaeCrossSection **section) {
    const StriaeProcess process = cell_process(shot->cell);
    StriaeMaterial material;
    StriaeTool *tool = NULL;
    StriaeStatus status = cell_material(shot->group, shot->cell, &material);
    if (status == STRIAE_STATUS_OK) status = shot->cell->make_tool(&tool);
    if (status == STRIAE_STATUS_OK) status = striae_cross_section(tool, &material, &process, section);
    striae_tool_release(tool);
    return status;
}

/* Halfway between the feet of the two peaks. */
static StriaeStatus find_middle(const StriaeCrossSection *section, double *middle_mm) {
    StriaeCrossSectionInfo info = {.struct_size = sizeof info};
    double first[1][2];
    StriaeStatus status = striae_cross_section_info(section, &info);
    if (status == STRIAE_STATUS_OK) status = striae_cross_section_vertices(section, first, 1, NULL);
    if (status != STRIAE_STATUS_OK) return status;
    *middle_mm = first[0][0] + 0.5 * (info.left.outer_width_mm + info.crest_width_mm + info.right.outer_width_mm);
    return status;
}

/* What a strip shows: as much across the scratch as the picture above, and the surface somewhat below its middle. */
static StriaePlotOptions strip_options(const Shot *shot, int height) {
    const double across = shot->group->across_mm;
    const double tall = across * height / shot->width / shot->group->exaggeration;
    return (StriaePlotOptions){.struct_size = sizeof(StriaePlotOptions),
                               .style = STRIAE_PLOT_STYLE_STRIP,
                               .title = shot->cell->caption,
                               .x_mm = {shot->middle_mm - 0.5 * across, shot->middle_mm + 0.5 * across},
                               .z_mm = {-0.38 * tall, 0.62 * tall}};
}

const char *section_plot(Shot *shot, int height, const char *strip_path, const char *whole_path) {
    const StriaePlotOptions whole = {.struct_size = sizeof whole, .title = shot->cell->caption};
    StriaeCrossSection *section = NULL;
    StriaeStatus status = form(shot, &section);
    if (status == STRIAE_STATUS_OK) status = find_middle(section, &shot->middle_mm);
    if (status == STRIAE_STATUS_OK) {
        const StriaePlotOptions strip = strip_options(shot, height);
        status = striae_plot_cross_section(section, strip_path, (uint32_t)shot->width, (uint32_t)height, &strip);
    }
    if (status == STRIAE_STATUS_OK) status = striae_plot_cross_section(section, whole_path, 1200, 800, &whole);
    striae_cross_section_release(section);
    return status == STRIAE_STATUS_OK ? NULL : striae_last_error();
}
