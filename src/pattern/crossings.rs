//! Where scratches cross, the later one cuts the earlier: its groove and peaks replace what was there.

use super::hit::Hit;
use super::region::Region;
use arrayvec::ArrayVec;

/// Parts of less than this share of the pixel are none.
const LEAST_PART: f64 = 1e-9;

/// How far beside a scratch's edge cuts still matter, as a share of its width: parallax shows the scratch there.
const BESIDE: f64 = 1.0;

/// What later scratches leave of a region that belongs to run `i`; `hits` are in the order in which they were
/// scratched. Nothing if it is too many parts.
pub(crate) fn uncut<const MOST_PARTS: usize>(
    hits: &[Hit<'_>],
    i: usize,
    region: Region,
    pixel_area: f64,
) -> Option<ArrayVec<Region, MOST_PARTS>> {
    let run = &hits[i];
    let mut left = ArrayVec::new();
    left.push(region);
    for later in &hits[i + 1..] {
        let [from, to] = later.ends_mm;
        if to <= from || later.adjoins(run) || !reaches(later, run, pixel_area) {
            continue;
        }
        let mut still = ArrayVec::new();
        for part in &left {
            let mut rest = Some(*part);
            for [origin, inward] in later.borders([from, to]) {
                let Some(whole) = rest else { break };
                if let Some(outside) = whole.clipped(origin, -inward)
                    && outside.area() > LEAST_PART * pixel_area
                {
                    still.try_push(outside).ok()?;
                }
                rest = whole.clipped(origin, inward);
            }
        }
        left = still;
    }
    Some(left)
}

/// Among so few runs what is left of each is measured.
const FEW: usize = 32;

/// The share of run `i` that is left; among many runs about: as if those that cut it did so independently
/// of one another.
pub(crate) fn uncut_share(hits: &[Hit<'_>], i: usize) -> f64 {
    let run = &hits[i];
    let Some(own) = run.cover else { return 0.0 };
    let [low, high] = own.bounds();
    let (ends, area) = (run.ends_mm, own.area());
    let parts = (hits.len() <= FEW).then(|| uncut::<8>(hits, i, own, area));
    if let Some(parts) = parts.flatten() {
        return parts.iter().map(Region::area).sum::<f64>() / area;
    }
    let mut left = 1.0;
    for later in &hits[i + 1..] {
        let Some(cover) = later.cover else { continue };
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
    let cut = later
        .cover
        .and_then(|cover| run.covered([from - beside, to + beside], cover));
    cut.is_some_and(|cut| cut.area() > LEAST_PART * pixel_area)
}
