//! What shading costs, as ratios to one GGX conductor evaluation in the same run.

#[path = "support/figures.rs"]
mod figures;

use std::f32::consts::PI;
use std::hint::black_box;
use std::time::Instant;
use striae::brdf::Metal;
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, PatternBuilder, Scratch, SurfacePoint};
use striae::scattering::{Output, Shading};

/// Calls that are timed together.
const CALLS: u32 = 2000;

/// Repetitions; the fastest is what the machine can do undisturbed.
const REPETITIONS: u32 = 60;

/// The plate's side, mm.
const SIDE_MM: f64 = 100.0;

fn main() {
    let mut figures = Vec::new();
    let mut note = |name: &str, figure: f64| figures.push((name.to_owned(), figure));
    let ggx = ggx_ns();
    note("ggx_ns", ggx);

    let scratched = pattern(&[0.5]);
    let beside = point(0.25, 0.05);
    let within = point(0.5, 0.05);
    let empty = shade_ns(&scratched, &beside);
    let one = shade_ns(&scratched, &within);
    let again = eval_ns(&scratched, &within);
    note("shade_empty_ns", empty);
    note("shade_one_ns", one);
    note("eval_one_ns", again);
    note("shade_empty_per_ggx", empty / ggx);
    note("shade_eval_per_ggx", (one + again) / ggx);
    note("eval_again_per_ggx", again / ggx);
    let crossed = pattern(&[0.5, 0.5003, 0.5006, 0.5009]);
    note("shade_four_ns", shade_ns(&crossed, &within));
    note("eval_four_ns", eval_ns(&crossed, &within));
    figures::write(&figures);
}

/// Scratches that run along v at these u, and one far away.
fn pattern(us: &[f64]) -> Pattern {
    let material = Material::metal(Metal::Steel);
    let mut builder = PatternBuilder::new(material, 1.0, [SIDE_MM; 2]).expect("valid");
    let (tool, keys) = (Tool::rockwell_c(), [Key::force(0.0, 1.0)]);
    for &u in us.iter().chain(&[0.9]) {
        let line = [[u, 0.0], [u, 1.0]];
        let scratch = Scratch {
            path: Path::Polyline(&line),
            keys: &keys,
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).expect("valid");
    }
    builder.build()
}

fn point(u: f64, radius_mm: f32) -> SurfacePoint {
    SurfacePoint {
        uv: [u, 0.5],
        dp_du: [100.0, 0.0, 0.0],
        dp_dv: [0.0, 100.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint: Footprint::Radius(radius_mm),
    }
}

fn fastest_ns(mut calls: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..REPETITIONS {
        let begun = Instant::now();
        calls();
        best = best.min(begun.elapsed().as_secs_f64());
    }
    best * 1e9 / f64::from(CALLS)
}

/// Directions that no branch predictor learns.
fn direction(number: u32) -> [f32; 3] {
    let share = |step: f32| (number as f32 * step).fract() - 0.5;
    [share(0.754_877_7), share(0.569_840_3), 0.6]
}

fn shade_ns(pattern: &Pattern, point: &SurfacePoint) -> f64 {
    let mut shading = Shading::default();
    fastest_ns(|| {
        for i in 0..CALLS {
            let shaded = shading.shade(pattern, black_box(point), direction(i));
            shaded.expect("a valid point");
            black_box(&shading);
        }
    })
}

fn eval_ns(pattern: &Pattern, point: &SurfacePoint) -> f64 {
    let mut shading = Shading::default();
    shading
        .shade(pattern, point, [0.2, 0.1, 0.9])
        .expect("a valid point");
    fastest_ns(|| {
        for i in 0..CALLS {
            black_box(black_box(&shading).eval(direction(i), Output::BrdfCos));
        }
    })
}

/// One evaluation of GGX with height-correlated masking and a conductor's Fresnel reflectance per channel, as any
/// renderer has it.
fn ggx_ns() -> f64 {
    let view = normalized([0.2, 0.1, 0.9]);
    fastest_ns(|| {
        for i in 0..CALLS {
            black_box(ggx_conductor(black_box(view), normalized(direction(i))));
        }
    })
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn normalized(v: [f32; 3]) -> [f32; 3] {
    let by = 1.0 / dot(v, v).sqrt();
    v.map(|x| x * by)
}

fn ggx_conductor(view: [f32; 3], light: [f32; 3]) -> [f32; 3] {
    let (alpha, eta, k) = (0.2_f32, [2.911, 2.950, 2.584], [3.089, 2.932, 2.767]);
    let (n_l, n_v) = (light[2], view[2]);
    if n_l <= 0.0 || n_v <= 0.0 {
        return [0.0; 3];
    }
    let half = normalized([0, 1, 2].map(|i| view[i] + light[i]));
    let a2 = alpha * alpha;
    let d = half[2] * half[2] * (a2 - 1.0) + 1.0;
    let distribution = a2 / (PI * d * d);
    let smith = |cos: f32| (a2 + (1.0 - a2) * cos * cos).sqrt();
    let visibility = 0.5 / (n_l * smith(n_v) + n_v * smith(n_l));
    let cos = dot(view, half);
    [0, 1, 2].map(|i| distribution * visibility * n_l * conductor(cos, eta[i], k[i]))
}

/// Exact reflectance of a conductor (Born and Wolf), unpolarised.
fn conductor(cos: f32, eta: f32, k: f32) -> f32 {
    let cos2 = cos * cos;
    let sin2 = 1.0 - cos2;
    let t = eta * eta - k * k - sin2;
    let a2b2 = (t * t + 4.0 * eta * eta * k * k).sqrt();
    let a = (0.5 * (a2b2 + t)).max(0.0).sqrt();
    let (t1, t2) = (a2b2 + cos2, 2.0 * cos * a);
    let rs = (t1 - t2) / (t1 + t2);
    let (t3, t4) = (cos2 * a2b2 + sin2 * sin2, t2 * sin2);
    0.5 * rs * (1.0 + (t3 - t4) / (t3 + t4))
}
