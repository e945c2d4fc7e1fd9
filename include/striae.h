/*
 * striae: physically based scratches for renderers.
 *
 * The calls that most programs need, in their order; c_examples/quickstart.c is a whole program:
 *
 *     striae_tool_preset()                       a tool; also from a mesh or a file: striae_tool_load()
 *     striae_material_metal()                    what is scratched
 *     striae_brdf_metal(), striae_brdf_host()    how its zones reflect, if not as it says: by name, or by code of yours
 *     striae_pattern_builder_new()               how large the surface is, and its material
 *     striae_pattern_builder_add_scratch()       a path, and force and orientation along it; by the many:
 *                                                striae_pattern_builder_add_scratches(), _generate(), _add_svg(),
 *                                                _load()
 *     striae_pattern_builder_build()             the pattern, for all threads; then
 *     striae_pattern_builder_free()
 *
 *     striae_frame(), striae_frame_to_local()    per shading point: directions in the surface's own frame
 *     striae_shade()                             per shading point and view
 *     striae_eval()                              per light: BRDF times cosine
 *     striae_shade_world(), _eval_world()        both with directions as the renderer has them: no frames to be turned into
 *     striae_sample()                            path tracers, per bounce: a light, its weight and density; for lights
 *     striae_eval_pdf(), _pdf_reverse()          chosen by others, BRDF times cosine and density, forwards and back
 *     striae_near()                              whether there is anything to shade: elsewhere the renderer's own material
 *                                                will do
 *     striae_shade_many(), _eval_many(), ...     the same for whole arrays, several times as fast where points have many
 *                                                lights
 *     striae_set_bounces()                       per shading point, if light is to go from wall to wall of a groove
 *     striae_zones(), striae_parameters()        what the point is made of; one lobe in place of all
 *     striae_pattern_query()                     which scratches are there, for masks and labels
 *
 *     striae_relief_mesh()                       the relief as triangles, to print, to check, or to look at from inside
 *     striae_baseline_bb90(), _bl99(), _mdg01()  the same scratches as earlier systems had them, shaded side by side
 *
 *     striae_pattern_release(), striae_tool_release()
 *
 * Units are in the names: lengths mm, forces kgf (9.80665 N), Vickers hardness kgf/mm^2, angles in
 * degrees. `view` and `light` both point away from the surface, in the local frame of striae_frame().
 *
 * Calls that can fail return a StriaeStatus; striae_last_error() then says which argument was refused,
 * what was given and what is accepted. A number that is NaN or out of the range told is refused, and so is NULL
 * where it is not said to do; it is never dereferenced. Outputs are written on success only; handles become NULL
 * on failure. Arrays must be as long as their counts say. Enumerations are passed as uint32_t.
 *
 * Structures with a struct_size are zero but for what is stated: StriaeScratch scratch = {.struct_size =
 * sizeof scratch, .tool = tool, ...}. Any other size than this header's is refused.
 *
 * Arrays, texts and structures given to a call are copied, and handles given to it may be released after it.
 * Handles are immutable and may be shared between threads: retain and release count references, may be called
 * from any thread, and accept NULL. What a call makes has one reference, its caller's.
 *
 * Every call may be made from any number of threads at once, as long as no two write to the same output or file
 * or use the same builder. Shading (from striae_frame() to striae_set_simd() below, and striae_baseline_shade()) never
 * allocates, locks or blocks, and gives the same with denormals flushed to zero. Other calls may allocate and take
 * time; building and generating work on all cores (RAYON_NUM_THREADS in the environment says how many). Where memory
 * runs out the process ends, as in any Rust library.
 */

#ifndef STRIAE_H
#define STRIAE_H

#include <stddef.h>
#include <stdint.h>

/**
 * Major version of the header.
 */
#define STRIAE_VERSION_MAJOR 0

/**
 * Minor version of the header. Before 1.0 each minor version may change the ABI.
 */
#define STRIAE_VERSION_MINOR 1

/**
 * Patch version of the header.
 */
#define STRIAE_VERSION_PATCH 0

/**
 * A triangle's `scratch` on the unscratched surface.
 */
#define STRIAE_NO_SCRATCH UINT32_MAX

/**
 * Flag of striae_eval(): the BRDF alone, without the cosine between light and normal.
 */
#define STRIAE_EVAL_BRDF_ONLY 1

/**
 * striae_set_bounces(): light goes from one zone to the viewer.
 */
#define STRIAE_BOUNCES_ONE 0

/**
 * striae_set_bounces(): light goes from zone to zone within a scratch, and to the flat surface beside it, until it leaves.
 */
#define STRIAE_BOUNCES_ALL 1

/**
 * Flag of a lobe: it reflects, as all of them do.
 */
#define STRIAE_LOBE_REFLECTION 1

/**
 * Flag of a lobe: diffuse (Lambert, Oren-Nayar).
 */
#define STRIAE_LOBE_DIFFUSE 2

/**
 * Flag of a lobe: about the mirrored view (Phong, microfacets).
 */
#define STRIAE_LOBE_GLOSSY 4

/**
 * Flag of a glossy lobe less than alpha 0.02 wide, which may be treated like a mirror. Its density is finite all the same.
 */
#define STRIAE_LOBE_SHARP 8

/**
 * Flag of a lobe: a zone of a scratch; without it the flat surface.
 */
#define STRIAE_LOBE_SCRATCH 16

/**
 * What a call says of its outcome. After anything but `STRIAE_STATUS_OK`, striae_last_error() has the details.
 */
typedef enum StriaeStatus {
  /**
   * All went well.
   */
  STRIAE_STATUS_OK = 0,
  /**
   * An argument was refused. Nothing was made or changed.
   */
  STRIAE_STATUS_INVALID_ARGUMENT = 1,
  /**
   * A fault of the library's own: it is caught, and what the call was to write may be there in part. Please report it.
   */
  STRIAE_STATUS_INTERNAL = 2,
  /**
   * A file could not be read, used or written. Nothing was made or changed.
   */
  STRIAE_STATUS_FILE = 3,
} StriaeStatus;

/**
 * Tools by name. Where no standard is named, none gives the sizes: they are typical ones of our choosing. No scratch may be
 * deeper than its tool is tall: 2 to 5 mm, the square graver 1.69 mm, the grain 0.125 mm.
 */
typedef enum StriaeToolPreset {
  /**
   * The diamond of scratch testers: a 120 degree cone with a 0.2 mm tip radius (ISO 6508-2).
   */
  STRIAE_TOOL_PRESET_ROCKWELL_C = 0,
  /**
   * A square pyramid, 136 degrees between opposite faces (ISO 6507-2). As it stands a face leads; spun by
   * 45 degrees an edge does.
   */
  STRIAE_TOOL_PRESET_VICKERS = 1,
  /**
   * A wire nail's point: a cone of 50 degrees in all, blunted to 0.1 mm.
   */
  STRIAE_TOOL_PRESET_NAIL = 2,
  /**
   * A slotted screwdriver, blade 0.8 x 4 mm (a size of ISO 2380-1), its edge across the travel.
   */
  STRIAE_TOOL_PRESET_SCREWDRIVER = 3,
  /**
   * A three-sided pyramid, faces at 65.27 degrees to the axis (ISO 14577-2).
   */
  STRIAE_TOOL_PRESET_BERKOVICH = 4,
  /**
   * A scriber: a 30 degree point, sharp to 0.05 mm.
   */
  STRIAE_TOOL_PRESET_SCRIBER = 5,
  /**
   * A square graver: a 90 degree keel on a 2.4 mm bar.
   */
  STRIAE_TOOL_PRESET_SQUARE_GRAVER = 6,
  /**
   * A round graver: a keel 0.6 mm wide, half a circle.
   */
  STRIAE_TOOL_PRESET_ROUND_GRAVER = 7,
  /**
   * A flat graver: an edge 0.6 mm wide.
   */
  STRIAE_TOOL_PRESET_FLAT_GRAVER = 8,
  /**
   * A needle's point: 20 degrees in all, tip radius 0.02 mm.
   */
  STRIAE_TOOL_PRESET_NEEDLE = 9,
  /**
   * The worn corner of a key: 90 degrees, tip radius 0.15 mm.
   */
  STRIAE_TOOL_PRESET_KEY = 10,
  /**
   * A corner of an abrasive grain, 0.125 mm across (the mean of FEPA P120), sharp.
   */
  STRIAE_TOOL_PRESET_ABRASIVE_GRAIN = 11,
} StriaeToolPreset;

/**
 * Metals with known hardness and optical constants.
 */
typedef enum StriaeMetal {
  /**
   * Aluminium alloy 6061-T6, 107 HV.
   */
  STRIAE_METAL_ALUMINIUM = 0,
  /**
   * Cartridge brass, half hard, 120 HV.
   */
  STRIAE_METAL_BRASS = 1,
  /**
   * Low-carbon steel AISI 1018, 131 HV.
   */
  STRIAE_METAL_STEEL = 2,
  /**
   * Titanium, grade 2, 145 HV.
   */
  STRIAE_METAL_TITANIUM = 3,
  /**
   * 37.6 HV.
   */
  STRIAE_METAL_COPPER = 4,
  /**
   * 22 HV.
   */
  STRIAE_METAL_GOLD = 5,
  /**
   * 25.6 HV.
   */
  STRIAE_METAL_SILVER = 6,
  /**
   * 62 HV.
   */
  STRIAE_METAL_IRON = 7,
  /**
   * 65 HV.
   */
  STRIAE_METAL_NICKEL = 8,
  /**
   * 108 HV.
   */
  STRIAE_METAL_CHROMIUM = 9,
} StriaeMetal;

/**
 * Materials by name that are no metals.
 */
typedef enum StriaeMaterialPreset {
  /**
   * Acrylic glass (PMMA), opaque grey, 20 HV: springs back.
   */
  STRIAE_MATERIAL_PRESET_ACRYLIC = 0,
  /**
   * Soda-lime glass over a dark ground, 550 HV: brittle, little pile-up (an estimate), springs back by 0.45.
   */
  STRIAE_MATERIAL_PRESET_GLASS = 1,
  /**
   * Alumina, white, 1500 HV: brittle, little pile-up (an estimate).
   */
  STRIAE_MATERIAL_PRESET_CERAMIC = 2,
} StriaeMaterialPreset;

/**
 * How steep the outer flanks of piled-up material are.
 */
typedef enum StriaePileUpLaw {
  /**
   * tan beta = -0.56 + 2.54 tan alpha (Bosch et al. 2004), at least a quarter of tan alpha.
   */
  STRIAE_PILE_UP_LAW_BOSCH2004 = 0,
  /**
   * tan beta = outer_slope.
   */
  STRIAE_PILE_UP_LAW_OUTER_SLOPE = 1,
  /**
   * No peaks at all.
   */
  STRIAE_PILE_UP_LAW_NONE = 2,
} StriaePileUpLaw;

/**
 * Kinds of base BRDF.
 */
typedef enum StriaeBrdfKind {
  /**
   * Perfectly diffuse: `albedo`.
   */
  STRIAE_BRDF_KIND_LAMBERT = 0,
  /**
   * GGX microfacets with height-correlated Smith masking: `alpha` and a Fresnel reflectance.
   */
  STRIAE_BRDF_KIND_GGX = 1,
  /**
   * Rough and diffuse, by Oren and Nayar in Fujii's form: `albedo` and `roughness`.
   */
  STRIAE_BRDF_KIND_OREN_NAYAR = 2,
  /**
   * Phong's lobe, normalised: `specular` and `exponent`.
   */
  STRIAE_BRDF_KIND_PHONG = 3,
  /**
   * Cook-Torrance: Beckmann microfacets, masked as V-grooves: `alpha` and a Fresnel reflectance.
   */
  STRIAE_BRDF_KIND_COOK_TORRANCE = 4,
  /**
   * GGX of polishing lines, which run along the scratch, or on the flat surface along dp_du: `alpha_across`,
   * `alpha_along` and a Fresnel reflectance.
   */
  STRIAE_BRDF_KIND_ANISOTROPIC_GGX = 5,
  /**
   * The host's own: `host`.
   */
  STRIAE_BRDF_KIND_HOST = 6,
} StriaeBrdfKind;

/**
 * Kinds of Fresnel reflectance.
 */
typedef enum StriaeFresnelKind {
  /**
   * Schlick's approximation from `f0`.
   */
  STRIAE_FRESNEL_KIND_SCHLICK = 0,
  /**
   * A conductor's exact reflectance from `eta` and `k`.
   */
  STRIAE_FRESNEL_KIND_CONDUCTOR = 1,
} StriaeFresnelKind;

/**
 * Laws that give a groove's depth.
 */
typedef enum StriaeDepthLaw {
  /**
   * The fit of Bosch et al. 2004, made with a Rockwell C cone in metals; below a force over hardness of
   * 4.17e-4 mm² it leaves no scratch.
   */
  STRIAE_DEPTH_LAW_BOSCH2004 = 0,
  /**
   * Scratch hardness (ASTM G171): the groove is sqrt(8 F / (pi HV)) wide between its two crests. Any tool.
   */
  STRIAE_DEPTH_LAW_SCRATCH_HARDNESS = 1,
  /**
   * The depth is stated, whatever the force.
   */
  STRIAE_DEPTH_LAW_STATED = 2,
} StriaeDepthLaw;

/**
 * A measure of a scratch that its author wants.
 */
typedef enum StriaeWanted {
  /**
   * Depth of the groove below the surface.
   */
  STRIAE_WANTED_DEPTH = 0,
  /**
   * Width of the groove at the surface.
   */
  STRIAE_WANTED_GROOVE_WIDTH = 1,
  /**
   * Width between the two crests.
   */
  STRIAE_WANTED_CREST_WIDTH = 2,
} StriaeWanted;

/**
 * How much a plot says.
 */
typedef enum StriaePlotStyle {
  /**
   * Axes around the drawing; every zone, area, width and angle labelled.
   */
  STRIAE_PLOT_STYLE_ANNOTATED = 0,
  /**
   * To be set under another picture of the same place and width: the drawing fills the image to its edges, its
   * scales lie within, and nothing but the title is written on it.
   */
  STRIAE_PLOT_STYLE_STRIP = 1,
} StriaePlotStyle;

/**
 * What a scratch's spin and azimuth are relative to.
 */
typedef enum StriaeHeld {
  /**
   * The direction of travel: the hand turns with the path. Azimuth 0 leans forward, 90 to the left.
   */
  STRIAE_HELD_TO_PATH = 0,
  /**
   * The surface: the hand does not turn while the path does. Azimuth 0 leans towards u, 90 towards v.
   */
  STRIAE_HELD_TO_SURFACE = 1,
} StriaeHeld;

/**
 * Kinds of path: what its points mean, and how many there must be.
 */
typedef enum StriaeCurve {
  /**
   * Straight lines from point to point: two points or more. Closed (three or more), the last joins the first.
   */
  STRIAE_CURVE_POLYLINE = 0,
  /**
   * Cubic Bezier curves, each starting where the last ends: 3 n + 1 points. Closed, the last one ends at the first
   * point: 3 n points.
   */
  STRIAE_CURVE_CUBIC_BEZIER = 1,
  /**
   * A smooth curve through all points, two or more, closed three or more: the centripetal Catmull-Rom spline, which
   * neither loops nor overshoots between unevenly spaced points. An open one sets out straight towards its
   * second point, and arrives likewise. Points that repeat the one before count once.
   */
  STRIAE_CURVE_CATMULL_ROM = 2,
  /**
   * A uniform cubic B-spline, smooth to its curvature, led by its points and passing through none: four or more;
   * open, n points give n - 3 curves and both ends lie inside. Closed it is periodic: three or more.
   */
  STRIAE_CURVE_B_SPLINE = 3,
  /**
   * A cubic B-spline with `knots`. Open: n points, four or more, and n + 4 knots, never descending; the curve runs
   * from knots[3] to knots[n], clamped to its first and last point where these knots are there four times. (Programs
   * that state n + 2 knots leave out the first and the last, which move nothing: repeat their neighbours.)
   * Between the ends a knot may be there three times at most: three times is a corner. Closed it is periodic: n
   * points, three or more, and n + 1 knots, from the first to its repetition one round later; of a periodic
   * curve told as an open one, its first three points repeated at its end, leave out those three and the last
   * six knots.
   */
  STRIAE_CURVE_NON_UNIFORM_B_SPLINE = 4,
} StriaeCurve;

/**
 * Generators by name. All numbers are of our choosing: somewhere to begin. Forces suit metals and a sharp tool, such
 * as STRIAE_TOOL_PRESET_ABRASIVE_GRAIN.
 */
typedef enum StriaeStyle {
  /**
   * Straight scratches in every direction: 20 on a cm², 2 to 20 mm long.
   */
  STRIAE_STYLE_STRAIGHT = 0,
  /**
   * A brushed finish: fine, dense, nearly parallel to u.
   */
  STRIAE_STYLE_BRUSHED = 1,
  /**
   * What a buffing wheel or a cloth moved in circles leaves: fine arcs, all bent to the left.
   */
  STRIAE_STYLE_SWIRLS = 2,
  /**
   * Years of handling: fine scratches of every size and direction, mostly short and light, few long and deep.
   */
  STRIAE_STYLE_HANDLING = 3,
} StriaeStyle;

/**
 * Kinds of distribution.
 */
typedef enum StriaeDistributionKind {
  /**
   * Every value from `from` to `to` alike; the same for all where both are the same.
   */
  STRIAE_DISTRIBUTION_KIND_UNIFORM = 0,
  /**
   * Normal, mean `middle` and standard deviation `deviation` (0 to 1e9), cut at both ends.
   */
  STRIAE_DISTRIBUTION_KIND_NORMAL = 1,
  /**
   * Normal in the logarithm, median `middle`, standard deviation of the natural logarithm `deviation` (0 to 10), cut
   * at both ends.
   */
  STRIAE_DISTRIBUTION_KIND_LOG_NORMAL = 2,
  /**
   * A density that falls like the value to the power of -`exponent` (-10 to 10); `from` is above 0.
   */
  STRIAE_DISTRIBUTION_KIND_POWER_LAW = 3,
  /**
   * A density that falls by a factor e with every `decay` (1e-9 to 1e9).
   */
  STRIAE_DISTRIBUTION_KIND_EXPONENTIAL = 4,
} StriaeDistributionKind;

/**
 * What a pixel covers of the surface around a point.
 */
typedef enum StriaeFootprint {
  /**
   * Nothing but the point itself.
   */
  STRIAE_FOOTPRINT_POINT = 0,
  /**
   * A square along x and y that reaches `radius` scene units from the point on each side.
   */
  STRIAE_FOOTPRINT_RADIUS = 1,
  /**
   * The parallelogram centred on the point with edges `duv_dx` and `duv_dy`.
   */
  STRIAE_FOOTPRINT_DIFFERENTIALS = 2,
} StriaeFootprint;

/**
 * A surface scratched in the manner of an earlier system, for work side by side. Immutable; any thread may use it;
 * reference-counted.
 */
typedef struct StriaeBaseline StriaeBaseline;

/**
 * A scratch's cross-section. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaeCrossSection StriaeCrossSection;

/**
 * Hardness that varies over a surface. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaeHardnessMap StriaeHardnessMap;

/**
 * A surface with its scratches. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaePattern StriaePattern;

/**
 * Collects scratches. One thread at a time; whoever made it frees it.
 */
typedef struct StriaePatternBuilder StriaePatternBuilder;

/**
 * A region's relief as triangles. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaeReliefMesh StriaeReliefMesh;

/**
 * A triangle mesh with texture coordinates, for paths that are drawn on it. Immutable; any thread may use it;
 * reference-counted.
 */
typedef struct StriaeSurface StriaeSurface;

/**
 * A scratching tool. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaeTool StriaeTool;

/**
 * The host's own base BRDF, for any zones and the flat surface: three functions. Set struct_size to sizeof(StriaeHostBrdf);
 * striae_brdf_host() makes a StriaeBrdf of it.
 *
 * Directions are three numbers each, in the zone's own frame: x across the scratch, to the right of its travel where the zone
 * is level, y along it (on the flat surface along dp_du), z the zone's normal. They have unit length and point away from the
 * surface. `view`, and in `eval` the light too, lie above the zone. What is reflected depends on them and on `user` alone.
 * Where it is to vary over the surface, ask for striae_zones() and add them up yourself.
 *
 * The functions are called while points are shaded, sampled and evaluated, by whichever threads do that, at any time and
 * several at once; they must not throw, jump out, or call striae with the StriaeShading that is being asked. The library
 * allocates nothing around them. Both they and what `user` points to must stay as long as any pattern or StriaeShading
 * that has them is used. The library remembers each different table, about 200 bytes, until the process ends.
 *
 * What they give is believed, but for this: what is negative or no number counts as 0. So it is up to them that no light is
 * gained, that samples follow their density, and that `eval` over light[2] is the same with view and light swapped.
 */
typedef struct StriaeHostBrdf {
  /**
   * sizeof(StriaeHostBrdf)
   */
  size_t struct_size;
  /**
   * Writes to `f` BRDF times cosine, that between light and the zone's normal (light[2]), linear RGB.
   */
  void (*eval)(void *user, const float *view, const float *light, float *f);
  /**
   * Writes to `light` a direction, of any length above 0, chosen by two numbers `u` from 0 up to (not including) 1. It is
   * all zeros before: left so, no light is chosen, which counts as black. A light below the zone reflects nothing.
   */
  void (*sample)(void *user, const float *u, const float *view, float *light);
  /**
   * Returns the density of `sample` at a light, per steradian: also at one below the zone, 0 where `sample` never goes.
   */
  float (*pdf)(void *user, const float *view, const float *light);
  /**
   * Given to each of them; NULL if they need none.
   */
  void *user;
  /**
   * STRIAE_LOBE_DIFFUSE or STRIAE_LOBE_GLOSSY: what samples of its zones are flagged with.
   */
  uint32_t lobe;
  /**
   * How far it spreads light: the width alpha of GGX microfacets that do so about as far across the scratch, 0.001 to 1 (1
   * if it is diffuse). The smaller, the more finely a curved groove is divided into zones.
   */
  float alpha_across;
  /**
   * The same along the scratch. Lobes without width, of a perfect mirror, are not accepted.
   */
  float alpha_along;
} StriaeHostBrdf;

/**
 * A base BRDF: how the finish of one zone reflects. Linear RGB. Fields that its kinds do not name are ignored.
 */
typedef struct StriaeBrdf {
  /**
   * A StriaeBrdfKind.
   */
  uint32_t kind;
  /**
   * A StriaeFresnelKind (GGX, anisotropic GGX, Cook-Torrance).
   */
  uint32_t fresnel;
  /**
   * Lambert, Oren-Nayar: albedo, 0 to 1.
   */
  float albedo[3];
  /**
   * GGX, Cook-Torrance: width of the distribution of slopes, 0.001 to 1.
   */
  float alpha;
  /**
   * Schlick: reflectance at normal incidence, 0 to 1.
   */
  float f0[3];
  /**
   * Conductor: real part of the index of refraction, 0.01 to 20.
   */
  float eta[3];
  /**
   * Conductor: its imaginary part, 0 to 20.
   */
  float k[3];
  /**
   * Anisotropic GGX: width of the distribution of slopes across the polishing lines, 0.001 to 1.
   */
  float alpha_across;
  /**
   * Anisotropic GGX: width along the lines, 0.001 to 1.
   */
  float alpha_along;
  /**
   * Oren-Nayar: 0 (Lambert) to 1 (as rough as can be), without a unit.
   */
  float roughness;
  /**
   * Phong: of the lobe's cosine, 1 (wide) to 100000 (sharp).
   */
  float exponent;
  /**
   * Phong: colour, 0 to 1.
   */
  float specular[3];
  /**
   * The host's own: its functions, as striae_brdf_host() fills in. A table of yours must live during each call that the
   * base BRDF is given to, and no longer; one that the library fills in stays.
   */
  const struct StriaeHostBrdf *host;
} StriaeBrdf;

/**
 * A layer on top of a material's bulk, such as paint. It changes how a scratch looks, not how deep it is.
 */
typedef struct StriaeLayer {
  /**
   * Thickness, mm, 1e-6 to 1000.
   */
  double thickness_mm;
  /**
   * How a scratch's zones reflect where they lie in this layer.
   */
  struct StriaeBrdf scratched;
} StriaeLayer;

/**
 * What is scratched. Set struct_size to sizeof(StriaeMaterial), fill it with striae_material_metal() or
 * striae_material_preset(), and change what you like.
 */
typedef struct StriaeMaterial {
  /**
   * sizeof(StriaeMaterial)
   */
  size_t struct_size;
  /**
   * Vickers hardness (scratch hardness for STRIAE_DEPTH_LAW_SCRATCH_HARDNESS), kgf/mm², 0.01 to 20000.
   */
  double hardness_hv;
  /**
   * A StriaePileUpLaw.
   */
  uint32_t pile_up_law;
  /**
   * tan beta for STRIAE_PILE_UP_LAW_OUTER_SLOPE, 0.001 to 11.4.
   */
  double outer_slope;
  /**
   * Area of both peaks over the area of the groove, 0 to 1 (nothing is lost).
   */
  double pile_up_fraction;
  /**
   * Share of the depth that springs back behind the tool, 0 to 0.95.
   */
  double elastic_recovery;
  /**
   * How the unscratched surface reflects.
   */
  struct StriaeBrdf surface;
  /**
   * How a scratch's zones reflect where it reaches the bulk of the material.
   */
  struct StriaeBrdf scratched;
  /**
   * Layers from the surface down; NULL for none. They must live during each call that the material is given to, and no
   * longer.
   */
  const struct StriaeLayer *layers;
  /**
   * How many layers, 4 at most.
   */
  size_t layer_count;
} StriaeMaterial;

/**
 * How a tool is held and pressed. Set struct_size to sizeof(StriaeProcess).
 */
typedef struct StriaeProcess {
  /**
   * sizeof(StriaeProcess)
   */
  size_t struct_size;
  /**
   * A StriaeDepthLaw.
   */
  uint32_t depth_law;
  /**
   * Normal force, kgf, 0 to 100000: does not count under STRIAE_DEPTH_LAW_STATED.
   */
  double force_kgf;
  /**
   * Depth under load, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
   */
  double depth_mm;
  /**
   * Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
   */
  double spin_deg;
  /**
   * Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
   */
  double tilt_deg;
  /**
   * Where the axis leans to: 0 = forward, 90 = left of travel, degrees, -3600 to 3600.
   */
  double azimuth_deg;
} StriaeProcess;

/**
 * One of the two peaks beside a groove.
 */
typedef struct StriaePeak {
  /**
   * Slope of the inner flank, degrees.
   */
  double alpha_deg;
  /**
   * Slope of the outer flank, degrees.
   */
  double beta_deg;
  /**
   * Height above the surface, mm.
   */
  double height_mm;
  /**
   * Width of the inner flank, mm.
   */
  double inner_width_mm;
  /**
   * Width of the outer flank, mm.
   */
  double outer_width_mm;
} StriaePeak;

/**
 * Measures of a cross-section; all 0 where the force left no scratch, lengths after elastic recovery. Set struct_size to
 * sizeof(StriaeCrossSectionInfo).
 */
typedef struct StriaeCrossSectionInfo {
  /**
   * sizeof(StriaeCrossSectionInfo)
   */
  size_t struct_size;
  /**
   * Depth of the groove below the surface, mm.
   */
  double depth_mm;
  /**
   * Area of the groove below the surface, mm².
   */
  double groove_area_mm2;
  /**
   * Width of the groove at the surface, mm.
   */
  double groove_width_mm;
  /**
   * Width between the two crests, mm.
   */
  double crest_width_mm;
  /**
   * The peak left of travel.
   */
  struct StriaePeak left;
  /**
   * The peak right of travel.
   */
  struct StriaePeak right;
  /**
   * How many points striae_cross_section_vertices() has.
   */
  size_t vertex_count;
} StriaeCrossSectionInfo;

/**
 * What else a plot is to be. All zero but struct_size: an annotated plot of all there is.
 */
typedef struct StriaePlotOptions {
  /**
   * sizeof(StriaePlotOptions)
   */
  size_t struct_size;
  /**
   * A StriaePlotStyle.
   */
  uint32_t style;
  /**
   * Written at the top, in bold; a strip has room for further lines, in plain. UTF-8, NUL-terminated. NULL for none
   * of your own.
   */
  const char *title;
  /**
   * What is shown across the scratch, from and to (above from), mm, -10000 to 10000; both 0 for what fits.
   */
  double x_mm[2];
  /**
   * What is shown of depths and heights, likewise.
   */
  double z_mm[2];
} StriaePlotOptions;

/**
 * One indentation: where it was made and what it gave.
 */
typedef struct StriaeReading {
  /**
   * Texture coordinates, -1e9 to 1e9.
   */
  double uv[2];
  /**
   * Vickers hardness, kgf/mm², 0.01 to 20000.
   */
  double hardness_hv;
} StriaeReading;

/**
 * Scale of a pattern. Texture space is not wrapped: scratches lie where they were drawn, once, at any (u, v). Set
 * struct_size to sizeof(StriaePatternOptions).
 */
typedef struct StriaePatternOptions {
  /**
   * sizeof(StriaePatternOptions)
   */
  size_t struct_size;
  /**
   * Millimetres in one scene unit, 1e-9 to 1e9.
   */
  double mm_per_scene_unit;
  /**
   * Scene units that one unit of u and of v spans, 1e-9 to 1e9 each. Arc length along paths is measured
   * with it, nothing else: while shading, dp_du and dp_dv count.
   */
  double units_per_uv[2];
} StriaePatternOptions;

/**
 * Force and orientation at one place along a scratch.
 */
typedef struct StriaeKey {
  /**
   * Share of the path's arc length, 0 to 1, not below the key before.
   */
  double at;
  /**
   * Normal force, kgf, 0 to 100000: does not count under STRIAE_DEPTH_LAW_STATED.
   */
  double force_kgf;
  /**
   * Depth under load, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
   */
  double depth_mm;
  /**
   * Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
   */
  double spin_deg;
  /**
   * Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
   */
  double tilt_deg;
  /**
   * Where the axis leans to, degrees, -3600 to 3600: StriaeHeld says from where.
   */
  double azimuth_deg;
} StriaeKey;

/**
 * One scratch: a tool drawn along a path. Set struct_size to sizeof(StriaeScratch). A scratch ends hard, with the tool's
 * own print, where it is pressed at an open end, and runs out softly where force or depth are 0 there.
 */
typedef struct StriaeScratch {
  /**
   * sizeof(StriaeScratch)
   */
  size_t struct_size;
  /**
   * The tool; the pattern keeps what it needs of it.
   */
  const struct StriaeTool *tool;
  /**
   * Another hardness and finish than the surface's for this scratch; NULL for the surface's own.
   */
  const struct StriaeMaterial *material;
  /**
   * A StriaeCurve.
   */
  uint32_t curve;
  /**
   * A StriaeDepthLaw.
   */
  uint32_t depth_law;
  /**
   * A StriaeHeld.
   */
  uint32_t held;
  /**
   * The path's points in texture space, (u, v) each, -1e9 to 1e9; not read with a surface.
   */
  const double (*points_uv)[2];
  /**
   * How many points, `points_uv` or `points_xyz`: StriaeCurve says how many there must be.
   */
  size_t point_count;
  /**
   * Force and orientation along the path, ascending in `at`: linear in arc length between keys, constant
   * before the first and after the last.
   */
  const struct StriaeKey *keys;
  /**
   * How many keys, 1 or more.
   */
  size_t key_count;
  /**
   * 1: the path ends where it begins; 0: it has two ends.
   */
  uint32_t closed;
  /**
   * Knots of a STRIAE_CURVE_NON_UNIFORM_B_SPLINE, -1e9 to 1e9; NULL for other curves.
   */
  const double *knots;
  /**
   * How many knots; 0 for other curves.
   */
  size_t knot_count;
  /**
   * NULL: the path is `points_uv`. Otherwise the mesh that it is drawn on: `points_xyz`, in space near the
   * mesh, as in a modeller. The path is the curve's closest points on the mesh, its arc length that on the mesh;
   * it goes on where texture space has a seam or passes to another chart, mirrored or not. Where it leaves an
   * open mesh by more than a tenth of a triangle there is no path; arc length goes on where it comes back. Where
   * the closest point leaps, the path runs straight across the mesh.
   */
  const struct StriaeSurface *surface;
  /**
   * The path's points in the mesh's own coordinates, -1e9 to 1e9, point_count of them; not read without a surface.
   */
  const double (*points_xyz)[3];
} StriaeScratch;

/**
 * How a quantity varies from scratch to scratch: always between `from` and `to`. Fields that the kind does not name
 * are ignored.
 */
typedef struct StriaeDistribution {
  /**
   * A StriaeDistributionKind.
   */
  uint32_t kind;
  /**
   * Least: the quantity's field says what there may be.
   */
  double from;
  /**
   * Most, not below `from`.
   */
  double to;
  /**
   * Normal: the mean; log-normal: the median, above 0; both before the cut, and between `from` and `to`.
   */
  double middle;
  /**
   * Normal and log-normal: the standard deviation.
   */
  double deviation;
  /**
   * Power law: the density falls like the value to the power of minus this.
   */
  double exponent;
  /**
   * Exponential: the density falls by a factor e with each.
   */
  double decay;
} StriaeDistribution;

/**
 * Scratches by the many. Set struct_size to sizeof(StriaeGenerator), fill it with striae_generator_preset() and change what
 * you like.
 */
typedef struct StriaeGenerator {
  /**
   * sizeof(StriaeGenerator)
   */
  size_t struct_size;
  /**
   * How many in all, 1e8 at most; 0 to go by `per_cm2`.
   */
  uint32_t count;
  /**
   * How many on each cm² of the area, 0 to 1e8, where `count` is 0; in all rounded to a whole number, 1e8 at most.
   */
  double per_cm2;
  /**
   * Two opposite corners of a rectangle, (u, v), -1e6 to 1e6, the first one lower in both. The scratches' middles
   * are spread over it evenly; their ends may reach beyond.
   */
  double area_uv[2][2];
  /**
   * Length along the path, mm, 1e-6 to 1e6.
   */
  struct StriaeDistribution length_mm;
  /**
   * Normal force in full, kgf, 0 to 100000.
   */
  struct StriaeDistribution force_kgf;
  /**
   * Depth under load in full, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
   */
  struct StriaeDistribution depth_mm;
  /**
   * Main direction, counter-clockwise from u on the surface, degrees, -3600 to 3600. A bent scratch has it on
   * average between its two ends.
   */
  double direction_deg;
  /**
   * Standard deviation from the main direction, degrees: 0 (parallel) to 360 (every direction alike).
   */
  double spread_deg;
  /**
   * How much a path turns from start to end on average, to the left, degrees, -3600 to 3600. No single curve turns
   * by more than 90 degrees.
   */
  double turn_deg;
  /**
   * Standard deviation of that from scratch to scratch, degrees, 0 to 3600.
   */
  double turn_spread_deg;
  /**
   * Standard deviation of a single curve's turn from its share of the whole, degrees, 0 to 90.
   */
  double wander_deg;
  /**
   * Curves in a path, of equal length, 1 to 64.
   */
  uint32_t curves;
  /**
   * Shares of the length over which force or depth rise from 0 and fall back to it, each 0 to 1, together 1 at most.
   */
  double taper[2];
  /**
   * Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
   */
  double spin_deg;
  /**
   * Standard deviation of the spin from scratch to scratch, degrees, 0 to 360.
   */
  double spin_spread_deg;
  /**
   * Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
   */
  double tilt_deg;
  /**
   * Where the axis leans to, degrees, -3600 to 3600: StriaeHeld says from where.
   */
  double azimuth_deg;
  /**
   * A StriaeHeld; STRIAE_HELD_TO_SURFACE gives each scratch cross-sections of its own, which takes memory.
   */
  uint32_t held;
  /**
   * A StriaeDepthLaw.
   */
  uint32_t depth_law;
} StriaeGenerator;

/**
 * What scratches are made along a drawing's paths. All zero but struct_size and tool: on the unit square, each as wide
 * as its stroke. Set struct_size to sizeof(StriaeSvgOptions).
 */
typedef struct StriaeSvgOptions {
  /**
   * sizeof(StriaeSvgOptions)
   */
  size_t struct_size;
  /**
   * The tool; the pattern keeps what it needs of it.
   */
  const struct StriaeTool *tool;
  /**
   * Another hardness and finish than the surface's for these scratches; NULL for the surface's own.
   */
  const struct StriaeMaterial *material;
  /**
   * Where the drawing's edges come to lie: two opposite corners, (u, v), -1e6 to 1e6, the first one lower in both; all 0
   * for the unit square. The drawing's top is the area's.
   */
  double area_uv[2][2];
  /**
   * A StriaeDepthLaw.
   */
  uint32_t depth_law;
  /**
   * A StriaeHeld.
   */
  uint32_t held;
  /**
   * Normal force, kgf, 0 to 100000; 0 for what makes each scratch as wide between its two crests as its stroke, at the
   * material's own hardness.
   */
  double force_kgf;
  /**
   * Likewise the depth under load, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
   */
  double depth_mm;
  /**
   * Shares of the length over which force or depth rise from 0 and fall back to it, each 0 to 1, together 1 at most.
   */
  double taper[2];
  /**
   * Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
   */
  double spin_deg;
  /**
   * Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
   */
  double tilt_deg;
  /**
   * Where the axis leans to, degrees, -3600 to 3600: StriaeHeld says from where.
   */
  double azimuth_deg;
} StriaeSvgOptions;

/**
 * What part of a pattern becomes triangles, and how closely. Set struct_size to sizeof(StriaeMeshRegion).
 */
typedef struct StriaeMeshRegion {
  /**
   * sizeof(StriaeMeshRegion)
   */
  size_t struct_size;
  /**
   * The rectangle's lowest (u, v), -1e9 to 1e9.
   */
  double low_uv[2];
  /**
   * Its highest (u, v), above the lowest.
   */
  double high_uv[2];
  /**
   * How far the triangles may stray from the relief, mm, 1e-9 to 1000: along straight scratches of steady force they
   * do not.
   */
  double tolerance_mm;
  /**
   * Thickness of the plate, mm: 0 for an open surface that ends at the rectangle's border; otherwise, up to 1e6 and more
   * than the deepest scratch, the triangles close around a solid.
   */
  double base_mm;
} StriaeMeshRegion;

/**
 * What a triangle is a part of.
 */
typedef struct StriaeMeshZone {
  /**
   * Number of its scratch in order of adding, from 0; STRIAE_NO_SCRATCH on the unscratched surface.
   */
  uint32_t scratch;
  /**
   * Number of its base BRDF: striae_relief_mesh_brdf().
   */
  uint32_t brdf;
  /**
   * Unit direction of the scratch's travel in x and y, along which polishing lines run; along x on the unscratched
   * surface.
   */
  float travel[2];
} StriaeMeshZone;

/**
 * A mesh's arrays: its own, valid until it is freed. Set struct_size to sizeof(StriaeMeshArrays).
 */
typedef struct StriaeMeshArrays {
  /**
   * sizeof(StriaeMeshArrays)
   */
  size_t struct_size;
  /**
   * (x, y, z) of each vertex, mm: x and y are u and v to the scale of the pattern's units_per_uv, z is up from the
   * unscratched surface.
   */
  const double (*positions)[3];
  /**
   * How many vertices.
   */
  size_t vertex_count;
  /**
   * Three vertices of each triangle, counter-clockwise from outside.
   */
  const uint32_t (*triangles)[3];
  /**
   * What each triangle is a part of.
   */
  const struct StriaeMeshZone *zones;
  /**
   * How many triangles.
   */
  size_t triangle_count;
  /**
   * How many base BRDFs; number 0 is the unscratched surface's.
   */
  size_t brdf_count;
} StriaeMeshArrays;

/**
 * A point of a scratched surface. `dp_du`, `dp_dv` and `normal` are in any one frame of the renderer's, world space say. A
 * footprint is below 1e12 mm long.
 */
typedef struct StriaePoint {
  /**
   * Texture coordinates: any finite numbers, not wrapped.
   */
  double uv[2];
  /**
   * Derivative of position by u, scene units. It and `dp_dv` span the tangent plane, at any angle and either way round.
   */
  float dp_du[3];
  /**
   * Derivative of position by v, scene units.
   */
  float dp_dv[3];
  /**
   * Surface normal, of any length above 0.
   */
  float normal[3];
  /**
   * A StriaeFootprint; fields that it does not name are ignored.
   */
  uint32_t footprint;
  /**
   * STRIAE_FOOTPRINT_RADIUS: scene units, above 0.
   */
  float radius;
  /**
   * STRIAE_FOOTPRINT_DIFFERENTIALS: change of (u, v) by one pixel in x.
   */
  float duv_dx[2];
  /**
   * STRIAE_FOOTPRINT_DIFFERENTIALS: change of (u, v) by one pixel in y. One of both may be 0, as an edge of a line.
   */
  float duv_dy[2];
} StriaePoint;

/**
 * A point's local frame in the renderer's: z is the unit normal, x is dp_du made orthogonal to it, y is z cross x.
 */
typedef struct StriaeFrame {
  /**
   * Along dp_du.
   */
  float x[3];
  /**
   * z cross x.
   */
  float y[3];
  /**
   * The normal.
   */
  float z[3];
} StriaeFrame;

/**
 * A point seen from one direction: plain data, 8 KiB at most, on the caller's stack. It need not be initialised, owns
 * nothing, outlives its pattern, and may be copied and read by any thread. Write to none of it.
 */
typedef struct StriaeShading {
  /**
   * How much of what the pixel shows belongs to scratches, as seen from `view`, 0 to 1.
   */
  float coverage;
  /**
   * How many scratches run through the footprint, those included that later ones cut away. Where they are too many to be
   * looked at one by one, how many cross-sections and directions they were summed up by.
   */
  uint32_t scratch_count;
  /**
   * The library's own.
   */
  uint64_t opaque[1023];
} StriaeShading;

/**
 * One scratch in a footprint. Coverage is that of the whole footprint; all else is told of the scratch's place that is
 * nearest to the footprint's centre.
 */
typedef struct StriaeHit {
  /**
   * Number of the scratch in order of adding, from 0: those of a generator or a file count one by one. Add those first
   * whose numbers are to be known beforehand.
   */
  uint32_t scratch;
  /**
   * The share of the footprint that the scratch covers with its rims, less what later scratches cut: above 0, to 1. Where
   * the footprint holds more than 128 runs of scratch, less what later ones cut on average.
   */
  float coverage;
  /**
   * From the scratch's start along its path, scene units.
   */
  double arc_length;
  /**
   * From the centre line to the footprint's centre, mm, to the right of travel.
   */
  double offset_mm;
  /**
   * Unit direction of travel in the local frame; z is 0. striae_frame_to_world() turns it into the renderer's.
   */
  float travel[3];
  /**
   * How deep the cross-section lies below the unscratched surface at the footprint's centre, mm; negative on the
   * piled-up rims, 0 beside the scratch. What a later scratch cuts away there counts as if it were still there.
   */
  float depth_mm;
  /**
   * The cross-section's depth where it is deepest, mm.
   */
  float deepest_mm;
} StriaeHit;

/**
 * How many scratches a footprint holds.
 */
typedef struct StriaeHitCount {
  /**
   * Hits that were written, from the first on: the smaller one of `found` and the capacity.
   */
  size_t written;
  /**
   * Scratches that were told apart.
   */
  size_t found;
  /**
   * 1 if these are all, 0 if not: a footprint over thousands of scratches is not searched to its end, so that it
   * has others that are not counted, and perhaps none that is.
   */
  uint32_t complete;
} StriaeHitCount;

/**
 * A light chosen for a view.
 */
typedef struct StriaeSample {
  /**
   * Unit direction to the light, away from the surface and above it.
   */
  float light[3];
  /**
   * Density of the choice, per steradian, by whichever zone the light might have been chosen: that of striae_pdf(). Always
   * finite. 0 if no light was chosen, which counts as black; then all else is 0, too.
   */
  float pdf;
  /**
   * BRDF times cosine over `pdf`: what light from there counts, linear RGB. With STRIAE_BOUNCES_ALL so on average only.
   */
  float weight[3];
  /**
   * STRIAE_LOBE flags of the zone that was chosen.
   */
  uint32_t lobe;
} StriaeSample;

/**
 * What is reflected of a light, and how often the light is chosen.
 */
typedef struct StriaeEvaluated {
  /**
   * BRDF times cosine, linear RGB, as striae_eval() without flags.
   */
  float f[3];
  /**
   * Density with which striae_sample() chooses the light, per steradian.
   */
  float pdf;
} StriaeEvaluated;

/**
 * A facet of a scratch, or the flat surface, as a shading point shows it. Directions are unit vectors in the local frame.
 */
typedef struct StriaeZone {
  /**
   * The zone's normal.
   */
  float normal[3];
  /**
   * Along the scratch, or along the flat surface's polishing lines; at right angles to `normal`.
   */
  float tangent[3];
  /**
   * How often striae_sample() chooses it, of all that is chosen: the share of the pixel that the viewer sees it in.
   * Scratches of a crowd are chosen by what all of them show on average.
   */
  float seen;
  /**
   * The share of the pixel in which the viewer sees it lit: its BRDF times cosine, about `normal`, counts so often.
   */
  float lit;
  /**
   * Number of its base BRDF: striae_zone_brdf().
   */
  uint32_t brdf;
} StriaeZone;

/**
 * The scratches of a point as a single lobe: GGX microfacets whose slopes deviate as much along either axis as the
 * seen zones' and those of their own microfacets do together. Of an unscratched point: the surface's own.
 */
typedef struct StriaeParameters {
  /**
   * The share of what the pixel shows that scratches are, 0 to 1.
   */
  float coverage;
  /**
   * Along the scratches, where the lobe is narrowest: from the local frame's x towards its y, degrees, 0 up to 180. 0
   * where no direction stands out.
   */
  float tangent_deg;
  /**
   * Width alpha of the distribution of slopes along that direction, 0.001 to 1.
   */
  float alpha_along;
  /**
   * Width across it, from `alpha_along` to 1.
   */
  float alpha_across;
  /**
   * Alpha of an isotropic lobe as wide: the geometric mean of both.
   */
  float roughness;
  /**
   * 0 (none) up to 1: 1 less `alpha_along` over `alpha_across`.
   */
  float anisotropy;
  /**
   * The lobe's unit normal in the local frame: scratches that show one wall lean.
   */
  float normal[3];
} StriaeParameters;

/**
 * Vectors that are read, as a structure of arrays. Of arrays of vectors: `{v[0], v[0] + 1, v[0] + 2, 3}` for `float v[][3]`.
 */
typedef struct StriaeVectors {
  /**
   * First components, one of each vector.
   */
  const float *x;
  /**
   * Second components.
   */
  const float *y;
  /**
   * Third components.
   */
  const float *z;
  /**
   * Floats from one vector's component to the next one's, 1 or more: 1 where they are packed.
   */
  size_t stride;
} StriaeVectors;

/**
 * Vectors that are written, as StriaeVectors are read.
 */
typedef struct StriaeVectorsOut {
  /**
   * First components, one of each vector.
   */
  float *x;
  /**
   * Second components.
   */
  float *y;
  /**
   * Third components.
   */
  float *z;
  /**
   * Floats from one vector's component to the next one's, 1 or more: 1 where they are packed.
   */
  size_t stride;
} StriaeVectorsOut;

/**
 * Samples that are written: what StriaeSample has, as a structure of arrays.
 */
typedef struct StriaeSamplesOut {
  /**
   * Unit directions to the lights.
   */
  struct StriaeVectorsOut light;
  /**
   * BRDF times cosine over `pdf`, linear RGB.
   */
  struct StriaeVectorsOut weight;
  /**
   * Densities per steradian, packed; 0 where no light was chosen.
   */
  float *pdf;
  /**
   * STRIAE_LOBE flags, packed; NULL if they are not wanted.
   */
  uint32_t *lobe;
} StriaeSamplesOut;

/**
 * Which part of texture space an earlier system paints its scratches on, and how finely. What lies beside it is unscratched.
 */
typedef struct StriaeCanvas {
  /**
   * Two opposite corners of a rectangle, (u, v), -1e6 to 1e6, the first one lower in both.
   */
  double area_uv[2][2];
  /**
   * Texels in u and in v, each 1 to 32768, 2^30 at most in all.
   */
  uint32_t texels[2];
} StriaeCanvas;

/**
 * The one cross-section of MDG01: four zones of equal width, a peak, a groove, and the same peak again. Set struct_size to
 * sizeof(StriaeTwoAngles).
 */
typedef struct StriaeTwoAngles {
  /**
   * sizeof(StriaeTwoAngles)
   */
  size_t struct_size;
  /**
   * Width of all four zones together, mm, 1e-6 to 1e6.
   */
  double width_mm;
  /**
   * How steeply the peaks rise from the surface, degrees, 0 to 85.
   */
  double peak_deg;
  /**
   * How steeply the groove falls from their tops, degrees, 0 to 85.
   */
  double groove_deg;
  /**
   * Base BRDFs of the zones, from left to right.
   */
  struct StriaeBrdf zones[4];
} StriaeTwoAngles;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The library's version at run time: (major << 16) | (minor << 8) | patch. Any thread; never fails.
 */
uint32_t striae_version(void);

/**
 * The text of this thread's last failed call: which argument, what was given, what is accepted. UTF-8, cut after 511
 * bytes, never NULL, empty before the first failure. The library's own: valid until this thread fails again or ends. Calls
 * that succeed leave it as it is. Allocates nothing; but where a library was opened at run time (dlopen), the system
 * may have to make room for a thread's first text when its first call fails.
 */
const char *striae_last_error(void);

/**
 * Makes a cone whose tip is rounded by a sphere.
 *
 * @param half_angle_deg angle between flank and axis, 5 to 85
 * @param tip_radius_mm 0 (sharp) to 100
 * @param height_mm 1e-6 to 1000, and taller than the rounded tip; no scratch may be deeper
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_sphero_cone(double half_angle_deg,
                                          double tip_radius_mm,
                                          double height_mm,
                                          struct StriaeTool **tool);

/**
 * Makes a pyramid, corners at azimuths 360 degrees (i + 1/2) / sides from the right of travel, counter-clockwise.
 *
 * @param sides 3 to 64
 * @param angle_deg between opposite faces (each stands at half of it to the axis), 10 to 170
 * @param height_mm 1e-6 to 1000
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_pyramid(uint32_t sides,
                                      double angle_deg,
                                      double height_mm,
                                      struct StriaeTool **tool);

/**
 * Makes a wedge: a straight edge across the travel, two faces meeting in it, flat upright ends.
 *
 * @param width_mm length of the edge, 1e-6 to 1000
 * @param angle_deg between the faces, 1 to 170
 * @param height_mm 1e-6 to 1000
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_wedge(double width_mm,
                                    double angle_deg,
                                    double height_mm,
                                    struct StriaeTool **tool);

/**
 * Makes a tool from a triangle mesh. Any mesh will do: non-convex, open, unoriented. z points up, the tip down.
 *
 * The lowest point (the middle, if several are lowest) becomes the tip. Where the mesh leans over its own foot, the
 * groove's wall stands upright. From 1e-6 to 1e4 mm across.
 *
 * @param positions position_count vertices x, y, z, in units of mm_per_unit; copied
 * @param position_count 1 to 50000000
 * @param triangles triangle_count times three indices into positions; copied
 * @param triangle_count 1 to 50000000
 * @param mm_per_unit 1e-9 to 1e9: 1 for mm, 25.4 for inches, 1000 for metres
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_mesh(const double (*positions)[3],
                                   size_t position_count,
                                   const uint32_t (*triangles)[3],
                                   size_t triangle_count,
                                   double mm_per_unit,
                                   struct StriaeTool **tool);

/**
 * Makes a flat sheet across the travel, such as a ground scraper, from its lower edge. Its lowest point becomes the
 * tip. From 1e-6 to 1e4 mm across.
 *
 * @param points_mm point_count corners of the edge in order, x to the right of travel, z up; copied
 * @param point_count 2 to 50000000
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_profile(const double (*points_mm)[2],
                                      size_t point_count,
                                      struct StriaeTool **tool);

/**
 * Makes a tool by name. From a 3D model: striae_tool_load().
 *
 * @param preset a StriaeToolPreset
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_preset(uint32_t preset, struct StriaeTool **tool);

/**
 * Adds a reference. NULL is fine.
 */
void striae_tool_retain(const struct StriaeTool *tool);

/**
 * Drops a reference; the last one frees the tool. NULL is fine.
 */
void striae_tool_release(const struct StriaeTool *tool);

/**
 * Fills in a base BRDF of the host's own. The table is copied.
 *
 * @code{.c}
 * static void paint_eval(void *user, const float *view, const float *light, float *f) {
 *   const Paint *paint = user;
 *   for (int c = 0; c < 3; c++) f[c] = paint->albedo[c] * light[2] / 3.14159265f;
 * }
 * StriaeHostBrdf host = {.struct_size = sizeof host, .eval = paint_eval, .sample = paint_sample, .pdf = paint_pdf,
 *                        .user = &paint, .lobe = STRIAE_LOBE_DIFFUSE, .alpha_across = 1.0f, .alpha_along = 1.0f};
 * striae_brdf_host(&host, &material.scratched);
 * @endcode
 *
 * @param host the functions
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_host(const struct StriaeHostBrdf *host,
                                   struct StriaeBrdf *brdf);

/**
 * Fills in a diffuse base BRDF. Allocates nothing.
 *
 * @param albedo RGB, each 0 to 1
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_lambert(const float albedo[3], struct StriaeBrdf *brdf);

/**
 * Fills in a rough diffuse base BRDF: Oren-Nayar.
 *
 * @param albedo RGB, each 0 to 1
 * @param roughness 0 (Lambert) to 1 (as rough as can be), without a unit
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_oren_nayar(const float albedo[3],
                                         float roughness,
                                         struct StriaeBrdf *brdf);

/**
 * Fills in a normalised Phong lobe.
 *
 * @param specular RGB, each 0 to 1
 * @param exponent of the lobe's cosine, 1 (wide) to 100000 (sharp)
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_phong(const float specular[3],
                                    float exponent,
                                    struct StriaeBrdf *brdf);

/**
 * Fills in GGX microfacets with Schlick's Fresnel reflectance. For Cook-Torrance set `kind` afterwards; for polishing
 * lines `kind` and whichever of `alpha_across` and `alpha_along` differs.
 *
 * @param f0 reflectance at normal incidence, RGB, each 0 to 1
 * @param alpha width of the distribution of slopes, 0.001 (mirror) to 1 (rough)
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_schlick(const float f0[3],
                                      float alpha,
                                      struct StriaeBrdf *brdf);

/**
 * Fills in a metal's base BRDF: GGX with its own conductor Fresnel reflectance. For Cook-Torrance set `kind`
 * afterwards; for polishing lines `kind` and whichever of `alpha_across` and `alpha_along` differs.
 *
 * @param metal a StriaeMetal
 * @param alpha width of the distribution of slopes, 0.001 (mirror) to 1 (rough)
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_metal(uint32_t metal,
                                    float alpha,
                                    struct StriaeBrdf *brdf);

/**
 * Fills in a metal: its hardness, a satin surface (GGX alpha 0.3) and smoother scratches (0.15), flowing as the
 * metals of Bosch et al. 2004 do: nothing is lost, nothing springs back. No layers.
 *
 * @param metal a StriaeMetal
 * @param material with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_material_metal(uint32_t metal,
                                        struct StriaeMaterial *material);

/**
 * Fills in a material by name. No layers.
 *
 * @param preset a StriaeMaterialPreset
 * @param material with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_material_preset(uint32_t preset, struct StriaeMaterial *material);

/**
 * Sets a material's pile-up fraction and elastic recovery from its plasticity, by a fit to finite-element
 * scratches (yield strain 5e-4 to 0.01, hardening 0.1 to 0.5).
 *
 * @param yield_strain yield stress over Young's modulus, 1e-4 to 0.1
 * @param hardening strain-hardening exponent, 0 to 0.6
 * @param material a filled-in material; its pile-up law counts; two fields are written, on success only
 */
enum StriaeStatus striae_material_set_plasticity(double yield_strain,
                                                 double hardening,
                                                 struct StriaeMaterial *material);

/**
 * Forms the cross-section that a tool, held and pressed so, leaves in a material. A force too small for a scratch is no
 * failure: all measures are 0. One that pushes the tool deeper than it is tall is refused.
 *
 * @param tool the tool
 * @param material its hardness, pile-up and recovery count
 * @param process how the tool is held and pressed
 * @param cross_section receives a handle to release with striae_cross_section_release(); NULL on failure
 */
enum StriaeStatus striae_cross_section(const struct StriaeTool *tool,
                                       const struct StriaeMaterial *material,
                                       const struct StriaeProcess *process,
                                       struct StriaeCrossSection **cross_section);

/**
 * Finds the process that leaves a scratch of a wanted size: the exact inverse of striae_cross_section().
 *
 * @param tool the tool
 * @param material the material
 * @param wanted a StriaeWanted
 * @param value_mm how much of it, 1e-9 to 1000, and no more than the tool can leave
 * @param process with struct_size, depth_law and angles set; its force_kgf (0 under STRIAE_DEPTH_LAW_STATED) and
 *     depth_mm are written, on success only
 */
enum StriaeStatus striae_process_for(const struct StriaeTool *tool,
                                     const struct StriaeMaterial *material,
                                     uint32_t wanted,
                                     double value_mm,
                                     struct StriaeProcess *process);

/**
 * Measures a cross-section.
 *
 * @param cross_section the cross-section
 * @param info with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_cross_section_info(const struct StriaeCrossSection *cross_section,
                                            struct StriaeCrossSectionInfo *info);

/**
 * Writes a cross-section's points (x, z), mm, from left to right of travel; the surface is at z = 0.
 *
 * @param cross_section the cross-section
 * @param xz_mm room for `capacity` points; may be NULL, to ask for the count alone
 * @param capacity how many points there is room for; what does not fit is left out
 * @param count receives how many points the cross-section has, also where fewer were written; may be NULL
 */
enum StriaeStatus striae_cross_section_vertices(const struct StriaeCrossSection *cross_section,
                                                double (*xz_mm)[2],
                                                size_t capacity,
                                                size_t *count);

/**
 * Adds a reference. NULL is fine.
 */
void striae_cross_section_retain(const struct StriaeCrossSection *cross_section);

/**
 * Drops a reference; the last one frees the cross-section. NULL is fine.
 */
void striae_cross_section_release(const struct StriaeCrossSection *cross_section);

/**
 * Draws a cross-section into a file: as PNG or as SVG, by the end of the file's name.
 *
 * Zones have their colours, lengths are in µm, and the picture says by how much heights are exaggerated. The same
 * cross-section gives the same picture on every machine. A file that cannot be written, and a
 * name that ends otherwise, are answered with STRIAE_STATUS_FILE.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param cross_section the cross-section; one without a scratch is a flat line
 * @param path the file's path, ending in .png or .svg, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param width_px 64 to 8192
 * @param height_px 64 to 8192
 * @param options what else the plot is to be; may be NULL
 */
enum StriaeStatus striae_plot_cross_section(const struct StriaeCrossSection *cross_section,
                                            const char *path,
                                            uint32_t width_px,
                                            uint32_t height_px,
                                            const struct StriaePlotOptions *options);

/**
 * Makes a hardness map from a texture over u and v from 0 to 1: bilinear between texel centres, clamped beyond.
 *
 * @param values width times height values, row by row, the first row at v = 1 (as images are stored)
 * @param width texels in a row, 1 or more
 * @param height rows, 1 or more; width times height is 2^28 at most
 * @param from_hv hardness that a value of 0 means, 0.01 to 20000
 * @param to_hv hardness that a value of 1 means, 0.01 to 20000; every value must lead into that range
 * @param map receives a handle to release with striae_hardness_map_release(); NULL on failure
 */
enum StriaeStatus striae_hardness_map_texture(const float *values,
                                              size_t width,
                                              size_t height,
                                              double from_hv,
                                              double to_hv,
                                              struct StriaeHardnessMap **map);

/**
 * Makes a hardness map from indentation readings: natural-neighbour interpolation, clamped outside their hull.
 *
 * @param readings one or more, anywhere; of several at the same place the last counts
 * @param reading_count 1 to 10000000
 * @param map receives a handle to release with striae_hardness_map_release(); NULL on failure
 */
enum StriaeStatus striae_hardness_map_readings(const struct StriaeReading *readings,
                                               size_t reading_count,
                                               struct StriaeHardnessMap **map);

/**
 * Adds a reference. NULL is fine.
 */
void striae_hardness_map_retain(const struct StriaeHardnessMap *map);

/**
 * Drops a reference; the last one frees the map. NULL is fine.
 */
void striae_hardness_map_release(const struct StriaeHardnessMap *map);

/**
 * Makes a surface of a triangle mesh. Where texture space has a seam the vertices are there twice, as renderers have
 * them: those at exactly the same position count as one place of the surface. Either winding will do, also a
 * mixture; charts may be mirrored. Triangles without area, in space or in texture space, are left out.
 *
 * @param positions vertex_count positions, scene units, each coordinate -1e7 to 1e7; copied
 * @param uv vertex_count texture coordinates, -1e9 to 1e9; copied
 * @param vertex_count how many vertices
 * @param triangles triangle_count times three vertex indices; copied
 * @param triangle_count how many triangles, below 2^32; one or more must have area
 * @param surface receives a handle to release with striae_surface_release(); NULL on failure
 */
enum StriaeStatus striae_surface_new(const double (*positions)[3],
                                     const double (*uv)[2],
                                     size_t vertex_count,
                                     const uint32_t (*triangles)[3],
                                     size_t triangle_count,
                                     struct StriaeSurface **surface);

/**
 * Adds a reference. NULL is fine.
 */
void striae_surface_retain(const struct StriaeSurface *surface);

/**
 * Drops a reference; the last one frees the surface. NULL is fine.
 */
void striae_surface_release(const struct StriaeSurface *surface);

/**
 * Begins a pattern on an unscratched surface; striae_pattern_builder_load() begins one with all that a file holds.
 *
 * @param surface the surface's material (a StriaeSurface is something else: a mesh to draw on)
 * @param options scale
 * @param builder receives a builder to free with striae_pattern_builder_free(); NULL on failure
 */
enum StriaeStatus striae_pattern_builder_new(const struct StriaeMaterial *surface,
                                             const struct StriaePatternOptions *options,
                                             struct StriaePatternBuilder **builder);

/**
 * Lets the surface's hardness vary: scratches added from now on meet the map along their way instead of the
 * material's own hardness. Scratches with a material of their own keep that one's.
 *
 * @param builder the builder; keeps a copy
 * @param map the map
 */
enum StriaeStatus striae_pattern_builder_set_hardness(struct StriaePatternBuilder *builder,
                                                      const struct StriaeHardnessMap *map);

/**
 * Adds a scratch on top of those before it: where they cross, it cuts them. Everything is copied; if it is refused, the
 * builder is as it was.
 *
 * @param builder the builder
 * @param scratch the scratch
 */
enum StriaeStatus striae_pattern_builder_add_scratch(struct StriaePatternBuilder *builder,
                                                     const struct StriaeScratch *scratch);

/**
 * Adds scratches in their order, prepared on all cores: as striae_pattern_builder_add_scratch() for each, but faster for
 * thousands. If one is refused, the builder is as it was, and the error names its number.
 *
 * @param builder the builder
 * @param scratches the scratches, packed
 * @param count how many
 */
enum StriaeStatus striae_pattern_builder_add_scratches(struct StriaePatternBuilder *builder,
                                                       const struct StriaeScratch *scratches,
                                                       size_t count);

/**
 * How many scratches were added so far, also by the many: the next one's number, which striae_pattern_query() tells.
 *
 * @param builder the builder
 * @param count receives it
 */
enum StriaeStatus striae_pattern_builder_scratch_count(const struct StriaePatternBuilder *builder,
                                                       size_t *count);

/**
 * Builds the pattern of all scratches added so far, none being fine, on all cores. The builder stays usable.
 *
 * @param builder the builder
 * @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
 */
enum StriaeStatus striae_pattern_builder_build(const struct StriaePatternBuilder *builder,
                                               struct StriaePattern **pattern);

/**
 * Frees a builder. Patterns built with it live on. NULL is fine.
 */
void striae_pattern_builder_free(struct StriaePatternBuilder *builder);

/**
 * Tells how much memory a pattern takes: all its arrays. Of an opened one the file's, which processes share.
 *
 * @param pattern the pattern
 * @param bytes receives it
 */
enum StriaeStatus striae_pattern_memory(const struct StriaePattern *pattern,
                                        size_t *bytes);

/**
 * Adds a reference. NULL is fine.
 */
void striae_pattern_retain(const struct StriaePattern *pattern);

/**
 * Drops a reference; the last one frees the pattern. NULL is fine.
 */
void striae_pattern_release(const struct StriaePattern *pattern);

/**
 * Fills in a generator by name, for the unit square.
 *
 * @param style a StriaeStyle
 * @param generator with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_generator_preset(uint32_t style, struct StriaeGenerator *generator);

/**
 * Adds generated scratches, on all cores; if one of them is refused, the builder is as it was. The same seed gives the same
 * scratches on every machine and with any number of threads. For layers over each other call again, with other seeds.
 *
 * @param builder the builder
 * @param generator how many, how long, how deep, which way and how bent
 * @param tool the tool
 * @param material another hardness and finish than the surface's for these scratches; NULL for the surface's own
 * @param seed another seed, other scratches
 */
enum StriaeStatus striae_pattern_builder_generate(struct StriaePatternBuilder *builder,
                                                  const struct StriaeGenerator *generator,
                                                  const struct StriaeTool *tool,
                                                  const struct StriaeMaterial *material,
                                                  uint64_t seed);

/**
 * Adds a scratch along each stroked path of an SVG drawing; if one of them is refused, the builder is as it was.
 *
 * Paths, lines, polylines, polygons, rectangles, circles and ellipses count, where visible, under their transforms; fills,
 * texts, images, clips, masks and dashes do not. A drawing is stretched where the area has other proportions; a stroke's
 * width is then the geometric mean of both directions.
 *
 * A file that is missing, no SVG, without a size or without a stroked path, and a scratch that cannot be made, are answered
 * with STRIAE_STATUS_FILE; striae_last_error() then names the file, the line and column or the path, what was found and what
 * is accepted.
 *
 * Not in a library that was built without the cargo feature `svg` (it is on by default).
 *
 * @param builder the builder
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param options what scratches are made
 */
enum StriaeStatus striae_pattern_builder_add_svg(struct StriaePatternBuilder *builder,
                                                 const char *path,
                                                 const struct StriaeSvgOptions *options);

/**
 * Makes triangles of a region of a pattern, with nothing filtered or summed up: what shading is measured against, and what
 * programs without this library can use. It takes time and memory, some microseconds and a kilobyte for each triangle.
 *
 * The mesh is watertight: each edge belongs to two triangles, but for those on the border of an open surface. Where a later
 * scratch cuts an earlier one, and between the facets that close a hard end, heights jump: there walls stand upright, so
 * that all else stays where it is. They count as a part of the later scratch.
 *
 * @param pattern the pattern
 * @param region which part, and how closely
 * @param mesh receives a handle to release with striae_relief_mesh_release(); NULL on failure
 */
enum StriaeStatus striae_relief_mesh(const struct StriaePattern *pattern,
                                     const struct StriaeMeshRegion *region,
                                     struct StriaeReliefMesh **mesh);

/**
 * Tells a mesh's arrays.
 *
 * @param mesh the mesh
 * @param arrays with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_relief_mesh_arrays(const struct StriaeReliefMesh *mesh,
                                            struct StriaeMeshArrays *arrays);

/**
 * A base BRDF of a mesh's zones, as the material had it but for rounding.
 *
 * @param mesh the mesh
 * @param number below the arrays' brdf_count; 0 is the unscratched surface's
 * @param brdf receives it
 */
enum StriaeStatus striae_relief_mesh_brdf(const struct StriaeReliefMesh *mesh,
                                          uint32_t number,
                                          struct StriaeBrdf *brdf);

/**
 * Adds a reference. NULL is fine.
 */
void striae_relief_mesh_retain(const struct StriaeReliefMesh *mesh);

/**
 * Drops a reference; the last one frees the mesh. NULL is fine.
 */
void striae_relief_mesh_release(const struct StriaeReliefMesh *mesh);

/**
 * Makes a tool from a 3D model: OBJ, STL (text or binary) or PLY (text or binary), by the end of the file's name.
 *
 * z points up, the tip down; polygons become fans of triangles, and the mesh is then what striae_tool_mesh() takes.
 * At most 1 GiB. A file that is missing, broken, empty, cut short, too large, holds a number that is not finite or
 * claims more than it contains is answered with STRIAE_STATUS_FILE; striae_last_error() then names the file, the
 * line (from 1) or byte (from 0), what was found and what is accepted.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param mm_per_unit the file's unit, 1e-9 to 1e9: 1 for mm, 25.4 for inches, 1000 for metres
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_load(const char *path,
                                   double mm_per_unit,
                                   struct StriaeTool **tool);

/**
 * Makes a hardness map from an image over u and v from 0 to 1, its top row at v = 1: PNG or EXR.
 *
 * Of a PNG the first channel counts, 0 to its largest value meaning 0 to 1; of an EXR the channel Y, else R, else the
 * first. At most 2^26 texels. A file that is missing, neither, broken or too large is answered with
 * STRIAE_STATUS_FILE; striae_last_error() then names the file, what was found and what is accepted.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param from_hv hardness that a value of 0 means, 0.01 to 20000
 * @param to_hv hardness that a value of 1 means, 0.01 to 20000; every texel must lead into that range
 * @param map receives a handle to release with striae_hardness_map_release(); NULL on failure
 */
enum StriaeStatus striae_hardness_map_load(const char *path,
                                           double from_hv,
                                           double to_hv,
                                           struct StriaeHardnessMap **map);

/**
 * Begins a pattern with all that a pattern file holds: surface, scratches and generators. JSON; its form is described in
 * docs/pattern-file.md. Files that it names are looked for from its own folder.
 *
 * A file that is missing, broken or of another version, that names what it does not hold, or in which a value is out of
 * its range is answered with STRIAE_STATUS_FILE; striae_last_error() then names the file, the line, column and field or the
 * scratch, what was found and what is accepted.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param builder receives a builder to add more to, and to free with striae_pattern_builder_free(); NULL on failure
 */
enum StriaeStatus striae_pattern_builder_load(const char *path,
                                              struct StriaePatternBuilder **builder);

/**
 * Saves a built pattern to be opened again by striae_pattern_open(), on machines of the same byte order and by the same
 * version of the library: a cache, no file to keep. It takes as much room as the pattern's memory. It is written beside
 * and takes the place of an older one all at once; two threads must not save to one path at once, processes may.
 *
 * Where it cannot be written the answer is STRIAE_STATUS_FILE, and an older file stays.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param pattern the pattern
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 */
enum StriaeStatus striae_pattern_save(const struct StriaePattern *pattern,
                                      const char *path);

/**
 * Opens a saved pattern where it lies: what it holds is read when it is needed, so that opening takes no time however
 * large it is, and processes that open one file share its memory. Shading may then have to wait for the disk. Until the
 * pattern is freed the file must not be written to or cut short, or the process may end; putting another one in its place,
 * as striae_pattern_save() does, is fine.
 *
 * A file that is missing, no saved pattern, of another version or byte order, cut short or damaged is answered with
 * STRIAE_STATUS_FILE. With `verify` 0 that is the header and all small arrays; a file whose large arrays are damaged opens,
 * and is safe to shade, but shows something else than what was saved.
 *
 * So is one that has base BRDFs of the host's own, which no file can hold: striae_pattern_open_with() takes them anew.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param verify 1: check every byte, which takes as long as reading the file; 0: check what takes no time; nothing else
 * @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
 */
enum StriaeStatus striae_pattern_open(const char *path,
                                      uint32_t verify,
                                      struct StriaePattern **pattern);

/**
 * As striae_pattern_open(), for a pattern that has base BRDFs of the host's own.
 *
 * @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 * @param verify 1: check every byte, which takes as long as reading the file; 0: check what takes no time; nothing else
 * @param hosts tables to reflect by, each that the pattern was built with once: the surface's, then those of its scratches
 *     in the order in which they were added (in each material that of the bulk, then the layers' from the surface down; the
 *     surface's own material first). The tables are copied
 * @param host_count how many: STRIAE_STATUS_FILE if the file has more or fewer, and the text says how many it has
 * @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
 */
enum StriaeStatus striae_pattern_open_with(const char *path,
                                           uint32_t verify,
                                           const struct StriaeHostBrdf *hosts,
                                           size_t host_count,
                                           struct StriaePattern **pattern);

/**
 * Writes a mesh to a file, mm: Wavefront OBJ or PLY, by the end of the file's name.
 *
 * An OBJ has a group for each scratch (scratch_0 on, surface) and names a material for each base BRDF (brdf_0 on). A PLY
 * (binary, little-endian, coordinates in double precision) has both numbers with each face: scratch, -1 on the unscratched
 * surface, and brdf. A file that cannot be written, and a name that ends otherwise, are answered with STRIAE_STATUS_FILE.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default).
 *
 * @param mesh the mesh
 * @param path the file's path, ending in .obj or .ply, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
 */
enum StriaeStatus striae_relief_mesh_write(const struct StriaeReliefMesh *mesh,
                                           const char *path);

/**
 * A point's local frame, in which `view` and `light` are given. Allocates nothing.
 *
 * @param point its normal and dp_du count. Without a usable dp_du (zero, or along the normal) x is any tangent.
 * @param frame is written on success only
 */
enum StriaeStatus striae_frame(const struct StriaePoint *point,
                               struct StriaeFrame *frame);

/**
 * Turns a vector of the renderer's frame into the local one. Allocates nothing.
 *
 * @param frame filled in by striae_frame()
 * @param world the vector, of any length
 * @param local receives it; may be `world` itself
 */
enum StriaeStatus striae_frame_to_local(const struct StriaeFrame *frame,
                                        const float world[3],
                                        float local[3]);

/**
 * Turns a vector of the local frame into the renderer's. Allocates nothing.
 *
 * @param frame filled in by striae_frame()
 * @param local the vector, of any length
 * @param world receives it; may be `local` itself
 */
enum StriaeStatus striae_frame_to_world(const struct StriaeFrame *frame,
                                        const float local[3],
                                        float world[3]);

/**
 * Prepares a point for one viewing direction: finds the scratches in its footprint and all that does not
 * depend on the light. Never allocates, locks or blocks; any number of threads at once. 256 KiB of stack suffice.
 *
 * A point that is refused leaves a shading that can be used all the same, so that a render goes on: a view that
 * is no direction reflects nothing; a bad normal, uv or derivative gives the unscratched surface; a
 * footprint of zero, infinite or NaN size counts as a point. Only with a NULL argument is nothing written.
 * A view below the surface is no error: it reflects nothing. Where a surface is to be seen from both sides, turn its normal
 * to the viewer's side.
 *
 * @param pattern the pattern
 * @param point the point
 * @param view direction to the viewer, away from the surface, in the local frame, of any length above 0
 * @param shading receives the result; need not be initialised. Shading into it again replaces what it held
 */
enum StriaeStatus striae_shade(const struct StriaePattern *pattern,
                               const struct StriaePoint *point,
                               const float view[3],
                               struct StriaeShading *shading);

/**
 * striae_frame() and striae_shade() in one, for a view in the renderer's frame. Never allocates, locks or blocks; any number
 * of threads at once. 256 KiB of stack suffice.
 *
 * A point that is refused can be used as after striae_shade(); but a bad normal has no frame: it reflects nothing, and the
 * frame is all zeros, which no light has a direction in.
 *
 * @param pattern the pattern
 * @param point the point
 * @param view direction to the viewer, away from the surface, in the renderer's frame, of any length above 0
 * @param frame receives the point's local frame
 * @param shading receives the result; need not be initialised. Shading into it again replaces what it held
 */
enum StriaeStatus striae_shade_world(const struct StriaePattern *pattern,
                                     const struct StriaePoint *point,
                                     const float view[3],
                                     struct StriaeFrame *frame,
                                     struct StriaeShading *shading);

/**
 * Evaluates a prepared point for one light. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param light direction to the light, away from the surface, in the local frame, of any length above 0. From
 *     below the surface, or with no direction (NaN, zero), f is 0.
 * @param flags 0 for BRDF times cosine, STRIAE_EVAL_BRDF_ONLY for the BRDF alone
 * @param f receives linear RGB, never negative, never NaN
 */
enum StriaeStatus striae_eval(const struct StriaeShading *shading,
                              const float light[3],
                              uint32_t flags,
                              float f[3]);

/**
 * As striae_eval(), with the light in the renderer's frame.
 *
 * @param shading filled in by striae_shade_world(), or striae_shade()
 * @param frame the point's, from the same call, or striae_frame()
 * @param light direction to the light, away from the surface, in the renderer's frame, of any length above 0
 * @param flags as for striae_eval()
 * @param f receives linear RGB, never negative, never NaN
 */
enum StriaeStatus striae_eval_world(const struct StriaeShading *shading,
                                    const struct StriaeFrame *frame,
                                    const float light[3],
                                    uint32_t flags,
                                    float f[3]);

/**
 * Whether scratches may matter at a point: for renderers that shade the unscratched surface themselves, and then need neither
 * striae_shade() nor striae_eval() where none is near. Refuses nothing but NULL. Never allocates, locks or blocks; any number of
 * threads at once.
 *
 * Where it says no, striae_shade() finds no scratch there, and the point reflects what the pattern's surface material
 * does. Where it says yes there may be none all the same; so it does of most points that striae_shade() refuses.
 *
 * @param pattern the pattern
 * @param point the point
 * @param view direction to the viewer, away from the surface, in the renderer's frame (that of the point's normal), of any
 *     length above 0. NULL asks for all views at once, as if it were a grazing one
 * @param is_near receives 1 or 0
 */
enum StriaeStatus striae_near(const struct StriaePattern *pattern,
                              const struct StriaePoint *point,
                              const float view[3],
                              uint32_t *is_near);

/**
 * The scratches in a footprint, whoever looks: for masks, labels and what else a renderer writes beside light.
 * The one that covers the largest share comes first, of equal ones the latest, which lies on top. Never
 * allocates, locks or blocks, and a footprint with any number of scratches is no failure; any number of threads at
 * once. 256 KiB of stack suffice.
 *
 * @param pattern the pattern
 * @param point the point; a STRIAE_FOOTPRINT_POINT tells what lies right there
 * @param hits receives the first `capacity` ones, may be NULL with a capacity of 0; need not be initialised
 * @param capacity how many `hits` can hold
 * @param count receives how many there are; zeros if the point is refused, so that a render goes on
 */
enum StriaeStatus striae_pattern_query(const struct StriaePattern *pattern,
                                       const struct StriaePoint *point,
                                       struct StriaeHit *hits,
                                       size_t capacity,
                                       struct StriaeHitCount *count);

/**
 * Says how far a prepared point's light is followed; striae_shade() sets it back to STRIAE_BOUNCES_ONE. Never allocates,
 * locks or blocks; any number of threads at once, each with a shading of its own.
 *
 * With all bounces striae_sample() walks through the cross-section, without bias, and striae_eval() adds what zones reflect to
 * one another: by its direction the first time (lobes of less than alpha 0.06 as if they were so wide), as if scattered
 * evenly from then on. Exact for Lambertian zones; metals of alpha 0.05 to 0.4 measured within 1 %. A host's own base BRDF
 * passes light on as Lambert's or GGX of its widths would, in its own colour. The density stays that of
 * one bounce, which is all that multiple importance sampling needs. To evaluate then takes many times as long, to sample
 * hardly longer.
 *
 * @param shading filled in by striae_shade()
 * @param bounces STRIAE_BOUNCES_ONE or STRIAE_BOUNCES_ALL
 */
enum StriaeStatus striae_set_bounces(struct StriaeShading *shading,
                                     uint32_t bounces);

/**
 * Chooses a light for the view, about as often as it is reflected. Never allocates, locks or blocks; any number of
 * threads at once.
 *
 * No light is chosen where the view is below the surface, and now and then elsewhere: that light is absorbed, and to sample
 * again instead would gain light. No lobe is so sharp that it has no density, so multiple importance sampling knows no
 * special case:
 *
 * @code{.c}
 * StriaeSample sample;
 * striae_sample_world(&shading, &frame, (float[3]){next(), next(), next()}, &sample);
 * if (sample.pdf > 0.0f) {
 *   const Hit hit = trace(position, sample.light);
 *   const float share = sample.pdf / (sample.pdf + lamp_pdf(&hit));
 *   for (int c = 0; c < 3; c++) sum[c] += share * sample.weight[c] * hit.emitted[c];
 * }
 * StriaeEvaluated lit;
 * const Lamp lamp = sample_lamp(position);
 * striae_eval_pdf_world(&shading, &frame, lamp.direction, &lit);
 * for (int c = 0; c < 3; c++) sum[c] += lit.f[c] * lamp.emitted[c] / (lamp.pdf + lit.pdf);
 * @endcode
 *
 * @param shading filled in by striae_shade()
 * @param u three numbers from 0 up to (not including) 1, others count as the nearest of them: the first chooses a zone, as
 *     often as the viewer sees it, the others a direction, as often as the zone's base BRDF reflects it
 * @param sample receives the light, in the local frame; a pdf of 0 if there is none
 */
enum StriaeStatus striae_sample(const struct StriaeShading *shading,
                                const float u[3],
                                struct StriaeSample *sample);

/**
 * As striae_sample(), with the light in the renderer's frame.
 *
 * @param shading filled in by striae_shade()
 * @param frame the point's, from striae_shade_world() or striae_frame()
 * @param u as for striae_sample()
 * @param sample receives the light, in the renderer's frame; a pdf of 0 if there is none
 */
enum StriaeStatus striae_sample_world(const struct StriaeShading *shading,
                                      const struct StriaeFrame *frame,
                                      const float u[3],
                                      struct StriaeSample *sample);

/**
 * The density with which striae_sample() chooses a light. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param light direction to the light in the local frame, of any length above 0
 * @param pdf receives it, per steradian: 0 from below the surface or with no direction (NaN, zero); elsewhere it adds up to
 *     1, or with base BRDFs of the host's own to the share of samples that choose a light
 */
enum StriaeStatus striae_pdf(const struct StriaeShading *shading,
                             const float light[3],
                             float *pdf);

/**
 * The density with which the view would be chosen were the light the view: what striae_pdf() says of the view once the point
 * is prepared for `light`. For paths walked from both ends. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param light direction to the light in the local frame, of any length above 0
 * @param pdf receives it, per steradian
 */
enum StriaeStatus striae_pdf_reverse(const struct StriaeShading *shading,
                                     const float light[3],
                                     float *pdf);

/**
 * striae_eval() and striae_pdf() in one, for little more than one costs. Never allocates, locks or blocks; any number of
 * threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param light direction to the light in the local frame, of any length above 0
 * @param evaluated receives both
 */
enum StriaeStatus striae_eval_pdf(const struct StriaeShading *shading,
                                  const float light[3],
                                  struct StriaeEvaluated *evaluated);

/**
 * As striae_eval_pdf(), with the light in the renderer's frame.
 *
 * @param shading filled in by striae_shade()
 * @param frame the point's, from striae_shade_world() or striae_frame()
 * @param light direction to the light in the renderer's frame, of any length above 0
 * @param evaluated receives both
 */
enum StriaeStatus striae_eval_pdf_world(const struct StriaeShading *shading,
                                        const struct StriaeFrame *frame,
                                        const float light[3],
                                        struct StriaeEvaluated *evaluated);

/**
 * The zones that the viewer sees, for renderers that evaluate base BRDFs of their own: what a light counts is the sum of each
 * zone's `lit` times BRDF times cosine about its normal. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param light direction to the light in the local frame, of any length above 0; from below the surface nothing is lit
 * @param zones receives the first `capacity` ones, may be NULL with a capacity of 0; need not be initialised
 * @param capacity how many `zones` can hold: 200 are enough but for crowds
 * @param count receives how many there are, which may be more; the last one is the flat surface. 0 for a point that
 *     reflects nothing
 */
enum StriaeStatus striae_zones(const struct StriaeShading *shading,
                               const float light[3],
                               struct StriaeZone *zones,
                               size_t capacity,
                               size_t *count);

/**
 * A zone's base BRDF, as the material had it but for rounding; of the host's own its table. Never allocates, locks or
 * blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param number a zone's `brdf`; 0 is the flat surface's
 * @param brdf receives it
 */
enum StriaeStatus striae_zone_brdf(const struct StriaeShading *shading,
                                   uint32_t number,
                                   struct StriaeBrdf *brdf);

/**
 * The scratches as a single lobe, for materials that take no other: mix it with the surface's by its coverage. Never
 * allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param parameters receives it
 */
enum StriaeStatus striae_parameters(const struct StriaeShading *shading,
                                    struct StriaeParameters *parameters);

/**
 * How rough the point is, scratches and surface together. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param roughness receives the alpha of GGX microfacets that spread light about as far, 0.001 to 1
 */
enum StriaeStatus striae_roughness(const struct StriaeShading *shading,
                                   float *roughness);

/**
 * An estimate of the share of light that the point reflects towards the view: the mean of 128 samples, within about 0.05. It
 * costs as much as 128 lights do. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param albedo receives linear RGB
 */
enum StriaeStatus striae_albedo(const struct StriaeShading *shading,
                                float albedo[3]);

/**
 * Which lobes the viewer sees, before one is chosen. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param lobes receives the STRIAE_LOBE flags of all zones together; 0 for a point that reflects nothing
 */
enum StriaeStatus striae_lobes(const struct StriaeShading *shading,
                               uint32_t *lobes);

/**
 * striae_shade() for many points. Never allocates, locks or blocks; any number of threads at once.
 *
 * All points are prepared, also those that are refused (as striae_shade() does): the status, and striae_last_error(), are
 * those of the first refused one.
 *
 * @param pattern the pattern
 * @param points the points
 * @param point_stride bytes from one point to the next: sizeof(StriaePoint) where they are packed
 * @param views directions to the viewer, in each point's local frame, of any length above 0
 * @param count how many points
 * @param shadings receives the results, packed; need not be initialised
 */
enum StriaeStatus striae_shade_many(const struct StriaePattern *pattern,
                                    const struct StriaePoint *points,
                                    size_t point_stride,
                                    const struct StriaeVectors *views,
                                    size_t count,
                                    struct StriaeShading *shadings);

/**
 * striae_eval() for many lights: of one point several times as fast as one by one, and the same within 1e-5. Never allocates,
 * locks or blocks; any number of threads at once.
 *
 * @param shadings points filled in by striae_shade() or striae_shade_many(), packed
 * @param per_shading how many lights each point has, 1 or more, one point's after another's: `count` for one point and all
 *     lights, 1 for a light of its own for each point
 * @param lights directions to the lights, in the local frame, of any length above 0
 * @param count how many lights in all
 * @param flags 0 for BRDF times cosine, STRIAE_EVAL_BRDF_ONLY for the BRDF alone
 * @param f receives linear RGB for each light; must not overlap the lights
 */
enum StriaeStatus striae_eval_many(const struct StriaeShading *shadings,
                                   size_t per_shading,
                                   const struct StriaeVectors *lights,
                                   size_t count,
                                   uint32_t flags,
                                   const struct StriaeVectorsOut *f);

/**
 * striae_eval_pdf() for many lights, as striae_eval_many().
 *
 * @param shadings points filled in by striae_shade() or striae_shade_many(), packed
 * @param per_shading how many lights each point has, 1 or more, one point's after another's
 * @param lights directions to the lights, in the local frame, of any length above 0
 * @param count how many lights in all
 * @param f receives BRDF times cosine, linear RGB, for each light; must not overlap the lights
 * @param pdf receives the density for each light, per steradian, packed
 */
enum StriaeStatus striae_eval_pdf_many(const struct StriaeShading *shadings,
                                       size_t per_shading,
                                       const struct StriaeVectors *lights,
                                       size_t count,
                                       const struct StriaeVectorsOut *f,
                                       float *pdf);

/**
 * striae_sample() for many numbers: of one point 1.6 times as fast as one by one, and the same within 1e-5. Never
 * allocates, locks or blocks; any number of threads at once.
 *
 * @param shadings points filled in by striae_shade() or striae_shade_many(), packed
 * @param per_shading how many samples each point has, 1 or more, one point's after another's
 * @param u three numbers from 0 up to (not including) 1 for each sample
 * @param count how many samples in all
 * @param samples receives them; must not overlap `u`
 */
enum StriaeStatus striae_sample_many(const struct StriaeShading *shadings,
                                     size_t per_shading,
                                     const struct StriaeVectors *u,
                                     size_t count,
                                     const struct StriaeSamplesOut *samples);

/**
 * Lets all threads use SIMD instructions where the processor has them (so it is at the start), or keeps them from it, to
 * measure and to compare: results agree within 1e-5.
 *
 * @param allowed 0 or 1
 */
enum StriaeStatus striae_set_simd(uint32_t allowed);

/**
 * Scratches as Becket and Badler had them (1990): each is a straight line, from where the pattern's starts to where it
 * ends, and reflects evenly in all directions: a random share of light. They are one texel wide; a point shows the texel
 * that it lies in.
 *
 * Not in a library that was built without the cargo feature `files` (it is on by default); nor are the other calls named
 * striae_baseline.
 *
 * @param pattern the scratches, their surface and its scale; scratches dealt out at random: STRIAE_STYLE_STRAIGHT
 * @param canvas where and how finely they are painted
 * @param lowest least intensity of a scratch, 0 to 1
 * @param highest its most, from `lowest` to 1
 * @param seed another seed, other intensities
 * @param baseline receives a handle to release with striae_baseline_release(); NULL on failure
 */
enum StriaeStatus striae_baseline_bb90(const struct StriaePattern *pattern,
                                       const struct StriaeCanvas *canvas,
                                       float lowest,
                                       float highest,
                                       uint64_t seed,
                                       struct StriaeBaseline **baseline);

/**
 * Scratches as Buchanan and Lalonde had them (1999): each is a straight line, from where the pattern's starts to where it
 * ends; each texel lists those that pass through it, and a point adds the strongest of their highlights to what the surface
 * reflects. All shine alike: by Phong's lobe about the nearest direction to which a thin line mirrors the view, lines being
 * told apart by 2.5 degrees. Such a surface may reflect more light than it gets.
 *
 * @param pattern the scratches, their surface and its scale; scratches dealt out at random: STRIAE_STYLE_STRAIGHT
 * @param canvas where and how finely they are listed
 * @param specular the highlight's colour, RGB, each 0 to 1
 * @param exponent of the lobe's cosine, 1 (wide) to 100000 (sharp)
 * @param baseline receives a handle to release with striae_baseline_release(); NULL on failure
 */
enum StriaeStatus striae_baseline_bl99(const struct StriaePattern *pattern,
                                       const struct StriaeCanvas *canvas,
                                       const float specular[3],
                                       float exponent,
                                       struct StriaeBaseline **baseline);

/**
 * Scratches as Merillou, Dischler and Ghazanfarpour had them (2001): painted into an image, one texel wide, all with one
 * symmetric cross-section of two angles. A pixel that holds a painted texel has the scratch in its middle, which takes half
 * of the pixel at most and runs the way that the seven by seven texels about the one nearest to its centre say.
 *
 * @param pattern the scratches' paths, their surface and its scale
 * @param canvas where and how finely they are painted
 * @param scratch the cross-section
 * @param baseline receives a handle to release with striae_baseline_release(); NULL on failure
 */
enum StriaeStatus striae_baseline_mdg01(const struct StriaePattern *pattern,
                                        const struct StriaeCanvas *canvas,
                                        const struct StriaeTwoAngles *scratch,
                                        struct StriaeBaseline **baseline);

/**
 * Prepares a point for one viewing direction, as striae_shade() does of a pattern: the shading is evaluated and sampled by
 * the same calls. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param baseline the scratches
 * @param point the point
 * @param view direction to the viewer, away from the surface, in the local frame, of any length above 0
 * @param shading receives the result; need not be initialised. Shading into it again replaces what it held
 */
enum StriaeStatus striae_baseline_shade(const struct StriaeBaseline *baseline,
                                        const struct StriaePoint *point,
                                        const float view[3],
                                        struct StriaeShading *shading);

/**
 * Tells how much memory the images or lists take.
 *
 * @param baseline the scratches
 * @param bytes receives it
 */
enum StriaeStatus striae_baseline_memory(const struct StriaeBaseline *baseline, size_t *bytes);

/**
 * Adds a reference. NULL is fine.
 */
void striae_baseline_retain(const struct StriaeBaseline *baseline);

/**
 * Drops a reference; the last one frees it. NULL is fine.
 */
void striae_baseline_release(const struct StriaeBaseline *baseline);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* STRIAE_H */
