//! Shadowing and masking of flocks side by side: numbers for a cross-section's vertices, registers for flocks.
//!
//! The same equations as in `visibility.rs` and `visit.rs`. A direction, which each flock sees turned another way, is a slope
//! w.x / w.z to a cross-section: it shifts a vertex to x - slope z on the plane. Swept over the vertices, from the side that
//! the direction comes from, the horizon moves on by what lies open of each facet.

use super::flocks::Over;
use super::relief::Zones;
use crate::brdf::Facets;
use crate::lanes::{Lanes, Number, Vector};
use crate::pattern::{MOST_CLASS_VERTICES, STRIPS};
use arrayvec::ArrayVec;
use core::ops::Range;

/// Facets of a class.
pub(super) const MOST_FACETS: usize = MOST_CLASS_VERTICES - 1;

/// A class's cross-section.
pub(super) struct Section<'a> {
    /// One more than facets.
    xs: &'a [f32],
    zs: &'a [f32],
    /// Across and upward components.
    normals: [&'a [f32]; 2],
    over: ArrayVec<Over, MOST_FACETS>,
    /// Facets that follow one another and have a finish of this number.
    pub runs: ArrayVec<(u8, Range<usize>), MOST_FACETS>,
}

/// One direction, as each of several flocks sees it.
pub(super) struct Slope<F> {
    slope: F,
    /// 1 where it comes from the right, so that the horizon moves leftwards.
    leftwards: F,
}

/// Widths of facets on the plane, flock beside flock.
pub(super) struct Widths<F> {
    /// From end to end, as the view shifts them.
    whole: [F; MOST_FACETS],
    /// What the viewer sees of that.
    seen: [F; MOST_FACETS],
    /// The share of the pixel that the flock would cover if all of it were like this facet.
    share: [F; MOST_FACETS],
    /// What of the pixel the viewer sees each facet in, and what of that is lit.
    pub shown: [F; MOST_FACETS],
    pub lit: [F; MOST_FACETS],
}

impl<F: Number> Widths<F> {
    #[inline(always)]
    pub(super) fn none<L: Lanes<F = F>>(lanes: L) -> Self {
        let none = [lanes.all(0.0); MOST_FACETS];
        Self {
            whole: none,
            seen: none,
            share: none,
            shown: none,
            lit: none,
        }
    }
}

impl Zones {
    /// A class's cross-section; `up` gets its normals' upward components.
    #[inline(always)]
    pub(super) fn section<'a>(
        &'a self,
        slots: Range<usize>,
        up: &'a mut [f32; MOST_FACETS],
    ) -> Section<'a> {
        let facets = slots.len().saturating_sub(1).min(MOST_FACETS);
        let own = slots.start..slots.start + facets;
        let across = &self.normal_x[own.clone()];
        for (up, x) in up.iter_mut().zip(across) {
            *up = (1.0 - x * x).max(0.0).sqrt();
        }
        let ends = self.x[own.start..=own.end].windows(2);
        Section {
            over: ends.map(|ends| Over::of([ends[0], ends[1]])).collect(),
            xs: &self.x[own.start..=own.end],
            zs: &self.z[own.start..=own.end],
            normals: [across, &up[..facets]],
            runs: runs(&self.finish[own]),
        }
    }
}

fn runs(finish: &[u8]) -> ArrayVec<(u8, Range<usize>), MOST_FACETS> {
    let mut next = 0;
    let runs = finish.chunk_by(PartialEq::eq).map(|run| {
        let first = next;
        next += run.len();
        (run[0], first..next)
    });
    runs.collect()
}

impl<F: Number> Slope<F> {
    #[inline(always)]
    pub(super) fn of<L: Lanes<F = F>>(lanes: L, w: &Vector<F>) -> Self {
        let slope = w.x / w.z;
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        Self {
            slope,
            leftwards: none.if_above(slope, none, one),
        }
    }

    /// Where a vertex lies on the plane.
    #[inline(always)]
    fn shifted(&self, [x, z]: [f32; 2]) -> F {
        let like = self.slope;
        like.like(-z).times_plus(self.slope, like.like(x))
    }

    /// `then` where it comes from the right.
    #[inline(always)]
    fn if_leftwards(&self, then: F, otherwise: F) -> F {
        self.leftwards.if_above(then.like(0.5), then, otherwise)
    }

    /// What of the plane lies in front of every vertex: left of the first horizon or right of the other one.
    #[inline(always)]
    fn flat_ends(&self, [leftmost, rightmost]: [F; 2], [from, to]: [F; 2]) -> [F; 2] {
        [
            self.if_leftwards(leftmost.min(from), from),
            self.if_leftwards(to, rightmost.max(to)),
        ]
    }
}

impl Section<'_> {
    fn point(&self, vertex: usize) -> [f32; 2] {
        [self.xs[vertex], self.zs[vertex]]
    }

    fn facet_count(&self) -> usize {
        self.normals[0].len()
    }

    pub(super) fn facets<'a, F>(&'a self, run: &Range<usize>, shares: &'a [F]) -> Facets<'a, F> {
        Facets {
            normals: self.normals.map(|components| &components[run.clone()]),
            shares: &shares[run.clone()],
        }
    }

    /// Goes over the facets, telling of each how wide it is on the plane, below 0 if it turns its back to the direction,
    /// and how much of that lies open; what it is told stays in `kept`. Returns the last horizons, to the left and to the right,
    /// and how much lies open in all.
    #[inline(always)]
    fn sweep<L: Lanes>(
        &self,
        lanes: L,
        w: &Slope<L::F>,
        kept: &mut [L::F; MOST_FACETS],
        mut keep: impl FnMut(usize, L::F, L::F) -> L::F,
    ) -> ([L::F; 2], L::F) {
        let facets = self.facet_count();
        let (first, last) = (w.shifted(self.point(0)), w.shifted(self.point(facets)));
        // What is passed from the other side has a horizon that nothing moves.
        let begun = w.if_leftwards(last, lanes.all(f32::MIN));
        let mut leftmost = begun;
        let begins = self.xs[..facets].iter().zip(&self.zs[..facets]);
        for (open, (&x, &z)) in kept[..facets].iter_mut().zip(begins).rev() {
            let next = leftmost.min(w.shifted([x, z]));
            *open = leftmost - next;
            leftmost = next;
        }
        let mut all = begun - leftmost;
        let begun = w.if_leftwards(lanes.all(f32::MAX), first);
        let (mut rightmost, mut here) = (begun, first);
        let ends = self.xs[1..].iter().zip(&self.zs[1..]);
        for (k, (kept, (&x, &z))) in kept[..facets].iter_mut().zip(ends).enumerate() {
            let there = w.shifted([x, z]);
            let next = rightmost.max(there);
            *kept = keep(k, there - here, *kept + (next - rightmost));
            (rightmost, here) = (next, there);
        }
        all = all + (rightmost - begun);
        ([leftmost, rightmost], all)
    }

    /// Finds what the viewer sees of flocks whose strips would cover so much of the pixel if all were like them; returns from
    /// where to where the flat surface is hidden, what of the pixel that is, and what all facets are that are seen.
    #[inline(always)]
    pub(super) fn see<L: Lanes>(
        &self,
        lanes: L,
        view: &Slope<L::F>,
        strips: &[L::F; STRIPS],
        widths: &mut Widths<L::F>,
    ) -> ([L::F; 2], [L::F; 2]) {
        let (none, whole) = (lanes.all(0.0), &mut widths.whole);
        let (horizons, all) = self.sweep(
            lanes,
            view,
            &mut widths.seen,
            #[inline(always)]
            |k, width, open| {
                whole[k] = width.max(none);
                open
            },
        );
        let mut shown = none;
        for (k, over) in self.over.iter().enumerate() {
            let share = over.mean(strips);
            widths.share[k] = share;
            widths.shown[k] = share * widths.seen[k];
            shown = shown + widths.shown[k];
        }
        let ends = [lanes.all(-0.5), lanes.all(0.5)];
        let [from, to] = view.flat_ends(horizons, ends);
        // Where its ends stand up, facets look wider or narrower together than what they hide.
        let hidden = (to - from) / all.max(lanes.all(f32::MIN_POSITIVE)) * shown;
        ([from, to], [hidden, shown])
    }

    /// Finds what of that is lit; returns from where to where the flat surface is hidden or dark.
    #[inline(always)]
    pub(super) fn light<L: Lanes>(
        &self,
        lanes: L,
        light: &Slope<L::F>,
        view: &Slope<L::F>,
        seen_flat: [L::F; 2],
        widths: &mut Widths<L::F>,
    ) -> [L::F; 2] {
        let (none, least) = (lanes.all(0.0), lanes.all(f32::MIN_POSITIVE));
        // Seen from one side and lit from the other, a facet is dark from the end on that is seen first.
        let (right, left) = (light.leftwards, view.leftwards);
        let opposite = (right - left) * (right - left);
        let (whole, seen, shares) = (&widths.whole, &widths.seen, &widths.share);
        let (horizons, _) = self.sweep(
            lanes,
            light,
            &mut widths.lit,
            #[inline(always)]
            |k, width, open| {
                let share = open / width.max(least);
                let hidden = whole[k] - seen[k];
                let lit = whole[k].times_plus(share, -(opposite * hidden));
                seen[k].min(lit.max(none)) * shares[k]
            },
        );
        light.flat_ends(horizons, seen_flat)
    }
}
