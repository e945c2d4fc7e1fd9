//! Where scratches cross, the later one cuts the earlier: its groove and peaks replace what was there.

use super::hit::Hit;
use super::laid::Laid;
use super::region::Region;
use arrayvec::ArrayVec;
use glam::DVec2;

/// Parts of less than this share of the pixel are none.
const LEAST_PART: f64 = 1e-9;

/// How far beside a scratch's edge cuts still matter, as a share of its width: parallax shows the scratch there.
const BESIDE: f64 = 1.0;

/// Parts up to which what is left of a run is measured.
const MEASURED_PARTS: usize = 16;

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

    /// Cuts from the one region in `left`, which belongs to run `i`, what later runs take of it; false if that leaves too
    /// many parts.
    pub(crate) fn cut<const MOST_PARTS: usize>(
        &self,
        i: usize,
        left: &mut ArrayVec<Region, MOST_PARTS>,
        pixel_area: f64,
    ) -> bool {
        let run = &self.hits[i];
        let [from, to] = run.ends_mm;
        let beside = BESIDE * (to - from);
        let near = [from - beside, to + beside];
        let least_area = LEAST_PART * pixel_area;
        self.later(i).all(|(later, cover)| {
            let meets = run.may_cover(near, cover) && !later.adjoins(run);
            !meets || cut_by(later, left, least_area)
        })
    }

    /// The share of run `i` that is left; where it is cut into many parts about: as if those that cut it did so
    /// independently of one another.
    pub(crate) fn uncut_share(&self, i: usize) -> f64 {
        let (run, Some(own)) = (&self.hits[i], &self.covers[i]) else {
            return 0.0;
        };
        let area = own.area();
        let mut parts: ArrayVec<Region, MEASURED_PARTS> = ArrayVec::new();
        parts.push(*own);
        if self.cut(i, &mut parts, area) {
            return parts.iter().map(Region::area).sum::<f64>() / area;
        }
        let near = self.later(i).filter(|(later, _)| !later.adjoins(run));
        let cuts = near.map(|(_, cover)| {
            run.covered(run.ends_mm, cover)
                .map_or(0.0, |cut| cut.area())
        });
        cuts.map(|cut| 1.0 - (cut / area).min(1.0)).product()
    }

    /// The share of each run that later ones leave of it, on the whole, if it is no wider than `thin_mm`.
    pub(crate) fn left_of_thin<const MOST: usize>(
        &self,
        thin_mm: f64,
        pixel_area: f64,
    ) -> ArrayVec<Option<f64>, MOST> {
        let mut shares: ArrayVec<Option<f64>, MOST> = self.hits.iter().map(|_| None).collect();
        if thin_mm == 0.0 {
            return shares;
        }
        let mut laid = Laid::new();
        // Of the whole footprint: what is left of runs that only shade it from beside.
        let mut bare = 1.0;
        // A run and the one that it goes on in do not cover each other.
        let mut next: Option<(usize, Even)> = None;
        for (i, (hit, cover)) in self.hits.iter().zip(self.covers).enumerate().rev() {
            let is_thin = hit.ends_mm[1] - hit.ends_mm[0] <= thin_mm;
            let Some(cover) = cover else {
                shares[i] = is_thin.then_some(bare);
                continue;
            };
            let even = Even::of(cover, hit.travel);
            let adjoining = next.take_if(|(later, _)| self.hits[*later].adjoins(hit));
            if let Some((_, later)) = next.take() {
                laid.lay(later.way, later.width_mm);
            }
            if is_thin {
                shares[i] = Some(laid.left_of(even.way, even.width_mm));
            }
            if let Some((_, later)) = adjoining {
                laid.lay(later.way, later.width_mm);
            }
            bare *= 1.0 - (even.area_mm2 / pixel_area).min(1.0);
            next = Some((i, even));
        }
        shares
    }

    /// Runs after run `i` that cover any of the footprint, and what they cover.
    fn later(&self, i: usize) -> impl Iterator<Item = (&'c Hit<'p>, &'c Region)> {
        let later = self.hits[i + 1..].iter().zip(&self.covers[i + 1..]);
        later.filter_map(|(hit, cover)| Some((hit, cover.as_ref()?)))
    }
}

/// Cuts what one run covers from some parts; false if that leaves too many.
fn cut_by<const MOST_PARTS: usize>(
    later: &Hit<'_>,
    left: &mut ArrayVec<Region, MOST_PARTS>,
    least_area: f64,
) -> bool {
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

/// A strip as long as what is covered is wide and large.
struct Even {
    way: [DVec2; 2],
    width_mm: f64,
    area_mm2: f64,
}

impl Even {
    fn of(cover: &Region, travel: DVec2) -> Self {
        let [low, high] = cover.extent(DVec2::ZERO, travel.perp());
        let (width_mm, area_mm2) = (high - low, cover.area());
        let half = travel * (0.5 * area_mm2 / width_mm);
        let middle = cover.centroid();
        Self {
            way: [middle - half, middle + half],
            width_mm,
            area_mm2,
        }
    }
}
