//! Where scratches cross, the later one cuts the earlier: its groove and peaks replace what was there.

use super::hit::Hit;
use super::lines::{Cuts, Left, Lines};
use super::region::Region;
use arrayvec::ArrayVec;

/// Parts of less than this share of the pixel are none.
const LEAST_PART: f64 = 1e-9;

/// Parts of a run that are still to be cut by later ones.
pub(crate) type Parts = ArrayVec<Region, 32>;

/// How far beside a scratch's edge cuts still matter, as a share of its width: parallax shows the scratch there.
const BESIDE: f64 = 1.0;

/// Runs in the order in which they were scratched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing<'c, 'p> {
    hits: &'c [Hit<'p>],
    /// What each covers of the footprint.
    covers: &'c [Option<Region>],
}

impl<'c, 'p> Crossing<'c, 'p> {
    /// Of runs that cover this of the footprint.
    pub(crate) fn new(hits: &'c [Hit<'p>], covers: &'c [Option<Region>]) -> Self {
        Self { hits, covers }
    }

    /// Whether none of these runs, which all cover some of the footprint, cuts another.
    pub(crate) fn are_apart(hits: &[Hit<'_>], footprint: &Region) -> bool {
        hits.iter().enumerate().all(|(i, run)| {
            let near = beside(run);
            let mut later = hits[i + 1..].iter();
            later.all(|later| later.adjoins(run) || !run.may_cover(near, later.region(footprint)))
        })
    }

    /// Cuts from the one region in `left`, which belongs to run `i`, what later runs take of it; false if that leaves too
    /// many parts, or too many corners.
    pub(crate) fn cut(&self, i: usize, left: &mut Parts, pixel_area: f64) -> bool {
        let least_area = LEAST_PART * pixel_area;
        self.cutting(i, beside(&self.hits[i]))
            .all(|later| cut_by(later, left, least_area))
    }

    /// What later ones leave of what run `i` covers. Of one that only shades the footprint, the share that they leave of all
    /// of it, as if they lay independently of one another.
    pub(crate) fn left(&self, i: usize, pixel_area: f64) -> Left {
        let (run, Some(cover)) = (&self.hits[i], &self.covers[i]) else {
            let covered = self.later(i).map(|(_, cover)| cover.area() / pixel_area);
            return Left::even(covered.map(|share| 1.0 - share.min(1.0)).product());
        };
        let lines = Lines::along(&run.line, cover);
        let whole = lines.within(cover.edges().map(|(a, b)| [a, (b - a).perp()]));
        let mut cuts = Cuts::new();
        // If they are too many, those that others lie upon are left out.
        let later = self.cutting(i, run.ends_mm).rev();
        let all = later.map(|later| lines.within(later.borders(later.ends_mm)));
        cuts.extend(all.filter(|cut| cut.meet(&whole)).take(cuts.capacity()));
        lines.left(&whole, &cuts)
    }

    /// Later ones that may cut what run `i` has between two distances across.
    fn cutting(
        &self,
        i: usize,
        across_mm: [f64; 2],
    ) -> impl DoubleEndedIterator<Item = &'c Hit<'p>> {
        let run = &self.hits[i];
        let meets = move |(later, cover): (&'c Hit<'p>, &Region)| {
            (!later.adjoins(run) && run.may_cover(across_mm, cover)).then_some(later)
        };
        self.later(i).filter_map(meets)
    }

    /// Runs after run `i` that cover any of the footprint, and what they cover.
    fn later(&self, i: usize) -> impl DoubleEndedIterator<Item = (&'c Hit<'p>, &'c Region)> {
        let later = self.hits[i + 1..].iter().zip(&self.covers[i + 1..]);
        later.filter_map(|(hit, cover)| Some((hit, cover.as_ref()?)))
    }
}

/// Between which distances across from a run cuts matter.
fn beside(run: &Hit<'_>) -> [f64; 2] {
    let [from, to] = run.ends_mm;
    let beside = BESIDE * (to - from);
    [from - beside, to + beside]
}

/// Cuts what one run covers from some parts; false if that leaves too many, or too many corners.
fn cut_by(later: &Hit<'_>, left: &mut Parts, least_area: f64) -> bool {
    let borders = later.borders(later.ends_mm);
    // From the last one on: what is left of a part is put behind those still to be cut.
    for part in (0..left.len()).rev() {
        if left[part]
            .within(&borders)
            .is_none_or(|cut| cut.area() <= least_area)
        {
            continue;
        }
        let mut rest = left.swap_remove(part);
        if !rest.has_room(borders.len()) {
            return false;
        }
        for [origin, inward] in borders {
            let outside = rest.clipped(origin, -inward);
            if let Some(outside) = outside.filter(|outside| outside.area() > least_area)
                && left.try_push(outside).is_err()
            {
                return false;
            }
            if !rest.clip(origin, inward) {
                break;
            }
        }
    }
    true
}
