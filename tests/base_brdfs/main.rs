//! Base BRDFs by themselves, on one facet: against textbook formulas, integrals and statistics, all in double precision.

#[path = "../support/chi_square.rs"]
mod chi_square;
mod energy;
mod formulas;
mod grid;
mod hostile;
#[path = "../support/hosts.rs"]
mod hosts;
mod limits;
mod sampling;
mod zones;

use rand::Rng;
use rand::rngs::StdRng;
use striae::brdf::{Brdf, Facet, Fresnel};

/// A direction in the frame (across, along, up) of a scratch, or of a facet.
type Direction = [f64; 3];

const WHITE: Fresnel = Fresnel::Schlick { f0: [1.0; 3] };

fn ggx(alpha: f32) -> Brdf {
    let fresnel = WHITE;
    Brdf::Ggx { alpha, fresnel }
}

fn anisotropic(alpha_across: f32, alpha_along: f32) -> Brdf {
    Brdf::AnisotropicGgx {
        alpha_across,
        alpha_along,
        fresnel: WHITE,
    }
}

fn cook_torrance(alpha: f32) -> Brdf {
    let fresnel = WHITE;
    Brdf::CookTorrance { alpha, fresnel }
}

fn oren_nayar(roughness: f32) -> Brdf {
    let albedo = [1.0; 3];
    Brdf::OrenNayar { albedo, roughness }
}

fn phong(exponent: f32) -> Brdf {
    let specular = [1.0; 3];
    Brdf::Phong { specular, exponent }
}

fn lambert() -> Brdf {
    Brdf::Lambert { albedo: [1.0; 3] }
}

/// White ones of every kind, from mirrors to as rough as can be, and a host's.
fn white() -> Vec<Brdf> {
    let mut all = vec![lambert()];
    all.extend([0.0, 0.4, 1.0].map(oren_nayar));
    all.extend([1.0, 12.0, 300.0, 100_000.0].map(phong));
    all.extend([0.001, 0.05, 0.3, 1.0].map(ggx));
    all.extend([0.001, 0.05, 0.3, 1.0].map(cook_torrance));
    let widths = [(0.05, 0.4), (0.4, 0.05), (1.0, 0.1), (0.02, 0.01)];
    all.extend(widths.map(|(across, along)| anisotropic(across, along)));
    all.push(hosts::hosted(hosts::Matt { albedo: [1.0; 3] }));
    let satin = |alphas| {
        hosts::hosted(hosts::Satin {
            alphas,
            eta_k: None,
        })
    };
    all.extend([[0.05, 0.05], [0.4, 0.1]].map(satin));
    all
}

fn facet(brdf: Brdf, tilt_deg: f64) -> Facet {
    Facet::new(brdf, tilt_deg).unwrap()
}

fn direction(zenith_deg: f64, azimuth_deg: f64) -> Direction {
    let (sin, cos) = zenith_deg.to_radians().sin_cos();
    let (y, x) = azimuth_deg.to_radians().sin_cos();
    [sin * x, sin * y, cos]
}

/// Any direction above a facet, by solid angle.
fn any_direction(random: &mut StdRng) -> Direction {
    let cos: f64 = random.random_range(1e-3..1.0);
    direction(cos.acos().to_degrees(), random.random_range(0.0..360.0))
}

/// From the frame of a facet to that of its scratch: its normal leans across by `tilt_deg`.
fn tilted(tilt_deg: f64, [x, y, z]: Direction) -> Direction {
    let (sin, cos) = tilt_deg.to_radians().sin_cos();
    [x * cos + z * sin, y, z * cos - x * sin]
}

fn dot(a: Direction, b: Direction) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: Direction) -> Direction {
    let length = dot(a, a).sqrt();
    a.map(|component| component / length)
}

fn single(a: Direction) -> [f32; 3] {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    a.map(|component| component as f32)
}
