//! The earlier systems (BB90, BL99, MDG01) do what is told of them, and err where they are said to.

use striae::Error;
use striae::baseline::{Baseline, Canvas, Highlight, TwoAngles};
use striae::brdf::{Brdf, Metal};
use striae::formation::{Material, Tool};
use striae::pattern::{
    Amount, Footprint, Generated, Generator, Key, Path, Pattern, PatternBuilder, Scratch,
    SurfacePoint,
};
use striae::scattering::{CrossFootprint, Output, SeenZone, Shading};

const PLATE_MM: f64 = 100.0;
const UP: [f32; 3] = [0.0, 0.0, 1.0];
const LIGHTS: [[f32; 3]; 4] = [
    [0.0, 0.0, 1.0],
    [0.6, 0.0, 0.8],
    [-0.2, 0.7, 0.68],
    [-0.5, -0.6, 0.3],
];

fn pattern(lines: &[[[f64; 2]; 2]]) -> Pattern {
    let material = Material::metal(Metal::Titanium);
    let mut builder = PatternBuilder::new(material, 1.0, [PLATE_MM; 2]).unwrap();
    let tool = Tool::rockwell_c();
    for line in lines {
        let scratch = Scratch {
            path: Path::Polyline(line),
            keys: &[Key::force(0.0, 1.0)],
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
    }
    builder.build()
}

/// The mean slope of seven texels in a row with one step in their middle (6/28): that of a line may be nearly none.
const MOST_ERROR_DEG: f32 = 12.1;

/// 1024 texels a side, about a tenth of a millimetre each.
fn canvas() -> Canvas {
    Canvas {
        area_uv: [[0.0; 2], [1.0; 2]],
        texels: [1024; 2],
    }
}

fn point(uv: [f64; 2], radius: f32) -> SurfacePoint {
    SurfacePoint {
        uv,
        dp_du: [100.0, 0.0, 0.0],
        dp_dv: [0.0, 100.0, 0.0],
        normal: UP,
        footprint: Footprint::Radius(radius),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounding to single")]
fn single(value: f64) -> f32 {
    value as f32
}

fn shaded(baseline: &Baseline, point: &SurfacePoint, view: [f32; 3]) -> Shading {
    let mut shading = Shading::default();
    baseline.shade(point, view, &mut shading).unwrap();
    shading
}

fn unscratched(point: &SurfacePoint, view: [f32; 3]) -> Shading {
    let mut shading = Shading::default();
    shading.shade(&pattern(&[]), point, view).unwrap();
    shading
}

fn two_angles(width_mm: f64) -> TwoAngles {
    let zone = Brdf::metal(Metal::Titanium, 0.2);
    TwoAngles {
        width_mm,
        peak_deg: 20.0,
        groove_deg: 35.0,
        zones: [zone; 4],
    }
}

/// A place on a straight line.
fn on_line(line: [[f64; 2]; 2], at: f64) -> [f64; 2] {
    [0, 1].map(|i| line[0][i] + at * (line[1][i] - line[0][i]))
}

/// The direction of the scratch that a point shows, degrees, 0 up to 180.
fn direction_deg(shading: &Shading) -> f32 {
    let mut zones = [SeenZone::default(); 8];
    let count = shading.zones(UP, &mut zones);
    assert!(count > 1, "no scratch");
    let [x, y, _] = zones[0].tangent;
    y.atan2(x).to_degrees().rem_euclid(180.0)
}

/// How far two directions are apart, whichever way either points.
fn apart_deg(a: f32, b: f32) -> f32 {
    let apart = (a - b).rem_euclid(180.0);
    apart.min(180.0 - apart)
}

/// MDG01's six zones are those of the library's own shading of the same cross-section in the same pixel.
#[test]
fn mdg01_shades_its_cross_section() {
    let line = [[0.1, 0.5005], [0.9, 0.5005]];
    let scratch = two_angles(0.2);
    let baseline = Baseline::mdg01(&pattern(&[line]), &canvas(), &scratch).unwrap();
    let (peak, groove) = (20.0_f32.to_radians().tan(), 35.0_f32.to_radians().tan());
    let z = [0.0, 0.05 * peak, 0.05 * (peak - groove), 0.05 * peak, 0.0];
    let vertices = [0, 1, 2, 3, 4].map(|i| [0.05 * (i as f32 - 2.0), z[i]]);
    for view in [UP, [0.5, 0.2, 0.8], [0.1, -0.7, 0.6]] {
        let shading = shaded(&baseline, &point([0.3, 0.5005], 0.5), view);
        let mut own = Shading::default();
        let pixel = CrossFootprint::Whole { margin_mm: 0.4 };
        let surface = Material::metal(Metal::Titanium).surface;
        // The cross-section's own scratch runs along y, this one along x.
        let turned = |[x, y, z]: [f32; 3]| [-y, x, z];
        let zone = &scratch.zones[0];
        own.shade_cross_section(&vertices, zone, &surface, pixel, turned(view))
            .unwrap();
        assert!(
            (shading.coverage() - own.coverage()).abs() < 1e-5,
            "coverage"
        );
        for light in LIGHTS {
            let (ours, theirs) = (
                shading.eval(light, Output::BrdfCos),
                own.eval(turned(light), Output::BrdfCos),
            );
            for (a, b) in ours.into_iter().zip(theirs) {
                assert!((a - b).abs() <= 1e-4 * b, "{view:?} {light:?}: {a} and {b}");
            }
        }
    }
}

/// A scratch never takes more than half of the pixel, and half as much of one twice as wide.
#[test]
fn mdg01_shares_the_pixel() {
    let line = [[0.1, 0.5], [0.9, 0.5]];
    let baseline = Baseline::mdg01(&pattern(&[line]), &canvas(), &two_angles(0.2)).unwrap();
    for (radius, share) in [
        (1e-4, 0.5),
        (0.05, 0.5),
        (0.2, 0.5),
        (0.4, 0.25),
        (0.8, 0.125),
    ] {
        let found = shaded(&baseline, &point([0.5, 0.5], radius), UP).coverage();
        assert!((found - share).abs() < 1e-4, "{radius}: {found}");
    }
}

/// On straight strokes neighbouring texels tell the direction within what seven texels can.
#[test]
fn mdg01_knows_straight_strokes() {
    let (mut sum, mut worst, mut count) = (0.0, 0.0_f32, 0.0);
    for step in 0..36 {
        let angle = (5.0 * f64::from(step) + 1.3).to_radians();
        let line = [-0.4, 0.4].map(|r| [0.5 + r * angle.cos(), 0.5 + r * angle.sin()]);
        let baseline = Baseline::mdg01(&pattern(&[line]), &canvas(), &two_angles(0.2)).unwrap();
        for i in 0..40 {
            let uv = on_line(line, 0.1 + 0.02 * f64::from(i));
            let shading = shaded(&baseline, &point(uv, 0.1), UP);
            let truth = single(angle.to_degrees());
            let error = apart_deg(direction_deg(&shading), truth);
            (sum, count, worst) = (sum + error, count + 1.0, worst.max(error));
        }
    }
    let mean = sum / count;
    assert!(
        worst < MOST_ERROR_DEG && mean < 3.0,
        "mean {mean} worst {worst}"
    );
    // An image cannot tell it exactly.
    assert!(mean > 0.3, "as good as a curve: {mean}");
}

/// Near crossings and beside close scratches neighbouring texels tell a wrong direction, as the paper says.
#[test]
fn mdg01_errs_near_crossings() {
    let lines = [[[0.2, 0.5], [0.8, 0.5]], [[0.45, 0.2], [0.55, 0.8]]];
    let baseline = Baseline::mdg01(&pattern(&lines), &canvas(), &two_angles(0.2)).unwrap();
    let at = |u: f64| direction_deg(&shaded(&baseline, &point([u, 0.5], 0.1), UP));
    let worst = (-4..=4).map(|i| apart_deg(at(0.5 + f64::from(i) * 5e-4), 0.0));
    let worst = worst.fold(0.0, f32::max);
    assert!(worst > 20.0, "{worst} at the crossing");
    assert!(apart_deg(at(0.4), 0.0) < 1e-3, "far from it");
    let close = [0.0, 0.003].map(|v| [[0.2, 0.5 + v], [0.8, 0.53 + v]]);
    let alone = Baseline::mdg01(&pattern(&close[..1]), &canvas(), &two_angles(0.2)).unwrap();
    let both = Baseline::mdg01(&pattern(&close), &canvas(), &two_angles(0.2)).unwrap();
    let worst = |baseline: &Baseline| {
        let error = |i| {
            let uv = on_line(close[0], 0.2 + 0.02 * f64::from(i));
            let truth = single(0.05_f64.atan().to_degrees());
            apart_deg(
                direction_deg(&shaded(baseline, &point(uv, 0.05), UP)),
                truth,
            )
        };
        (0..30).map(error).fold(0.0, f32::max)
    };
    let (alone, both) = (worst(&alone), worst(&both));
    assert!(
        alone < MOST_ERROR_DEG && both > 20.0,
        "{both} degrees beside another, {alone} alone"
    );
}

/// A pixel however large finds the scratch that runs through it, and none where none does.
#[test]
fn mdg01_finds_scratches_at_every_distance() {
    let line = [[0.1, 0.3], [0.9, 0.62]];
    let baseline = Baseline::mdg01(&pattern(&[line]), &canvas(), &two_angles(0.2)).unwrap();
    for radius in [1e-3, 0.1, 0.7, 3.0, 20.0, 60.0] {
        let uv = on_line(line, 0.4);
        let coverage = shaded(&baseline, &point(uv, radius), UP).coverage();
        let width = 2.0 * radius * (0.4_f32.atan().cos());
        let share = (0.2 / width).min(0.5);
        assert!(
            (coverage / share - 1.0).abs() < 0.1,
            "{radius}: {coverage} of {share}"
        );
    }
    for (uv, radius) in [([0.3, 0.7], 1.0), ([0.95, 0.64], 0.5), ([1.5, 0.5], 3.0)] {
        assert_eq!(
            shaded(&baseline, &point(uv, radius), UP).coverage(),
            0.0,
            "{uv:?}"
        );
    }
}

/// BL99 adds the strongest of a texel's highlights to what the surface reflects, not their sum, and nothing elsewhere.
#[test]
fn bl99_adds_the_strongest_highlight() {
    let lines = [[[0.2, 0.5], [0.8, 0.5]], [[0.5, 0.2], [0.5, 0.8]]];
    let highlight = Highlight {
        specular: [0.5, 0.4, 0.3],
        exponent: 30.0,
    };
    let new = |lines: &[[[f64; 2]; 2]]| Baseline::bl99(&pattern(lines), &canvas(), &highlight);
    let crossing = point([0.5, 0.5], 0.2);
    let view = [0.3, 0.2, 0.9];
    let surface = unscratched(&crossing, view);
    let shadings = [&lines[..1], &lines[1..], &lines[..]]
        .map(|lines| shaded(&new(lines).unwrap(), &crossing, view));
    let mut both_shine = false;
    for light in LIGHTS {
        let plain = surface.eval(light, Output::BrdfCos);
        let added = |i: usize| shadings[i].eval(light, Output::BrdfCos)[1] - plain[1];
        let (one, other, both) = (added(0), added(1), added(2));
        let strongest = one.max(other);
        assert!(
            (both - strongest).abs() < 1e-4 * (strongest + plain[1]),
            "{light:?}"
        );
        both_shine |= one.min(other) > 0.1 * strongest;
    }
    assert!(both_shine, "no light tells the strongest from the sum");
    let beside = shaded(&new(&lines).unwrap(), &point([0.51, 0.52], 0.2), view);
    assert_eq!(
        beside.eval(LIGHTS[1], Output::BrdfCos),
        unscratched(&crossing, view).eval(LIGHTS[1], Output::BrdfCos)
    );
}

/// BB90's scratches reflect alike in every direction, each in an intensity of its own between the two that were stated.
#[test]
fn bb90_is_isotropic() {
    let lines: Vec<[[f64; 2]; 2]> = (0..40)
        .map(|i| 0.02 * f64::from(i) + 0.1)
        .map(|v| [[0.1, v], [0.9, v]])
        .collect();
    let new = |seed| Baseline::bb90(&pattern(&lines), &canvas(), [0.2, 0.7], seed).unwrap();
    let baseline = new(7);
    let intensity = |baseline: &Baseline, v: f64, view: [f32; 3], light: [f32; 3]| {
        let shading = shaded(baseline, &point([0.5, v], 0.2), view);
        assert!(
            (shading.coverage() - 1.0).abs() < 1e-6,
            "the texel is all scratch"
        );
        core::f32::consts::PI * shading.eval(light, Output::Brdf)[0]
    };
    let all: Vec<f32> = lines
        .iter()
        .map(|line| {
            let v = line[0][1];
            let straight = intensity(&baseline, v, UP, UP);
            for light in LIGHTS {
                let other = intensity(&baseline, v, [-0.4, 0.5, 0.7], light);
                assert!(
                    (other / straight - 1.0).abs() < 1e-3,
                    "{light:?}: {other} {straight}"
                );
            }
            straight
        })
        .collect();
    let (low, high) = all
        .iter()
        .fold((1.0_f32, 0.0_f32), |(a, b), &c| (a.min(c), b.max(c)));
    assert!(
        (0.199..0.3).contains(&low) && (0.6..0.701).contains(&high),
        "{low} to {high}"
    );
    let again: Vec<f32> = lines
        .iter()
        .map(|l| intensity(&new(7), l[0][1], UP, UP))
        .collect();
    assert_eq!(all, again, "the same seed");
    let other: Vec<f32> = lines
        .iter()
        .map(|l| intensity(&new(8), l[0][1], UP, UP))
        .collect();
    assert_ne!(all, other, "another seed");
}

/// Samples of every system weigh what evaluation says, and densities add up to 1.
#[test]
fn samples_agree_with_evaluation() {
    let pattern = pattern(&[[[0.2, 0.4], [0.8, 0.6]], [[0.5, 0.2], [0.5, 0.8]]]);
    let highlight = Highlight {
        specular: [0.3; 3],
        exponent: 20.0,
    };
    let systems = [
        Baseline::bb90(&pattern, &canvas(), [0.5, 0.9], 1),
        Baseline::bl99(&pattern, &canvas(), &highlight),
        Baseline::mdg01(&pattern, &canvas(), &two_angles(0.2)),
    ];
    for baseline in systems.map(Result::unwrap) {
        let shading = shaded(&baseline, &point([0.5, 0.5], 0.2), [0.3, -0.2, 0.9]);
        let side = 400;
        let (mut density, mut albedo) = (0.0, 0.0);
        for i in 0..side * side {
            let (u, v) = ((i % side) as f32 + 0.5, (i / side) as f32 + 0.5);
            let (cos, angle) = (u / side as f32, v / side as f32 * core::f32::consts::TAU);
            let sin = (1.0 - cos * cos).sqrt();
            let light = [sin * angle.cos(), sin * angle.sin(), cos];
            density += f64::from(shading.pdf(light));
            albedo += f64::from(shading.eval(light, Output::BrdfCos)[0]);
        }
        let step = core::f64::consts::TAU / f64::from(side * side);
        let (density, albedo) = (density * step, albedo * step);
        let mut sampled = 0.0;
        for i in 0..40_000 {
            let u =
                [0.8191725, 0.6710436, 0.5497005].map(|s: f64| single((f64::from(i) * s).fract()));
            if let Some(sample) = shading.sample(u) {
                let value =
                    shading.eval(sample.light, Output::BrdfCos)[0] / shading.pdf(sample.light);
                assert!(
                    (value / sample.weight[0] - 1.0).abs() < 1e-2,
                    "{sample:?} {value}"
                );
                sampled += f64::from(sample.weight[0]) / 40_000.0;
            }
        }
        assert!((density - 1.0).abs() < 0.01, "{baseline:?}: {density}");
        assert!(
            (sampled / albedo - 1.0).abs() < 0.01,
            "{sampled} and {albedo}"
        );
    }
}

/// A generator's scratches can be had in every system's manner; curved ones as curves where they are painted.
#[test]
fn takes_a_pattern_s_scratches() {
    let material = Material::metal(Metal::Aluminium);
    let mut builder = PatternBuilder::new(material, 1.0, [PLATE_MM; 2]).unwrap();
    let generator = Generator {
        amount: Amount::Count(300),
        turn_deg: 60.0,
        curves: 4,
        ..Generator::default()
    };
    let tool = Tool::rockwell_c();
    builder
        .generate(&Generated {
            generator: &generator,
            tool: &tool,
            material: None,
            seed: 3,
        })
        .unwrap();
    let pattern = builder.build();
    let painted = Baseline::mdg01(&pattern, &canvas(), &two_angles(0.1)).unwrap();
    let mut seen = [0; 2];
    for i in 0..4000 {
        let uv = [0.7548777, 0.5698403].map(|s| (f64::from(i) * s).fract());
        let at = point(uv, 0.02);
        let ours = shaded(&painted, &at, UP).scratch_count() > 0;
        let mut shading = Shading::default();
        shading.shade(&pattern, &at, UP).unwrap();
        seen[usize::from(ours)] += u32::from(shading.scratch_count() > 0);
    }
    assert!(
        seen[1] > 5 * seen[0] && seen[1] > 50,
        "{seen:?} unpainted and painted"
    );
}

/// What cannot be is refused by name.
#[test]
fn refuses_by_name() {
    let pattern = pattern(&[]);
    let refused = |result: Result<Baseline, Error>| result.unwrap_err().to_string();
    let flat = Canvas {
        area_uv: [[0.0, 1.0], [1.0, 1.0]],
        ..canvas()
    };
    let huge = Canvas {
        texels: [32768, 32769],
        ..canvas()
    };
    let bad = Canvas {
        texels: [0, 5],
        ..canvas()
    };
    for (canvas, name) in [(flat, "area_uv"), (huge, "texels"), (bad, "texels")] {
        let result = Baseline::bb90(&pattern, &canvas, [0.0, 1.0], 0);
        assert!(refused(result).starts_with(name), "{name}");
    }
    let result = Baseline::bb90(&pattern, &canvas(), [0.5, 1.5], 0);
    assert!(refused(result).starts_with("intensity is 1.5"), "intensity");
    let scratch = TwoAngles {
        groove_deg: 90.0,
        ..two_angles(0.1)
    };
    let result = Baseline::mdg01(&pattern, &canvas(), &scratch);
    assert!(refused(result).starts_with("groove_deg is 90"), "groove");
    let highlight = Highlight {
        specular: [0.5; 3],
        exponent: f32::NAN,
    };
    let result = Baseline::bl99(&pattern, &canvas(), &highlight);
    assert!(refused(result).starts_with("exponent is NaN"), "exponent");
}
