//! Densities of more pieces than a shading point has room for: neighbours become one, those first of which it changes least.

use super::steps::Steps;
use super::{Densities, MOST_DENSITIES, Piece, Weight};
use crate::scattering::relief::{MOST_RELIEFS, Relief};
use crate::single;
use arrayvec::ArrayVec;

/// The densities of a shading point's runs, and by how much these are thinned, until there is room for all.
#[derive(Debug)]
pub(crate) struct Surplus(ArrayVec<(Steps, f32), MOST_RELIEFS>);

impl Surplus {
    pub(crate) const fn new() -> Self {
        Self(ArrayVec::new_const())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Keeps the density of one more run that the shading point holds.
    pub(crate) fn keep(&mut self, mut steps: Steps, relief: &Relief) {
        steps.look_through(relief.seen_flat);
        let kept = self.0.try_push((steps, relief.gain));
        debug_assert!(kept.is_ok(), "more runs than a shading point holds");
    }

    /// All, in the order in which they were kept.
    pub(crate) fn steps(&self) -> impl Iterator<Item = &Steps> {
        self.0.iter().map(|(steps, _)| steps)
    }

    /// Merges steps of any runs until there is room for all: those first that change the pixel least.
    pub(crate) fn merge(&mut self) {
        let cheapest = |(steps, gain): &(Steps, f32)| {
            let (place, change) = steps.cheapest()?;
            Some((place, gain * change))
        };
        let mut of_runs: ArrayVec<_, MOST_RELIEFS> = self.0.iter().map(cheapest).collect();
        let count: usize = self.steps().map(Steps::count).sum();
        for _ in MOST_DENSITIES..count {
            let runs = of_runs.iter_mut().zip(&mut self.0);
            let may_merge = runs.filter_map(|(own, run)| Some(((*own)?, own, run)));
            let least = may_merge.min_by(|((_, a), ..), ((_, b), ..)| a.total_cmp(b));
            let Some(((place, _), own, run)) = least else {
                return;
            };
            run.0.merge_at(place);
            *own = cheapest(run);
        }
    }
}

impl<const MOST: usize> Densities<MOST> {
    /// A density that it holds, in steps, of a run that is seen between two places across.
    #[inline(never)]
    pub(crate) fn steps(&self, weight: &Weight, seen_mm: [f32; 2]) -> Steps {
        Steps::of_pieces(self.pieces(weight), seen_mm)
    }

    /// Adds a density for which there is room.
    pub(crate) fn put(&mut self, steps: &Steps) -> Weight {
        let first = self.used;
        let free = self.pieces.iter_mut().skip(first as usize);
        for (piece, step) in free.zip(steps.all()) {
            *piece = Piece {
                from: step.from,
                to: step.to,
                weight: single(step.weight),
                skew: single((step.lean / step.weight).clamp(-1.0, 1.0)),
            };
            self.used += 1;
        }
        self.weight_from(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{CenterLine, Region};
    use crate::scattering::footprint::steps::{MOST_OF_RUN, MOST_STEPS};
    use glam::DVec2;

    type Raw = Densities<MOST_OF_RUN>;

    /// Slices of a pixel of this size, which lie over one another across a run at such an angle, so far from it.
    fn pieces(size: f64, angle: f64, far: f64) -> (Raw, Weight) {
        let pixel =
            Region::parallelogram(size * DVec2::new(1.0, 0.3), size * DVec2::new(-0.2, 0.9));
        let slice = |i: i32| {
            let start = size * 0.13 * f64::from(i) * DVec2::X;
            let inward = DVec2::from_angle(0.1 * f64::from(i));
            let end = start + 0.09 * size * DVec2::X;
            pixel.clipped(start, inward)?.clipped(end, -inward)
        };
        let slices: Vec<Region> = (-2..2).filter_map(slice).collect();
        let across = DVec2::from_angle(angle);
        let line = CenterLine::even(far * across, across.perp());
        let mut raw = Raw::EMPTY;
        let weight = raw.add_regions(&slices, &line, pixel.area());
        (raw, weight.unwrap())
    }

    /// Of many angles and places, and of pixels of which single precision can tell few places or one.
    fn all_pieces() -> impl Iterator<Item = (Raw, Weight)> {
        let sizes = [(1.0, 0.1), (1.0, -37.0), (1e-6, -37.0), (1e-9, 37.0)];
        let angles = (0..12).map(|i| 0.55 * f64::from(i));
        angles.flat_map(move |angle| sizes.map(|(size, far)| pieces(size, angle, far)))
    }

    /// One that counts for so much and is seen between two places.
    fn relief(gain: f32, seen_flat: [f32; 2]) -> Relief {
        let mut relief = Relief::NONE;
        (relief.gain, relief.seen_flat) = (gain, seen_flat);
        relief
    }

    /// Weight, and centre of mass times weight.
    fn moments(steps: &Steps) -> [f64; 2] {
        let all = steps.all().iter().map(|step| {
            let [from, to] = [step.from, step.to].map(f64::from);
            let centre = 0.5 * (from + to) * step.weight + (to - from) / 6.0 * step.lean;
            [step.weight, centre]
        });
        all.fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]])
    }

    /// Up to any place steps weigh as much as the pieces of which they are made, also where these lie over one another or
    /// are too thin to have a width.
    #[test]
    fn steps_weigh_what_pieces_do() {
        for (raw, weight) in all_pieces() {
            let steps = raw.steps(&weight, weight.window);
            assert!(steps.count() <= MOST_STEPS, "{} steps", steps.count());
            let [from, to] = weight.window;
            let mut densities = <Densities>::EMPTY;
            let own = densities.put(&steps);
            assert_eq!(own.window, weight.window, "where it is");
            for i in 0..=400 {
                let to = from + (to - from) * i as f32 / 400.0;
                let [wanted, ours] = [
                    raw.between(&weight, -1e3, to),
                    densities.between(&own, -1e3, to),
                ];
                assert!((wanted - ours).abs() < 2e-6, "{ours}, not {wanted}");
            }
            let all = [raw.pieces(&weight), densities.pieces(&own)];
            let [wanted, ours] = all.map(|all| all.iter().map(|piece| piece.weight).sum::<f32>());
            assert!((wanted - ours).abs() < 2e-6, "{ours} in all, not {wanted}");
        }
    }

    /// Down to the last step none of the weight goes; nor does its centre move, but for steps that would be below 0 somewhere.
    #[test]
    fn merging_keeps_weight_and_centre() {
        let (mut merged, mut kept) = (0, 0);
        for (raw, weight) in all_pieces() {
            let mut steps = raw.steps(&weight, weight.window);
            steps.look_through(weight.window);
            let [from, to] = weight.window.map(f64::from);
            let all = moments(&steps)[0];
            while let Some((place, change)) = steps.cheapest() {
                assert!(change >= 0.0, "changes by {change}");
                let (before, count) = (moments(&steps)[1], steps.count());
                steps.merge_at(place);
                assert_eq!(steps.count(), count - 1, "one less");
                let [ours, moment] = moments(&steps);
                assert!((ours - all).abs() < 1e-12 * all, "{ours}, not {all}");
                let step = &steps.all()[place];
                assert!(step.lean.abs() <= step.weight, "below 0: {step:?}");
                merged += 1;
                if step.lean.abs() < step.weight {
                    kept += 1;
                    let off = (moment - before) / all;
                    let most = 1e-9 * (to - from) + 1e-12;
                    assert!(off.abs() <= most, "{off} of {from} to {to}");
                }
            }
            assert_eq!(steps.count(), 1);
        }
        println!("centres of {kept} of {merged} stay");
        assert!(merged > 300 && 2 * kept > merged, "{kept} of {merged}");
    }

    /// As many runs as a shading point holds, each of as many steps as are kept, find room; none loses weight, and where runs are
    /// seen little changes.
    #[test]
    fn any_surplus_finds_room() {
        let runs = (0..MOST_RELIEFS).map(|i| pieces(1.0, 0.37 * i as f64, 0.05));
        let runs: Vec<(Raw, Weight)> = runs.collect();
        let mut surplus = Surplus::new();
        let seen = [-0.2, 0.1];
        for (raw, weight) in &runs {
            let relief = relief(1.0, seen);
            surplus.keep(raw.steps(weight, seen), &relief);
        }
        let before: usize = surplus.steps().map(Steps::count).sum();
        assert!(before > 2 * MOST_DENSITIES, "{before} steps are few");
        surplus.merge();
        let after: usize = surplus.steps().map(Steps::count).sum();
        assert_eq!(after, MOST_DENSITIES, "not all room is used");
        let mut densities = <Densities>::EMPTY;
        let mut worst = 0.0_f32;
        for ((raw, weight), steps) in runs.iter().zip(surplus.steps()) {
            let own = densities.put(steps);
            assert!(own.count > 0, "a run is lost");
            let [wanted, ours] = [
                raw.between(weight, -9.0, 9.0),
                densities.between(&own, -9.0, 9.0),
            ];
            assert!((wanted - ours).abs() < 2e-6, "{ours} in all, not {wanted}");
            for i in 0..=100 {
                let place = seen[0] + (seen[1] - seen[0]) * i as f32 / 100.0;
                let parts = [
                    raw.between(weight, -9.0, place),
                    densities.between(&own, -9.0, place),
                ];
                worst = worst.max((parts[0] - parts[1]).abs());
            }
        }
        println!("{before} steps in {after}: {worst:.1e} elsewhere");
        assert!(worst < 0.01, "{worst} of the pixel is elsewhere");
    }

    /// Of runs that count for nothing steps are merged first, and of others those where nobody looks.
    #[test]
    fn what_is_not_seen_is_merged_first() {
        let (raw, weight) = pieces(1.0, 0.4, 0.0);
        let mut surplus = Surplus::new();
        for i in 0..12 {
            let relief = relief(if i == 0 { 0.0 } else { 1.0 }, [0.0, 0.1]);
            surplus.keep(raw.steps(&weight, weight.window), &relief);
        }
        surplus.merge();
        let counts: Vec<usize> = surplus.steps().map(Steps::count).collect();
        assert!(counts[0] == 1 && counts[1] > 1, "{counts:?}");
        let mut densities = <Densities>::EMPTY;
        for steps in surplus.steps().skip(1) {
            let own = densities.put(steps);
            let worst = |[from, to]: [f32; 2]| {
                let places = (0..=50).map(|i| from + (to - from) * i as f32 / 50.0);
                let offs = places.map(|to| {
                    let wanted = raw.between(&weight, -9.0, to);
                    (wanted - densities.between(&own, -9.0, to)).abs()
                });
                offs.fold(0.0, f32::max)
            };
            let [inside, outside] = [[0.0, 0.1], weight.window].map(worst);
            assert!(inside < 0.5 * outside, "{inside}, and {outside} elsewhere");
        }
    }
}
