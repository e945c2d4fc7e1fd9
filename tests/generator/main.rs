//! Generated scratches: as many, as long, as deep and as bent as asked for, and the same for the same seed everywhere.

mod same_again;
mod shapes;
mod statistics;

use striae::brdf::Metal;
use striae::formation::{DepthLaw, Material, Tool};
use striae::pattern::{
    Amount, Distribution, Generated, Generator, Held, PatternBuilder, Stroke, Strokes, Style,
};

const MM_PER_UV: [f64; 2] = [100.0, 40.0];

fn strokes(generator: &Generator, seed: u64) -> Strokes {
    generator.strokes(MM_PER_UV, seed).unwrap()
}

/// One scratch by its number.
fn stroke(generator: &Generator, seed: u64, number: u32) -> Stroke {
    let mut stroke = Stroke::default();
    strokes(generator, seed).stroke(number, &mut stroke);
    stroke
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
    let refused = |text: &str, change: &dyn Fn(&mut Generator)| {
        let mut generator = Generator::default();
        change(&mut generator);
        let error = generator.strokes(MM_PER_UV, 0).unwrap_err().to_string();
        assert!(
            error.starts_with(text) && error.contains("; accepted: "),
            "{text}: {error}"
        );
    };
    let uniform = |from, to| Distribution::Uniform { from, to };
    refused("per_cm2 is -1", &|g| g.amount = Amount::PerCm2(-1.0));
    refused("per_cm2 is NaN", &|g| g.amount = Amount::PerCm2(f64::NAN));
    refused("per_cm2 is 100000000", &|g| g.amount = Amount::PerCm2(1e8));
    refused("count is 200000000", &|g| {
        g.amount = Amount::Count(200_000_000);
    });
    refused("area_uv is 0.5", &|g| g.area_uv = [[0.0, 0.5], [1.0, 0.25]]);
    refused("area_uv is NaN", &|g| g.area_uv[0][1] = f64::NAN);
    refused("length_mm.from is 0", &|g| g.length_mm = uniform(0.0, 1.0));
    refused("force_kgf.to is 1", &|g| g.force_kgf = uniform(2.0, 1.0));
    refused("depth_mm.from is NaN", &|g| {
        g.depth_mm = uniform(f64::NAN, 1.0);
    });
    refused("length_mm.middle is 3", &|g| {
        g.length_mm = Distribution::Normal {
            from: 1.0,
            to: 2.0,
            middle: 3.0,
            deviation: 1.0,
        };
    });
    refused("force_kgf.middle is 0", &|g| {
        g.force_kgf = Distribution::LogNormal {
            from: 0.0,
            to: 2.0,
            middle: 0.0,
            deviation: 1.0,
        };
    });
    refused("force_kgf.from is 0", &|g| {
        g.force_kgf = Distribution::PowerLaw {
            from: 0.0,
            to: 2.0,
            exponent: 1.0,
        };
    });
    refused("force_kgf.decay is 0", &|g| {
        g.force_kgf = Distribution::Exponential {
            from: 0.0,
            to: 2.0,
            decay: 0.0,
        };
    });
    refused("spread_deg is 400", &|g| g.spread_deg = 400.0);
    refused("turn_deg is inf", &|g| g.turn_deg = f64::INFINITY);
    refused("wander_deg is 91", &|g| g.wander_deg = 91.0);
    refused("curves is 0", &|g| g.curves = 0);
    refused("taper is 1.5", &|g| g.taper = [0.5, 1.5]);
    refused("taper[0] + taper[1] is 1.5", &|g| g.taper = [0.75, 0.75]);
    refused("tilt_deg is 86", &|g| g.orientation.tilt_deg = 86.0);
    refused("spin_spread_deg is -1", &|g| g.spin_spread_deg = -1.0);
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
