//! A curve in space carried onto a mesh: places along its projection, run by run.

use super::project::Spot;
use super::route::Route;
use super::{Joint, Surface};
use crate::error::{Error, Result};
use crate::pattern::spline::{Cubic, Spline};
use glam::{DVec2, DVec3};

/// Places along a path without a seam, corner or crease between them.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub samples: Vec<Sample>,
    /// It starts in texture space where the run before it ends.
    pub joins: bool,
}

/// A place along a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Arc length from the path's start, on the mesh, scene units.
    pub s: f64,
    pub uv: DVec2,
    pub triangle: u32,
}

/// Samples are at most this far apart, in units of the mean triangle's size.
const STEP: f64 = 0.25;
/// Between two samples the drawn curve turns by no more than this, radians.
const STEP_TURN_RAD: f64 = 0.02;
/// Most samples of one cubic of the drawn curve.
const MOST_SAMPLES: f64 = 20_000.0;
/// A path that strays no further beyond the border, in units of a triangle's size, follows it.
const ALONG_BORDER: f64 = 0.1;
/// Between two samples the projection strays no further from a straight line, in units of the mean triangle's size, where
/// that is more than the mesh itself leaves open: at a sharp edge it may turn where the drawn curve does not.
const STRAY: f64 = 1e-3;
/// A step is halved no more often for that.
const MOST_HALVINGS: u32 = 7;
/// Where the drawn curve turns by more than this between two of its cubics it has a corner, radians.
const CORNER_RAD: f64 = 1e-3;

/// The runs of a drawn curve's projection, and whether it closes without a corner.
pub(crate) fn trace(surface: &Surface, spline: &Spline<'_, 3>) -> Result<(Vec<Run>, bool)> {
    let cubics = spline.cubics("points_xyz", [1.0; 3])?;
    let mut cubics: Vec<[DVec3; 4]> = cubics
        .iter()
        .map(|c: &Cubic<3>| c.map(DVec3::from))
        .collect();
    cubics.retain(|c| c.iter().any(|&p| p != c[0]));
    let accepted = "points of which two differ, at least";
    if cubics.is_empty() {
        return Err(Error::number("points_xyz", 0.0, accepted));
    }
    let mut tracer = Tracer {
        surface,
        cubics,
        runs: Vec::new(),
        s: 0.0,
    };
    let stretches = tracer.stretches();
    let whole = stretches.len() == 1 && stretches[0].len() == tracer.steps().len();
    for stretch in &stretches {
        tracer.follow(stretch);
    }
    let closes = spline.closed && whole;
    let mut runs = tracer.runs;
    // A run of one place has no length; the next joins what was before it if both do.
    let mut joins = true;
    runs.retain_mut(|run| {
        run.joins &= joins;
        joins = run.samples.len() > 1 || run.joins;
        run.samples.len() > 1
    });
    let (Some(first), Some(last)) = (runs.first(), runs.last()) else {
        let accepted = "a path of which some length is over the surface";
        return Err(Error::text("points_xyz", "off the surface", accepted));
    };
    let gap = first.samples[0].uv - last.samples[last.samples.len() - 1].uv;
    let meets = surface.in_space(first.samples[0].triangle, gap) < 1e-6 * surface.size;
    runs[0].joins = closes && meets;
    let cubics = &tracer.cubics;
    let smooth = !corner(&cubics[cubics.len() - 1], &cubics[0]);
    let smooth = runs[0].joins && smooth;
    Ok((runs, smooth))
}

struct Tracer<'a> {
    surface: &'a Surface,
    cubics: Vec<[DVec3; 4]>,
    runs: Vec<Run>,
    s: f64,
}

/// A parameter of the drawn curve (the cubic's number and the share of it), and its projection.
type Step = (f64, Spot);

impl Tracer<'_> {
    fn at(&self, t: f64) -> DVec3 {
        let (i, t) = self.locate(t);
        let [a, b, c, d] = self.cubics[i];
        let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
        ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count of cubics"
    )]
    fn locate(&self, t: f64) -> (usize, f64) {
        let i = (t as usize).min(self.cubics.len() - 1);
        (i, t - i as f64)
    }

    /// Parameters at which to look.
    fn steps(&self) -> Vec<f64> {
        let mut steps = vec![0.0];
        for (i, cubic) in self.cubics.iter().enumerate() {
            let [a, b, c, d] = *cubic;
            let legs = [b - a, c - b, d - c];
            let length: f64 = legs.iter().map(|leg| leg.length()).sum();
            let turn = |from: DVec3, to: DVec3| {
                let both = from.length() * to.length();
                if both > 0.0 {
                    from.angle_between(to)
                } else {
                    0.0
                }
            };
            let turn = turn(legs[0], legs[1]) + turn(legs[1], legs[2]);
            let count = (length / (STEP * self.surface.size))
                .max(turn / STEP_TURN_RAD)
                .clamp(4.0, MOST_SAMPLES)
                .ceil();
            let shares = (1..).map(f64::from).take_while(|&k| k <= count);
            steps.extend(shares.map(|k| i as f64 + k / count));
        }
        steps
    }

    /// The steps whose projection is on the mesh, stretch by stretch; each ends where the curve leaves it.
    fn stretches(&self) -> Vec<Vec<Step>> {
        let project = |t: f64| self.surface.project(self.at(t)).map(|spot| (t, spot));
        let steps: Vec<Step> = self.steps().into_iter().filter_map(project).collect();
        let over = |step: &Step| step.1.beyond < 1e-6;
        let mut stretches: Vec<Vec<Step>> = vec![Vec::new()];
        let mut before: Option<Step> = None;
        for group in steps.chunk_by(|a, b| over(a) == over(b)) {
            let strays = group.iter().any(|step| step.1.beyond > ALONG_BORDER);
            if strays {
                if let (Some(last), Some(stretch)) = (before, stretches.last_mut()) {
                    stretch.extend(self.border(last, group[0]));
                }
                stretches.push(Vec::new());
            } else if let Some(stretch) = stretches.last_mut() {
                if let (true, Some(last)) = (stretch.is_empty(), before) {
                    stretch.extend(self.border(group[0], last));
                }
                stretch.extend(group);
            }
            before = group.last().copied();
        }
        stretches.retain(|stretch| stretch.len() > 1);
        stretches
    }

    /// Where the curve leaves the mesh between a step on it and one beyond its border.
    fn border(&self, mut on: Step, mut beyond: Step) -> Option<Step> {
        for _ in 0..50 {
            let t = 0.5 * (on.0 + beyond.0);
            let spot = self.surface.project(self.at(t))?;
            if spot.beyond < 1e-6 {
                on = (t, spot);
            } else {
                beyond = (t, spot);
            }
        }
        Some(on)
    }

    /// Follows the projection from step to step.
    fn follow(&mut self, stretch: &[Step]) {
        self.begin(stretch[0].1, stretch[0].1.uv, false);
        let mut last = stretch[0];
        for &step in &stretch[1..] {
            last = self.refine(last, step, MOST_HALVINGS);
            let (t, spot) = last;
            let (i, share) = self.locate(t);
            if share == 0.0 && i > 0 && corner(&self.cubics[i - 1], &self.cubics[i]) {
                self.begin(spot, spot.uv, true);
            }
        }
    }

    fn begin(&mut self, spot: Spot, uv: DVec2, joins: bool) {
        let sample = Sample {
            s: self.s,
            uv,
            triangle: spot.triangle,
        };
        self.runs.push(Run {
            samples: vec![sample],
            joins,
        });
    }

    /// The run goes on, to a place `length` further.
    fn push(&mut self, length: f64, uv: DVec2, triangle: u32) {
        self.s += length;
        let s = self.s;
        let nearest = 1e-9 * self.surface.size;
        if let Some(run) = self.runs.last_mut() {
            let samples = &mut run.samples;
            let last = samples.len() - 1;
            let sample = Sample { s, uv, triangle };
            if s - samples[last].s > nearest {
                samples.push(sample);
            } else if last > 0 {
                samples[last] = sample;
            }
        }
    }

    /// From one step to the next, by halves while the projection bends between them. Returns the step as it was
    /// taken: a place on an edge stays with the triangle that it was reached in.
    fn refine(&mut self, from: Step, to: Step, halvings: u32) -> Step {
        let t = 0.5 * (from.0 + to.0);
        if let (true, Some(spot)) = (halvings > 0, self.surface.project(self.at(t))) {
            let middle = 0.5 * (from.1.point + to.1.point);
            let slack = |step: &Step| self.surface.triangle(step.1.triangle).slack;
            let allowed = (STRAY * self.surface.size)
                .max(slack(&from))
                .max(slack(&to));
            if spot.point.distance(middle) > allowed {
                let half = self.refine(from, (t, spot), halvings - 1);
                return self.refine(half, to, halvings - 1);
            }
        }
        let to = (to.0, self.surface.seen_from(from.1.triangle, &to.1));
        self.advance(from, to);
        to
    }

    /// From one step to the next, looking closer until all that is between is smooth or known to the digit.
    fn advance(&mut self, mut from: Step, to: Step) {
        loop {
            if let Some(route) = self.plain(&from, &to) {
                self.push(route.length, to.1.uv, to.1.triangle);
                return;
            }
            let (mut near, mut far) = (from, to);
            while far.0 - near.0 > 1e-12 * far.0.max(1.0)
                && near.1.point.distance(far.1.point) > 1e-7 * self.surface.size
            {
                let t = 0.5 * (near.0 + far.0);
                let Some(spot) = self.surface.project(self.at(t)) else {
                    break;
                };
                if t <= near.0 || t >= far.0 {
                    break;
                }
                if self.plain(&from, &(t, spot)).is_some() {
                    near = (t, spot);
                } else {
                    far = (t, spot);
                }
            }
            if let Some(route) = self.plain(&from, &near) {
                self.push(route.length, near.1.uv, near.1.triangle);
            }
            self.cross(&near.1, &far.1);
            if far.0 >= to.0 {
                return;
            }
            from = far;
        }
    }

    /// The route between two steps if it is smooth and no detour.
    fn plain(&self, from: &Step, to: &Step) -> Option<Route> {
        let drawn = self.at(from.0).distance(self.at(to.0));
        let direct = |route: &Route| {
            route.is_smooth() && route.length <= 3.0 * drawn + 1e-6 * self.surface.size
        };
        self.surface.route(&from.1, &to.1).filter(direct)
    }

    /// Over a seam or crease, or across the mesh where the closest point leaps.
    fn cross(&mut self, from: &Spot, to: &Spot) {
        let leaps = from.point.distance(to.point) > 0.01 * self.surface.size;
        if leaps {
            self.begin(*from, from.uv, true);
        }
        if let Some(route) = self.surface.route(from, to) {
            let mut last = from.point;
            for crossing in route.crossings {
                self.push(
                    last.distance(crossing.point),
                    crossing.uv[0],
                    self.runs
                        .last()
                        .map_or(0, |run| run.samples[run.samples.len() - 1].triangle),
                );
                if crossing.joint != Joint::Smooth {
                    let spot = Spot {
                        triangle: crossing.triangle,
                        ..*to
                    };
                    self.begin(spot, crossing.uv[1], crossing.joint == Joint::Crease);
                }
                last = crossing.point;
            }
            self.push(last.distance(to.point), to.uv, to.triangle);
        } else {
            let gap = self.surface.in_space(to.triangle, to.uv - from.uv);
            self.begin(*to, to.uv, gap < 1e-6 * self.surface.size);
        }
        if leaps {
            self.begin(*to, to.uv, true);
        }
    }
}

impl Surface {
    /// How long a step in (u, v) is in space.
    fn in_space(&self, triangle: u32, step: DVec2) -> f64 {
        self.triangle(triangle).in_space(step).length()
    }
}

/// Whether a curve turns sharply from one cubic to the next.
fn corner(one: &[DVec3; 4], next: &[DVec3; 4]) -> bool {
    let apart = |p: DVec3, q: DVec3| (q != p).then(|| (q - p).normalize());
    let [a, b, c, d] = *one;
    let into = apart(c, d).or(apart(b, d)).or(apart(a, d));
    let [a, b, c, d] = *next;
    let out = apart(a, b).or(apart(a, c)).or(apart(a, d));
    match (into, out) {
        (Some(into), Some(out)) => into.distance(out) > CORNER_RAD,
        _ => false,
    }
}
