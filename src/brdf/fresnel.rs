//! Reflectance of a smooth interface.

use super::Metal;
use crate::error::{Result, rgb_in_range};
use crate::lanes::{Lanes, Number};

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

    /// Reflectance at angles whose cosines are `cos` (0 to 1), per channel.
    #[inline(always)]
    pub(crate) fn reflectance<F: Number>(&self, cos: F) -> [F; 3] {
        match *self {
            // Written out, not by `map`, which would not be written into code for registers.
            Self::Schlick { f0: [r, g, b] } => [schlick(cos, r), schlick(cos, g), schlick(cos, b)],
            Self::Conductor { eta, k } => [
                conductor(cos, cos.like(eta[0]), cos.like(k[0])),
                conductor(cos, cos.like(eta[1]), cos.like(k[1])),
                conductor(cos, cos.like(eta[2]), cos.like(k[2])),
            ],
        }
    }

    /// The same of one angle, channels side by side.
    #[inline(always)]
    pub(crate) fn reflectance_in<L: Lanes>(&self, lanes: L, cos: f32) -> [f32; 3] {
        match *self {
            Self::Schlick { f0 } => f0.map(|f0| schlick(cos, f0)),
            Self::Conductor { eta, k } => lanes.of_three(
                eta,
                k,
                #[inline(always)]
                |eta, k| conductor(lanes.all(cos), eta, k),
            ),
        }
    }
}

#[inline(always)]
fn schlick<F: Number>(cos: F, f0: f32) -> F {
    let m = -cos + 1.0;
    let m2 = m * m;
    m2 * m2 * m * (1.0 - f0) + f0
}

/// The unpolarised Fresnel equations of a conductor in air.
#[inline(always)]
fn conductor<F: Number>(cos: F, eta: F, k: F) -> F {
    let cos2 = cos * cos;
    let sin2 = -cos2 + 1.0;
    let (eta2, k2) = (eta * eta, k * k);
    let t0 = eta2 - k2 - sin2;
    let a2_b2 = (t0 * t0 + eta2 * k2 * 4.0).sqrt();
    let t1 = a2_b2 + cos2;
    let a = ((a2_b2 + t0) * 0.5).max(cos.like(0.0)).sqrt();
    let t2 = cos * a * 2.0;
    let s = (t1 - t2) / (t1 + t2);
    let t3 = cos2 * a2_b2 + sin2 * sin2;
    let t4 = t2 * sin2;
    let p = s * (t3 - t4) / (t3 + t4);
    (s + p) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At normal incidence ((eta-1)² + k²) / ((eta+1)² + k²); at grazing incidence 1.
    #[test]
    fn conductor_limits() {
        let (eta, k) = (2.5, 3.4);
        let normal = (1.5_f32.powi(2) + 3.4_f32.powi(2)) / (3.5_f32.powi(2) + 3.4_f32.powi(2));
        assert!(
            (conductor(1.0_f32, eta, k) - normal).abs() < 1e-6,
            "normal incidence"
        );
        assert!(
            (conductor(0.0_f32, eta, k) - 1.0).abs() < 1e-5,
            "grazing incidence"
        );
    }
}
