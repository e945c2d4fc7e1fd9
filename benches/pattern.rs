//! What a million scratches cost: time to build, bytes to hold, time to query.

#[path = "support/figures.rs"]
mod figures;

use rayon::prelude::*;
use std::hint::black_box;
use std::time::Instant;
use striae::brdf::Metal;
use striae::formation::{Material, Tool};
use striae::pattern::{
    Amount, Footprint, Generator, Pattern, PatternBuilder, Scratch, Stroke, Style, SurfacePoint,
};
use striae::scattering::Shading;

/// The plate's side, mm.
const SIDE_MM: f64 = 1000.0;

/// Runs of scratch that a footprint should hold on average.
const HITS: f64 = 4.0;

/// Points at which queries are timed.
const POINTS: u32 = 20_000;

const MILLION: u32 = 1_000_000;

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!("{cores} cores, {} threads", rayon::current_num_threads());
    let mut figures = Vec::new();
    let mut note = |name: &str, figure: f64| figures.push((name.to_owned(), figure));
    note("cores", cores as f64);

    let (untapered, timed) = built(MILLION, 0.0);
    note("build_1m_untapered_s", timed.wall_s);
    note("build_1m_untapered_cpu_s", timed.cpu_s);
    note("bytes_per_scratch_1m_untapered", bytes(&untapered));
    drop(untapered);

    let (million, timed) = built(MILLION, 0.2);
    note("build_1m_s", timed.wall_s);
    note("build_1m_cpu_s", timed.cpu_s);
    note("bytes_per_scratch_1m", bytes(&million));
    let points = million.memory_bytes().control_points as f64 / f64::from(MILLION);
    note("control_point_bytes_per_scratch_1m", points);

    let few = built(500, 0.2).0;
    let [of_million, of_few] = [&million, &few].map(query);
    note("query_1m_us", of_million.us);
    note("query_500_us", of_few.us);
    note("query_1m_hits", of_million.hits);
    note("query_500_hits", of_few.hits);
    note("query_1m_per_query_500", of_million.us / of_few.us);

    #[cfg(feature = "files")]
    cache(&million, &mut note);
    figures::write(&figures);
}

/// Wall-clock time and processor time of all threads, seconds.
struct Timed {
    wall_s: f64,
    cpu_s: f64,
}

/// A pattern of so many scratches of four curves each, and what it took from control points in memory.
fn built(count: u32, taper: f64) -> (Pattern, Timed) {
    let generator = Generator {
        amount: Amount::Count(count),
        turn_spread_deg: 20.0,
        wander_deg: 3.0,
        curves: 4,
        taper: [taper; 2],
        ..Generator::style(Style::Straight)
    };
    let tool = Tool::abrasive_grain();
    let material = Material::metal(Metal::Steel);
    let mut builder = PatternBuilder::new(material, 1.0, [SIDE_MM; 2]).expect("valid");
    let strokes = generator.strokes(builder.mm_per_uv(), 1).expect("valid");
    let drawn = |number: u32| {
        let mut stroke = Stroke::default();
        strokes.stroke(number, &mut stroke);
        stroke
    };
    let drawn: Vec<Stroke> = (0..count).into_par_iter().map(drawn).collect();
    let scratches: Vec<Scratch<'_>> = drawn.iter().map(|stroke| stroke.scratch(&tool)).collect();

    let (begun, cpu) = (Instant::now(), cpu_s());
    builder.add_all(&scratches).expect("valid scratches");
    let added_s = begun.elapsed().as_secs_f64();
    let pattern = builder.build();
    let wall_s = begun.elapsed().as_secs_f64();
    println!(
        "{count} scratches, tapers {taper}: added in {added_s:.3} s, built in {:.3} s",
        wall_s - added_s
    );
    let cpu_s = cpu_s() - cpu;
    (pattern, Timed { wall_s, cpu_s })
}

/// What a pattern holds beyond its control points, per scratch.
fn bytes(pattern: &Pattern) -> f64 {
    pattern.memory_bytes().rest as f64 / pattern.scratch_count() as f64
}

struct Queried {
    us: f64,
    hits: f64,
}

/// Time of a query at random points whose footprints hold [`HITS`] on average.
fn query(pattern: &Pattern) -> Queried {
    let (mut low, mut high) = (1e-6_f64, 0.25 * SIDE_MM);
    for _ in 0..30 {
        let middle = (low * high).sqrt();
        if hits(pattern, middle, 2000) < HITS {
            low = middle;
        } else {
            high = middle;
        }
    }
    let begun = Instant::now();
    let hits = black_box(hits(pattern, low, POINTS));
    let us = begun.elapsed().as_secs_f64() * 1e6 / f64::from(POINTS);
    println!(
        "{} scratches: radius {low:.4} mm, {hits:.2} hits, {us:.2} us",
        pattern.scratch_count()
    );
    Queried { us, hits }
}

/// Mean number of runs that footprints of this radius hold, at the same random points each time.
fn hits(pattern: &Pattern, radius_mm: f64, points: u32) -> f64 {
    let mut shading = Shading::default();
    let mut sum = 0_u64;
    for number in 0..points {
        let point = SurfacePoint {
            uv: place(number).map(|share| 0.25 + 0.5 * share),
            dp_du: [single(SIDE_MM), 0.0, 0.0],
            dp_dv: [0.0, single(SIDE_MM), 0.0],
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Radius(single(radius_mm)),
        };
        shading
            .shade(pattern, &point, [0.2, 0.1, 0.9])
            .expect("a valid point");
        sum += u64::from(shading.scratch_count());
    }
    sum as f64 / f64::from(points)
}

/// Points spread evenly over the unit square, in no order that a cache could guess (Roberts 2018).
fn place(number: u32) -> [f64; 2] {
    let scattered = f64::from(number.wrapping_mul(2_654_435_761) >> 8);
    [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| (scattered * step).fract())
}

/// Processor time of this process so far, user and system; 0 where the system does not tell.
fn cpu_s() -> f64 {
    const TICKS_PER_S: f64 = 100.0;
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after_name = text.rsplit(')').next().unwrap_or("");
    let ticks = after_name.split_whitespace().skip(11).take(2);
    ticks
        .filter_map(|field| field.parse::<f64>().ok())
        .sum::<f64>()
        / TICKS_PER_S
}

/// How long a saved pattern takes to open.
#[cfg(feature = "files")]
fn cache(million: &Pattern, note: &mut impl FnMut(&str, f64)) {
    let path = std::env::temp_dir().join(format!("striae-bench-{}.cache", std::process::id()));
    let begun = Instant::now();
    million.save_cache(&path).expect("room for the file");
    note("cache_save_ms", begun.elapsed().as_secs_f64() * 1e3);
    let begun = Instant::now();
    let opened = Pattern::open_cache(&path).expect("opens");
    note("cache_open_ms", begun.elapsed().as_secs_f64() * 1e3);
    let begun = Instant::now();
    Pattern::verify_cache(&path).expect("whole");
    note("cache_verify_ms", begun.elapsed().as_secs_f64() * 1e3);
    note("query_1m_opened_us", query(&opened).us);
    std::fs::remove_file(&path).expect("was written");
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to single is what it is for"
)]
fn single(value: f64) -> f32 {
    value as f32
}
