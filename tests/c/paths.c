/* The example renderer's paths against what can be worked out by hand: lights, white furnaces, three ways to find light. */
#include "choose_light.h"
#include "paths.h"
#include "plate_fixture.h"

enum { ACROSS = 8 }; /* pixels of a side */

/* A square table, two units wide, seen from above. */
typedef struct Room {
    Scene scene;
    Tracer *tracer;
    Stage stage;
} Room;

static void flat_place(double u, double v, const void *user, Vec *position, Vec *normal) {
    (void)user;
    *position = vec(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0);
    *normal = vec(0.0, 0.0, 1.0);
}

static void ball_place(double u, double v, const void *user, Vec *position, Vec *normal) {
    (void)user;
    const double round = 2.0 * PI * u, polar = PI * (1.0 - v);
    *normal = vec(sin(polar) * cos(round), sin(polar) * sin(round), cos(polar));
    *position = *normal;
}

/* `pattern` may be NULL: matte, of the albedo. */
static bool room_init(Room *room, MeshPlace *place, StriaePattern *pattern, double albedo, double width_deg) {
    static char error[SCENE_ERROR_SIZE];
    *room = (Room){.scene = {.name = "room", .mesh_count = 1, .view_count = 1}};
    room->scene.views[0] = (View){
        .name = "from above", .heading_deg = -90.0, .elevation_deg = 60.0, .distance = 5.0, .width_deg = width_deg};
    if (!EXPECT(mesh_init_grid(&room->scene.meshes[0], 1, 64, 32, place, NULL))) return false;
    room->scene.meshes[0].pattern = pattern;
    for (int c = 0; c < 3; c++) room->scene.meshes[0].albedo[c] = albedo;
    room->tracer = tracer_new(&room->scene, error);
    room->stage = (Stage){.scene = &room->scene, .view = &room->scene.views[0], .tracer = room->tracer};
    room->stage.camera = camera_for_view(&room->scene, room->stage.view, ACROSS, ACROSS);
    return EXPECT(room->tracer != NULL);
}

static void room_free(Room *room) {
    tracer_free(room->tracer);
    scene_free(&room->scene);
}

/* Each pixel's green channel. */
typedef struct Pixels {
    double radiance[ACROSS * ACROSS];
} Pixels;

static Pixels draw(const Stage *stage, int samples, int reflections, PathStrategy strategy) {
    const PathSettings settings = {
        .samples = samples, .looks = 3, .reflections = reflections, .strategy = strategy};
    Pixels pixels = {{0.0}};
    for (int pixel = 0; pixel < ACROSS * ACROSS; pixel++) {
        for (int i = 0; i < samples; i++) {
            const PathLight light = path_follow(stage, &settings, pixel % ACROSS, pixel / ACROSS, (uint32_t)i);
            pixels.radiance[pixel] += (light.direct[1] + light.indirect[1]) / samples;
        }
    }
    return pixels;
}

/* The mean over all pixels less that of others, and that mean's standard deviation, as pixels tell it. */
typedef struct Mean {
    double value, deviation;
} Mean;

static Mean mean_above(const Pixels *pixels, const Pixels *others) {
    const int count = ACROSS * ACROSS;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        const double value = pixels->radiance[i] - others->radiance[i];
        sum += value / count;
        squares += value * value / count;
    }
    return (Mean){sum, sqrt(fmax(0.0, squares - sum * sum) / count)};
}

static double mean_radiance(const Stage *stage, int samples, int reflections, PathStrategy strategy) {
    const Pixels pixels = draw(stage, samples, reflections, strategy), black = {{0.0}};
    return mean_above(&pixels, &black).value;
}

static bool is_near(const char *what, double value, double expected, double tolerance) {
    printf("  %s: %.6f, expected %.6f\n", what, value, expected);
    return fabs(value - expected) <= tolerance * expected;
}

/* The share of a cosine-weighted hemisphere that a parallel rectangle fills, seen from under one of its corners, with sides
   a and b times its distance (Howell's catalogue of configuration factors, B-3). */
static double corner_factor(double a, double b) {
    const double p = sqrt(1.0 + a * a), q = sqrt(1.0 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2.0 * PI);
}

static void rectangle(void) {
    protects("a rectangle lights a matte surface under its middle as the integral over it says");
    Room room;
    if (!room_init(&room, flat_place, NULL, 0.5, 0.2)) return;
    const Lamp lamp = {.centre = {0.0, 0.0, 1.5},
                       .width = 2.0,
                       .height = 1.0,
                       .columns = 1,
                       .rows = 1,
                       .radiance = {3.0, 3.0, 3.0},
                       .fade = 1.0};
    lights_add(&room.stage.lights, &lamp);
    const double expected = 0.5 * 3.0 * 4.0 * corner_factor(1.0 / 1.5, 0.5 / 1.5);
    EXPECT(is_near("by lights", mean_radiance(&room.stage, 256, 1, PATHS_BY_LIGHTS), expected, 2e-3));
    EXPECT(is_near("by surfaces", mean_radiance(&room.stage, 1024, 1, PATHS_BY_SURFACES), expected, 1e-2));
    EXPECT(is_near("shared", mean_radiance(&room.stage, 256, 1, PATHS_SHARED), expected, 2e-3));
    room_free(&room);
}

static void points_and_suns(void) {
    protects("a point and a sun light a matte surface as their distance and angle say, without noise");
    Room room;
    if (!room_init(&room, flat_place, NULL, 0.5, 0.2)) return;
    room.stage.lights.points[0] = (PointLight){{3.0, 0.0, 4.0}, {50.0, 50.0, 50.0}};
    room.stage.lights.point_count = 1;
    EXPECT(is_near("point", mean_radiance(&room.stage, 1, 1, PATHS_SHARED), 0.5 / PI * 50.0 / 25.0 * 0.8, 1e-3));
    room.stage.lights.point_count = 0;
    room.stage.lights.suns[0] = (Sun){{0.6, 0.0, 0.8}, {2.0, 2.0, 2.0}};
    room.stage.lights.sun_count = 1;
    EXPECT(is_near("sun", mean_radiance(&room.stage, 1, 1, PATHS_SHARED), 0.5 / PI * 2.0 * 0.8, 1e-6));
    room_free(&room);
}

static void white(Vec direction, double radiance[3]) {
    (void)direction;
    for (int c = 0; c < 3; c++) radiance[c] = 1.0;
}

static void lopsided(Vec direction, double radiance[3]) {
    const double up = fmax(0.0, direction.z), spot = direction.x > 0.3 && direction.x < 0.6 ? 4.0 : 0.0;
    for (int c = 0; c < 3; c++) radiance[c] = 0.2 + up * up + spot * up;
}

static void expect_furnace(const char *what, MeshPlace *place, StriaePattern *pattern, uint32_t bounces,
                           double least, double most) {
    Room room;
    Environment environment;
    if (!EXPECT(environment_paint(&environment, 16, white)) || !room_init(&room, place, pattern, 1.0, 12.0)) return;
    room.stage.lights.environment = &environment;
    room.stage.bounces = bounces;
    const double mean = mean_radiance(&room.stage, 128, 4, PATHS_SHARED);
    printf("  %s: %.5f\n", what, mean);
    EXPECT(mean >= least && mean <= most);
    room_free(&room);
    environment_free(&environment);
}

/* White of one kind, bare or scratched all over. */
static StriaePattern *white_pattern(uint32_t kind, bool scratched) {
    const StriaePatternOptions options = {sizeof options, 1.0, {2.0, 2.0}};
    const StriaeBrdf finish = {.kind = kind, .albedo = {1, 1, 1}, .f0 = {1, 1, 1}, .alpha = 0.2f};
    StriaeMaterial material = {.struct_size = sizeof material};
    StriaeGenerator brushed = {.struct_size = sizeof brushed};
    StriaeTool *tool = NULL;
    StriaePatternBuilder *builder = NULL;
    StriaePattern *pattern = NULL;
    EXPECT_OK(striae_material_metal(STRIAE_METAL_STEEL, &material));
    material.surface = material.scratched = finish;
    EXPECT_OK(striae_generator_preset(STRIAE_STYLE_HANDLING, &brushed));
    EXPECT_OK(striae_tool_preset(STRIAE_TOOL_PRESET_ABRASIVE_GRAIN, &tool));
    EXPECT_OK(striae_pattern_builder_new(&material, &options, &builder));
    brushed.per_cm2 = 10000.0;
    if (scratched) EXPECT_OK(striae_pattern_builder_generate(builder, &brushed, tool, NULL, 1));
    EXPECT_OK(striae_pattern_builder_build(builder, &pattern));
    striae_pattern_builder_free(builder);
    striae_tool_release(tool);
    return pattern;
}

static void furnaces(void) {
    protects("what is white and convex does not show in white surroundings; GGX of alpha 0.2 loses what its facets "
             "steeper "
             "than 45 degrees (0.04 of them) send below the horizon, and more where it is seen aslant");
    expect_furnace("matte ball", ball_place, NULL, STRIAE_BOUNCES_ONE, 0.999, 1.001);
    expect_furnace("Lambert", flat_place, white_pattern(STRIAE_BRDF_KIND_LAMBERT, false), STRIAE_BOUNCES_ONE, 0.999,
                   1.001);
    expect_furnace("GGX ball", ball_place, white_pattern(STRIAE_BRDF_KIND_GGX, false), STRIAE_BOUNCES_ONE, 0.92,
                   0.96);
    protects("within grooves light is lost with one reflection, and none with all");
    expect_furnace("scratched, one", flat_place, white_pattern(STRIAE_BRDF_KIND_LAMBERT, true), STRIAE_BOUNCES_ONE,
                   0.6, 0.99);
    expect_furnace("scratched, all", flat_place, white_pattern(STRIAE_BRDF_KIND_LAMBERT, true), STRIAE_BOUNCES_ALL,
                   0.99, 1.01);
}

static void three_ways(void) {
    protects("light looked for, run into, and both with shares, is the same light: on a scratched, glossy plate "
             "under a lamp "
             "and lopsided surroundings");
    Room room;
    Environment environment;
    if (!EXPECT(environment_paint(&environment, 32, lopsided)) ||
        !room_init(&room, flat_place, white_pattern(STRIAE_BRDF_KIND_GGX, true), 0.0, 12.0))
        return;
    const Lamp lamp = {.centre = {-0.5, 1.0, 2.0},
                       .width = 1.0,
                       .height = 2.0,
                       .columns = 2,
                       .rows = 1,
                       .radiance = {3.0, 3.0, 3.0},
                       .fade = 0.3};
    lights_add(&room.stage.lights, &lamp);
    room.stage.lights.environment = &environment;
    const Pixels black = {{0.0}}, shared = draw(&room.stage, 128, 1, PATHS_SHARED);
    const double mean = mean_above(&shared, &black).value;
    for (PathStrategy way = PATHS_BY_LIGHTS; way <= PATHS_BY_SURFACES; way++) {
        const Pixels pixels = draw(&room.stage, 512, 1, way);
        const Mean above = mean_above(&pixels, &shared);
        printf("  %.5f above %.5f, by chance %.5f\n", above.value, mean, above.deviation);
        EXPECT(fabs(above.value) < 3.5 * above.deviation && above.deviation < 0.006 * mean);
    }
    room_free(&room);
    environment_free(&environment);
}

/* Its mean radiance over the sphere, by choosing directions. */
static double environment_mean(const Environment *environment) {
    const int count = 4096;
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        Sampler sampler = sampler_start(1, 2, (uint32_t)i);
        double u[2], radiance[3];
        sampler_next(&sampler, u);
        const Vec direction = environment_sample(environment, u);
        environment_radiance(environment, direction, radiance);
        sum += radiance[1] / (environment_pdf(environment, direction) * 4.0 * PI * count);
    }
    return sum;
}

static void surroundings(void) {
    protects("surroundings are chosen with the density told, and are the same after being written to a file and "
             "read back");
    Environment painted, read;
    Film film;
    double sum = 0.0;
    if (!EXPECT(environment_paint(&painted, 64, lopsided))) return;
    for (int i = 0; i < 200000; i++) {
        const double z = 1.0 - 2.0 * (i + 0.5) / 200000.0, turn = 2.399963229728653 * i, r = sqrt(1.0 - z * z);
        double radiance[3];
        environment_radiance(&painted, vec(r * cos(turn), r * sin(turn), z), radiance);
        sum += radiance[1] / 200000.0;
    }
    const double mean = environment_mean(&painted);
    EXPECT(is_near("mean by density", mean, sum, 2e-3));
    EXPECT(film_write_exr(&painted.map, "surroundings.exr") == NULL);
    EXPECT(film_read_exr(&film, "surroundings.exr") == NULL);
    EXPECT(environment_init(&read, &film));
    EXPECT(environment_mean(&read) == mean);
    remove("surroundings.exr");
    environment_free(&painted);
    environment_free(&read);
}

/* Where the ray through a place of the picture meets the table after a mirror at the ball. */
static Vec mirrored_place(const Room *room, double x, double y) {
    const Sample sample = {x, y, 1.0};
    const Ray ray = camera_ray(&room->stage.camera, &sample, (double[2]){0.0, 0.0});
    const double b = vec_dot(ray.origin, ray.direction);
    const double distance = -b - sqrt(b * b - vec_dot(ray.origin, ray.origin) + 1.0);
    const Vec normal = vec_along(ray.origin, distance, ray.direction);
    const Vec mirrored = vec_along(ray.direction, -2.0 * vec_dot(ray.direction, normal), normal);
    return vec_along(normal, 3.0, mirrored);
}

static void differentials(void) {
    protects(
        "a ray knows how far its neighbours lie from it: on the first surface, and after a mirror that is round");
    Room room;
    if (!room_init(&room, ball_place, NULL, 1.0, 12.0)) return;
    const Sample sample = {3.0, 5.0, 1.0};
    const Ray ray = camera_ray(&room.stage.camera, &sample, (double[2]){0.0, 0.0});
    Hit hit;
    if (!EXPECT(trace_closest(room.tracer, ray.origin, ray.direction, &hit))) return;
    const Surface surface = mesh_surface(hit.mesh, hit.triangle, ray.origin, ray.direction);
    float duv_dx[2], duv_dy[2];
    Vec offsets[2];
    double duv[2];
    EXPECT(ray_footprint(&ray, &surface, offsets));
    EXPECT(camera_footprint(&room.stage.camera, &surface, sample.x, sample.y, 1.0, duv_dx, duv_dy));
    surface_to_uv(&surface, offsets[0], duv);
    EXPECT(fabs(duv[0] - (double)duv_dx[0]) < 1e-3 * hypot(duv[0], duv[1]));
    EXPECT(fabs(duv[1] - (double)duv_dx[1]) < 1e-3 * hypot(duv[0], duv[1]));

    const Vec mirrored = vec_along(ray.direction, -2.0 * vec_dot(ray.direction, surface.normal), surface.normal);
    const Ray onwards = ray_onwards(&ray, &surface, vec_unit(mirrored), 1e12, 1); /* of no spread of its own */
    for (int k = 0; k < 2; k++) {
        const double h = 0.01, dx = k == 0 ? h : 0.0, dy = k == 1 ? h : 0.0;
        const Vec difference =
            vec_sub(mirrored_place(&room, 3.0 + dx, 5.0 + dy), mirrored_place(&room, 3.0 - dx, 5.0 - dy));
        const Vec truth = vec_scale(difference, 0.5 / h);
        const Vec told = vec_along(onwards.origin_by[k], 3.0, onwards.direction_by[k]);
        printf("  off by %.4f of %.4f\n", vec_length(vec_sub(told, truth)), vec_length(truth));
        EXPECT(vec_length(vec_sub(told, truth)) < 0.03 * vec_length(truth));
    }
    room_free(&room);
}

int main(void) {
    rectangle();
    points_and_suns();
    furnaces();
    three_ways();
    surroundings();
    differentials();
    return expect_summary();
}
