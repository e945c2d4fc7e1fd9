//! Reflectance of a smooth interface.

use super::Metal;
use crate::error::{Result, rgb_in_range};
use glam::Vec3;

/// How much a microfacet reflects, per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fresnel {
    /// Schlick's approximation (1994) from the reflectance at normal incidence.
    Schlick {
        /// Reflectance at normal incidence, 0 to 1.
        f0: [f32; 3],
    },
    /// The exact Fresnel equations of a conductor, unpolarised.
    Conductor {
        /// Real part of the index of refraction, 0.01 to 20.
        eta: [f32; 3],
        /// Its imaginary part (extinction), 0 to 20.
        k: [f32; 3],
    },
}

impl Fresnel {
    /// A metal's own reflectance.
    pub fn metal(metal: Metal) -> Self {
        let (eta, k) = metal.eta_k();
        Self::Conductor { eta, k }
    }

    pub(crate) fn check(self) -> Result<Self> {
        match self {
            Self::Schlick { f0 } => {
                rgb_in_range("f0", f0, 0.0, 1.0)?;
            }
            Self::Conductor { eta, k } => {
                rgb_in_range("eta", eta, 0.01, 20.0)?;
                rgb_in_range("k", k, 0.0, 20.0)?;
            }
        }
        Ok(self)
    }

    /// Reflectance at an angle whose cosine is `cos` (0 to 1).
    pub(crate) fn reflectance(&self, cos: f32) -> Vec3 {
        match *self {
            Self::Schlick { f0 } => {
                let f0 = Vec3::from(f0);
                let m = 1.0 - cos;
                let m2 = m * m;
                f0 + (Vec3::ONE - f0) * (m2 * m2 * m)
            }
            Self::Conductor { eta, k } => conductor(cos, Vec3::from(eta), Vec3::from(k)),
        }
    }
}

/// The unpolarised Fresnel equations of a conductor in air, all channels at once.
fn conductor(cos: f32, eta: Vec3, k: Vec3) -> Vec3 {
    let cos2 = cos * cos;
    let sin2 = 1.0 - cos2;
    let (eta2, k2) = (eta * eta, k * k);
    let t0 = eta2 - k2 - Vec3::splat(sin2);
    let a2_b2 = (t0 * t0 + 4.0 * eta2 * k2).map(f32::sqrt);
    let t1 = a2_b2 + Vec3::splat(cos2);
    let a = (0.5 * (a2_b2 + t0)).max(Vec3::ZERO).map(f32::sqrt);
    let t2 = 2.0 * cos * a;
    let s = (t1 - t2) / (t1 + t2);
    let t3 = cos2 * a2_b2 + Vec3::splat(sin2 * sin2);
    let t4 = t2 * sin2;
    let p = s * (t3 - t4) / (t3 + t4);
    0.5 * (s + p)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At normal incidence ((eta-1)² + k²) / ((eta+1)² + k²); at grazing incidence 1.
    #[test]
    fn conductor_limits() {
        let (eta, k) = (Vec3::splat(2.5), Vec3::splat(3.4));
        let normal = (1.5_f32.powi(2) + 3.4_f32.powi(2)) / (3.5_f32.powi(2) + 3.4_f32.powi(2));
        assert!(
            (conductor(1.0, eta, k).x - normal).abs() < 1e-6,
            "normal incidence"
        );
        assert!(
            (conductor(0.0, eta, k).x - 1.0).abs() < 1e-5,
            "grazing incidence"
        );
    }
}
