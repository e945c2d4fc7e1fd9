//! How much of each piece later scratches leave of it (Bosch et al. 2004, section 3.3, leaves crossings out).
//!
//! Where a pixel holds few scratches, crossings are cut out exactly while shading; this is their mean along a
//! piece, for pixels that hold many. Pairs of strips are looked for where both are: the plate is halved again and
//! again until few strips are left in each part, and a pair counts in the part that holds its place.

use super::Pattern;
use super::grid::number;
use super::lists::{Lists, Sink};
use super::raster::{Extents, Raster};
use super::strip::{Strip, crossed, for_each_quarter};
use crate::single;
use core::sync::atomic::{AtomicU32, Ordering};
use glam::{DVec2, Vec2};
use rayon::prelude::*;

/// Strips in a cell to begin with.
const PER_CELL: f64 = 1024.0;

/// Cells that a strip lies in, on average: no more.
const MOST_CELLS_PER_STRIP: f64 = 4.0;

/// Parts with no more strips than this are not divided.
const FEW: usize = 96;

/// Strips that a part should have, where more are divided.
const PER_PART: f64 = 48.0;

/// Parts per side of what is divided in one go.
const MOST_PER_SIDE: f64 = 64.0;

/// Dividing until few are left may list the strips of a cell again so many times.
const MOST_LISTED: f64 = 16.0;

/// Later strips in a part that one is compared with. Of more, every so manyth counts for its neighbours, so that
/// heaps take no longer than they must.
const MOST_LATER: usize = 128;

/// From this many strips on, parts are looked at on all cores.
const MANY: usize = 4096;

/// Strips whose crossing takes up more than this share of their length are nearly parallel.
const SHORT: f64 = 0.25;

/// What covers a quarter is added up as the negative logarithm of what is left, in whole numbers: their sum is the
/// same in any order.
const UNIT: f64 = (1 << 20) as f64;

/// Rounding to single precision moves a place by less than this share of its coordinates, thrice.
const SINGLE: f64 = 1e-6;

/// A quarter of which no more than exp(-8) is left is hidden.
const HIDDEN: f64 = 8.0;

const HIDDEN_UNITS: u32 = 8 << 20;

/// Sums that go no further, far below what 32 bits hold.
const FULL: u32 = 1 << 30;

type Covered = [AtomicU32; 4];

/// What later scratches leave of the quarters of each piece, in 255ths: those that cover a part of one each do so
/// independently of one another.
pub(super) fn visible_shares(pattern: &Pattern) -> Vec<[u8; 4]> {
    let count = pattern.curves().pieces.len();
    let strips: Vec<Strip> = (0..count)
        .into_par_iter()
        .map(|i| strip(pattern, i))
        .collect();
    shares_left(&strips)
}

/// The same, of strips alone.
fn shares_left(strips: &[Strip]) -> Vec<[u8; 4]> {
    let count = strips.len();
    let mut covered = Vec::new();
    covered.resize_with(count, Covered::default);
    let Some(extents) = Extents::of(count, |i| strips[i].bounds()) else {
        return Vec::new();
    };
    let raster = extents.raster(PER_CELL, MOST_CELLS_PER_STRIP);
    let cells = Lists::new(raster.count(), count, |i, sink: &mut Sink<u32>| {
        let strip = &strips[i];
        if strip.half_width > 0.0 {
            let listed = |cell| sink.put(cell, number(i));
            raster.for_each_cell_within(strip.half_width, [strip.start, strip.end], listed);
        }
    });
    (0..raster.count())
        .into_par_iter()
        .for_each_init(Part::default, |part, i| {
            let bounds = raster.corners(i);
            let cell = Cell::of(cells.of(i), strips, bounds);
            let all: Vec<u32> = (0..number(cell.lines.len())).collect();
            let room = MOST_LISTED * all.len() as f64;
            cell.share_out(part, &all, bounds, room);
            cell.add_to(&covered);
        });
    covered
        .par_iter()
        .map(|quarters| quarters.each_ref().map(left))
        .collect()
}

/// A strip where pairs are looked for.
#[derive(Clone, Copy)]
struct Line {
    number: u32,
    strip: Strip,
    length: f64,
    /// Unit normal, and its product with any place on the centre line.
    normal: DVec2,
    offset: f64,
}

/// A strip, or a part of one, relative to the middle of its cell, for a first look: start, end, normal, offset and half
/// width, with what rounding may take.
type Rough = [f32; 8];

impl Line {
    fn of(number: u32, strip: &Strip) -> Self {
        let (normal, offset) = strip.line();
        Self {
            number,
            strip: *strip,
            length: strip.length(),
            normal,
            offset,
        }
    }

    /// Seen from the middle of a box.
    fn rough(&self, [low, high]: [DVec2; 2]) -> Rough {
        let (middle, normal) = (0.5 * (low + high), self.normal);
        let [start, end] = [self.strip.start - middle, self.strip.end - middle];
        let farthest = start.abs().max(end.abs()).max(high - middle).max_element();
        let half_width = self.strip.half_width + SINGLE * farthest;
        let offset = normal.dot(start);
        [
            start.x, start.y, end.x, end.y, normal.x, normal.y, offset, half_width,
        ]
        .map(single)
    }

    fn side(&self, place: DVec2) -> f64 {
        self.normal.dot(place) - self.offset
    }
}

/// Strips of a cell, all that parts of it list by their places here.
struct Cell {
    lines: Vec<Line>,
    roughs: Vec<Rough>,
    covered: Vec<Covered>,
    middle: DVec2,
}

impl Cell {
    fn of(list: &[u32], strips: &[Strip], bounds: [DVec2; 2]) -> Self {
        // All at once: many are waited for at the same time.
        let strips: Vec<Strip> = list.iter().map(|&i| strips[i as usize]).collect();
        let line = |(&i, strip)| Line::of(i, strip);
        let lines: Vec<Line> = list.iter().zip(&strips).map(line).collect();
        let mut covered = Vec::new();
        covered.resize_with(list.len(), Covered::default);
        Self {
            roughs: lines.iter().map(|line| line.rough(bounds)).collect(),
            lines,
            covered,
            middle: 0.5 * (bounds[0] + bounds[1]),
        }
    }

    /// Adds what covers its strips.
    fn add_to(&self, all: &[Covered]) {
        for (line, covered) in self.lines.iter().zip(&self.covered) {
            for (sum, own) in all[line.number as usize].iter().zip(covered) {
                let own = own.load(Ordering::Relaxed);
                if own > 0 && sum.load(Ordering::Relaxed) < FULL {
                    sum.fetch_add(own.min(HIDDEN_UNITS), Ordering::Relaxed);
                }
            }
        }
    }

    /// Looks for pairs among strips in a box, which may be listed `room` times in all.
    fn share_out(&self, part: &mut Part, list: &[u32], [low, high]: [DVec2; 2], room: f64) {
        let per_side = self.parts_per_side(list, high - low, room);
        if per_side < 2.0 {
            part.fill(self, list, [low, high]);
            part.pairs(self, [low, high]);
            return;
        }
        let raster = Raster::of_box([low, high], per_side);
        let mut listed = Vec::with_capacity(2 * list.len());
        for &i in list {
            let Strip {
                start,
                end,
                half_width,
            } = self.lines[i as usize].strip;
            raster.for_each_cell_within(half_width, [start, end], |part| listed.push((part, i)));
        }
        let lists = Lists::few(raster.count(), &listed);
        let look = |part: &mut Part, number: usize| {
            let list = lists.of(number);
            if list.len() > 1 {
                let room = room * list.len() as f64 / listed.len() as f64;
                self.share_out(part, list, raster.corners_within(number, [low, high]), room);
            }
        };
        if list.len() > MANY {
            let parts = (0..raster.count()).into_par_iter();
            parts.for_each_init(Part::default, look);
        } else {
            (0..raster.count()).for_each(|number| look(part, number));
        }
    }

    /// How finely a box with these strips is to be divided.
    fn parts_per_side(&self, list: &[u32], size: DVec2, room: f64) -> f64 {
        let count = list.len() as f64;
        if list.len() <= FEW {
            return 1.0;
        }
        // In units of the box: each border that a strip crosses lists it once more.
        let extent = |&i: &u32| {
            let Strip {
                start,
                end,
                half_width,
            } = self.lines[i as usize].strip;
            let extent = (end - start).abs() + 2.0 * half_width;
            (extent / size).min(DVec2::ONE).element_sum()
        };
        let extents: f64 = list.iter().map(extent).sum();
        // A part of k² has count / k² + extents / k of them.
        let wanted = extents + (extents * extents + 4.0 * PER_PART * count).sqrt();
        let most = (room - count) / extents;
        (wanted / (2.0 * PER_PART))
            .min(most)
            .min(MOST_PER_SIDE)
            .floor()
    }
}

/// Strips of a part, number by number: so are all pairs of one compared at once.
#[derive(Default)]
struct Part {
    list: Vec<u32>,
    lines: Vec<Line>,
    rough: [Vec<f32>; 8],
    gaps: Vec<f32>,
    near: Vec<u32>,
}

impl Part {
    fn fill(&mut self, cell: &Cell, list: &[u32], within: [DVec2; 2]) {
        let within = within.map(|corner| (corner - cell.middle).as_vec2());
        self.list.clear();
        self.list.extend(list);
        self.lines.clear();
        let lines = list.iter().map(|&i| cell.lines[i as usize]);
        self.lines.extend(lines);
        self.rough.iter_mut().for_each(Vec::clear);
        for &i in list {
            let numbers = cut_off(cell.roughs[i as usize], within);
            for (all, number) in self.rough.iter_mut().zip(numbers) {
                all.push(number);
            }
        }
        self.gaps.resize(list.len(), 0.0);
        self.near.resize(list.len(), 0);
    }

    /// Adds what covers each strip, of the pairs whose place lies in the box.
    fn pairs(&mut self, cell: &Cell, within: [DVec2; 2]) {
        let count = self.list.len();
        for i in 0..count.saturating_sub(1) {
            let line = &self.lines[i];
            let covered = &cell.covered[self.list[i] as usize];
            // Whatever else covers it: nothing is left.
            if covered
                .iter()
                .all(|sum| sum.load(Ordering::Relaxed) >= HIDDEN_UNITS)
            {
                continue;
            }
            let later = count - 1 - i;
            let stride = later.div_ceil(MOST_LATER);
            let mut sums = [0.0; 4];
            let mut add = |j: usize, weight: f64| {
                let other = &self.lines[j];
                if other.number != line.number + 1 {
                    add_lost(&mut sums, weight, line, other, within);
                }
            };
            if stride == 1 {
                let near = look_for(i, &self.rough, &mut self.gaps, &mut self.near);
                near.iter().for_each(|&j| add(i + 1 + j as usize, 1.0));
            } else {
                for j in (i + 1..count).step_by(stride) {
                    let [own, theirs] = [i, j].map(|i| self.rough.each_ref().map(|all| all[i]));
                    if gap(own, theirs) <= 0.0 {
                        add(j, stride.min(count - j) as f64);
                    }
                }
            }
            add_units(covered, sums);
        }
    }
}

/// Which strips after number `i` may touch it, counted from there.
fn look_for<'n>(
    i: usize,
    rough: &[Vec<f32>; 8],
    gaps: &mut [f32],
    near: &'n mut [u32],
) -> &'n [u32] {
    let own = rough.each_ref().map(|numbers| numbers[i]);
    let gaps = &mut gaps[i + 1..];
    let later = rough.each_ref().map(|all| &all[i + 1..][..gaps.len()]);
    for (j, between) in gaps.iter_mut().enumerate() {
        *between = gap(own, later.map(|numbers| numbers[j]));
    }
    // Written at once and kept or not: no branch to guess.
    let mut count = 0;
    for (j, gap) in (0..).zip(&*gaps) {
        near[count] = j;
        count += usize::from(*gap <= 0.0);
    }
    &near[..count]
}

/// How far either of two strips keeps to one side of the other.
fn gap(a: Rough, b: Rough) -> f32 {
    // Of a strip's ends from the other's centre line.
    let sides = |a: Rough, b: Rough| {
        let [start_x, start_y, end_x, end_y, ..] = a;
        let [.., x, y, offset, _] = b;
        beside(
            x * start_x + y * start_y - offset,
            x * end_x + y * end_y - offset,
        )
    };
    greater(sides(a, b), sides(b, a)) - (a[7] + b[7])
}

/// A strip without what lies further than its half width outside a box: only pairs that may meet there stay near.
fn cut_off(strip: Rough, [low, high]: [Vec2; 2]) -> Rough {
    let [x, y, end_x, end_y, .., half_width] = strip;
    let (start, reach) = (Vec2::new(x, y), Vec2::splat(half_width));
    let step = Vec2::new(end_x, end_y) - start;
    let per_step = step.recip();
    let [a, b] = [low - reach, high + reach].map(|border| (border - start) * per_step);
    // Of a strip along a border, no number at all: it is kept whole.
    let from = a.x.min(b.x).max(a.y.min(b.y)).max(0.0);
    let to = a.x.max(b.x).min(a.y.max(b.y)).min(1.0).max(from);
    let (first, last) = (start + from * step, start + to * step);
    let [.., normal_x, normal_y, offset, _] = strip;
    [
        first.x, first.y, last.x, last.y, normal_x, normal_y, offset, half_width,
    ]
}

/// Adds what a later strip covers of the quarters of another, if they meet in the box, `weight` times.
#[inline(always)]
fn add_lost(sums: &mut [f64; 4], weight: f64, a: &Line, b: &Line, [low, high]: [DVec2; 2]) {
    let sin = a.normal.perp_dot(b.normal).abs();
    let widths = 2.0 * (a.strip.half_width + b.strip.half_width);
    if SHORT * sin * a.length.min(b.length) < widths {
        return add_lost_along(sums, weight, a, b, [low, high]);
    }
    let [from, to] = [a.strip.start, a.strip.end].map(|end| b.side(end));
    let theirs = [b.strip.start, b.strip.end].map(|end| a.side(end));
    // Where one piece ends and the next begins, one of them crosses.
    if ((from >= 0.0) == (to >= 0.0)) | ((theirs[0] >= 0.0) == (theirs[1] >= 0.0)) {
        return;
    }
    let place = from / (from - to);
    if is_within(a.strip.start.lerp(a.strip.end, place), [low, high]) {
        let covered = crossed(place, b.strip.half_width / (sin * a.length));
        for_each_quarter(covered, |quarter, share| {
            sums[quarter] += weight * lost(share);
        });
    }
}

/// The same, of strips that run side by side.
#[inline(never)]
fn add_lost_along(sums: &mut [f64; 4], weight: f64, a: &Line, b: &Line, within: [DVec2; 2]) {
    let cover = a.strip.covered_by(&b.strip);
    if let Some(cover) = cover.filter(|cover| is_within(cover.place, within)) {
        for (sum, share) in sums.iter_mut().zip(cover.quarters) {
            *sum += weight * lost(share);
        }
    }
}

/// Whether a place lies in a box: on a border that two share, in one.
fn is_within(place: DVec2, [low, high]: [DVec2; 2]) -> bool {
    place.cmpge(low).all() && place.cmplt(high).all()
}

/// The negative logarithm of what is left once this share is covered.
fn lost(share: f64) -> f64 {
    if share > 0.3 {
        return -(1.0 - share.min(1.0)).ln();
    }
    // The series is as good and takes less: of the inverse hyperbolic tangent.
    let z = share / (2.0 - share);
    let square = z * z;
    2.0 * z * (1.0 + square * (1.0 / 3.0 + square * (1.0 / 5.0 + square / 7.0)))
}

/// How far two places keep to one side of a line: not above 0 if they lie on both.
fn beside(a: f32, b: f32) -> f32 {
    greater(-greater(a, b), -greater(-a, -b))
}

/// As [`f32::max`], but of numbers alone: one instruction.
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Adds to what covers a strip's quarters.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from 0 to HIDDEN"
)]
fn add_units(covered: &Covered, sums: [f64; 4]) {
    for (covered, sum) in covered.iter().zip(sums) {
        if sum > 0.0 && covered.load(Ordering::Relaxed) < FULL {
            let units = (sum.min(HIDDEN) * UNIT + 0.5) as u32;
            covered.fetch_add(units, Ordering::Relaxed);
        }
    }
}

/// What is left of a quarter, in 255ths.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn left(covered: &AtomicU32) -> u8 {
    match covered.load(Ordering::Relaxed) {
        0 => 255,
        covered => (255.0 * (-f64::from(covered) / UNIT).exp() + 0.5) as u8,
    }
}

fn strip(pattern: &Pattern, number: usize) -> Strip {
    let curves = pattern.curves();
    let [start, _, _, end] = curves.control(number);
    let scale = pattern.units_per_uv * pattern.mm_per_scene_unit;
    let [from, to] = curves.at(number);
    let strand = pattern.strand(curves.pieces[number].scratch);
    let width = strand.map_or(0.0, |(track, course)| course.mean_width(&track, [from, to]));
    Strip {
        start: start * scale,
        end: end * scale,
        // Where it sets in, it covers less.
        half_width: 0.5 * width,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    fn strip(start: [f64; 2], end: [f64; 2], half_width: f64) -> Strip {
        Strip {
            start: start.into(),
            end: end.into(),
            half_width,
        }
    }

    /// What is left of each quarter by the rule, pair by pair with polygons.
    fn truth(strips: &[Strip]) -> Vec<[f64; 4]> {
        let left = |i: usize| {
            let mut left = [1.0; 4];
            for later in strips.iter().skip(i + 2) {
                if let Some(cover) = strips[i].covered_by(later) {
                    (0..4).for_each(|k| left[k] *= 1.0 - cover.quarters[k]);
                }
            }
            left
        };
        (0..strips.len()).map(left).collect()
    }

    fn assert_near(strips: &[Strip], most: f64, mean: f64) {
        let (ours, truth) = (shares_left(strips), truth(strips));
        let quarters = ours.iter().flatten().zip(truth.iter().flatten());
        let off: Vec<f64> = quarters.map(|(a, b)| f64::from(*a) / 255.0 - b).collect();
        let worst = off.iter().fold(0.0_f64, |worst, off| worst.max(off.abs()));
        let sum: f64 = off.iter().sum();
        assert!(worst < most, "off by {worst}");
        assert!(sum.abs() < mean * off.len() as f64, "off by {sum} in all");
    }

    /// Lines that cross where halves, quarters and eighths of the plate meet: each crossing counts once.
    #[test]
    fn crossings_on_borders_count_once() {
        let at = |i: u32| f64::from(i) / 64.0;
        for half_width in [1e-5, 1e-3] {
            let rows = (1..64).map(|i| strip([0.0, at(i)], [1.0, at(i)], half_width));
            let columns = (1..64).map(|i| strip([at(i), 0.0], [at(i), 1.0], half_width));
            let all: Vec<Strip> = rows.chain(columns).collect();
            assert_near(&all, 0.5001 / 255.0, 0.5 / 255.0);
        }
    }

    /// Strips anywhere, thick and thin, long and short, bundled and not: as polygons say, on average within a
    /// thousandth, each quarter within half a crossing, which at an end counts wholly or not at all.
    #[test]
    fn strips_anywhere() {
        let mut rng = StdRng::seed_from_u64(8);
        for (spread, width) in [(6.3, 0.002), (6.3, 0.02), (0.1, 0.01), (0.0, 0.01)] {
            let mut any = || {
                let start = DVec2::new(rng.random(), rng.random());
                let size: f64 = rng.random_range(0.1..0.5);
                let angle = spread * rng.random::<f64>();
                let end = start + size * DVec2::from_angle(angle);
                strip(start.into(), end.into(), width * rng.random::<f64>())
            };
            let all: Vec<Strip> = (0..1500).map(|_| any()).collect();
            assert_near(&all, 2.0 * SHORT, 1e-3);
        }
    }

    /// Of a heap far too large to be looked at pair by pair nothing is left but the last ones; of many crossings
    /// those that are looked at stand for all.
    #[test]
    fn heaps() {
        let same = vec![strip([0.0; 2], [1.0, 0.2], 0.01); 5000];
        let left = shares_left(&same);
        assert_eq!(left[0], [0; 4]);
        assert_eq!(left[4998], [255; 4], "only its own next piece lies on it");
        let mut rng = StdRng::seed_from_u64(9);
        let mut all = vec![strip([0.0, 0.5], [1.0, 0.5], 1e-3); 1];
        for _ in 0..20_000 {
            let x = rng.random::<f64>();
            all.push(strip([x, 0.0], [x, 1.0], 2e-5));
        }
        // 20 000 of a width of 4e-5 leave exp(-0.8).
        for quarter in shares_left(&all)[0] {
            let left = f64::from(quarter) / 255.0;
            assert!((left - 0.4493).abs() < 0.02, "{left} is left");
        }
    }
}
