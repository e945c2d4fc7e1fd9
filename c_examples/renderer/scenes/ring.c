/* The paper's Figure 13: a gold ring with an inscription, cut with an engraver's square graver. Scene units are mm. */
#include <stdio.h>
#include <stdlib.h>

#include "letters.h"
#include "props.h"
#include "scenes.h"

enum { FACE_RING = 1, ROUND = 128, PROFILE = 36, STROKE_KEYS = 9 };

/* "What is written remains." */
static const char INSCRIPTION[] = "SCRIPTA MANENT";
static const double LETTER_MM = 1.66;

static const double RADIUS_MM = 10.2, HALF_THICK_MM = 0.95, HALF_WIDE_MM = 3.1;

/* How deep the graver goes: as with a broad nib held slantwise, strokes across the nib are the heaviest. */
static const double THIN_MM = 0.06, THICK_MM = 0.17, NIB_DEG = 25.0;

/* The band's profile: a superellipse (r / a)^n + (z / b)^n = 1, flat outside and inside, its edges round. It is walked at
   even steps of length, so that texture space lies evenly on it. */
static const double POWER = 3.6;

typedef struct Profile {
    double place[PROFILE + 1][2]; /* from the middle of the inside round by the lower edge: outward and up */
} Profile;

static void superellipse(double turn, double place[2]) {
    place[0] = HALF_THICK_MM * copysign(pow(fabs(cos(turn)), 2.0 / POWER), cos(turn));
    place[1] = HALF_WIDE_MM * copysign(pow(fabs(sin(turn)), 2.0 / POWER), sin(turn));
}

static Profile make_profile(void) {
    enum { STEPS = 65536 };
    static double length[STEPS + 1];
    Profile profile;
    double before[2], place[2];
    superellipse(-PI, before);
    for (int i = 1; i <= STEPS; i++) {
        superellipse(2.0 * PI * i / STEPS - PI, place);
        length[i] = length[i - 1] + hypot(place[0] - before[0], place[1] - before[1]);
        before[0] = place[0];
        before[1] = place[1];
    }
    for (int row = 0, i = 0; row <= PROFILE; row++) {
        while (i < STEPS && length[i] < length[STEPS] * row / PROFILE) i++;
        superellipse(2.0 * PI * i / STEPS - PI, profile.place[row]);
    }
    return profile;
}

/* Its gradient is the profile's normal. */
static void ring_place(double u, double v, const void *user, Vec *position, Vec *normal) {
    const double *place = ((const Profile *)user)->place[(int)(v * PROFILE + 0.5)], round = 2.0 * PI * u;
    const double out = copysign(pow(fabs(place[0]) / HALF_THICK_MM, POWER - 1.0), place[0]) / HALF_THICK_MM;
    const double up = copysign(pow(fabs(place[1]) / HALF_WIDE_MM, POWER - 1.0), place[1]) / HALF_WIDE_MM;
    const double radius = RADIUS_MM + place[0];
    *position = vec(radius * cos(round), radius * sin(round), HALF_WIDE_MM + place[1]);
    *normal = vec_unit(vec(out * cos(round), out * sin(round), up));
}

/* A place of the inscription, mm along and up from its middle, on the ring's outside; +x is where it is read. */
static void engrave_at(double along, double up, double xyz[3]) {
    const double round = along / (RADIUS_MM + HALF_THICK_MM);
    xyz[0] = (RADIUS_MM + HALF_THICK_MM) * cos(round);
    xyz[1] = (RADIUS_MM + HALF_THICK_MM) * sin(round);
    xyz[2] = HALF_WIDE_MM + up;
}

/* The direction of a stroke at a share of its curves. */
static void tangent(const LetterStroke *stroke, double share, double direction[2]) {
    const size_t curves = (stroke->count - 1) / 3;
    const size_t curve = (size_t)fmin(share * (double)curves, (double)curves - 1.0);
    const double t = share * (double)curves - (double)curve, s = 1.0 - t;
    const double (*p)[2] = &stroke->points[3 * curve];
    for (int axis = 0; axis < 2; axis++)
        direction[axis] = s * s * (p[1][axis] - p[0][axis]) + 2.0 * s * t * (p[2][axis] - p[1][axis]) +
                          t * t * (p[3][axis] - p[2][axis]);
}

/* The graver dips in and comes out again, deepest where the stroke runs across the nib. */
static void stroke_keys(const LetterStroke *stroke, StriaeKey keys[STROKE_KEYS]) {
    static const double dip[STROKE_KEYS] = {0.35, 0.85, 1.0, 1.0, 1.0, 1.0, 1.0, 0.85, 0.35};
    const double nib = radians(NIB_DEG);
    for (int i = 0; i < STROKE_KEYS; i++) {
        const double share = i / (STROKE_KEYS - 1.0);
        double d[2];
        tangent(stroke, share, d);
        const double across = fabs(d[0] * sin(nib) - d[1] * cos(nib)) / hypot(d[0], d[1]);
        keys[i] = (StriaeKey){.at = share, .depth_mm = dip[i] * (THIN_MM + (THICK_MM - THIN_MM) * across)};
    }
}

static StriaeStatus cut(const LetterStroke *stroke, double left_mm, const StriaeTool *graver,
                        const StriaeSurface *surface, StriaePatternBuilder *builder) {
    double points[LETTER_MOST_POINTS][3];
    StriaeKey keys[STROKE_KEYS];
    for (size_t i = 0; i < stroke->count; i++)
        engrave_at(left_mm + LETTER_MM * stroke->points[i][0], LETTER_MM * (stroke->points[i][1] - 0.5), points[i]);
    stroke_keys(stroke, keys);
    const StriaeScratch scratch = {.struct_size = sizeof scratch,
                                   .tool = graver,
                                   .curve = STRIAE_CURVE_CUBIC_BEZIER,
                                   .depth_law = STRIAE_DEPTH_LAW_STATED,
                                   .point_count = stroke->count,
                                   .keys = keys,
                                   .key_count = STROKE_KEYS,
                                   .surface = surface,
                                   .points_xyz = (const double (*)[3])points};
    return striae_pattern_builder_add_scratch(builder, &scratch);
}

static StriaeStatus inscribe(const StriaeTool *graver, const StriaeSurface *surface,
                             StriaePatternBuilder *builder) {
    LetterStroke strokes[LETTER_MOST_STROKES];
    StriaeStatus status = STRIAE_STATUS_OK;
    double width, total = -LETTER_GAP;
    for (const char *letter = INSCRIPTION; *letter; letter++) {
        letter_strokes(*letter, strokes, &width);
        total += width + LETTER_GAP;
    }
    double left_mm = -0.5 * LETTER_MM * total;
    for (const char *letter = INSCRIPTION; *letter; letter++) {
        const size_t count = letter_strokes(*letter, strokes, &width);
        for (size_t i = 0; i < count && status == STRIAE_STATUS_OK; i++)
            status = cut(&strokes[i], left_mm, graver, surface, builder);
        left_mm += LETTER_MM * (width + LETTER_GAP);
    }
    return status;
}

/* What years on a finger leave. */
static StriaeStatus wear(const StriaeMaterial *bare, StriaePatternBuilder *builder) {
    StriaeGenerator handling = {.struct_size = sizeof handling};
    StriaeTool *grain = NULL;
    StriaeStatus status = striae_generator_preset(STRIAE_STYLE_HANDLING, &handling);
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_ABRASIVE_GRAIN, &grain);
    handling.per_cm2 = 1.5;
    handling.length_mm.from = 1.5;
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_generate(builder, &handling, grain, bare, 13);
    striae_tool_release(grain);
    return status;
}

static StriaeStatus ring_pattern(const Mesh *mesh, StriaePattern **pattern) {
    const StriaePatternOptions options = {
        sizeof options, 1.0, {2.0 * PI * RADIUS_MM, 4.0 * (HALF_THICK_MM + HALF_WIDE_MM) * 0.9}};
    StriaeMaterial gold = {.struct_size = sizeof gold};
    StriaeTool *graver = NULL;
    StriaeSurface *surface = NULL;
    StriaePatternBuilder *builder = NULL;
    double (*positions)[3] = malloc(mesh->vertex_count * sizeof *positions);
    if (!positions) return STRIAE_STATUS_INTERNAL;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const Vec p = mesh->positions[i];
        positions[i][0] = p.x;
        positions[i][1] = p.y;
        positions[i][2] = p.z;
    }
    StriaeStatus status = striae_material_metal(STRIAE_METAL_GOLD, &gold);
    if (status == STRIAE_STATUS_OK) status = striae_brdf_metal(STRIAE_METAL_GOLD, 0.09f, &gold.surface);
    /* Letters are darkened with a patina, or they would show as little as what they are cut into. */
    static const float patina[3] = {0.24f, 0.14f, 0.06f};
    if (status == STRIAE_STATUS_OK) status = striae_brdf_schlick(patina, 0.2f, &gold.scratched);
    StriaeMaterial bare = gold;
    bare.scratched = gold.surface;
    gold.pile_up_law = STRIAE_PILE_UP_LAW_NONE; /* a graver lifts chips out */
    if (status == STRIAE_STATUS_OK) status = striae_tool_preset(STRIAE_TOOL_PRESET_SQUARE_GRAVER, &graver);
    if (status == STRIAE_STATUS_OK)
        status =
            striae_surface_new((const double (*)[3])positions, (const double (*)[2])mesh->uv, mesh->vertex_count,
                               (const uint32_t (*)[3])mesh->triangles, mesh->triangle_count, &surface);
    free(positions);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_new(&gold, &options, &builder);
    if (status == STRIAE_STATUS_OK) status = wear(&bare, builder);
    if (status == STRIAE_STATUS_OK) status = inscribe(graver, surface, builder);
    if (status == STRIAE_STATUS_OK) status = striae_pattern_builder_build(builder, pattern);
    striae_pattern_builder_free(builder);
    striae_surface_release(surface);
    striae_tool_release(graver);
    return status;
}

/* A tent of white cloth, as jewellery is photographed in: bright above, dark below and behind the camera. */
static void tent(Vec direction, double radiance[3]) {
    static const double cloth[3] = {1.0, 0.93, 0.84};
    const double up = fmax(0.0, direction.z), away = 0.5 - 0.5 * direction.x;
    const double light = 0.015 + 0.25 * up * up * (0.2 + 0.8 * away);
    for (int c = 0; c < 3; c++) radiance[c] = light * cloth[c];
}

static void add_lamps(const Scene *scene, const Camera *camera, Lights *lights) {
    static const double key[3] = {13.0, 12.2, 11.0}, above[3] = {2.6, 2.5, 2.35}, behind[3] = {1.5, 1.5, 1.6};
    (void)camera;
    prop_soft_box(lights, scene->target, -62.0, 38.0, 34.0, 13.0, 13.0, key);
    prop_soft_box(lights, scene->target, 60.0, 66.0, 50.0, 40.0, 16.0, above);
    prop_soft_box(lights, scene->target, 160.0, 30.0, 70.0, 60.0, 20.0, behind);
}

bool scene_ring(Scene *scene, char error[SCENE_ERROR_SIZE]) {
    scene->mm_per_unit = 1.0;
    scene->target = vec(0.0, 0.0, HALF_WIDE_MM);
    scene->exposure = 1.1;
    scene->paths = 96;
    scene->most_indirect = 0.5;
    scene->add_lamps = add_lamps;
    scene->views[0] = (View){.name = "figure-13",
                             .heading_deg = -4.0,
                             .elevation_deg = 27.0,
                             .distance = 75.0,
                             .width_deg = 22.5,
                             .aside = {2.5, 0.0, -0.5},
                             .lens_radius = 0.4};
    scene->view_count = 1;
    scene->mesh_count = 2;
    snprintf(error, SCENE_ERROR_SIZE, "out of memory");
    const Profile profile = make_profile();
    Mesh *ring = &scene->meshes[0], *table = &scene->meshes[1];
    if (!mesh_init_grid(ring, FACE_RING, ROUND, PROFILE, ring_place, &profile) || !prop_table(table, 400.0, 0.0) ||
        !environment_paint(&scene->environment, 128, tent))
        return false;
    static const double felt[3] = {0.36, 0.30, 0.255};
    for (int c = 0; c < 3; c++) table->albedo[c] = felt[c];
    StriaePattern *pattern = NULL;
    if (ring_pattern(ring, &pattern) != STRIAE_STATUS_OK) return prop_refused(error);
    ring->pattern = pattern;
    return true;
}
