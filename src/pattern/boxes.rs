//! Boxes around runs, each turned with its own: which of many one may meet is told of eight at a time.

use super::center_line::CenterLine;
use super::region::Region;
use crate::lanes::{Lanes, Number, in_lanes};
use arrayvec::ArrayVec;
use glam::DVec2;

/// Boxes that lie side by side in memory.
const EIGHT: usize = 8;

/// Eights of boxes.
const MOST_EIGHTS: usize = 26;

/// Boxes that there is room for.
pub(crate) const MOST_BOXES: usize = MOST_EIGHTS * EIGHT;

/// Boxes are larger than what they hold by this share of their size and place: single precision is to lose nothing.
const SLACK: f64 = 1e-5;

/// Numbers of a box, mm.
#[derive(Clone, Copy)]
enum Of {
    X,
    Y,
    AlongX,
    AlongY,
    HalfLength,
    HalfWidth,
}

const NUMBERS: usize = 6;

/// Number by number.
type Eight = [[f32; EIGHT]; NUMBERS];

/// Of what is nowhere, which meets nothing.
const NOWHERE: [f32; NUMBERS] = [0.0, 0.0, 1.0, 0.0, -1e30, -1e30];

/// A rectangle along a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct TurnedBox {
    middle: DVec2,
    along: DVec2,
    half_size: DVec2,
}

/// Boxes of many runs.
#[derive(Debug)]
pub(super) struct Boxes(ArrayVec<Eight, MOST_EIGHTS>);

/// How far one box reaches into each of others, in eights: not below 0 if they may meet.
pub(super) type Depths = ArrayVec<[f32; EIGHT], MOST_EIGHTS>;

impl TurnedBox {
    /// Holds a region.
    pub(super) fn around(line: &CenterLine, region: &Region) -> Self {
        let across = region.extent(line.origin, line.across());
        Self::between(line, region.extent(line.origin, line.travel), across)
    }

    /// Between two places along and two across.
    pub(super) fn between(line: &CenterLine, along: [f64; 2], across: [f64; 2]) -> Self {
        let [low, high] = [0, 1].map(|end| DVec2::new(along[end], across[end]));
        let middle = 0.5 * (low + high);
        let middle = line.origin + line.travel * middle.x + line.across() * middle.y;
        let slack = SLACK * (middle.abs().max_element() + (high - low).max_element());
        Self {
            middle,
            along: line.travel,
            half_size: 0.5 * (high - low) + slack,
        }
    }

    /// In the order of [`Of`].
    fn numbers(&self) -> [f32; NUMBERS] {
        let single = |pair: DVec2| pair.as_vec2();
        let [middle, along, half] = [self.middle, self.along, self.half_size].map(single);
        [middle.x, middle.y, along.x, along.y, half.x, half.y]
    }
}

impl Boxes {
    pub(super) const fn new() -> Self {
        Self(ArrayVec::new_const())
    }

    /// Adds boxes of some things, as many as there is room for; what has none meets nothing.
    pub(super) fn add(&mut self, all: impl Iterator<Item = Option<TurnedBox>>) {
        for (i, own) in all.enumerate().take(MOST_BOXES) {
            if i % EIGHT == 0 {
                self.0.push(NOWHERE.map(|number| [number; EIGHT]));
            }
            if let (Some(own), Some(eight)) = (own, self.0.last_mut()) {
                for (all, number) in eight.iter_mut().zip(own.numbers()) {
                    all[i % EIGHT] = number;
                }
            }
        }
    }

    /// How far a box reaches into each.
    #[inline(always)]
    pub(super) fn depths(&self, own: &TurnedBox) -> Depths {
        let own = own.numbers();
        let mut depths = Depths::new();
        in_lanes!(lanes => {
            for eight in &self.0 {
                let mut of_eight = [0.0; EIGHT];
                depths_of(lanes, &own, eight, &mut of_eight);
                depths.push(of_eight);
            }
        });
        depths
    }
}

/// Two boxes are apart if they are so along a side of either (Gottschalk et al. 1996).
#[inline(always)]
fn depths_of<L: Lanes>(lanes: L, own: &[f32; NUMBERS], eight: &Eight, depths: &mut [f32; EIGHT]) {
    let [x, y, along_x, along_y, half_length, half_width] = *own;
    for first in (0..EIGHT).step_by(L::WIDTH) {
        let (to_x, to_y) = (
            load(lanes, eight, Of::X, first) - x,
            load(lanes, eight, Of::Y, first) - y,
        );
        let (their_x, their_y) = (
            load(lanes, eight, Of::AlongX, first),
            load(lanes, eight, Of::AlongY, first),
        );
        let (their_length, their_width) = (
            load(lanes, eight, Of::HalfLength, first),
            load(lanes, eight, Of::HalfWidth, first),
        );
        let cos = size(their_x * along_x + their_y * along_y);
        let sin = size(their_x * along_y - their_y * along_x);
        let along = cos * their_length + sin * their_width + half_length
            - size(to_x * along_x + to_y * along_y);
        let across = sin * their_length + cos * their_width + half_width
            - size(to_x * along_y - to_y * along_x);
        let their_along = cos * half_length + sin * half_width + their_length
            - size(to_x * their_x + to_y * their_y);
        let their_across = sin * half_length + cos * half_width + their_width
            - size(to_x * their_y - to_y * their_x);
        let depth = along.min(across).min(their_along).min(their_across);
        lanes.store(depth, &mut depths[first..]);
    }
}

/// A number of [`Lanes::WIDTH`] boxes.
#[inline(always)]
fn load<L: Lanes>(lanes: L, eight: &Eight, number: Of, first: usize) -> L::F {
    lanes.load(&eight[number as usize][first..])
}

#[inline(always)]
fn size<F: Number>(number: F) -> F {
    number.max(-number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Boxes reach into each other if a polygon clipper finds that they share any area, but for their slack; what is nowhere
    /// never does.
    #[test]
    fn boxes_meet_as_polygons_do() {
        let mut rng = StdRng::seed_from_u64(4);
        let mut met = 0;
        for _ in 0..300 {
            let all: Vec<_> = (0..20).map(|_| any(&mut rng)).collect();
            let (own, others) = (&all[0], &all[1..]);
            let boxes = others.iter().enumerate();
            let mut around = Boxes::new();
            around.add(boxes.map(|(i, other)| (i % 5 > 0).then_some(other.0)));
            let depths = around.depths(&own.0);
            for (i, (around, polygon)) in others.iter().enumerate() {
                let depth = depths[i / EIGHT][i % EIGHT];
                let mut shared = own.1;
                let shift = around.middle - own.0.middle;
                let mut edges = polygon.edges();
                let meet = edges.all(|(a, b)| shared.clip(a + shift, (b - a).perp()));
                if i % 5 == 0 {
                    assert!(depth < 0.0, "what is nowhere was met");
                } else {
                    assert!(depth >= 0.0 || !meet, "{:?} and {around:?}", own.0);
                    assert!(depth < 1e-4 || meet, "{:?} and {around:?}", own.0);
                    met += u32::from(meet);
                }
            }
        }
        assert!((500..4000).contains(&met), "{met} met");
    }

    /// A box, and the same as a polygon around its middle.
    fn any(rng: &mut StdRng) -> (TurnedBox, Region) {
        let mut place = || rng.random_range(-0.5..0.5_f64);
        let origin = DVec2::new(place(), place());
        let [a, b, c] = [place(), place(), place()];
        let line = CenterLine::even(origin, DVec2::from_angle(7.0 * place()));
        let (along, across) = ([a.min(b), a.max(b)], [-0.1 * c.abs(), 0.3 * c.abs()]);
        let polygon = Region::parallelogram(
            line.travel * (along[1] - along[0]),
            line.across() * (across[1] - across[0]),
        );
        (TurnedBox::between(&line, along, across), polygon)
    }
}
