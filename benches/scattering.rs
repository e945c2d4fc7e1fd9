//! What shading costs, as ratios to one GGX conductor evaluation in the same run: by time (criterion), and, where valgrind is
//! there, by instructions.

#[path = "support/figures.rs"]
mod figures;

use criterion::{BenchmarkId, Criterion, Throughput};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::f32::consts::PI;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::PathBuf;
use std::process::Command;
use std::sync::LazyLock;
use std::time::Duration;
use striae::brdf::Metal;
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, PatternBuilder, Scratch, SurfacePoint};
use striae::scattering::{Output, Shading, Vectors, set_simd};

/// The plate's side, mm.
const SIDE_MM: f64 = 100.0;

/// The side of a plate with scratches strewn all over, mm; half the width of a pixel there, and how long they are.
const STREWN_MM: f32 = 20.0;
const STREWN_RADIUS_MM: f32 = 0.42;
const STREWN_LENGTHS_MM: core::ops::Range<f64> = 2.5..10.5;

/// Lights and samples that are asked for at once.
const MANY: u32 = 64;

/// A call of each kind, and of how many things it disposes.
const JOBS: [(&str, u32); 19] = [
    ("ggx", 1),
    ("near_empty", 1),
    ("near_beside", 1),
    ("shade_empty", 1),
    ("shade_beside", 1),
    ("shade_one", 1),
    ("shade_four", 1),
    ("shade_curved", 1),
    ("shade_tapering", 1),
    ("shade_end", 1),
    ("shade_few", 1),
    ("shade_dozens", 1),
    ("shade_crowd", 1),
    ("eval", 1),
    ("eval_four", 1),
    ("eval_pdf", 1),
    ("sample", 1),
    ("eval_many", MANY),
    ("sample_many", MANY),
];

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, flag, job, calls] = &arguments[..]
        && flag == COUNT
    {
        let scene = Scene::new();
        let mut shading = scene.prepared(job);
        for i in 0..calls.parse().expect("a number") {
            scene.call(job, i, &mut shading);
        }
        return;
    }
    let mut figures = Vec::new();
    let times = JOBS.map(|(job, things)| (job, median_ns(job, "simd") / f64::from(things)));
    set_simd(false);
    let slow = ["eval", "shade_one", "eval_many"].map(|job| (job, median_ns(job, "plain")));
    set_simd(true);
    let of = |name: &str| {
        let found = times.iter().find(|(job, _)| *job == name);
        found.expect("a job").1
    };
    let mut note = |name: &str, figure: f64| figures.push((name.to_owned(), figure));
    let ggx = of("ggx");
    for (job, ns) in times {
        note(&format!("{job}_ns"), ns);
    }
    note("near_per_ggx", of("near_beside") / ggx);
    note("shade_empty_per_ggx", of("shade_empty") / ggx);
    note("shade_eval_per_ggx", (of("shade_one") + of("eval")) / ggx);
    note("eval_again_per_ggx", of("eval") / ggx);
    note("sample_per_ggx", of("sample") / ggx);
    note("batch_speedup", of("eval") / of("eval_many"));
    note("batch_sample_speedup", of("sample") / of("sample_many"));
    note("simd_speedup", slow[0].1 / of("eval"));
    note("simd_shade_speedup", slow[1].1 / of("shade_one"));
    if let Some(all) = instructions() {
        let of = |name: &str| {
            let found = all.iter().find(|(job, _)| *job == name);
            found.expect("a job").1
        };
        let ggx = of("ggx");
        for (job, count) in &all {
            note(&format!("{job}_instructions"), *count);
        }
        note("shade_empty_per_ggx_instructions", of("shade_empty") / ggx);
        let both = of("shade_one") + of("eval");
        note("shade_eval_per_ggx_instructions", both / ggx);
        note("eval_again_per_ggx_instructions", of("eval") / ggx);
        note("sample_per_ggx_instructions", of("sample") / ggx);
    }
    figures::write(&figures);
}

/// The median time of a call, by criterion.
fn median_ns(job: &str, how: &str) -> f64 {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("criterion");
    let scene = Scene::new();
    let mut shading = scene.prepared(job);
    let mut criterion = Criterion::default()
        .output_directory(&folder)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    let mut group = criterion.benchmark_group("scattering");
    group.throughput(Throughput::Elements(1));
    let mut i = 0;
    group.bench_function(BenchmarkId::new(job, how), |bencher| {
        bencher.iter(|| {
            i += 1;
            scene.call(job, i, &mut shading);
        });
    });
    group.finish();
    let path = folder.join(format!("scattering/{job}/{how}/new/estimates.json"));
    let text = std::fs::read(path).expect("criterion writes its estimates");
    let estimates: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
    let median = estimates["median"]["point_estimate"].as_f64();
    median.expect("a median")
}

/// The first argument of a run that valgrind counts.
const COUNT: &str = "--count";

/// Instructions per thing, by callgrind; nothing where there is no valgrind.
fn instructions() -> Option<Vec<(&'static str, f64)>> {
    JOBS.iter()
        .map(|&(job, things)| {
            // What starting up takes falls out of the difference.
            let (few, many) = (counted(job, 50)?, counted(job, 550)?);
            Some((job, (many - few) / 500.0 / f64::from(things)))
        })
        .collect()
}

fn counted(job: &str, calls: u32) -> Option<f64> {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("callgrind.out");
    let own = std::env::current_exe().ok()?;
    let run = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(own)
        .args([COUNT, job, &calls.to_string()])
        // Threads that wait for work would be counted.
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .ok()?;
    let told = String::from_utf8_lossy(&run.stderr).into_owned();
    let line = told.lines().find(|line| line.contains("Collected"))?;
    line.split_whitespace().last()?.parse().ok()
}

/// What is shaded.
struct Scene {
    one: Pattern,
    four: Pattern,
    /// A curve that sets in, goes on evenly and runs out.
    curved: Pattern,
    /// Scratches that cross: some 5, 30 and 70 to the pixel.
    few: LazyLock<Pattern>,
    dozens: LazyLock<Pattern>,
    crowd: LazyLock<Pattern>,
    /// Packed, x then y then z.
    lights: [Vec<f32>; 3],
    numbers: [Vec<f32>; 3],
}

impl Scene {
    fn new() -> Self {
        let lights = [0, 1, 2].map(|k| (0..MANY).map(|i| direction(i)[k]).collect());
        let numbers = [0, 1, 2].map(|k| (0..MANY).map(|i| number(i)[k]).collect());
        Self {
            one: pattern(&[0.5]),
            four: pattern(&[0.5, 0.5003, 0.5006, 0.5009]),
            curved: curved(),
            few: LazyLock::new(|| strewn(228)),
            dozens: LazyLock::new(|| strewn(1480)),
            crowd: LazyLock::new(|| strewn(3480)),
            lights,
            numbers,
        }
    }

    /// A point in the middle of the scratches.
    fn prepared(&self, job: &str) -> Shading {
        let mut shading = Shading::default();
        let pattern = if job == "eval_four" {
            &self.four
        } else {
            &self.one
        };
        let shaded = shading.shade(pattern, &point(0.5, 0.05), [0.2, 0.1, 0.9]);
        shaded.expect("a valid point");
        shading
    }

    fn call(&self, job: &str, i: u32, shading: &mut Shading) {
        match job {
            "ggx" => {
                let view = black_box([0.215_67, 0.107_83, 0.970_5]);
                black_box(ggx_conductor(view, normalized(direction(i))));
            }
            "near_empty" => near(&self.one, &point(0.25, 0.05), i),
            "near_beside" => near(&self.one, &point(0.7, 0.05), i),
            "shade_empty" => shade(shading, &self.one, &point(0.25, 0.05), i),
            // Within the grid, and nothing there.
            "shade_beside" => shade(shading, &self.one, &point(0.7, 0.05), i),
            "shade_one" => shade(shading, &self.one, &point(0.5, 0.05), i),
            "shade_four" => shade(shading, &self.four, &point(0.5, 0.05), i),
            "shade_curved" => shade(shading, &self.curved, &on_curve(0.4), i),
            "shade_tapering" => shade(shading, &self.curved, &on_curve(0.1), i),
            "shade_end" => shade(shading, &self.one, &END, i),
            "shade_few" => shade(shading, &self.few, &on_strewn(i), i),
            "shade_dozens" => shade(shading, &self.dozens, &on_strewn(i), i),
            "shade_crowd" => shade(shading, &self.crowd, &on_strewn(i), i),
            "eval" | "eval_four" => {
                black_box(black_box(&*shading).eval(direction(i), Output::BrdfCos));
            }
            "eval_pdf" => {
                black_box(black_box(&*shading).eval_pdf(direction(i)));
            }
            "sample" => {
                black_box(black_box(&*shading).sample(number(i)));
            }
            "eval_many" => {
                let tell = |_, rgb| {
                    black_box(rgb);
                };
                let lights = vectors(&self.lights);
                let told =
                    black_box(&*shading).eval_many(&lights, MANY as usize, Output::BrdfCos, tell);
                told.expect("arrays long enough");
            }
            "sample_many" => {
                let tell = |_, sample| {
                    black_box(sample);
                };
                let told =
                    black_box(&*shading).sample_many(&vectors(&self.numbers), MANY as usize, tell);
                told.expect("arrays long enough");
            }
            _ => panic!("{job} is no job"),
        }
    }
}

fn vectors([x, y, z]: &[Vec<f32>; 3]) -> Vectors<'_> {
    Vectors { x, y, z, stride: 1 }
}

fn shade(shading: &mut Shading, pattern: &Pattern, point: &SurfacePoint, i: u32) {
    let shaded = shading.shade(pattern, black_box(point), direction(i));
    shaded.expect("a valid point");
    black_box(shading);
}

fn near(pattern: &Pattern, point: &SurfacePoint, i: u32) {
    black_box(pattern.is_near(black_box(point), Some(direction(i))));
}

fn builder() -> PatternBuilder {
    let material = Material::metal(Metal::Steel);
    PatternBuilder::new(material, 1.0, [SIDE_MM; 2]).expect("valid")
}

/// Scratches that run along v at these u, and one far away.
fn pattern(us: &[f64]) -> Pattern {
    let mut builder = builder();
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

/// Its control points.
const CURVE: [[f64; 2]; 4] = [[0.2, 0.3], [0.3, 0.5], [0.4, 0.45], [0.6, 0.6]];

fn curved() -> Pattern {
    let mut builder = builder();
    let tool = Tool::rockwell_c();
    let forces = [(0.0, 0.0), (0.3, 1.0), (0.7, 1.0), (1.0, 0.0)];
    let scratch = Scratch {
        path: Path::CubicBezier(&CURVE),
        keys: &forces.map(|(at, force_kgf)| Key::force(at, force_kgf)),
        ..Scratch::new(&tool)
    };
    builder.add(&scratch).expect("valid");
    builder.build()
}

/// So many scratches anywhere and in every direction, with hard ends.
fn strewn(count: u32) -> Pattern {
    let (material, side_mm) = (Material::metal(Metal::Steel), f64::from(STREWN_MM));
    let mut builder = PatternBuilder::new(material, 1.0, [side_mm; 2]).expect("valid");
    let (tool, keys) = (Tool::vickers(), [Key::force(0.0, 0.25)]);
    let mut rng = StdRng::seed_from_u64(1);
    for _ in 0..count {
        let (start, angle): ([f64; 2], f64) = (rng.random(), TAU * rng.random::<f64>());
        let length = rng.random_range(STREWN_LENGTHS_MM) / side_mm;
        let end = [
            start[0] + length * angle.cos(),
            start[1] + length * angle.sin(),
        ];
        let scratch = Scratch {
            path: Path::Polyline(&[start, end]),
            keys: &keys,
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).expect("valid");
    }
    builder.build()
}

/// A pixel well within such a plate.
fn on_strewn(i: u32) -> SurfacePoint {
    let [x, y, _] = direction(i);
    SurfacePoint {
        uv: [0.5 + 0.4 * f64::from(x), 0.5 + 0.4 * f64::from(y)],
        dp_du: [STREWN_MM, 0.0, 0.0],
        dp_dv: [0.0, STREWN_MM, 0.0],
        ..point(0.0, STREWN_RADIUS_MM)
    }
}

/// A point at parameter `t` of it.
fn on_curve(t: f64) -> SurfacePoint {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    let of = |axis: usize| CURVE.iter().zip(weights).map(|(p, w)| p[axis] * w).sum();
    SurfacePoint {
        uv: [of(0), of(1)],
        ..point(0.0, 0.05)
    }
}

/// A pixel that holds the whole hard end of a scratch.
const END: SurfacePoint = SurfacePoint {
    uv: [0.5, 1.0],
    ..point(0.5, 0.5)
};

const fn point(u: f64, radius_mm: f32) -> SurfacePoint {
    SurfacePoint {
        uv: [u, 0.5],
        dp_du: [100.0, 0.0, 0.0],
        dp_dv: [0.0, 100.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint: Footprint::Radius(radius_mm),
    }
}

/// Directions that no branch predictor learns.
fn direction(number: u32) -> [f32; 3] {
    let share = |step: f32| (number as f32 * step).fract() - 0.5;
    [share(0.754_877_7), share(0.569_840_3), 0.6]
}

/// Numbers spread over the unit cube.
fn number(i: u32) -> [f32; 3] {
    let [x, y, _] = direction(i);
    [x + 0.5, y + 0.5, (i as f32 * 0.367_879).fract()]
}

/// One evaluation of GGX with height-correlated masking and a conductor's Fresnel reflectance per channel, as any
/// renderer has it.
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

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn normalized(v: [f32; 3]) -> [f32; 3] {
    let by = 1.0 / dot(v, v).sqrt();
    v.map(|x| x * by)
}
