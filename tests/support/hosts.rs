//! Base BRDFs as a host might have: Lambert's and GGX's over again, in double precision.

#![allow(dead_code, reason = "each test file uses its own part of this")]

use std::f64::consts::{PI, TAU};
use striae::brdf::{Brdf, HostBrdf, Hosted, Lobe};

type Direction = [f64; 3];

/// Perfectly diffuse.
pub(crate) struct Matt {
    pub albedo: [f32; 3],
}

/// GGX microfacets (Walter et al. 2007) with height-correlated masking (Heitz 2014).
pub(crate) struct Satin {
    /// Across the scratch and along it.
    pub alphas: [f32; 2],
    /// A conductor's eta and k; without, the microfacets are perfect mirrors.
    pub eta_k: Option<([f32; 3], [f32; 3])>,
}

/// To be used in a material.
pub(crate) fn hosted(brdf: impl HostBrdf) -> Brdf {
    Brdf::Hosted(Hosted::new(brdf).unwrap())
}

/// What a host says where it errs: whatever is in here.
pub(crate) struct Odd {
    pub f: [f32; 3],
    pub light: Option<[f32; 3]>,
    pub pdf: f32,
}

impl HostBrdf for Matt {
    fn eval(&self, _: [f32; 3], light: [f32; 3]) -> [f32; 3] {
        let cos = f64::from(light[2]);
        self.albedo
            .map(|channel| single(f64::from(channel) * cos / PI))
    }

    fn sample(&self, u: [f32; 2], _: [f32; 3]) -> Option<[f32; 3]> {
        let [u, v] = u.map(f64::from);
        let (sin, cos) = (TAU * u).sin_cos();
        let light = [v.sqrt() * cos, v.sqrt() * sin, (1.0 - v).sqrt()];
        Some(light.map(single))
    }

    fn pdf(&self, _: [f32; 3], light: [f32; 3]) -> f32 {
        single(f64::from(light[2]).max(0.0) / PI)
    }

    fn lobe(&self) -> Lobe {
        Lobe::Diffuse
    }

    fn alphas(&self) -> [f32; 2] {
        [1.0; 2]
    }
}

impl Satin {
    /// How much longer a slope is than a unit of height, in widths.
    fn stretched(&self, [x, y, z]: Direction) -> Direction {
        let [across, along] = self.alphas.map(f64::from);
        [x * across, y * along, z]
    }

    fn distribution(&self, [x, y, z]: Direction) -> f64 {
        let [across, along] = self.alphas.map(f64::from);
        let sum = (x / across).powi(2) + (y / along).powi(2) + z * z;
        1.0 / (PI * across * along * sum * sum)
    }

    /// Smith's lambda.
    fn lambda(&self, w: Direction) -> f64 {
        let [x, y, z] = self.stretched(w);
        0.5 * ((x * x + y * y + z * z).sqrt() / z - 1.0)
    }

    /// The Fresnel equations in complex numbers, unpolarised.
    fn reflectance(&self, cos: f64) -> [f64; 3] {
        let Some((eta, k)) = self.eta_k else {
            return [1.0; 3];
        };
        [0, 1, 2].map(|channel| {
            let (eta, k) = (f64::from(eta[channel]), f64::from(k[channel]));
            // cos of the refracted ray times the index: the root of (eta + i k)² - sin².
            let (re, im) = (eta * eta - k * k - 1.0 + cos * cos, 2.0 * eta * k);
            let length = re.hypot(im);
            let (a, b) = (
                (0.5 * (length + re)).max(0.0).sqrt(),
                (0.5 * (length - re)).max(0.0).sqrt(),
            );
            let s = ((a - cos).powi(2) + b * b) / ((a + cos).powi(2) + b * b);
            let (n_re, n_im) = ((eta * eta - k * k) * cos, 2.0 * eta * k * cos);
            let p = ((n_re - a).powi(2) + (n_im - b).powi(2))
                / ((n_re + a).powi(2) + (n_im + b).powi(2));
            0.5 * (s + p)
        })
    }
}

impl HostBrdf for Satin {
    fn eval(&self, view: [f32; 3], light: [f32; 3]) -> [f32; 3] {
        let [view, light] = [view, light].map(|w| w.map(f64::from));
        let half = unit([0, 1, 2].map(|i| view[i] + light[i]));
        let seen = 1.0 / (1.0 + self.lambda(view) + self.lambda(light));
        let lobe = self.distribution(half) * seen / (4.0 * view[2]);
        self.reflectance(dot(view, half))
            .map(|share| single(share * lobe))
    }

    fn sample(&self, u: [f32; 2], view: [f32; 3]) -> Option<[f32; 3]> {
        let ([u, v], view) = (u.map(f64::from), view.map(f64::from));
        // Spherical caps (Dupuy and Benyoub 2023).
        let smooth = unit(self.stretched(view));
        let z = (1.0 - v) * (1.0 + smooth[2]) - smooth[2];
        let sin = (1.0 - z * z).max(0.0).sqrt();
        let (y, x) = (TAU * u).sin_cos();
        let cap = [sin * x + smooth[0], sin * y + smooth[1], z + smooth[2]];
        let half = unit(self.stretched(cap));
        let along = 2.0 * dot(view, half);
        Some([0, 1, 2].map(|i| single(along * half[i] - view[i])))
    }

    fn pdf(&self, view: [f32; 3], light: [f32; 3]) -> f32 {
        let [view, light] = [view, light].map(|w| w.map(f64::from));
        let half = unit([0, 1, 2].map(|i| view[i] + light[i]));
        // Lights below the zone count too: samples may go there.
        if half[2] <= 0.0 {
            return 0.0;
        }
        single(self.distribution(half) / (4.0 * view[2] * (1.0 + self.lambda(view))))
    }

    fn lobe(&self) -> Lobe {
        Lobe::Glossy
    }

    fn alphas(&self) -> [f32; 2] {
        self.alphas
    }
}

impl HostBrdf for Odd {
    fn eval(&self, _: [f32; 3], _: [f32; 3]) -> [f32; 3] {
        self.f
    }

    fn sample(&self, _: [f32; 2], _: [f32; 3]) -> Option<[f32; 3]> {
        self.light
    }

    fn pdf(&self, _: [f32; 3], _: [f32; 3]) -> f32 {
        self.pdf
    }

    fn lobe(&self) -> Lobe {
        Lobe::Glossy
    }

    fn alphas(&self) -> [f32; 2] {
        [0.5; 2]
    }
}

fn dot(a: Direction, b: Direction) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: Direction) -> Direction {
    let length = dot(a, a).sqrt();
    a.map(|component| component / length)
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
fn single(value: f64) -> f32 {
    value as f32
}
