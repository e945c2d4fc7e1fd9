//! Which place of a run stands for what a footprint holds of it.

use super::{Mark, Run, Walk};
use crate::pattern::center_line::CenterLine;
use crate::pattern::closest::{foot_on_line, length_share, nearest};
use crate::pattern::hit::Hit;
use crate::pattern::profile::Profile;
use crate::pattern::region::Region;
use core::ops::ControlFlow;
use glam::DVec2;

/// The place of a run that is nearest to some point.
#[derive(Clone, Copy)]
pub(super) struct Near {
    distance: f64,
    pub at: f64,
    pub origin: DVec2,
    pub travel: DVec2,
}

impl Near {
    pub(super) fn line(&self) -> CenterLine {
        CenterLine::even(self.origin, self.travel)
    }
}

impl<'p, V: FnMut(&Hit<'p>) -> ControlFlow<()>> Walk<'_, 'p, V> {
    /// The place in the middle of what a region holds of a run, its line there, and the mean cross-section. How much of the
    /// scratch is covered depends on how wide it is there, and that on what is covered: it is looked at once as wide as at the
    /// wider end, and once more as it tapers on that way.
    pub(super) fn look(
        &self,
        run: &Run<'_, 'p>,
        region: &Region,
        near: Near,
        profile: Profile<'p>,
        is_even: bool,
    ) -> (f64, CenterLine, Profile<'p>) {
        let Run { first, last } = run;
        if is_even {
            let half_width_mm = profile.half_width_mm();
            let (near, _) = self.stretch(run, region, near, &near.line(), half_width_mm);
            return (near.at, near.line(), profile);
        }
        let half_width_mm = |at: f64| first.half_width_mm(&Mark::new(&first.course, at));
        let [a, b] = [&first.ends[0], &last.mark].map(|mark| first.half_width_mm(mark));
        let (near, stretch) = self.stretch(run, region, near, &near.line(), a.max(b));
        let half_widths_mm = stretch.map(half_width_mm);
        let mean_mm = 0.5 * (half_widths_mm[0] + half_widths_mm[1]);
        let (_, line) = self.tapering(
            run,
            region,
            &near,
            stretch,
            half_widths_mm,
            [-mean_mm, mean_mm],
        );
        let (near, stretch) = self.stretch(run, region, near, &line, mean_mm);
        let profile = Profile::mean(&first.track, &first.course, stretch);
        let half_widths_mm = stretch.map(half_width_mm);
        let edges_mm = profile.ends().map(f64::from);
        let (at, line) = self.tapering(run, region, &near, stretch, half_widths_mm, edges_mm);
        (at, line, profile)
    }

    /// What a region holds of a run that is so wide at the line's origin: the place in its middle, and from where to where it
    /// is, as shares of arc length.
    fn stretch(
        &self,
        run: &Run<'_, 'p>,
        region: &Region,
        near: Near,
        line: &CenterLine,
        half_width_mm: f64,
    ) -> (Near, [f64; 2]) {
        let Some(covered) = region.within(&line.sides([-half_width_mm, half_width_mm])) else {
            return (near, [near.at; 2]);
        };
        let near = self.nearest_on(run, covered.centroid());
        let [from, to] = run.at();
        let Near {
            at, origin, travel, ..
        } = near;
        let per_mm = (to - from) / run.length();
        let corners = covered.corners().iter();
        let reaches = corners.map(|corner| at + (*corner - origin).dot(travel) * per_mm);
        let stretch = reaches.fold([at; 2], |[first, last], reach| {
            [first.min(reach.max(from)), last.max(reach.min(to))]
        });
        (near, stretch)
    }

    /// The line of a stretch that is so wide at its ends and has such edges on average, and where it has these: in its middle.
    fn tapering(
        &self,
        run: &Run<'_, 'p>,
        region: &Region,
        near: &Near,
        stretch: [f64; 2],
        [a, b]: [f64; 2],
        [left, right]: [f64; 2],
    ) -> (f64, CenterLine) {
        let [from, to] = run.at();
        let mm = run.length() / (to - from);
        let at = 0.5 * (stretch[0] + stretch[1]);
        let origin = near.origin + near.travel * ((at - near.at) * mm);
        let taper = (b - a) / (right.max(-left) * (stretch[1] - stretch[0]) * mm);
        let line = CenterLine::even(origin, near.travel);
        (at, line.tapering(taper, [left, right], region))
    }

    #[inline(always)]
    pub(super) fn nearest_on(&self, run: &Run<'_, 'p>, target: DVec2) -> Near {
        let first = run.first;
        if !(first.is_line && first.number == run.last.number) {
            return self.nearest_on_curves(run, target);
        }
        let [a, _, _, d] = first.control;
        let (t, origin) = foot_on_line(a, d, target);
        let [from, to] = run.at();
        Near {
            distance: origin.distance_squared(target),
            at: from + (to - from) * t,
            origin,
            travel: first.travel,
        }
    }

    #[inline(never)]
    fn nearest_on_curves(&self, run: &Run<'_, 'p>, target: DVec2) -> Near {
        let first = run.first;
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
