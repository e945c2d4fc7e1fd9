//! What is scratched: its hardness, and how its surface and its scratches reflect.

use crate::brdf::{Brdf, Metal};
use crate::error::{Result, in_range};

/// A material that can be scratched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Vickers hardness, kgf/mm², 0.01 to 20000.
    pub hardness_hv: f64,
    /// How the unscratched surface reflects.
    pub surface: Brdf,
    /// How the zones of a scratch reflect. A tool usually leaves them smoother or rougher than the surface.
    pub scratched: Brdf,
}

impl Material {
    /// A metal with its hardness, a satin surface and smoother scratches.
    pub fn metal(metal: Metal) -> Self {
        Self {
            hardness_hv: metal.hardness_hv(),
            surface: Brdf::metal(metal, 0.3),
            scratched: Brdf::metal(metal, 0.15),
        }
    }

    /// Itself, if every value lies in its range.
    pub(crate) fn check(self) -> Result<Self> {
        in_range("hardness_hv", self.hardness_hv, 0.01, 20_000.0)?;
        self.surface.check()?;
        self.scratched.check()?;
        Ok(self)
    }
}
