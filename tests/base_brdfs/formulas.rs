//! Values against the formulas as their papers write them, angles and all.

use super::{Direction, any_direction, dot, facet, single, tilted, unit};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::f64::consts::PI;
use striae::brdf::{Brdf, Fresnel, Metal};

/// A pair above a facet, as formulas see it.
struct Angles {
    l: Direction,
    v: Direction,
    h: Direction,
}

impl Angles {
    fn of(l: Direction, v: Direction) -> Self {
        let h = unit([0, 1, 2].map(|i| l[i] + v[i]));
        Self { l, v, h }
    }
}

/// tan² of a direction's zenith angle over the width's square at its azimuth.
fn scaled_tan2(w: Direction, [across, along]: [f64; 2]) -> f64 {
    let (zenith, azimuth) = (w[2].min(1.0).acos(), w[1].atan2(w[0]));
    zenith.tan().powi(2) * ((azimuth.cos() / across).powi(2) + (azimuth.sin() / along).powi(2))
}

/// Heitz 2014, equations 85, 86 and 99.
fn ggx(pair: &Angles, alphas: [f64; 2]) -> f64 {
    let [across, along] = alphas;
    let cos = pair.h[2];
    let d = 1.0 / (PI * across * along * cos.powi(4) * (1.0 + scaled_tan2(pair.h, alphas)).powi(2));
    let lambda = |w: Direction| {
        let (zenith, azimuth) = (w[2].acos(), w[1].atan2(w[0]));
        let alpha2 = (azimuth.cos() * across).powi(2) + (azimuth.sin() * along).powi(2);
        let a = 1.0 / (alpha2.sqrt() * zenith.tan());
        0.5 * (-1.0 + (1.0 + 1.0 / (a * a)).sqrt())
    };
    let g = 1.0 / (1.0 + lambda(pair.l) + lambda(pair.v));
    d * g / (4.0 * pair.l[2] * pair.v[2])
}

/// Cook and Torrance 1982, with 4 for pi.
fn cook_torrance(pair: &Angles, m: f64) -> f64 {
    let (n_h, v_h) = (pair.h[2], dot(pair.v, pair.h));
    let tan = n_h.min(1.0).acos().tan();
    let d = (-(tan / m).powi(2)).exp() / (PI * m * m * n_h.powi(4));
    let wall = |n_w: f64| 2.0 * n_h * n_w / v_h;
    let g = wall(pair.v[2]).min(wall(pair.l[2])).min(1.0);
    d * g / (4.0 * pair.l[2] * pair.v[2])
}

/// Fujii 2013: A and B over pi.
fn fujii(pair: &Angles, sigma: f64) -> f64 {
    let scale = PI + (PI / 2.0 - 2.0 / 3.0) * sigma;
    let (a, b) = (1.0 / scale, sigma / scale);
    let s = dot(pair.l, pair.v) - pair.l[2] * pair.v[2];
    let t = if s <= 0.0 {
        1.0
    } else {
        pair.l[2].max(pair.v[2])
    };
    a + b * s / t
}

/// Lafortune and Willems 1994.
fn phong(pair: &Angles, n: f64) -> f64 {
    let mirrored = [-pair.v[0], -pair.v[1], pair.v[2]];
    (n + 2.0) / (2.0 * PI) * dot(mirrored, pair.l).max(0.0).powf(n)
}

fn schlick(f0: f64, cos: f64) -> f64 {
    f0 + (1.0 - f0) * (1.0 - cos).powi(5)
}

/// A complex number, for Fresnel's equations as they stand.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn times(self, by: Self) -> Self {
        Self(self.0 * by.0 - self.1 * by.1, self.0 * by.1 + self.1 * by.0)
    }

    fn plus(self, other: Self, by: f64) -> Self {
        Self(self.0 + by * other.0, self.1 + by * other.1)
    }

    fn norm2(self) -> f64 {
        self.0 * self.0 + self.1 * self.1
    }

    fn sqrt(self) -> Self {
        let (size, angle) = (self.norm2().powf(0.25), 0.5 * self.1.atan2(self.0));
        Self(size * angle.cos(), size * angle.sin())
    }
}

/// Fresnel's equations with a complex index of refraction.
fn conductor(index: Complex, cos: f64) -> f64 {
    let index2 = index.times(index);
    let root = index2.plus(Complex(1.0 - cos * cos, 0.0), -1.0).sqrt();
    let ratio = |a: Complex, b: Complex| a.plus(b, -1.0).norm2() / a.plus(b, 1.0).norm2();
    let across = ratio(Complex(cos, 0.0), root);
    let within = ratio(index2.times(Complex(cos, 0.0)), root);
    0.5 * (across + within)
}

/// How far any of random pairs on a facet is from `truth` (BRDF, RGB), as a share.
fn worst(seed: u64, brdf: Brdf, truth: &dyn Fn(&Angles) -> [f64; 3]) -> f64 {
    let mut random = StdRng::seed_from_u64(seed);
    let mut worst = 0.0_f64;
    for _ in 0..2000 {
        let tilt_deg = random.random_range(-80.0..80.0);
        let facet = facet(brdf, tilt_deg);
        let v = any_direction(&mut random);
        let other = any_direction(&mut random);
        let spread: f64 = 10_f64.powf(random.random_range(-2.0..1.0));
        let l = unit([0, 1, 2].map(|i| [-v[0], -v[1], v[2]][i] + spread * other[i]));
        // As the facet gets them: rounded.
        let [view, light] = [v, l].map(|w| single(tilted(tilt_deg, w)));
        let [v, l] = [view, light].map(|w| unit(tilted(-tilt_deg, w.map(f64::from))));
        let found = facet.eval(view, light).map(f64::from);
        let truth = truth(&Angles::of(l, v));
        for (found, truth) in found.into_iter().zip(truth) {
            let (found, truth) = (found, truth * l[2]);
            worst = worst.max((found - truth).abs() / truth.max(1e-5));
        }
    }
    worst
}

/// GGX, also of polishing lines, is Heitz's.
#[test]
fn ggx_as_published() {
    let f0 = [0.04, 0.5, 1.0_f32];
    let fresnel = Fresnel::Schlick { f0 };
    for (across, along) in [(0.3_f32, 0.3_f32), (0.05, 0.4), (1.0, 0.02), (0.1, 1.0)] {
        let brdf = if across == along {
            Brdf::Ggx {
                alpha: across,
                fresnel,
            }
        } else {
            Brdf::AnisotropicGgx {
                alpha_across: across,
                alpha_along: along,
                fresnel,
            }
        };
        let off = worst(31, brdf, &|pair| {
            let lobe = ggx(pair, [across, along].map(f64::from));
            f0.map(|f0| lobe * schlick(f64::from(f0), dot(pair.v, pair.h)))
        });
        println!("{brdf:?}: {off:.1e}");
        assert!(off < 1e-3, "{brdf:?}: off by {off}");
    }
}

/// Cook-Torrance with a metal's reflectance is theirs, with Fresnel's equations in complex numbers.
#[test]
fn cook_torrance_as_published() {
    let (eta, k) = Metal::Gold.eta_k();
    for alpha in [0.03_f32, 0.2, 0.9] {
        let fresnel = Fresnel::metal(Metal::Gold);
        let off = worst(32, Brdf::CookTorrance { alpha, fresnel }, &|pair| {
            let lobe = cook_torrance(pair, f64::from(alpha));
            let index = |i: usize| Complex(f64::from(eta[i]), f64::from(k[i]));
            [0, 1, 2].map(|i| lobe * conductor(index(i), dot(pair.v, pair.h)))
        });
        println!("alpha {alpha}: {off:.1e}");
        assert!(off < 1e-3, "alpha {alpha}: off by {off}");
    }
}

/// Oren-Nayar is Fujii's, and Phong Lafortune's.
#[test]
fn plain_ones_as_published() {
    let rgb = [0.2_f32, 0.5, 0.9];
    for roughness in [0.1_f32, 0.6, 1.0] {
        let brdf = Brdf::OrenNayar {
            albedo: rgb,
            roughness,
        };
        let off = worst(33, brdf, &|pair| {
            rgb.map(|rgb| f64::from(rgb) * fujii(pair, f64::from(roughness)))
        });
        println!("roughness {roughness}: {off:.1e}");
        assert!(off < 1e-3, "roughness {roughness}: off by {off}");
    }
    for exponent in [1.0_f32, 7.5, 100.0, 5000.0] {
        let brdf = Brdf::Phong {
            specular: rgb,
            exponent,
        };
        let off = worst(34, brdf, &|pair| {
            rgb.map(|rgb| f64::from(rgb) * phong(pair, f64::from(exponent)))
        });
        println!("exponent {exponent}: {off:.1e}");
        assert!(off < 1e-3, "exponent {exponent}: off by {off}");
    }
}
