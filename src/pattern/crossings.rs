//! Where scratches cross, the later one cuts the earlier: its groove and peaks replace what was there.

use super::hit::Hit;
use super::region::Region;
use arrayvec::ArrayVec;

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
