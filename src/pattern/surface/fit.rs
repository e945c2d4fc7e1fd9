//! Smooth cubics through the places of a run.
//!
//! A mesh's triangles stand for a smooth surface: what their flatness does to a path is taken out again. Each
//! cubic is Hermite's over arc length; values and derivatives at its ends come from a cubic regression over the samples
//! around them, so that neighbouring cubics share them.

use super::Surface;
use super::trace::{Run, Sample};
use crate::pattern::path::Curve;
use glam::{DMat4, DVec2, DVec4};

/// Samples on either side that a derivative is taken from: a triangle and a half, fewer where that turns sharply.
const REACHES: [usize; 3] = [REACH, 3, 1];
const REACH: usize = 6;
/// Cubics may stray from exact samples by this share of the path's length.
const ACCURACY: f64 = 1e-5;
/// One cubic's speed in texture space changes no more than this along it.
const MOST_STRETCH: f64 = 1.1;

/// The curves of these runs. Where the path closes smoothly (`smooth`) its ends share a tangent too.
pub(crate) fn curves(
    surface: &Surface,
    runs: &[Run],
    smooth: bool,
    units_per_uv: DVec2,
) -> Vec<Curve> {
    let whole = runs.last().map_or(0.0, |run| end(run).s);
    let mut curves = Vec::new();
    for (i, run) in runs.iter().enumerate() {
        let before = (smooth && i == 0).then(|| &runs[runs.len() - 1]);
        let after = (smooth && i + 1 == runs.len()).then(|| &runs[0]);
        let fit = Fit::new(surface, run, [before, after], whole, units_per_uv);
        let first = curves.len();
        fit.cover(0, run.samples.len() - 1, &mut curves);
        if let Some(curve) = curves.get_mut(first) {
            curve.joins = run.joins;
        }
    }
    curves
}

fn end(run: &Run) -> &Sample {
    &run.samples[run.samples.len() - 1]
}

struct Fit<'a> {
    surface: &'a Surface,
    /// The run's samples, and those of its neighbours where the path closes.
    all: Vec<Sample>,
    /// Where in `all` the run begins, and its count.
    own: [usize; 2],
    pinned: [bool; 2],
    accuracy: f64,
    units_per_uv: DVec2,
}

/// Value and derivative by arc length at a sample.
type Knot = (DVec2, DVec2);

impl<'a> Fit<'a> {
    fn new(
        surface: &'a Surface,
        run: &Run,
        [before, after]: [Option<&Run>; 2],
        whole: f64,
        units_per_uv: DVec2,
    ) -> Self {
        let mut all = Vec::with_capacity(run.samples.len() + 2 * REACH);
        if let Some(before) = before {
            // All but the last, which is the run's first.
            let count = before.samples.len() - 1;
            let moved = |sample: &Sample| Sample {
                s: sample.s - whole,
                ..*sample
            };
            all.extend(
                before.samples[count.saturating_sub(REACH)..count]
                    .iter()
                    .map(moved),
            );
        }
        let own = [all.len(), run.samples.len()];
        all.extend(&run.samples);
        if let Some(after) = after {
            let moved = |sample: &Sample| Sample {
                s: sample.s + whole,
                ..*sample
            };
            all.extend(after.samples.iter().skip(1).take(REACH).map(moved));
        }
        Self {
            surface,
            all,
            own,
            pinned: [before.is_none(), after.is_none()],
            accuracy: ACCURACY * whole,
            units_per_uv,
        }
    }

    /// Covers samples i to j of the run with as few halvings as it takes.
    fn cover(&self, i: usize, j: usize, curves: &mut Vec<Curve>) {
        let (from, to) = (self.knot(i), self.knot(j));
        let samples = &self.all[self.own[0] + i..=self.own[0] + j];
        let length = samples[j - i].s - samples[0].s;
        if j - i < 2 || self.fits(samples, from, to) {
            let chord = to.0 - from.0;
            let leg = |slope: DVec2| {
                if self.swings(chord, slope * length) {
                    chord / 3.0
                } else {
                    slope * (length / 3.0)
                }
            };
            let control = [from.0, from.0 + leg(from.1), to.0 - leg(to.1), to.0];
            if length > 0.0 {
                curves.push(Curve {
                    control,
                    length,
                    joins: true,
                });
            }
            return;
        }
        let middle = i + (j - i) / 2;
        self.cover(i, middle, curves);
        self.cover(middle, j, curves);
    }

    fn fits(&self, samples: &[Sample], from: Knot, to: Knot) -> bool {
        let [a, b] = [from.1, to.1].map(|d| (d * self.units_per_uv).length());
        if samples.len() > 4 && a.max(b) > MOST_STRETCH * a.min(b) {
            return false;
        }
        let start = samples[0].s;
        let length = samples[samples.len() - 1].s - start;
        let chord = to.0 - from.0;
        if self.swings(chord, from.1 * length) || self.swings(chord, to.1 * length) {
            return false;
        }
        samples.iter().all(|sample| {
            let t = (sample.s - start) / length;
            let (r, t2, t3) = (1.0 - t, t * t, t * t * t);
            let blend = 3.0 * t2 - 2.0 * t3;
            let uv = from.0 * (1.0 - blend) + to.0 * blend + from.1 * (length * t * r * r)
                - to.1 * (length * t2 * r);
            let triangle = self.surface.triangle(sample.triangle);
            let stray = triangle.in_space(uv - sample.uv).length();
            stray <= self.allowed(sample)
        })
    }

    /// Value and derivative at sample i of the run, from the widest neighbourhood that one cubic describes.
    fn knot(&self, i: usize) -> Knot {
        let i = self.own[0] + i;
        let here = self.all[i];
        let mut knot = (here.uv, DVec2::ZERO);
        for reach in REACHES {
            let window = i.saturating_sub(reach)..(i + reach + 1).min(self.all.len());
            let (found, stray) = self.regression(&self.all[window], &here);
            if stray <= 1.0 {
                knot = found;
                break;
            }
            // Nothing describes it: the path turns sharply just here.
            knot = (here.uv, found.1);
        }
        let is_end = [i == self.own[0], i + 1 == self.own[0] + self.own[1]];
        if (is_end[0] && self.pinned[0]) || (is_end[1] && self.pinned[1]) {
            knot.0 = here.uv;
        }
        knot
    }

    /// Whether a curve that sets out at this velocity would swing far out on its way along the chord: at a
    /// pole, say, where texture space tears.
    fn swings(&self, chord: DVec2, velocity: DVec2) -> bool {
        let [chord, velocity] = [chord, velocity].map(|v| (v * self.units_per_uv).length());
        velocity.is_nan() || velocity > 3.0 * chord
    }

    /// How far a sample may be from the curve, scene units.
    fn allowed(&self, sample: &Sample) -> f64 {
        let triangle = self.surface.triangle(sample.triangle);
        self.accuracy.max(triangle.slack)
    }

    /// The cubic with the least squares: its value and derivative here, and how far it strays from the samples, in units
    /// of what is allowed.
    fn regression(&self, samples: &[Sample], here: &Sample) -> (Knot, f64) {
        let away = |sample: &Sample| sample.s - here.s;
        let reach = samples.iter().map(|s| away(s).abs()).fold(0.0, f64::max);
        let degree = (samples.len() - 1).min(3);
        let powers = |sample: &Sample| {
            let x = away(sample) / reach;
            let all = DVec4::new(1.0, x, x * x, x * x * x);
            DVec4::from_array(std::array::from_fn(
                |k| {
                    if k <= degree { all[k] } else { 0.0 }
                },
            ))
        };
        let mut normal = DMat4::ZERO;
        let (mut u, mut v) = (DVec4::ZERO, DVec4::ZERO);
        for sample in samples {
            let powers = powers(sample);
            for k in 0..4 {
                *normal.col_mut(k) += powers * powers[k];
            }
            let offset = sample.uv - here.uv;
            u += powers * offset.x;
            v += powers * offset.y;
        }
        for k in degree + 1..4 {
            normal.col_mut(k)[k] = 1.0;
        }
        let solve = normal.inverse();
        let (u, v) = (solve * u, solve * v);
        let stray = |sample: &Sample| {
            let powers = powers(sample);
            let found = DVec2::new(powers.dot(u), powers.dot(v));
            let triangle = self.surface.triangle(sample.triangle);
            let off = triangle.in_space(found - (sample.uv - here.uv));
            off.length() / self.allowed(sample)
        };
        let value = here.uv + DVec2::new(u.x, v.x);
        let knot = (value, DVec2::new(u.y, v.y) / reach);
        let worst = samples
            .iter()
            .map(stray)
            .fold(0.0, |a: f64, b| if b <= a { a } else { b });
        (knot, worst)
    }
}
