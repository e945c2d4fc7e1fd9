//! Which place of a run stands for what a footprint holds of it.

use super::{Run, Walk};
use crate::pattern::closest::{length_share, nearest, nearest_on_line};
use crate::pattern::hit::Hit;
use crate::pattern::profile::Profile;
use crate::pattern::region::Region;
use core::ops::ControlFlow;
use glam::DVec2;

/// Where a scratch turns out to be this much narrower than thought, what is covered of it is looked at again.
const LEAST_NARROWING: f64 = 0.9;
const MOST_LOOKS: usize = 3;

/// The place of a run that is nearest to some point.
#[derive(Clone, Copy)]
pub(super) struct Near {
    distance: f64,
    pub at: f64,
    pub origin: DVec2,
    pub travel: DVec2,
}

impl<'p, V: FnMut(&Hit<'p>) -> ControlFlow<()>> Walk<'_, 'p, V> {
    /// The place in the middle of what a region holds of a run, and the mean cross-section there. How much of the
    /// scratch is covered depends on how wide it is there, and that on what is covered.
    pub(super) fn look(
        &self,
        run: &Run<'_, 'p>,
        region: &Region,
        mut near: Near,
        mut profile: Profile<'p>,
        is_even: bool,
    ) -> (Near, Profile<'p>) {
        let Run { first, last } = run;
        let mut half_width_mm = match is_even {
            true => profile.half_width_mm(),
            false => first
                .half_width_mm(&first.ends[0])
                .max(first.half_width_mm(&last.mark)),
        };
        for _ in 0..MOST_LOOKS {
            let stretch;
            (near, stretch) = self.stretch(run, region, &near, half_width_mm);
            if is_even {
                break;
            }
            profile = Profile::mean(&first.track, &first.course, stretch);
            let narrower = profile.half_width_mm();
            if narrower > LEAST_NARROWING * half_width_mm {
                break;
            }
            half_width_mm = narrower;
        }
        (near, profile)
    }

    /// What a region holds of a run so wide: the place in its middle, and from where to where it is, as shares of arc
    /// length.
    fn stretch(
        &self,
        run: &Run<'_, 'p>,
        region: &Region,
        near: &Near,
        half_width_mm: f64,
    ) -> (Near, [f64; 2]) {
        let Run { first, last } = run;
        let across = DVec2::new(near.travel.y, -near.travel.x);
        let side = across * half_width_mm;
        let covered = region.within(&[[near.origin - side, across], [near.origin + side, -across]]);
        let Some(covered) = covered else {
            return (*near, [near.at; 2]);
        };
        let near = self.nearest_on(run, covered.centroid());
        let Near {
            at, origin, travel, ..
        } = near;
        let [from, to] = run.at();
        let per_mm = (to - from) / (last.end - first.control[0]).length();
        let corners = covered.corners().iter();
        let reaches = corners.map(|corner| at + (*corner - origin).dot(travel) * per_mm);
        let stretch = reaches.fold([at; 2], |[first, last], reach| {
            [first.min(reach.max(from)), last.max(reach.min(to))]
        });
        (near, stretch)
    }

    pub(super) fn nearest_on(&self, run: &Run<'_, 'p>, target: DVec2) -> Near {
        let first = run.first;
        if first.is_line && first.number == run.last.number {
            let [a, _, _, d] = first.control;
            let (t, origin, travel) = nearest_on_line(a, d, target);
            let [from, to] = run.at();
            return Near {
                distance: origin.distance_squared(target),
                at: from + (to - from) * t,
                origin,
                travel,
            };
        }
        let on = |control: &[DVec2; 4], [from, to]: [f64; 2]| {
            let (t, origin, travel) = nearest(control, target);
            Near {
                distance: origin.distance_squared(target),
                at: from + (to - from) * length_share(control, t),
                origin,
                travel,
            }
        };
        let mut best = on(&first.control, first.ends.map(|end| end.at));
        for number in run.first.number + 1..=run.last.number {
            let other = on(&self.control(number), self.curves.at(number));
            if other.distance < best.distance {
                best = other;
            }
        }
        best
    }
}
