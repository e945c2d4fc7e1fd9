//! Generated scratches: as many, as long, as deep and as bent as asked for, and the same for the same seed everywhere.

use core::f64::consts::FRAC_1_SQRT_2;
use kurbo::{CubicBez, ParamCurveArclen, Point};
use std::time::Instant;
use striae::brdf::Metal;
use striae::formation::{DepthLaw, Material, Tool};
use striae::pattern::{
    Amount, Distribution, Generated, Generator, Held, PatternBuilder, Stroke, Strokes, Style,
};

const MM_PER_UV: [f64; 2] = [100.0, 40.0];

fn strokes(generator: &Generator, seed: u64) -> Strokes {
    generator.strokes(MM_PER_UV, seed).unwrap()
}

/// What `measure` gives for each scratch.
fn measured<T>(strokes: &Strokes, mut measure: impl FnMut(&Stroke) -> T) -> Vec<T> {
    let mut values = Vec::new();
    let all = strokes.try_for_each(0..strokes.count(), |_, stroke| {
        values.push(measure(stroke));
        Ok::<(), ()>(())
    });
    all.unwrap();
    values
}

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

fn normal_below(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Kolmogorov's test: how far the values' own distribution is from `below` stays under what chance exceeds once in
/// ten thousand.
fn assert_distributed(what: &str, mut values: Vec<f64>, below: impl Fn(f64) -> f64) {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let farthest = values
        .iter()
        .enumerate()
        .map(|(i, &value)| {
            let p = below(value);
            (p - i as f64 / count)
                .abs()
                .max(((i + 1) as f64 / count - p).abs())
        })
        .fold(0.0, f64::max);
    let limit = (0.5 * (2.0 / 1e-4_f64).ln()).sqrt() / count.sqrt();
    assert!(
        farthest < limit,
        "{what}: {farthest} from its distribution, limit {limit}, {count} values"
    );
}

/// A generator of 20000 scratches in which all but one quantity is as simple as can be.
fn plain() -> Generator {
    Generator {
        amount: Amount::Count(20_000),
        taper: [0.0; 2],
        ..Generator::default()
    }
}

/// Probability below a value.
type Below = Box<dyn Fn(f64) -> f64>;

/// Every distribution, and the probability below a value by its textbook formula, cut to its ends.
fn distributions() -> Vec<(&'static str, Distribution, Below)> {
    let (from, to) = (0.5, 20.0);
    let cut = |below: Below| -> Below {
        Box::new(move |x| (below(x) - below(from)) / (below(to) - below(from)))
    };
    let normal = Distribution::Normal {
        from,
        to,
        middle: 4.0,
        deviation: 5.0,
    };
    let log_normal = Distribution::LogNormal {
        from,
        to,
        middle: 3.0,
        deviation: 0.8,
    };
    let power = |exponent| Distribution::PowerLaw { from, to, exponent };
    let exponential = Distribution::Exponential {
        from,
        to,
        decay: 3.0,
    };
    vec![
        (
            "uniform",
            Distribution::Uniform { from, to },
            cut(Box::new(|x| x)),
        ),
        (
            "normal",
            normal,
            cut(Box::new(|x| normal_below((x - 4.0) / 5.0))),
        ),
        (
            "log-normal",
            log_normal,
            cut(Box::new(|x| normal_below((x / 3.0).ln() / 0.8))),
        ),
        (
            "power law 2.5",
            power(2.5),
            cut(Box::new(|x| -x.powf(-1.5))),
        ),
        ("power law 1", power(1.0), cut(Box::new(f64::ln))),
        ("power law -1", power(-1.0), cut(Box::new(|x| x * x))),
        (
            "exponential",
            exponential,
            cut(Box::new(|x| -(-x / 3.0).exp())),
        ),
    ]
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

fn correlation(pairs: &[[f64; 2]]) -> f64 {
    let count = pairs.len() as f64;
    let mean = |k: usize| pairs.iter().map(|pair| pair[k]).sum::<f64>() / count;
    let (a, b) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(f).sum::<f64>();
    sum(&|p| (p[0] - a) * (p[1] - b))
        / (sum(&|p| (p[0] - a).powi(2)) * sum(&|p| (p[1] - b).powi(2))).sqrt()
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
    let mut stroke = Stroke::default();
    strokes(&generator, 6).stroke(7, &mut stroke);
    let curves = curves(&stroke);
    let center = curves[0].p0.midpoint(curves[1].p3);
    for curve in &curves {
        for i in 0..=8 {
            let point = kurbo::ParamCurve::eval(curve, f64::from(i) / 8.0);
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
        let mut stroke = Stroke::default();
        strokes(&generator, 8).stroke(0, &mut stroke);
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

/// A generator in which every kind of random number is drawn.
fn thorough() -> Generator {
    Generator {
        amount: Amount::Count(1000),
        spin_spread_deg: 30.0,
        depth_mm: Distribution::Exponential {
            from: 0.0,
            to: 0.1,
            decay: 0.01,
        },
        ..Generator::style(Style::Swirls)
    }
}

/// Scratches do not depend on which were asked for before, nor on which thread asks.
#[test]
fn chunks_and_threads_agree() {
    let strokes = strokes(&thorough(), 9);
    let together = measured(&strokes, |stroke| {
        (stroke.points_uv().to_vec(), stroke.keys().to_vec())
    });
    let strokes = &strokes;
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..7_u32)
            .map(|first| {
                scope.spawn(move || {
                    let mut stroke = Stroke::default();
                    let mut made = Vec::new();
                    for number in (first..1000).step_by(7).collect::<Vec<_>>().iter().rev() {
                        strokes.stroke(*number, &mut stroke);
                        let parts = (stroke.points_uv().to_vec(), stroke.keys().to_vec());
                        made.push((*number, parts));
                    }
                    made
                })
            })
            .collect();
        for thread in threads {
            for (number, parts) in thread.join().unwrap() {
                assert_eq!(together[number as usize], parts, "scratch {number}");
            }
        }
    });
}

/// More scratches of the same seed begin with the same ones.
#[test]
fn denser_patterns_hold_sparser_ones() {
    let mut generator = thorough();
    let few = measured(&strokes(&generator, 9), |stroke| {
        stroke.points_uv().to_vec()
    });
    generator.amount = Amount::Count(1500);
    let many = measured(&strokes(&generator, 9), |stroke| {
        stroke.points_uv().to_vec()
    });
    assert_eq!(few[..], many[..1000], "the first thousand");
}

/// Stored bits: the same on every machine, compiler and version of the libraries below.
#[test]
fn bits_are_stored() {
    let hash = |style: Style, seed: u64| {
        let generator = Generator {
            amount: Amount::Count(1000),
            ..Generator::style(style)
        };
        let mut sum = 0_u64;
        measured(&strokes(&generator, seed), |stroke| sum = fnv(sum, stroke));
        sum
    };
    let mut stroke = Stroke::default();
    strokes(&thorough(), 10).stroke(999, &mut stroke);
    let [u, v] = stroke.points_uv()[6];
    let key = stroke.keys()[1];
    assert_eq!([u, v], [0.013436829920936533, 0.11493989328930143]);
    assert_eq!(key.force_kgf, 0.0005858283508854287);
    assert_eq!(key.orientation.spin_deg, 23.255392442959245);
    let stored = [
        0x76b5_89b6_b05b_0746,
        0x84c0_e695_8465_8c3a,
        0xf475_a9c0_ab11_e4c6,
        0x2c09_a4dc_0ada_fad7,
    ];
    for (style, sum) in Style::ALL.into_iter().zip(stored) {
        assert_eq!(hash(style, 11), sum, "{style:?}");
    }
}

/// A million scratches of four curves are a matter of a second: `cargo test --release -- --ignored` says how long.
#[test]
#[ignore = "a measurement"]
fn million() {
    let generator = Generator {
        amount: Amount::Count(1_000_000),
        ..Generator::style(Style::Swirls)
    };
    let strokes = strokes(&generator, 1);
    let begin = Instant::now();
    let mut points = 0;
    let all = strokes.try_for_each(0..strokes.count(), |_, stroke| {
        points += stroke.points_uv().len();
        Ok::<(), ()>(())
    });
    assert_eq!((all, points), (Ok(()), 13_000_000));
    println!("{:?}", begin.elapsed());
}

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits) of a scratch's numbers.
fn fnv(sum: u64, stroke: &Stroke) -> u64 {
    let points = stroke.points_uv().iter().flatten().copied();
    let keys = stroke
        .keys()
        .iter()
        .flat_map(|key| [key.at, key.force_kgf, key.depth_mm]);
    points
        .chain(keys)
        .flat_map(f64::to_le_bytes)
        .fold(sum ^ 0xcbf2_9ce4_8422_2325, |sum, byte| {
            (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        })
}

/// Other seeds are other scratches.
#[test]
fn seeds_differ() {
    let first = |seed| measured(&strokes(&thorough(), seed), |stroke| stroke.points_uv()[0]);
    let (one, other) = (first(1), first(2));
    assert!(one.iter().zip(&other).all(|(a, b)| a != b), "seeds 1 and 2");
    let pairs: Vec<[f64; 2]> = one.iter().zip(&other).map(|(a, b)| [a[0], b[0]]).collect();
    let related = correlation(&pairs);
    assert!(related.abs() < 0.12, "{related}");
}

fn builder() -> PatternBuilder {
    PatternBuilder::new(Material::metal(Metal::Steel), 1.0, MM_PER_UV).unwrap()
}

/// Every style makes patterns with its own sizes, in layers over each other.
#[test]
fn styles_make_patterns() {
    let tool = Tool::abrasive_grain();
    let mut builder = builder();
    for (seed, style) in Style::ALL.into_iter().enumerate() {
        let generator = Generator {
            area_uv: [[0.5, 0.5], [0.52, 0.55]],
            ..Generator::style(style)
        };
        let generated = Generated {
            generator: &generator,
            tool: &tool,
            material: None,
            seed: seed as u64,
        };
        builder.generate(&generated).unwrap();
    }
    // 2 mm x 2 mm: 0.8, 80, 6 and 16 scratches.
    assert_eq!(builder.build().scratch_count(), 1 + 80 + 6 + 16);
}

/// Values out of their ranges are refused by their names.
#[test]
fn refusals() {
    let refused = |generator: Generator, text: &str| {
        let error = generator.strokes(MM_PER_UV, 0).unwrap_err().to_string();
        assert!(
            error.starts_with(text) && error.contains("; accepted: "),
            "{error}"
        );
    };
    let style = Generator::default;
    let nan = f64::NAN;
    let uniform = |from, to| Distribution::Uniform { from, to };
    refused(
        Generator {
            amount: Amount::PerCm2(-1.0),
            ..style()
        },
        "per_cm2 is -1",
    );
    refused(
        Generator {
            amount: Amount::PerCm2(1e8),
            ..style()
        },
        "per_cm2 is 100000000",
    );
    refused(
        Generator {
            amount: Amount::Count(200_000_000),
            ..style()
        },
        "count is 200000000",
    );
    refused(
        Generator {
            area_uv: [[0.0, 0.5], [1.0, 0.25]],
            ..style()
        },
        "area_uv is 0.5",
    );
    refused(
        Generator {
            area_uv: [[0.0, nan], [1.0, 1.0]],
            ..style()
        },
        "area_uv is NaN",
    );
    refused(
        Generator {
            length_mm: uniform(0.0, 1.0),
            ..style()
        },
        "length_mm.from is 0",
    );
    refused(
        Generator {
            force_kgf: uniform(2.0, 1.0),
            ..style()
        },
        "force_kgf.to is 1",
    );
    refused(
        Generator {
            depth_mm: uniform(nan, 1.0),
            ..style()
        },
        "depth_mm.from is NaN",
    );
    let normal = Distribution::Normal {
        from: 1.0,
        to: 2.0,
        middle: 3.0,
        deviation: 1.0,
    };
    refused(
        Generator {
            length_mm: normal,
            ..style()
        },
        "length_mm.middle is 3",
    );
    let power = Distribution::PowerLaw {
        from: 0.0,
        to: 2.0,
        exponent: 1.0,
    };
    refused(
        Generator {
            force_kgf: power,
            ..style()
        },
        "force_kgf.from is 0",
    );
    refused(
        Generator {
            spread_deg: 400.0,
            ..style()
        },
        "spread_deg is 400",
    );
    refused(
        Generator {
            turn_deg: f64::INFINITY,
            ..style()
        },
        "turn_deg is inf",
    );
    refused(
        Generator {
            wander_deg: 91.0,
            ..style()
        },
        "wander_deg is 91",
    );
    refused(
        Generator {
            curves: 0,
            ..style()
        },
        "curves is 0",
    );
    refused(
        Generator {
            taper: [0.5, 1.5],
            ..style()
        },
        "taper is 1.5",
    );
    refused(
        Generator {
            taper: [0.75, 0.75],
            ..style()
        },
        "taper[0] + taper[1] is 1.5",
    );
}

/// A scratch that the tool is too short for is named, and the builder stays as it was.
#[test]
fn builders_survive() {
    let stub = Tool::sphero_cone(60.0, 0.005, 0.01).unwrap();
    let generator = Generator {
        amount: Amount::Count(40),
        force_kgf: Distribution::Uniform {
            from: 1e-4,
            to: 2.0,
        },
        depth_law: DepthLaw::Bosch2004,
        held: Held::ToSurface,
        ..Generator::default()
    };
    let mut builder = builder();
    let generated = |tool| Generated {
        generator: &generator,
        tool,
        material: None,
        seed: 3,
    };
    let error = builder.generate(&generated(&stub)).unwrap_err().to_string();
    assert!(
        error.starts_with("scratches[") && error.contains("force_kgf is "),
        "{error}"
    );
    assert_eq!(builder.build().scratch_count(), 0, "after {error}");
    assert_eq!(builder.generate(&generated(&Tool::rockwell_c())), Ok(40));
    assert_eq!(builder.build().scratch_count(), 40);
}
