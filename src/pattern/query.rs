//! Which scratches a pixel sees, and how each runs through its footprint.

use super::closest::{length_share, nearest};
use super::pieces::Piece;
use super::point::Metric;
use super::region::Region;
use super::{Pattern, Track};
use glam::DVec2;

/// Pieces gathered before they are joined into runs. More are handled too, in several batches.
const BATCH: usize = 64;

/// Neighbouring pieces that turn less than this in all are one run, with one frame: cos 2 degrees.
const RUN_COS: f64 = 0.9994;

/// One scratch's way through a footprint. Lengths in mm, in the local frame around the footprint's centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit<'p> {
    pub track: &'p Track,
    /// Share of the scratch's arc length at `origin`.
    pub at: f64,
    /// A point of the scratch's centre line.
    pub origin: DVec2,
    /// The centre line's unit direction of travel there.
    pub travel: DVec2,
    /// The part of the footprint beside this run of the scratch.
    pub region: Region,
}

impl Pattern {
    /// Calls `visit` with each run of scratch that comes within `reach_mm` of the footprint.
    pub(crate) fn query<'p>(
        &'p self,
        metric: &Metric,
        footprint: &Region,
        reach_mm: f64,
        visit: &mut impl FnMut(Hit<'p>),
    ) {
        let reach = metric.reach_uv(reach_mm);
        let corners = footprint
            .corners()
            .iter()
            .map(|&corner| metric.place_uv(corner));
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = corners.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
        let mut batch = [0; BATCH];
        let mut count = 0;
        self.grid
            .query(&self.pieces, low - reach, high + reach, |piece| {
                if count == BATCH {
                    self.for_each_run(&mut batch, metric, footprint, visit);
                    count = 0;
                }
                batch[count] = piece;
                count += 1;
            });
        self.for_each_run(&mut batch[..count], metric, footprint, visit);
    }

    /// Joins neighbouring pieces of the same scratch where they run nearly straight.
    fn for_each_run<'p>(
        &'p self,
        numbers: &mut [u32],
        metric: &Metric,
        footprint: &Region,
        visit: &mut impl FnMut(Hit<'p>),
    ) {
        numbers.sort_unstable();
        let mut from = 0;
        while from < numbers.len() {
            let mut to = from + 1;
            while to < numbers.len() && self.joins(numbers[from], numbers[to - 1], numbers[to]) {
                to += 1;
            }
            let run = &self.pieces[numbers[from] as usize..=numbers[to - 1] as usize];
            if let Some(hit) = self.hit(run, metric, footprint) {
                visit(hit);
            }
            from = to;
        }
    }

    fn joins(&self, first: u32, last: u32, next: u32) -> bool {
        let [a, b] = [first, next].map(|number| &self.pieces[number as usize]);
        let straight = |a: DVec2, b: DVec2| a.dot(b) > RUN_COS * (a.length() * b.length());
        next == last + 1
            && !b.changed
            && a.scratch == b.scratch
            && straight(a.chord(), b.chord())
            && straight(a.parting[0], b.parting[1])
    }

    fn hit(&self, run: &[Piece], metric: &Metric, footprint: &Region) -> Option<Hit<'_>> {
        let (first, last) = (&run[0], &run[run.len() - 1]);
        let place = |uv: DVec2| metric.to_mm * (uv - metric.uv);
        let direction = |uv: DVec2| (metric.to_mm * uv).normalize_or_zero();
        let region = footprint
            .clipped(place(first.control[0]), direction(first.parting[0]))?
            .clipped(place(last.control[3]), -direction(last.parting[1]))?;
        let track = &self.tracks[first.scratch as usize];
        // The cross-section is taken in the middle of what is covered of the scratch, not of the footprint.
        let near = nearest_on(run, place, region.centroid());
        let across = DVec2::new(near.travel.y, -near.travel.x);
        let side = across * f64::from(track.extent.half_width_mm);
        let covered = region
            .clipped(near.origin - side, across)
            .and_then(|half| half.clipped(near.origin + side, -across));
        let Near {
            at, origin, travel, ..
        } = match covered {
            Some(covered) => nearest_on(run, place, covered.centroid()),
            None => near,
        };
        Some(Hit {
            track,
            at,
            origin,
            travel,
            region,
        })
    }
}

/// The place of a run that is nearest to some point.
struct Near {
    distance: f64,
    at: f64,
    origin: DVec2,
    travel: DVec2,
}

fn nearest_on(run: &[Piece], place: impl Fn(DVec2) -> DVec2, target: DVec2) -> Near {
    let on_piece = |piece: &Piece| {
        let control = piece.control.map(&place);
        let (t, origin, travel) = nearest(&control, target);
        let [from, to] = piece.at;
        let at = from + (to - from) * length_share(&control, t);
        Near {
            distance: origin.distance_squared(target),
            at,
            origin,
            travel,
        }
    };
    let mut best = on_piece(&run[0]);
    for piece in &run[1..] {
        let other = on_piece(piece);
        if other.distance < best.distance {
            best = other;
        }
    }
    best
}
