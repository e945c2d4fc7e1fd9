//! The commonest of all: one straight scratch that passes a pixel.

use crate::pattern::Pattern;
use crate::pattern::center_line::CenterLine;
use crate::pattern::closest::{foot_on_line, unit_or_x};
use crate::pattern::hit::Hit;
use crate::pattern::query::Reach;
use glam::DVec2;

impl Pattern {
    /// The run of a piece that is near alone, if that is a straight line with one cross-section and the whole of a path whose
    /// ends lie out of reach: all that [`Self::for_each_run`] tells of it, sooner. Of any other piece nothing.
    #[inline(always)]
    pub(crate) fn only_run(&self, number: usize, reach: &Reach<'_>) -> Option<Hit<'_>> {
        let curves = self.curves();
        let [start, end] = curves.line(number)?;
        let [start, end] = [reach.place(start), reach.place(end)];
        let travel = unit_or_x(end - start);
        let near = reach.footprint.half_size() + reach.reach_mm;
        let is_near = |end: DVec2| end.abs().cmple(near).all();
        let lines = [[start, travel], [end, -travel]];
        let passes = reach.footprint.is_parallelogram_within(&lines);
        if !passes || is_near(start) || is_near(end) || !curves.is_alone(number) {
            return None;
        }
        let piece = curves.pieces.get(number)?;
        let (track, course) = self.strand(piece.scratch)?;
        if !course.is_constant() {
            return None;
        }
        let (at, origin) = foot_on_line(start, end, DVec2::ZERO);
        let place = course.value(at);
        let profile = track.profile(place);
        Some(Hit {
            track,
            place,
            ends_mm: profile.ends().map(f64::from),
            profile,
            scratch: piece.scratch,
            at,
            line: CenterLine::even(origin, travel),
            parting: [[start, travel], [end, travel]],
            part: None,
            piece: number,
            alone: 1.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Metal;
    use crate::formation::{Material, Tool};
    use crate::pattern::{
        Candidates, Footprint, Frame, Key, Metric, Path, PatternBuilder, Region, Scratch,
        SurfacePoint,
    };
    use core::ops::ControlFlow;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    fn pattern(points: &[[f64; 2]], force_kgf: f64) -> Pattern {
        let material = Material::metal(Metal::Steel);
        let mut builder = PatternBuilder::new(material, 1.0, [100.0, 60.0]).unwrap();
        let tool = Tool::rockwell_c();
        let scratch = Scratch {
            path: Path::Polyline(points),
            keys: &[Key::force(0.0, 1.0), Key::force(1.0, force_kgf)],
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
        // A neighbour in memory, far away.
        let far = [[5.0, 5.0], [5.0, 6.0]];
        let neighbour = Scratch {
            path: Path::Polyline(&far),
            ..scratch
        };
        builder.add(&neighbour).unwrap();
        builder.build()
    }

    /// What is told of a piece sooner is what is told of all pieces: of those that bend, change or end nearby nothing.
    #[test]
    fn tells_what_is_told_of_all() {
        let mut rng = StdRng::seed_from_u64(5);
        let (mut told, mut untold) = (0, 0);
        for i in 0..300 {
            let points: Vec<[f64; 2]> = (0..if i % 4 == 0 { 3 } else { 2 })
                .map(|_| [rng.random(), rng.random()])
                .collect();
            let pattern = pattern(&points, if i % 5 == 0 { 2.0 } else { 1.0 });
            let on = DVec2::from(points[0]).lerp(points[1].into(), rng.random_range(-0.02..1.02));
            let mut off = || rng.random_range(-0.1..0.1);
            let point = SurfacePoint {
                uv: [on.x + 0.01 * off(), on.y + 0.01 * off()],
                dp_du: [100.0, 0.0, 0.0],
                dp_dv: [7.0, 60.0, 0.0],
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Point,
            };
            let metric = Metric::at(&point, &Frame::at(&point).unwrap(), 1.0).unwrap();
            let footprint = Region::parallelogram(DVec2::new(0.3, off()), DVec2::new(off(), 0.4));
            let reach = Reach::new(&metric, &footprint, 0.3);
            let Some(hit) = pattern.only_run(0, &reach) else {
                untold += 1;
                continue;
            };
            let (mut candidates, mut all) = (Candidates::new(), Vec::new());
            candidates.push(0);
            pattern.for_each_run(&candidates, &reach, 0.0, &mut |hit| {
                all.push(*hit);
                ControlFlow::Continue(())
            });
            assert_eq!(all.len(), 1, "runs of one line");
            let [ours, theirs] = [hit, all[0]].map(|hit| {
                assert!(hit.part.is_none(), "a part of the footprint");
                let numbers = [hit.place, hit.at, hit.ends_mm[0], hit.ends_mm[1], hit.alone];
                (
                    numbers,
                    hit.parting,
                    hit.line.origin,
                    hit.line.travel,
                    (hit.piece, hit.scratch, hit.profile.vertex_count),
                )
            });
            assert_eq!(ours, theirs, "{point:?}");
            told += 1;
        }
        assert!(told > 100 && untold > 50, "{told} told, {untold} not");
    }
}
