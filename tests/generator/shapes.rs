//! Scratches are as long, as deep, as bent and as soft at their ends as asked for.

use super::statistics::{assert_distributed, correlation, distributions, normal_below};
use super::*;
use kurbo::{CubicBez, ParamCurve, ParamCurveArclen, Point};

/// The curves of a scratch, mm.
fn curves(stroke: &Stroke) -> Vec<CubicBez> {
    let points: Vec<Point> = stroke
        .points_uv()
        .iter()
        .map(|&[u, v]| Point::new(u * MM_PER_UV[0], v * MM_PER_UV[1]))
        .collect();
    (0..points.len() / 3)
        .map(|i| {
            CubicBez::new(
                points[3 * i],
                points[3 * i + 1],
                points[3 * i + 2],
                points[3 * i + 3],
            )
        })
        .collect()
}

fn length_mm(stroke: &Stroke) -> f64 {
    curves(stroke).iter().map(|curve| curve.arclen(1e-9)).sum()
}

/// Direction from one control point to another, degrees.
fn heading_deg(from: Point, to: Point) -> f64 {
    (to - from).atan2().to_degrees()
}

/// An angle as one between -180 and 180 degrees.
fn wrapped(angle_deg: f64) -> f64 {
    (angle_deg + 180.0).rem_euclid(360.0) - 180.0
}

fn full_force_kgf(stroke: &Stroke) -> f64 {
    stroke
        .keys()
        .iter()
        .map(|key| key.force_kgf)
        .fold(0.0, f64::max)
}

/// A generator of 20000 scratches in which all but one quantity is as simple as can be.
fn plain() -> Generator {
    Generator {
        amount: Amount::Count(20_000),
        taper: [0.0; 2],
        ..Generator::default()
    }
}

/// Paths are as long as their distribution says, measured along them, however wide u and v are.
#[test]
fn lengths() {
    for (name, distribution, below) in distributions() {
        let generator = Generator {
            length_mm: distribution,
            turn_spread_deg: 60.0,
            curves: 3,
            ..plain()
        };
        assert_distributed(name, measured(&strokes(&generator, 1), length_mm), below);
    }
}

/// Forces and stated depths are distributed as asked for, independently of lengths.
#[test]
fn forces_and_depths() {
    for (name, distribution, below) in distributions() {
        let generator = Generator {
            force_kgf: distribution,
            depth_mm: distribution,
            ..plain()
        };
        let strokes = strokes(&generator, 2);
        assert_distributed(name, measured(&strokes, full_force_kgf), &below);
        let depth_mm = |stroke: &Stroke| stroke.keys()[0].depth_mm;
        assert_distributed(name, measured(&strokes, depth_mm), below);
        let pairs = measured(&strokes, |stroke| {
            [full_force_kgf(stroke), length_mm(stroke)]
        });
        let ranks = correlation(&pairs);
        assert!(ranks.abs() < 0.03, "{name}: force and length {ranks}");
    }
}

/// Directions scatter normally about the main one, on the surface rather than in texture space; 360 degrees is every
/// direction alike.
#[test]
fn directions() {
    let of = |spread_deg: f64| {
        let generator = Generator {
            direction_deg: 30.0,
            spread_deg,
            ..plain()
        };
        measured(&strokes(&generator, 3), |stroke| {
            let curve = curves(stroke)[0];
            wrapped(heading_deg(curve.p0, curve.p3) - 30.0)
        })
    };
    assert_distributed("20 degrees", of(20.0), |angle| normal_below(angle / 20.0));
    assert_distributed("every direction", of(360.0), |angle| {
        (angle + 180.0) / 360.0
    });
    assert!(of(0.0).iter().all(|angle| angle.abs() < 1e-9), "parallel");
}

/// The spin scatters about the stated one, the same along one scratch.
#[test]
fn spins() {
    let mut generator = Generator {
        spin_spread_deg: 15.0,
        taper: [0.25; 2],
        ..plain()
    };
    generator.orientation.spin_deg = 40.0;
    let spins = measured(&strokes(&generator, 12), |stroke| {
        let spin_deg = stroke.keys()[0].orientation.spin_deg;
        let same = |key: &striae::pattern::Key| key.orientation.spin_deg == spin_deg;
        assert!(stroke.keys().iter().all(same), "{:?}", stroke.keys());
        spin_deg
    });
    assert_distributed("spin", spins, |deg| normal_below((deg - 40.0) / 15.0));
}

/// The middles lie evenly over the area, as many on a cm² as asked for.
#[test]
fn density() {
    let generator = Generator {
        amount: Amount::PerCm2(500.0),
        area_uv: [[0.2, -0.5], [0.7, 1.0]],
        ..Generator::style(Style::Handling)
    };
    let strokes = strokes(&generator, 4);
    // 50 mm x 60 mm.
    assert_eq!(strokes.count(), 15_000);
    let middles = measured(&strokes, |stroke| stroke.points_uv()[6]);
    let along = |k: usize| middles.iter().map(|middle| middle[k]).collect();
    assert_distributed("u", along(0), |u| (u - 0.2) / 0.5);
    assert_distributed("v", along(1), |v| (v + 0.5) / 1.5);
    let together = correlation(&middles);
    assert!(together.abs() < 0.03, "u and v {together}");
}

/// Whole paths turn as asked for, half before the middle and half behind, and stay smooth where curves meet.
#[test]
fn curl() {
    let generator = Generator {
        direction_deg: 10.0,
        spread_deg: 0.0,
        turn_deg: 90.0,
        turn_spread_deg: 25.0,
        curves: 4,
        ..plain()
    };
    let turned = measured(&strokes(&generator, 5), |stroke| {
        let curves = curves(stroke);
        let ends: Vec<[f64; 2]> = curves
            .iter()
            .map(|c| [heading_deg(c.p0, c.p1), heading_deg(c.p2, c.p3)])
            .collect();
        for pair in ends.windows(2) {
            let kink = wrapped(pair[1][0] - pair[0][1]);
            assert!(kink.abs() < 1e-6, "a kink of {kink} degrees");
        }
        let middle = wrapped(ends[1][1] - 10.0);
        assert!(middle.abs() < 1e-6, "{middle} degrees off in the middle");
        ends.iter().map(|[from, to]| wrapped(to - from)).sum()
    });
    assert_distributed("turn", turned, |deg| normal_below((deg - 90.0) / 25.0));
}

/// An arc of a quarter turn keeps its radius to the accuracy that cubics have.
#[test]
fn arcs_are_round() {
    let generator = Generator {
        length_mm: Distribution::constant(10.0),
        turn_deg: 360.0,
        curves: 4,
        ..plain()
    };
    let radius_mm = 10.0 / core::f64::consts::TAU;
    let stroke = stroke(&generator, 6, 7);
    let curves = curves(&stroke);
    let center = curves[0].p0.midpoint(curves[1].p3);
    for curve in &curves {
        for i in 0..=8 {
            let point = curve.eval(f64::from(i) / 8.0);
            let off = (point - center).hypot() / radius_mm - 1.0;
            assert!(off.abs() < 3e-4, "{off}");
        }
    }
    let length = length_mm(&stroke);
    assert!((length / 10.0 - 1.0).abs() < 3e-4, "{length}");
}

/// An unsteady hand: single curves turn differently, by the deviation asked for, and never beyond 90 degrees.
#[test]
fn wander() {
    let of = |wander_deg: f64| {
        let generator = Generator {
            wander_deg,
            curves: 5,
            ..plain()
        };
        let turns = measured(&strokes(&generator, 7), |stroke| -> Vec<f64> {
            let turn = |c: &CubicBez| wrapped(heading_deg(c.p2, c.p3) - heading_deg(c.p0, c.p1));
            curves(stroke).iter().map(turn).collect()
        });
        turns.concat()
    };
    assert_distributed("wander", of(6.0), |deg| normal_below(deg / 6.0));
    let most = of(90.0).into_iter().fold(0.0, f64::max);
    assert!((89.0..90.001).contains(&most), "{most}");
}

/// Force rises and falls over the shares asked for; without a taper one key is enough; tapers that meet share a key.
#[test]
fn taper() {
    let keys = |taper: [f64; 2]| {
        let generator = Generator {
            taper,
            force_kgf: Distribution::constant(2.0),
            ..plain()
        };
        let stroke = stroke(&generator, 8, 0);
        let pairs = stroke.keys().iter().map(|key| [key.at, key.force_kgf]);
        pairs.collect::<Vec<_>>()
    };
    assert_eq!(keys([0.0, 0.0]), [[0.0, 2.0]]);
    assert_eq!(
        keys([0.25, 0.125]),
        [[0.0, 0.0], [0.25, 2.0], [0.875, 2.0], [1.0, 0.0]]
    );
    assert_eq!(keys([0.0, 0.5]), [[0.0, 2.0], [0.5, 2.0], [1.0, 0.0]]);
    assert_eq!(keys([0.5, 0.5]), [[0.0, 0.0], [0.5, 2.0], [1.0, 0.0]]);
    assert_eq!(keys([1.0, 0.0]), [[0.0, 0.0], [1.0, 2.0]]);
}
