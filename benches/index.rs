//! The pattern's two-level grid against a uniform grid of one level and a bounding-volume hierarchy: time of a small
//! query and bytes per piece, where scratches lie evenly, crowd in a corner, or cross the whole plate.

#![expect(
    clippy::cast_possible_truncation,
    reason = "numbers of cells and pieces, far below 2^32"
)]

#[path = "support/figures.rs"]
mod figures;

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use static_aabb2d_index::{Control, StaticAABB2DIndex, StaticAABB2DIndexBuilder};
use std::hint::black_box;
use std::time::Instant;
use striae::brdf::Metal;
use striae::formation::{Material, Tool};
use striae::pattern::{Key, Path, Pattern, PatternBuilder, Scratch};

/// Pieces that a query's box should touch on average.
const HITS: f64 = 5.0;

const QUERIES: usize = 20_000;

type Line = [[f64; 2]; 2];

fn main() {
    let mut figures = Vec::new();
    println!(
        "{:>10} {:>6} {:>9} {:>9} {:>8} {:>12}",
        "pattern", "index", "us/query", "relative", "hits", "bytes/piece"
    );
    for (name, lines) in [
        ("uniform", uniform(200_000)),
        ("clustered", clustered(200_000)),
        ("crossing", crossing(20_000)),
    ] {
        compare(name, &lines, &mut figures);
    }
    figures::write(&figures);
}

/// Short lines all over the unit square.
fn uniform(count: usize) -> Vec<Line> {
    let mut rng = StdRng::seed_from_u64(1);
    (0..count)
        .map(|_| short(&mut rng, [0.0; 2], 1.0, 0.01))
        .collect()
}

/// One in a hundred anywhere, all others in a hundredth of the area.
fn clustered(count: usize) -> Vec<Line> {
    let mut rng = StdRng::seed_from_u64(2);
    let line = |i: usize| match i % 100 {
        0 => short(&mut rng, [0.0; 2], 1.0, 0.01),
        _ => short(&mut rng, [0.6, 0.3], 0.1, 0.001),
    };
    (0..count).map(line).collect()
}

/// Lines from one side of the square to another.
fn crossing(count: usize) -> Vec<Line> {
    let mut rng = StdRng::seed_from_u64(3);
    let line = |i: usize| {
        let (a, b) = (rng.random::<f64>(), rng.random::<f64>());
        match i % 2 {
            0 => [[0.0, a], [1.0, b]],
            _ => [[a, 0.0], [b, 1.0]],
        }
    };
    (0..count).map(line).collect()
}

fn short(rng: &mut StdRng, low: [f64; 2], size: f64, length: f64) -> Line {
    let start = low.map(|low| low + size * rng.random::<f64>());
    let angle = std::f64::consts::TAU * rng.random::<f64>();
    [
        start,
        [
            start[0] + length * angle.cos(),
            start[1] + length * angle.sin(),
        ],
    ]
}

fn pattern(lines: &[Line]) -> Pattern {
    let material = Material::metal(Metal::Steel);
    let mut builder = PatternBuilder::new(material, 1.0, [1000.0; 2]).expect("valid");
    let (tool, keys) = (Tool::abrasive_grain(), [Key::force(0.0, 0.01)]);
    let scratch = |line| Scratch {
        path: Path::Polyline(line),
        keys: &keys,
        ..Scratch::new(&tool)
    };
    let scratches: Vec<_> = lines.iter().map(|line| scratch(line)).collect();
    builder.add_all(&scratches).expect("valid");
    builder.build()
}

/// Where a line lies, for boxes that miss it although its own box does not.
fn touches(line: &Line, low: [f64; 2], high: [f64; 2]) -> bool {
    let [[ax, ay], [bx, by]] = *line;
    let beside = |x: f64, y: f64| (bx - ax) * (y - ay) - (by - ay) * (x - ax);
    let sides = [
        beside(low[0], low[1]),
        beside(high[0], low[1]),
        beside(high[0], high[1]),
        beside(low[0], high[1]),
    ];
    let apart =
        ax.min(bx) > high[0] || ax.max(bx) < low[0] || ay.min(by) > high[1] || ay.max(by) < low[1];
    !apart && sides.iter().any(|&side| side >= 0.0) && sides.iter().any(|&side| side <= 0.0)
}

fn compare(name: &str, lines: &[Line], figures: &mut Vec<(String, f64)>) {
    let pattern = pattern(lines);
    let count = lines.len() as f64;
    let tree = hierarchy(lines);
    let flat = Flat::new(lines);
    let grid = |low, high| pattern.count_near(low, high);
    // Each as the pattern's own: what touches the box, in order, each once.
    let mut found = Vec::with_capacity(lines.len());
    let bvh = |low: [f64; 2], high: [f64; 2]| {
        found.clear();
        tree.visit_query(low[0], low[1], high[0], high[1], &mut |i: usize| {
            if touches(&lines[i], low, high) {
                found.push(i);
            }
            Control::<()>::Continue
        });
        found.sort_unstable();
        black_box(&found).len()
    };
    let mut found = Vec::with_capacity(lines.len());
    let one_level = |low, high| {
        flat.find(lines, low, high, &mut found);
        black_box(&found).len()
    };
    // Boxes centred on random scratches: where scratches are is where pixels are looked at.
    let half = half_of(lines, &grid);
    let (grid_us, hits) = timed(lines, half, grid);
    // Nodes of 16 boxes: each box and its number, and a sixteenth more above.
    let box_bytes = (4 * size_of::<f64>() + size_of::<usize>()) as f64;
    let rows = [
        ("grid", grid_us, hits, pattern.index_bytes() as f64 / count),
        ("flat", 0.0, 0.0, flat.bytes() as f64 / count),
        ("bvh", 0.0, 0.0, box_bytes * 16.0 / 15.0),
    ];
    let (flat_us, flat_hits) = timed(lines, half, one_level);
    let (bvh_us, bvh_hits) = timed(lines, half, bvh);
    let times = [(grid_us, hits), (flat_us, flat_hits), (bvh_us, bvh_hits)];
    for ((index, _, _, bytes), (us, hits)) in rows.into_iter().zip(times) {
        println!(
            "{name:>10} {index:>6} {us:>9.3} {:>9.2} {hits:>8.2} {bytes:>12.1}",
            us / grid_us
        );
        figures.push((format!("index_{name}_{index}_us"), us));
        figures.push((format!("index_{name}_{index}_bytes_per_piece"), bytes));
        if index != "grid" {
            figures.push((format!("index_{name}_{index}_per_grid"), us / grid_us));
        }
    }
}

/// Half the side of boxes that touch [`HITS`] pieces on average.
fn half_of(lines: &[Line], count: &impl Fn([f64; 2], [f64; 2]) -> usize) -> f64 {
    let (mut low, mut high) = (1e-8_f64, 0.1_f64);
    for _ in 0..30 {
        let middle = (low * high).sqrt();
        if sum(lines, middle, 2000, count) < HITS * 2000.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

fn sum(
    lines: &[Line],
    half: f64,
    queries: usize,
    mut count: impl FnMut([f64; 2], [f64; 2]) -> usize,
) -> f64 {
    let mut rng = StdRng::seed_from_u64(4);
    let mut sum = 0;
    for _ in 0..queries {
        let [a, b] = lines[rng.random_range(0..lines.len())];
        let share = rng.random::<f64>();
        let middle = [0, 1].map(|i| a[i] + share * (b[i] - a[i]));
        sum += count(middle.map(|x| x - half), middle.map(|x| x + half));
    }
    sum as f64
}

fn timed(
    lines: &[Line],
    half: f64,
    mut count: impl FnMut([f64; 2], [f64; 2]) -> usize,
) -> (f64, f64) {
    black_box(sum(lines, half, QUERIES, &mut count));
    let begun = Instant::now();
    let hits = black_box(sum(lines, half, QUERIES, count));
    let us = begun.elapsed().as_secs_f64() * 1e6 / QUERIES as f64;
    (us, hits / QUERIES as f64)
}

fn hierarchy(lines: &[Line]) -> StaticAABB2DIndex<f64> {
    let mut builder = StaticAABB2DIndexBuilder::new(lines.len());
    for [a, b] in lines {
        builder.add(
            a[0].min(b[0]),
            a[1].min(b[1]),
            a[0].max(b[0]),
            a[1].max(b[1]),
        );
    }
    builder.build().expect("as many as were announced")
}

/// A uniform grid of one level, two pieces a cell.
struct Flat {
    side: usize,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl Flat {
    fn new(lines: &[Line]) -> Self {
        let side = (lines.len() as f64 / 2.0).sqrt().ceil().max(1.0) as usize;
        let mut pairs = Vec::new();
        for (i, [a, b]) in lines.iter().enumerate() {
            let cells = |axis: usize| cells(a[axis].min(b[axis]), a[axis].max(b[axis]), side);
            for row in cells(1) {
                for column in cells(0) {
                    let at = |cell: usize| cell as f64 / side as f64;
                    // The outermost cells hold what lies beyond them.
                    let edge = |cell: usize| cell == 0 || cell + 1 == side;
                    let (low, high) = ([at(column), at(row)], [at(column + 1), at(row + 1)]);
                    if edge(column) || edge(row) || touches(&lines[i], low, high) {
                        pairs.push(((row * side + column) as u64) << 32 | i as u64);
                    }
                }
            }
        }
        pairs.sort_unstable();
        let start = |cell: usize| pairs.partition_point(|&pair| pair >> 32 < cell as u64) as u32;
        Self {
            side,
            starts: (0..=side * side).map(start).collect(),
            entries: pairs.iter().map(|&pair| pair as u32).collect(),
        }
    }

    fn find(&self, lines: &[Line], low: [f64; 2], high: [f64; 2], found: &mut Vec<u32>) {
        found.clear();
        for row in cells(low[1], high[1], self.side) {
            for column in cells(low[0], high[0], self.side) {
                let cell = row * self.side + column;
                let [from, to] = [cell, cell + 1].map(|cell| self.starts[cell] as usize);
                let listed = self.entries[from..to].iter().copied();
                found.extend(listed.filter(|&i| touches(&lines[i as usize], low, high)));
            }
        }
        found.sort_unstable();
        found.dedup();
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.entries[..])
    }
}

fn cells(low: f64, high: f64, side: usize) -> std::ops::RangeInclusive<usize> {
    let cell = |at: f64| ((at * side as f64) as usize).min(side - 1);
    cell(low)..=cell(high)
}
