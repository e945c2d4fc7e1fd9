//! Brute force: one ray per sample, cast at every facet in turn, in double precision.
//!
//! A pixel's filter runs over the macro plane; each sample follows the view ray down to the first facet it
//! meets, then a ray towards the light past all others. Where two neighbouring samples differ in what they
//! hit, the change is found by halving, so that sampling loses only features thinner than one stratum.

use super::{ggx, lambert, single};
use rand::Rng;
use rand::rngs::StdRng;
use striae::brdf::Brdf;
use striae::scattering::{CrossFootprint, Output, Shading};

pub(crate) type Vector = [f64; 3];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn unit(w: [f32; 3]) -> Vector {
    let w = w.map(f64::from);
    w.map(|component| component / dot(w, w).sqrt())
}

/// Lambert, or GGX with height-correlated Smith masking and Schlick's Fresnel factor.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Finish {
    Lambert(f32),
    Ggx(f32, f32),
}

impl Finish {
    pub(crate) fn brdf(self) -> Brdf {
        match self {
            Self::Lambert(albedo) => lambert(albedo),
            Self::Ggx(alpha, f0) => ggx(alpha, f0),
        }
    }

    /// From the textbook: D from the tangent of the half vector, G = 1 / (1 + Λ(l) + Λ(v)).
    pub(crate) fn value(self, n: Vector, l: Vector, v: Vector) -> f64 {
        let (alpha, f0) = match self {
            Self::Lambert(albedo) => return f64::from(albedo) / std::f64::consts::PI,
            Self::Ggx(alpha, f0) => (f64::from(alpha), f64::from(f0)),
        };
        let h = std::array::from_fn(|i| l[i] + v[i]);
        let h: Vector = h.map(|component: f64| component / dot(h, h).sqrt());
        let tan2 = |cos: f64| (1.0 - cos * cos).max(0.0) / (cos * cos);
        let lambda = |cos: f64| 0.5 * ((1.0 + alpha * alpha * tan2(cos)).sqrt() - 1.0);
        let (n_l, n_v, n_h) = (dot(n, l), dot(n, v), dot(n, h));
        let slope = 1.0 + tan2(n_h) / (alpha * alpha);
        let d = 1.0 / (std::f64::consts::PI * alpha * alpha * n_h.powi(4) * slope * slope);
        let fresnel = f0 + (1.0 - f0) * (1.0 - dot(h, v)).powi(5);
        d * fresnel / ((1.0 + lambda(n_l) + lambda(n_v)) * 4.0 * n_l * n_v)
    }
}

/// A cross-section between two flats, as segments from left to right.
pub(crate) struct Caster {
    pub(crate) segments: Vec<[[f64; 2]; 2]>,
    pub(crate) zone: Finish,
    pub(crate) flat: Finish,
}

impl Caster {
    pub(crate) fn new(points: &[[f32; 2]], flat_mm: f64, zone: Finish, flat: Finish) -> Self {
        let mut points: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::from)).collect();
        points.insert(0, [points[0][0] - flat_mm, 0.0]);
        points.push([points[points.len() - 1][0] + flat_mm, 0.0]);
        let segments = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        Self {
            segments,
            zone,
            flat,
        }
    }

    pub(crate) fn normal(&self, k: usize) -> Vector {
        let [a, b] = self.segments[k];
        let (dx, dz) = (b[0] - a[0], b[1] - a[1]);
        [-dz / dx.hypot(dz), 0.0, dx / dx.hypot(dz)]
    }

    /// The highest segment on the view ray through (x, 0) of the macro plane, and where it is met.
    pub(crate) fn seen(&self, x: f64, v: Vector) -> (usize, [f64; 2]) {
        let slope = v[0] / v[2];
        let mut best = (0, [x, f64::NEG_INFINITY]);
        for (k, [a, b]) in self.segments.iter().enumerate() {
            let run = (b[0] - a[0]) - slope * (b[1] - a[1]);
            let s = (x - a[0] + slope * a[1]) / run;
            let z = a[1] + s * (b[1] - a[1]);
            if (0.0..=1.0).contains(&s) && z > best.1[1] {
                best = (k, [x + slope * z, z]);
            }
        }
        best
    }

    /// Whether a ray from `p` on segment `k` in direction `w` meets no other segment.
    pub(crate) fn clear(&self, k: usize, p: [f64; 2], w: Vector) -> bool {
        dot(self.normal(k), w) > 0.0
            && self.segments.iter().enumerate().all(|(j, [a, b])| {
                let (dx, dz) = (b[0] - a[0], b[1] - a[1]);
                let (px, pz) = (p[0] - a[0], p[1] - a[1]);
                let det = dx * w[2] - dz * w[0];
                let along = (px * w[2] - pz * w[0]) / det;
                let distance = (px * dz - pz * dx) / det;
                j == k || !(distance > 0.0 && (0.0..=1.0).contains(&along))
            })
    }

    /// What a lit segment reflects: base BRDF times cosine.
    pub(crate) fn reflected(&self, k: usize, l: Vector, v: Vector) -> f64 {
        let flat = k == 0 || k + 1 == self.segments.len();
        let n = self.normal(k);
        if flat { self.flat } else { self.zone }.value(n, l, v) * dot(n, l)
    }
}

/// A pixel's filter across the scratch: two boxes convolved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Filter {
    pub(crate) center: f64,
    pub(crate) extents: [f64; 2],
}

impl Filter {
    /// The share of the filter left of `x`.
    pub(crate) fn before(self, x: f64) -> f64 {
        let ([a, b], x) = (self.extents, x - self.center);
        let ramp = |x: f64| 0.5 * x.max(0.0).powi(2);
        (ramp(x + 0.5 * (a + b)) - ramp(x + 0.5 * (a - b)) - ramp(x - 0.5 * (a - b))
            + ramp(x - 0.5 * (a + b)))
            / (a * b)
    }

    pub(crate) fn density(self, x: f64) -> f64 {
        let ([a, b], x) = (self.extents, (x - self.center).abs());
        ((0.5 * (a + b) - x).max(0.0) / (a * b)).min(1.0 / a.max(b))
    }
}

pub(crate) const STRATA: u32 = 20000;

/// A pixel by rays.
pub(crate) struct Pixel {
    /// The pixel's BRDF times the cosine between light and normal.
    pub(crate) value: f64,
    /// What a feature thinner than one stratum could add or hide.
    pub(crate) missed: f64,
    /// How much the value changes when all edges move by a share 1 of the cross-section's own extent.
    pub(crate) per_shift: f64,
}

pub(crate) fn cast(caster: &Caster, filter: Filter, l: Vector, v: Vector) -> Pixel {
    let inner = &caster.segments[1..caster.segments.len() - 1];
    let (left, right) = (inner[0][0][0], inner[inner.len() - 1][1][0]);
    let tallest = inner.iter().fold(0.0, |z: f64, s| z.max(s[1][1].abs()));
    // Beyond this, nothing of the cross-section shows and none of its shadow falls.
    let reach = tallest * ((l[0] / l[2]).abs() + (v[0] / v[2]).abs()) + 1e-3 * (right - left);
    let half = 0.5 * (filter.extents[0] + filter.extents[1]);
    let from = (left - reach).max(filter.center - half);
    let to = (right + reach).min(filter.center + half);
    let flat = caster.reflected(0, l, v);
    if from >= to {
        return Pixel {
            value: flat,
            missed: 0.0,
            per_shift: 0.0,
        };
    }
    let label = |x: f64| {
        let (k, p) = caster.seen(x, v);
        (k, caster.clear(k, p, l))
    };
    let value = |(k, lit)| if lit { caster.reflected(k, l, v) } else { 0.0 };

    let stratum = (to - from) / f64::from(STRATA);
    let mut x = from;
    let mut here = label(from);
    let mut sum = flat * (filter.before(from) + 1.0 - filter.before(to));
    let (mut steps, mut brightest) = (0.0, value(here));
    for i in 1..=STRATA {
        let end = from + stratum * f64::from(i);
        let there = label(end);
        while here != there {
            let (mut same, mut other) = (x, end);
            for _ in 0..48 {
                let middle = 0.5 * (same + other);
                *(if label(middle) == here {
                    &mut same
                } else {
                    &mut other
                }) = middle;
            }
            sum += value(here) * (filter.before(other) - filter.before(x));
            let next = if other >= end { there } else { label(other) };
            steps += (value(next) - value(here)).abs() * filter.density(other);
            (x, here) = (other, next);
        }
        sum += value(here) * (filter.before(end) - filter.before(x));
        brightest = brightest.max(value(here));
        x = end;
    }
    Pixel {
        value: sum,
        missed: brightest * stratum * filter.density(filter.center.clamp(from, to)),
        per_shift: steps * (right - left + reach),
    }
}

/// A polyline without overhangs from z = 0 to z = 0, mostly a groove, sometimes anything.
pub(crate) fn any_profile(random: &mut StdRng) -> Vec<[f32; 2]> {
    let count = random.random_range(3..24);
    let width = 10_f64.powf(random.random_range(-3.0..1.0));
    let steepness = random.random_range(0.02..1.0);
    let steps: Vec<f64> = (1..count).map(|_| random.random_range(0.05..1.0)).collect();
    let total: f64 = steps.iter().sum();
    let mut x = -0.5 * width;
    let mut points = vec![[single(x), 0.0]];
    for step in &steps {
        x += width * step / total;
        let z = steepness * width * random.random_range(-0.4..0.3);
        points.push([single(x), single(z)]);
    }
    points[count - 1][1] = 0.0;
    points
}

pub(crate) fn shade(
    points: &[[f32; 2]],
    finishes: [Finish; 2],
    pixel: CrossFootprint,
    l: [f32; 3],
    v: [f32; 3],
    output: Output,
) -> f64 {
    let [zone, flat] = finishes.map(Finish::brdf);
    let mut shading = Shading::default();
    shading
        .shade_cross_section(points, &zone, &flat, pixel, v)
        .unwrap();
    f64::from(shading.eval(l, output)[0])
}
