//! What changes along a scratch changes smoothly, and layers, hands and hardness show where they should.
#![expect(
    clippy::cast_possible_truncation,
    reason = "steps are counted in double precision"
)]

use striae::brdf::{Brdf, Metal};
use striae::formation::{HardnessMap, Layer, Material, Orientation, Reading, Tool};
use striae::pattern::{Footprint, Held, Key, Path, Pattern, PatternBuilder, Scratch, SurfacePoint};
use striae::scattering::{Output, Shading};

/// A plate 100 mm square, matt.
fn matt(albedo: [f32; 3]) -> Brdf {
    Brdf::Lambert { albedo }
}

fn material() -> Material {
    Material::new(131.0, matt([0.0; 3]), matt([1.0; 3]))
}

fn pattern(material: Material, scratch: &Scratch<'_>) -> Pattern {
    let mut builder = PatternBuilder::new(material, 1.0, [100.0, 100.0]).unwrap();
    builder.add(scratch).unwrap();
    builder.build()
}

fn point(uv: [f64; 2], footprint: Footprint) -> SurfacePoint {
    SurfacePoint {
        uv,
        dp_du: [100.0, 0.0, 0.0],
        dp_dv: [0.0, 100.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint,
    }
}

fn radiance(pattern: &Pattern, uv: [f64; 2], footprint: Footprint, light: [f32; 3]) -> [f32; 3] {
    let mut shading = Shading::default();
    shading
        .shade(pattern, &point(uv, footprint), [0.3, -0.2, 0.9])
        .unwrap();
    shading.eval(light, Output::BrdfCos)
}

const LIGHT: [f32; 3] = [-0.5, 0.4, 0.7];

/// The largest change per micrometre of arc length of what a 0.2 mm pixel on the scratch shows, relative to
/// the largest value, at steps of `step_mm` along y = 0.5.
fn steepest_per_um(pattern: &Pattern, step_mm: f64) -> f32 {
    let steps = (78.0 / step_mm).round();
    let mut last: Option<f32> = None;
    let (mut steepest, mut largest) = (0.0_f32, 0.0_f32);
    let mut i = 0.0;
    while i <= steps {
        let uv = [0.11 + i * step_mm / 100.0, 0.5];
        let [value, ..] = radiance(pattern, uv, Footprint::Radius(0.1), LIGHT);
        largest = largest.max(value);
        if let Some(last) = last {
            steepest = steepest.max((value - last).abs());
        }
        last = Some(value);
        i += 1.0;
    }
    steepest / largest / (step_mm as f32 * 1e3)
}

/// No step along a path on which force, tilt, azimuth and spin all change, for tools whose corners pass the surface
/// and for smooth ones: the change per micrometre stays bounded, and stays the same at ten times finer steps.
#[test]
fn change_per_micrometre_is_bounded() {
    let held = |tilt_deg, azimuth_deg, spin_deg| Orientation {
        spin_deg,
        tilt_deg,
        azimuth_deg,
    };
    let keys = [
        Key {
            orientation: held(0.0, 0.0, 0.0),
            ..Key::force(0.0, 0.2)
        },
        Key {
            orientation: held(12.0, 60.0, 50.0),
            ..Key::force(0.4, 2.0)
        },
        Key {
            orientation: held(8.0, 200.0, 90.0),
            ..Key::force(0.7, 0.6)
        },
        Key {
            orientation: held(2.0, 300.0, -30.0),
            ..Key::force(1.0, 0.0)
        },
    ];
    let path = Path::Polyline(&[[0.1, 0.5], [0.9, 0.5]]);
    let tools = [
        ("Rockwell C", Tool::rockwell_c()),
        ("Vickers", Tool::vickers()),
        ("Berkovich", Tool::berkovich()),
        ("nail", Tool::nail()),
    ];
    for (name, tool) in tools {
        let pattern = pattern(
            material(),
            &Scratch {
                path,
                keys: &keys,
                ..Scratch::new(&tool)
            },
        );
        let (coarse, fine) = (
            steepest_per_um(&pattern, 0.02),
            steepest_per_um(&pattern, 0.002),
        );
        println!(
            "{name}: steepest change {:.2e} of the largest value per um (steps of 2 um: {fine:.2e})",
            coarse
        );
        assert!(fine < 2e-3, "{name}: {fine} per um");
        assert!(
            fine < 5.0 * coarse + 1e-5,
            "{name}: a step: {fine} at fine steps, {coarse} at coarse ones"
        );
    }
}

/// Red paint on blue primer on white metal: a light scratch shows paint only, a deep one paint, primer and metal.
#[test]
fn layers_show_by_depth() {
    let mut painted = material();
    painted.layers = vec![
        Layer {
            thickness_mm: 0.004,
            scratched: matt([1.0, 0.0, 0.0]),
        },
        Layer {
            thickness_mm: 0.006,
            scratched: matt([0.0, 0.0, 1.0]),
        },
    ];
    let (tool, path) = (
        Tool::rockwell_c(),
        Path::Polyline(&[[0.1, 0.5], [0.9, 0.5]]),
    );
    let shown = |force_kgf: f64| {
        let keys = [Key::force(0.0, force_kgf)];
        let scratch = Scratch {
            path,
            keys: &keys,
            ..Scratch::new(&tool)
        };
        radiance(
            &pattern(painted.clone(), &scratch),
            [0.5, 0.5],
            Footprint::Radius(0.3),
            LIGHT,
        )
    };
    let [red, green, blue] = shown(0.5);
    assert!(
        red > 0.0 && green == 0.0 && blue == 0.0,
        "shallow: {red} {green} {blue}"
    );
    let [red, green, blue] = shown(1.2);
    assert!(
        red > 0.0 && green == 0.0 && blue > 0.0,
        "middling: {red} {green} {blue}"
    );
    let [red, green, blue] = shown(5.0);
    assert!(
        red > green && blue > green && green > 0.0,
        "deep: {red} {green} {blue}"
    );
}

/// A tool leant so that its two sides differ.
fn leant() -> Key {
    let orientation = Orientation {
        spin_deg: 30.0,
        tilt_deg: 15.0,
        azimuth_deg: 40.0,
    };
    Key {
        orientation,
        ..Key::force(0.0, 1.0)
    }
}

/// A hand that does not turn: going there and back its tool leaves mirrored cross-sections relative to the
/// travel, so the same ones on the surface; a hand that turns with the path does not.
#[test]
fn fixed_hand_does_not_turn() {
    let tool = Tool::vickers();
    let keys = [leant()];
    let there = Path::Polyline(&[[0.1, 0.5], [0.9, 0.5]]);
    let back = Path::Polyline(&[[0.9, 0.5], [0.1, 0.5]]);
    let shown = |path: Path<'_>, held: Held| {
        let scratch = Scratch {
            path,
            held,
            keys: &keys,
            ..Scratch::new(&tool)
        };
        let pattern = pattern(material(), &scratch);
        radiance(&pattern, [0.5, 0.50008], Footprint::Radius(0.004), LIGHT)[0]
    };
    let fixed = [there, back].map(|path| shown(path, Held::ToSurface));
    assert!((fixed[0] - fixed[1]).abs() < 1e-4 * fixed[0], "{fixed:?}");
    let turning = [there, back].map(|path| shown(path, Held::ToPath));
    assert!(
        (turning[0] - turning[1]).abs() > 1e-2 * turning[0],
        "{turning:?}"
    );
}

/// Around a curve and a corner the fixed hand's cross-section turns without a step.
#[test]
fn fixed_hand_turns_smoothly() {
    let tool = Tool::vickers();
    let keys = [leant()];
    let path = Path::Polyline(&[[0.1, 0.5], [0.5, 0.5], [0.9, 0.52]]);
    let scratch = Scratch {
        path,
        held: Held::ToSurface,
        keys: &keys,
        ..Scratch::new(&tool)
    };
    let pattern = pattern(material(), &scratch);
    let at = |i: i32| {
        let u = 0.5 + f64::from(i) * 1e-6;
        let v = 0.5 + (u - 0.5).max(0.0) * 0.05;
        radiance(&pattern, [u, v], Footprint::Radius(0.002), LIGHT)[0]
    };
    let steepest = (-6000..6000)
        .map(|i| (at(i + 1) - at(i)).abs())
        .fold(0.0, f32::max);
    let whole = (at(6000) - at(-6000)).abs();
    assert!(
        steepest < 0.02 * whole.max(0.05),
        "a step of {steepest} in a change of {whole}"
    );
}

/// Readings along the way make a scratch narrow where the surface is hard.
#[test]
fn hardness_readings_count() {
    let readings = [[0.0, 40.0], [1.0, 400.0]].map(|[u, hardness_hv]| Reading {
        uv: [u, 0.5],
        hardness_hv,
    });
    let (tool, keys) = (Tool::rockwell_c(), [Key::force(0.0, 1.0)]);
    let path = Path::Polyline(&[[0.05, 0.5], [0.95, 0.5]]);
    let mut builder =
        PatternBuilder::new(Material::metal(Metal::Steel), 1.0, [100.0, 100.0]).unwrap();
    builder.set_hardness(HardnessMap::readings(&readings).unwrap());
    builder
        .add(&Scratch {
            path,
            keys: &keys,
            ..Scratch::new(&tool)
        })
        .unwrap();
    let pattern = builder.build();
    let coverage = |u: f64| {
        let mut shading = Shading::default();
        let point = point([u, 0.5], Footprint::Radius(0.5));
        shading.shade(&pattern, &point, [0.0, 0.0, 1.0]).unwrap();
        shading.coverage()
    };
    let [soft, middle, hard] = [0.1, 0.5, 0.9].map(coverage);
    assert!(
        soft > 1.2 * middle && middle > 1.1 * hard,
        "{soft} {middle} {hard}"
    );
}
