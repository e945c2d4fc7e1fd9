//! What is scratched: how hard it is, how it flows and springs back, and how its parts reflect.

use super::pileup::PileUpLaw;
use super::plasticity::Plasticity;
use crate::brdf::{Brdf, Fresnel, Metal};
use crate::error::{Error, Result, in_range};

/// Most layers on a material.
pub const MOST_LAYERS: usize = 4;

/// A material that can be scratched.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Vickers hardness (scratch hardness for [`super::DepthLaw::ScratchHardness`]), kgf/mm², 0.01 to 20000.
    pub hardness_hv: f64,
    /// How steep the outer flanks of the piled-up material are.
    pub pile_up: PileUpLaw,
    /// Area of both peaks over the area of the groove, 0 (all is compacted or chipped away) to 1
    /// (nothing is lost).
    pub pile_up_fraction: f64,
    /// Share of the depth that springs back behind the tool, 0 to 0.95.
    pub elastic_recovery: f64,
    /// How the unscratched surface reflects.
    pub surface: Brdf,
    /// How the zones of a scratch reflect where it reaches the bulk of the material.
    pub scratched: Brdf,
    /// Layers on top of the bulk, from the surface down, at most [`MOST_LAYERS`].
    pub layers: Vec<Layer>,
}

/// A layer of another material, such as paint on primer on metal. It changes how a scratch looks, not how deep it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Thickness, mm, 1e-6 to 1000.
    pub thickness_mm: f64,
    /// How a scratch's zones reflect where they lie in this layer.
    pub scratched: Brdf,
}

impl Material {
    /// A material of this hardness and these finishes that flows as the metals of the paper do: nothing is
    /// lost, nothing springs back, peaks by the relation of 2004.
    pub fn new(hardness_hv: f64, surface: Brdf, scratched: Brdf) -> Self {
        Self {
            hardness_hv,
            pile_up: PileUpLaw::default(),
            pile_up_fraction: 1.0,
            elastic_recovery: 0.0,
            surface,
            scratched,
            layers: Vec::new(),
        }
    }

    /// A metal with its hardness, a satin surface (alpha 0.3) and smoother scratches (0.15).
    pub fn metal(metal: Metal) -> Self {
        Self::new(
            metal.hardness_hv(),
            Brdf::metal(metal, 0.3),
            Brdf::metal(metal, 0.15),
        )
    }

    /// Acrylic glass (PMMA), opaque grey: 20 HV. What springs back and piles up is [`Plasticity`]'s for a yield
    /// strain of 0.03 without hardening (100 MPa over 3.2 GPa), beyond the strains that the fit was made with: an
    /// estimate.
    pub fn acrylic() -> Self {
        let body = Brdf::Lambert {
            albedo: [0.35, 0.35, 0.36],
        };
        Self::new(20.0, body, body).with_plasticity(Plasticity::ACRYLIC)
    }

    /// Soda-lime glass over a dark ground: 550 HV. 0.45 of the depth springs back, as under a Vickers indenter at
    /// 40 gf (0.98 of 2.20 um, Ziemath and Herrmann 2000, J. Non-Cryst. Solids 273); glass is compacted rather than
    /// displaced, so that a tenth of the groove piles up: an estimate, as is the hardness.
    pub fn glass() -> Self {
        let schlick = |alpha| Brdf::Ggx {
            alpha,
            fresnel: Fresnel::Schlick { f0: [0.043; 3] },
        };
        Self {
            pile_up_fraction: 0.1,
            elastic_recovery: 0.45,
            ..Self::new(550.0, schlick(0.02), schlick(0.4))
        }
    }

    /// White alumina ceramic: 1500 HV. Brittle: pile-up (0.15) and recovery (0.2) are estimates.
    pub fn ceramic() -> Self {
        let body = |albedo| Brdf::Lambert {
            albedo: [albedo; 3],
        };
        Self {
            pile_up_fraction: 0.15,
            elastic_recovery: 0.2,
            ..Self::new(1500.0, body(0.8), body(0.6))
        }
    }

    /// The same material with pile-up fraction and recovery from its plasticity.
    pub fn with_plasticity(self, plasticity: Plasticity) -> Self {
        Self {
            pile_up_fraction: plasticity.pile_up_fraction(self.pile_up),
            elastic_recovery: plasticity.elastic_recovery(),
            ..self
        }
    }

    /// Itself, if every value lies in its range.
    pub(crate) fn check(&self) -> Result<&Self> {
        in_range("hardness_hv", self.hardness_hv, 0.01, 20_000.0)?;
        self.pile_up.check()?;
        in_range("pile_up_fraction", self.pile_up_fraction, 0.0, 1.0)?;
        in_range("elastic_recovery", self.elastic_recovery, 0.0, 0.95)?;
        self.surface.check()?;
        self.scratched.check()?;
        if self.layers.len() > MOST_LAYERS {
            return Err(Error::number(
                "layer_count",
                self.layers.len() as f64,
                "4 or fewer",
            ));
        }
        for (i, layer) in self.layers.iter().enumerate() {
            let checked = in_range("thickness_mm", layer.thickness_mm, 1e-6, 1000.0);
            checked
                .and(layer.scratched.check())
                .map_err(|error| error.within("layers", i))?;
        }
        Ok(self)
    }
}
