//! Where scratches cross, the later one cuts the earlier: its groove and peaks replace what was there.

use super::boxes::{Boxes, MOST_BOXES, TurnedBox};
use super::hit::Hit;
use super::left::Left;
use super::lines::{Cuts, Lines};
use super::region::Region;
use arrayvec::ArrayVec;

/// Parts of less than this share of the pixel are none.
const LEAST_PART: f64 = 1e-9;

/// Parts of a run that are still to be cut by later ones.
pub(crate) type Parts = ArrayVec<Region, 32>;

/// How far beside a scratch's edge cuts still matter, as a share of its width: parallax shows the scratch there.
const BESIDE: f64 = 1.0;

/// What runs cover of the footprint.
#[derive(Debug)]
pub(crate) struct Covers<const MOST: usize> {
    regions: ArrayVec<Option<Region>, MOST>,
    /// mm².
    pub areas: ArrayVec<f64, MOST>,
    boxes: Boxes,
}

impl<const MOST: usize> Covers<MOST> {
    /// Of none yet: in place, for room for many is not to be moved.
    pub(crate) const fn new() -> Self {
        const { assert!(MOST <= MOST_BOXES, "room for as many boxes") }
        Self {
            regions: ArrayVec::new_const(),
            areas: ArrayVec::new_const(),
            boxes: Boxes::new(),
        }
    }

    /// Adds those of all runs.
    pub(crate) fn add(&mut self, hits: &[Hit<'_>], footprint: &Region) {
        let Self {
            regions,
            areas,
            boxes,
        } = self;
        regions.extend(hits.iter().map(|hit| hit.cover(footprint)));
        areas.extend(
            regions
                .iter()
                .map(|region| region.as_ref().map_or(0.0, Region::area)),
        );
        boxes.add(hits.iter().zip(regions).map(|(hit, region)| {
            let region = region.as_ref()?;
            Some(TurnedBox::around(&hit.line, region))
        }));
    }

    /// These runs and what they cover.
    pub(crate) fn crossing<'c, 'p>(
        &'c self,
        hits: &'c [Hit<'p>],
        footprint: &'c Region,
    ) -> Crossing<'c, 'p> {
        Crossing {
            hits,
            footprint,
            covers: &self.regions,
            areas: &self.areas,
            boxes: &self.boxes,
        }
    }
}

/// Runs in the order in which they were scratched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing<'c, 'p> {
    hits: &'c [Hit<'p>],
    footprint: &'c Region,
    /// What each covers of the footprint.
    pub covers: &'c [Option<Region>],
    areas: &'c [f64],
    boxes: &'c Boxes,
}

/// Later runs that may cut one.
pub(crate) type Cutting<'c, 'p> = ArrayVec<&'c Hit<'p>, MOST_BOXES>;

impl<'c, 'p> Crossing<'c, 'p> {
    /// Whether none of these runs, which all cover some of the footprint, cuts another.
    pub(crate) fn are_apart(hits: &[Hit<'_>], footprint: &Region) -> bool {
        hits.iter().enumerate().all(|(i, run)| {
            let near = beside(run);
            let mut later = hits[i + 1..].iter();
            later.all(|later| later.adjoins(run) || !run.may_cover(near, later.region(footprint)))
        })
    }

    /// Finds the later runs that may cut what run `i` covers, or what lies beside it: also of one that covers nothing.
    pub(crate) fn find_cutting(&self, i: usize, cutting: &mut Cutting<'c, 'p>) {
        let run = &self.hits[i];
        let region = run.region(self.footprint);
        let along = region.extent(run.line.origin, run.line.travel);
        let across = run.line.widest(beside(run), along);
        let near = TurnedBox::between(&run.line, along, across);
        let depths = self.boxes.depths(&near);
        let later = self.hits.iter().zip(depths.as_flattened()).skip(i + 1);
        let meet = later.filter(|(later, depth)| **depth >= 0.0 && !later.adjoins(run));
        cutting.clear();
        cutting.extend(meet.map(|(later, _)| later));
    }

    /// What later ones leave of what run `i` covers. Of one that only shades the footprint, the share that they leave of all
    /// of it, as if they lay independently of one another.
    pub(crate) fn left(&self, i: usize, cutting: &Cutting<'_, '_>, pixel_area: f64) -> Left {
        let Some(cover) = &self.covers[i] else {
            let later = self.areas[i + 1..].iter();
            let left = later.map(|area| 1.0 - (area / pixel_area).min(1.0));
            return Left::even(left.product());
        };
        let lines = Lines::along(&self.hits[i].line, cover);
        let mut cuts = Cuts::new();
        // If they are too many, those that others lie upon are left out.
        let mut later = cutting.iter().rev();
        later.all(|later| lines.cut(&later.borders(later.ends_mm), &mut cuts));
        lines.left(&cuts)
    }
}

/// Cuts from the one region in `left`, which belongs to a run, what later runs take of it; false if that leaves too many
/// parts, or too many corners.
pub(crate) fn cut_away(left: &mut Parts, cutting: &Cutting<'_, '_>, pixel_area: f64) -> bool {
    let least_area = LEAST_PART * pixel_area;
    let mut cutting = cutting.iter();
    cutting.all(|later| cut_by(later, left, least_area))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Metal;
    use crate::formation::{Material, Tool};
    use crate::pattern::{
        Candidates, Footprint, Frame, Key, Metric, Path, Pattern, PatternBuilder, Reach, Scratch,
        SurfacePoint,
    };
    use core::ops::ControlFlow;
    use glam::DVec2;

    /// Straight scratches across the plate, 18 mm long.
    fn pattern(lines: &[[[f64; 2]; 2]]) -> Pattern {
        let material = Material::metal(Metal::Steel);
        let mut builder = PatternBuilder::new(material, 1.0, [1.0; 2]).unwrap();
        let (tool, keys) = (Tool::rockwell_c(), [Key::force(0.0, 1.0)]);
        for line in lines {
            let scratch = Scratch {
                path: Path::Polyline(line),
                keys: &keys,
                ..Scratch::new(&tool)
            };
            builder.add(&scratch).unwrap();
        }
        builder.build()
    }

    /// A later scratch cuts an earlier one, not the other way round, be it in the footprint or beside it; one that covers
    /// nothing of the footprint cuts none.
    #[test]
    fn later_runs_cut_what_lies_beside() {
        let down = [[0.0, -9.0], [0.0, 9.0]];
        let half_width = f64::from(pattern(&[down]).extent.half_width_mm);
        // The first one runs beside the footprint, the second through it and across the others.
        let level = |y: f64| [[-9.0, y], [9.0, y]];
        let beside = 0.025 + 1.5 * half_width;
        let pattern = pattern(&[level(beside), down, level(-beside)]);
        let point = SurfacePoint {
            uv: [0.0; 2],
            dp_du: [1.0, 0.0, 0.0],
            dp_dv: [0.0, 1.0, 0.0],
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Point,
        };
        let metric = Metric::at(&point, &Frame::at(&point).unwrap(), 1.0).unwrap();
        let footprint = Region::parallelogram(0.05 * DVec2::X, 0.05 * DVec2::Y);
        let reach = Reach::new(&metric, &footprint, 3.0 * half_width);
        let (mut candidates, mut hits) = (Candidates::new(), Vec::new());
        assert!(pattern.candidates(&reach, &mut candidates), "too many");
        pattern.for_each_run(&candidates, &reach, 0.0, &mut |hit| {
            hits.push(*hit);
            ControlFlow::Continue(())
        });
        assert_eq!(hits.len(), 3, "runs");
        let mut covers = Covers::<8>::new();
        covers.add(&hits, &footprint);
        let crossing = covers.crossing(&hits, &footprint);
        let covered = [0, 1, 2].map(|i| crossing.covers[i].is_some());
        assert_eq!(covered, [false, true, false], "what covers any");
        let cut_by = |i| {
            let mut cutting = Cutting::new();
            crossing.find_cutting(i, &mut cutting);
            cutting
                .iter()
                .map(|later| later.scratch)
                .collect::<Vec<_>>()
        };
        assert_eq!([0, 1, 2].map(cut_by), [vec![1], vec![], vec![]]);
    }
}
