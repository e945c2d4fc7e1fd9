//! A scratch's facets: rails along its path at each vertex of its cross-section, joined between stations.

use super::patches::{Patches, Skins, Strip};
use crate::error::Result;
use crate::formation::End;
use crate::pattern::Pattern;
use crate::pattern::closest::{
    LengthShares, bezier, end_tangent, end_tangents, speed, start_tangent, tangent,
};
use crate::pattern::course::Course;
use crate::pattern::pieces::{bounds, sagitta};
use crate::pattern::runs::halving;
use crate::pattern::track::MOST_VERTICES;
use crate::pattern::tracks::TrackRef;
use glam::{DVec2, DVec3};

/// Between two breaks of its course a piece is halved so often at most.
const MOST_HALVINGS: u32 = 14;

/// Stations that lean less, in mm along per mm across, stand square: pieces meet there without a corner.
const LEAST_SKEW: f64 = 1e-6;

/// A piece of a scratch, in mm.
struct Piece<'p> {
    control: [DVec2; 4],
    /// Shares of the path's arc length at its ends.
    at: [f64; 2],
    lengths: LengthShares,
    track: TrackRef<'p>,
    course: Course<'p>,
    /// At its ends: what it is cut across by, unlike its own direction at a corner.
    parting: [DVec2; 2],
}

/// The cross-section at a place of a piece, where it stands in space.
#[derive(Clone, Debug)]
struct Station {
    t: f64,
    rails: Vec<DVec3>,
}

impl Pattern {
    /// Adds the facets of a scratch and of its ends.
    pub(super) fn add_patches(
        &self,
        scratch: u32,
        tolerance_mm: f64,
        patches: &mut Patches,
    ) -> Result<()> {
        let Some((track, _)) = self.strand(scratch) else {
            return Ok(());
        };
        let skins = patches.skins(scratch, &track);
        let [first, last] = self.pieces_of(scratch);
        for number in first..=last {
            let Some(piece) = self.piece(scratch, number) else {
                continue;
            };
            if self.is_far(&piece, patches) {
                continue;
            }
            if let Some(cap) = self.cap_at(number, End::Start) {
                let (point, travel) = (piece.control[0], piece.parting[0]);
                patches.push_fan(&cap, End::Start, point, travel, &skins)?;
            }
            piece.add_to(patches, &skins, tolerance_mm)?;
            if let Some(cap) = self.cap_at(number, End::Stop) {
                let (point, travel) = (piece.control[3], piece.parting[1]);
                patches.push_fan(&cap, End::Stop, point, travel, &skins)?;
            }
        }
        Ok(())
    }

    fn piece(&self, scratch: u32, number: usize) -> Option<Piece<'_>> {
        let curves = self.curves();
        let (track, course) = self.strand(scratch)?;
        let [first, last] = self.pieces_of(scratch);
        let scale = self.mm_per_scene_unit * self.units_per_uv;
        let control_of = |number: usize| curves.control(number).map(|uv| uv * scale);
        let is_joined = |number: usize| curves.pieces.get(number).is_some_and(|p| p.is_joined());
        let control = control_of(number);
        let own = end_tangents(&control);
        let before = if number == first { last } else { number - 1 };
        let next = if number == last { first } else { number + 1 };
        let mut parting = own;
        if is_joined(number) {
            let arriving = end_tangent(&control_of(before));
            parting[0] = halving(arriving, own[0]).unwrap_or(own[0]);
        }
        if is_joined(next) {
            let leaving = start_tangent(&control_of(next));
            parting[1] = halving(own[1], leaving).unwrap_or(own[1]);
        }
        Some(Piece {
            control,
            at: curves.at(number),
            lengths: LengthShares::of(&control),
            track,
            course,
            parting,
        })
    }

    /// Whether neither the piece nor a cap at its end reaches the window.
    fn is_far(&self, piece: &Piece<'_>, patches: &Patches) -> bool {
        let own = end_tangents(&piece.control);
        let mitre = [0, 1].map(|i| 1.0 / own[i].dot(piece.parting[i]).max(0.01));
        let reach = f64::from(self.extent.half_width_mm) * mitre[0].max(mitre[1]);
        let [low, high] = bounds(&piece.control);
        patches.window.misses(low - reach, high + reach)
    }
}

impl Piece<'_> {
    fn add_to(&self, patches: &mut Patches, skins: &Skins, tolerance_mm: f64) -> Result<()> {
        let mut stations: Vec<Station> = Vec::new();
        for t in self.breaks() {
            let next = self.station(t);
            if let Some(last) = stations.last().cloned() {
                self.refine(
                    &last,
                    &next,
                    patches,
                    tolerance_mm,
                    MOST_HALVINGS,
                    &mut stations,
                );
            }
            stations.push(next);
        }
        for pair in stations.windows(2) {
            let travel = tangent(&self.control, 0.5 * (pair[0].t + pair[1].t));
            let strip = Strip {
                from: &pair[0].rails,
                to: &pair[1].rails,
                travel,
                skipped: 0,
            };
            patches.push(&strip, skins)?;
        }
        Ok(())
    }

    /// Parameters, ascending from 0 to 1, between which vertices of the cross-section run evenly in arc length.
    fn breaks(&self) -> Vec<f64> {
        let [from, to] = self.at;
        let mut at = Vec::new();
        for [[at_a, a], [at_b, b]] in self.course.turns(from, to) {
            at.push(at_b);
            let values = (0..self.track.station_count()).map(|i| self.track.station_at(i));
            let between = values.filter(|value| *value > a.min(b) && *value < a.max(b));
            at.extend(between.map(|value| at_a + (at_b - at_a) * (value - a) / (b - a)));
        }
        let inner = at.into_iter().filter(|at| *at > from && *at < to);
        let parameter = |at: f64| self.lengths.parameter((at - from) / (to - from));
        let mut breaks: Vec<f64> = inner.map(parameter).chain([0.0, 1.0]).collect();
        if sagitta(&self.control) > 0.0 {
            // The middle of an S lies on its chord.
            breaks.push(0.5);
        }
        breaks.sort_unstable_by(f64::total_cmp);
        breaks.dedup_by(|b, a| *b - *a < 1e-9);
        // The end may have had a neighbour too.
        if let Some(last) = breaks.last_mut() {
            *last = 1.0;
        }
        breaks
    }

    /// Appends stations between two, without them, until rails run straight enough.
    fn refine(
        &self,
        a: &Station,
        b: &Station,
        patches: &Patches,
        tolerance_mm: f64,
        halvings: u32,
        stations: &mut Vec<Station>,
    ) {
        let middle = self.station(0.5 * (a.t + b.t));
        if halvings == 0 || is_straight(a, &middle, b, tolerance_mm) || out_of(a, b, patches) {
            return;
        }
        self.refine(a, &middle, patches, tolerance_mm, halvings - 1, stations);
        stations.push(middle.clone());
        self.refine(&middle, b, patches, tolerance_mm, halvings - 1, stations);
    }

    fn station(&self, t: f64) -> Station {
        let skews = [0, 1].map(|end| self.skew(end));
        let skew = skews[0] + t * (skews[1] - skews[0]);
        let rails = if t <= 0.0 || t >= 1.0 {
            self.parted(usize::from(t >= 1.0))
        } else if skew.abs() < LEAST_SKEW {
            self.section(t).map(|x_z| self.place(t, x_z)).collect()
        } else {
            // Rails keep their distance from the centre line up to where two pieces meet at a corner, the inner ones
            // meet earlier: so stations lean more and more towards it.
            let per_mm = skew / speed(&self.control, t);
            let leaning = self.section(t).enumerate().map(|(i, [x, _])| {
                let t = t + x * per_mm;
                let x_z = self.section(t).nth(i).unwrap_or_default();
                self.place(t, x_z)
            });
            leaning.collect()
        };
        Station { t, rails }
    }

    /// The station at an end.
    fn parted(&self, end: usize) -> Vec<DVec3> {
        let t = [0.0, 1.0][end];
        let point = bezier(&self.control, t);
        let across = self.across(end);
        let rail = |[x, z]: [f64; 2]| (point + across * x).extend(z);
        self.section(t).map(rail).collect()
    }

    /// Where rails end, per mm to the right of an end of the path.
    fn across(&self, end: usize) -> DVec2 {
        let parting = self.parting[end];
        let own = end_tangents(&self.control)[end];
        DVec2::new(parting.y, -parting.x) / own.dot(parting)
    }

    /// How much farther along a rail ends per mm to the right.
    fn skew(&self, end: usize) -> f64 {
        end_tangents(&self.control)[end].dot(self.across(end))
    }

    /// The cross-section's vertices.
    fn section(&self, t: f64) -> impl Iterator<Item = [f64; 2]> + use<> {
        let [from, to] = self.at;
        let at = match t {
            t if t <= 0.0 => from,
            t if t >= 1.0 => to,
            t => from + (to - from) * self.lengths.at(t),
        };
        let (mut xs, mut zs) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
        let profile = self.track.profile(self.course.value(at));
        profile.sample(&mut xs, &mut zs);
        let vertices = xs.into_iter().zip(zs).take(profile.vertex_count);
        vertices.map(|(x, z)| [f64::from(x), f64::from(z)])
    }

    /// A vertex of the cross-section in space; before the piece and after it as if it went on straight.
    fn place(&self, t: f64, [x, z]: [f64; 2]) -> DVec3 {
        let on = t.clamp(0.0, 1.0);
        let travel = tangent(&self.control, on);
        let beyond = (t - on) * speed(&self.control, on) * travel;
        let point = bezier(&self.control, on) + beyond;
        (point + DVec2::new(travel.y, -travel.x) * x).extend(z)
    }
}

/// Whether rails between two stations, and the facets between rails, stray so little from what they stand for.
fn is_straight(a: &Station, middle: &Station, b: &Station, tolerance_mm: f64) -> bool {
    let rails = || a.rails.iter().zip(&middle.rails).zip(&b.rails);
    let strays = |((a, middle), b): ((&DVec3, &DVec3), &DVec3)| {
        (0.5 * (*a + *b)).distance(*middle) > tolerance_mm
    };
    let twist = |k: usize| {
        let (p, q) = (&a.rails[k..k + 2], &b.rails[k..k + 2]);
        // From one diagonal's middle to the other's: the two triangles of a facet and the even one between its rails
        // are half of that apart.
        let apart = 0.5 * (p[0] + q[1]) - 0.5 * (p[1] + q[0]);
        let normal = (q[1] - p[0]).cross(q[0] - p[1]).normalize_or_zero();
        0.5 * apart.dot(normal).abs() > tolerance_mm
    };
    !rails().any(strays) && !(0..a.rails.len().saturating_sub(1)).any(twist)
}

/// Whether what lies between two stations is so far from the window that it need not be known well.
fn out_of(a: &Station, b: &Station, patches: &Patches) -> bool {
    let all = || a.rails.iter().chain(&b.rails).map(|p| p.truncate());
    let low = all().fold(DVec2::INFINITY, DVec2::min);
    let high = all().fold(DVec2::NEG_INFINITY, DVec2::max);
    // No arc of a piece, which turns half a radian at most, lies as far as its chord's length beside it.
    let slack = high - low;
    patches.window.misses(low - slack, high + slack)
}
