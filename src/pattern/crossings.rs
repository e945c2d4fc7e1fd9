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

/// Cuts from the one region in `left`, which belongs to run `i`, what later scratches take of it; `hits` are in the
/// order in which they were scratched. False if that leaves too many parts.
pub(crate) fn cut<const MOST_PARTS: usize>(
    hits: &[Hit<'_>],
    i: usize,
    left: &mut ArrayVec<Region, MOST_PARTS>,
    pixel_area: f64,
) -> bool {
    let run = &hits[i];
    let Some([low, high]) = left.first().map(Region::bounds) else {
        return true;
    };
    hits[i + 1..].iter().all(|later| {
        let Some([from, to]) = later.cover.as_ref().map(Region::bounds) else {
            return true;
        };
        let meets = from.cmple(high).all() && to.cmpge(low).all() && !later.adjoins(run);
        !meets || !reaches(later, run, pixel_area) || cut_by(later, left, pixel_area)
    })
}

/// Cuts what one run covers from some parts; false if that leaves too many.
fn cut_by<const MOST_PARTS: usize>(
    later: &Hit<'_>,
    left: &mut ArrayVec<Region, MOST_PARTS>,
    pixel_area: f64,
) -> bool {
    let borders = later.borders(later.ends_mm);
    let least = LEAST_PART * pixel_area;
    // From the last one on: what is left of a part is put behind those still to be cut.
    for part in (0..left.len()).rev() {
        if !left[part]
            .within(&borders)
            .is_some_and(|cut| cut.area() > least)
        {
            continue;
        }
        let mut rest = left.swap_remove(part);
        for [origin, inward] in borders {
            let outside = rest.clipped(origin, -inward);
            if let Some(outside) = outside.filter(|outside| outside.area() > least)
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

/// The share of each run that later ones leave of it, on the whole, if it is no wider than `thin_mm`; nothing of a single
/// one. `area` is the footprint's.
pub(crate) fn left_of_thin<const MOST: usize>(
    hits: &[Hit<'_>],
    thin_mm: f64,
    area: f64,
) -> ArrayVec<Option<f64>, MOST> {
    let mut shares: ArrayVec<Option<f64>, MOST> = ArrayVec::new();
    if hits.len() < 2 {
        return shares;
    }
    shares.extend(hits.iter().map(|_| None));
    let mut laid = Laid::new();
    // Of what lies beside the footprint, and of the footprint: what runs that shade it from there are left of it.
    let mut bare = 1.0;
    // A run and the one that it goes on in do not cover each other.
    let mut next: Option<(usize, Even)> = None;
    for (i, hit) in hits.iter().enumerate().rev() {
        let is_thin = hit.ends_mm[1] - hit.ends_mm[0] <= thin_mm;
        let Some(cover) = &hit.cover else {
            shares[i] = is_thin.then_some(bare);
            continue;
        };
        let even = Even::of(cover, hit.travel);
        let adjoining = next.take_if(|(later, _)| hits[*later].adjoins(hit));
        if let Some((_, later)) = next.take() {
            laid.lay(later.way, later.width_mm);
        }
        if is_thin {
            shares[i] = Some(laid.left_of(even.way, even.width_mm));
        }
        if let Some((_, later)) = adjoining {
            laid.lay(later.way, later.width_mm);
        }
        bare *= 1.0 - (even.area_mm2 / area).min(1.0);
        next = Some((i, even));
    }
    shares
}

/// A strip as long as what is covered is wide and large.
struct Even {
    way: [DVec2; 2],
    width_mm: f64,
    area_mm2: f64,
}

impl Even {
    fn of(cover: &Region, travel: DVec2) -> Self {
        let places = cover
            .corners()
            .iter()
            .map(|corner| travel.perp_dot(*corner));
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
            (low.min(at), high.max(at))
        });
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

/// Parts up to which what is left of a run is measured.
const MEASURED_PARTS: usize = 16;

/// The share of run `i` that is left; where it is cut into many parts about: as if those that cut it did so
/// independently of one another.
pub(crate) fn uncut_share(hits: &[Hit<'_>], i: usize) -> f64 {
    let run = &hits[i];
    let Some(own) = &run.cover else { return 0.0 };
    let [low, high] = own.bounds();
    let (ends, area) = (run.ends_mm, own.area());
    let mut parts: ArrayVec<Region, MEASURED_PARTS> = ArrayVec::new();
    parts.push(*own);
    if cut(hits, i, &mut parts, area) {
        return parts.iter().map(Region::area).sum::<f64>() / area;
    }
    let mut left = 1.0;
    for later in &hits[i + 1..] {
        let Some(cover) = &later.cover else { continue };
        let [from, to] = cover.bounds();
        if from.cmple(high).all() && to.cmpge(low).all() && !later.adjoins(run) {
            let cut = run.covered(ends, cover).map_or(0.0, |cut| cut.area());
            left *= 1.0 - (cut / area).min(1.0);
        }
    }
    left
}

/// Whether a later run covers anything near an earlier one.
fn reaches(later: &Hit<'_>, run: &Hit<'_>, pixel_area: f64) -> bool {
    let [from, to] = run.ends_mm;
    let beside = BESIDE * (to - from);
    let cover = later.cover.as_ref();
    let cut = cover.and_then(|cover| run.covered([from - beside, to + beside], cover));
    cut.is_some_and(|cut| cut.area() > LEAST_PART * pixel_area)
}
