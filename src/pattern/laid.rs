//! What of a scratch later ones cover within a footprint that holds many, line by line along it: exactly where one does, and as
//! if independently of one another where several meet in the same part of a line.

mod lines;
mod way;

use super::strips::Strips;
use crate::lanes::in_lanes;
use crate::single;
use arrayvec::ArrayVec;
use lines::Lines;
pub(super) use way::Way;

/// Strips that lie side by side in memory.
const EIGHT: usize = 8;

/// Eights of strips that are remembered: what lies under more of them is covered as it is on average.
const MOST_EIGHTS: usize = 48;

/// Numbers of a strip.
#[derive(Clone, Copy)]
enum Of {
    NormalX,
    NormalY,
    /// The normal's product with any place on the centre line.
    Offset,
    HalfWidth,
    AlongX,
    AlongY,
    /// The direction's product with its start.
    Start,
    Length,
}

const NUMBERS: usize = 8;

/// Number by number.
type Eight = [[f32; EIGHT]; NUMBERS];

/// Strips that were laid, the latest first; mm.
#[derive(Debug)]
pub(super) struct Laid {
    eights: ArrayVec<Eight, MOST_EIGHTS>,
    count: usize,
}

impl Laid {
    pub(super) fn new() -> Self {
        Self {
            eights: ArrayVec::new(),
            count: 0,
        }
    }

    /// What all strips leave of each line of a way, as a share of all of the chord.
    pub(super) fn left_of(&self, way: &Way) -> Strips {
        let lines = Lines::of(way);
        let left = in_lanes!(lanes => lines.left(lanes, &self.eights));
        let whole = way.whole();
        core::array::from_fn(|i| left[i] * whole[i])
    }

    /// Lays a chord under the others; false if there is no room.
    pub(super) fn lay(&mut self, way: &Way) -> bool {
        let place = self.count % EIGHT;
        if place == 0 && self.eights.try_push([[0.0; EIGHT]; NUMBERS]).is_err() {
            return false;
        }
        let (start, along) = (way.start, way.along);
        let normal = along.perp();
        let Some(eight) = self.eights.last_mut() else {
            return false;
        };
        for (number, value) in [
            (Of::NormalX, normal.x),
            (Of::NormalY, normal.y),
            (Of::Offset, normal.dot(start)),
            (Of::HalfWidth, way.half_width_mm),
            (Of::AlongX, along.x),
            (Of::AlongY, along.y),
            (Of::Start, along.dot(start)),
            (Of::Length, along.dot(way.end - start)),
        ] {
            eight[number as usize][place] = single(value);
        }
        self.count += 1;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::region::Region;
    use crate::pattern::strip::Strip;
    use crate::pattern::strips::STRIPS;
    use glam::DVec2;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Strips laid one under the other leave of each, on average over many, what polygons leave of it, each by itself;
    /// the first is whole, and parallel ones that do not touch leave each other whole.
    #[test]
    fn as_polygons_say() {
        let mut rng = StdRng::seed_from_u64(3);
        let (mut ours, mut truth) = (0.0, 0.0);
        let footprint = Region::parallelogram(10.0 * DVec2::X, 10.0 * DVec2::Y);
        for spread in [6.3, 0.02, 0.0].repeat(8) {
            let mut laid = Laid::new();
            let mut strips: Vec<Strip> = Vec::new();
            for i in 0..150 {
                let start = DVec2::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
                let end = start
                    + DVec2::from_angle(spread * rng.random::<f64>()) * rng.random_range(0.5..2.0);
                let half_width = 0.01 * rng.random::<f64>();
                let strip = Strip {
                    start,
                    end,
                    half_width,
                };
                let way = Way::within(&footprint, [start, end], 2.0 * half_width).unwrap();
                let left = laid.left_of(&way).iter().sum::<f32>() / STRIPS as f32;
                let left = f64::from(left);
                assert!(laid.lay(&way), "no room for strip {i}");
                let of_quarters = |later: &Strip| {
                    let cover = strip.covered_by(later)?;
                    Some(1.0 - cover.quarters.iter().sum::<f64>() / 4.0)
                };
                let exact: f64 = strips.iter().filter_map(of_quarters).product();
                assert!(i > 0 || left == 1.0, "the first one is left {left}");
                ours += left * half_width;
                truth += exact * half_width;
                strips.push(strip);
            }
        }
        assert!((ours / truth - 1.0).abs() < 3e-3, "{ours} and {truth}");
    }

    #[test]
    fn neighbours_leave_each_other_whole() {
        let mut laid = Laid::new();
        let footprint = Region::parallelogram(200.0 * DVec2::X, 200.0 * DVec2::Y);
        for i in 0..MOST_EIGHTS * EIGHT {
            let y = 0.1 * i as f64;
            let ends = [DVec2::new(-1e3, y), DVec2::new(1e3, y)];
            let way = Way::within(&footprint, ends, 0.0999).unwrap();
            assert_eq!(laid.left_of(&way), way.whole(), "strip {i}");
            assert!(laid.lay(&way), "no room for strip {i}");
        }
        let way = Way::within(&footprint, [DVec2::ZERO, DVec2::X], 0.1).unwrap();
        assert!(!laid.lay(&way), "there is no end of room");
    }
}
