//! The two peaks of material that a tool pushes out of its groove.

use super::material::Material;
use super::outline::Measures;
use crate::error::{Result, in_range};

/// Flanks are never steeper than this.
const STEEPEST_DEG: f64 = 85.0;

/// How steep the outer flank of a peak is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "files",
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum PileUpLaw {
    /// tan beta = -0.56 + 2.54 tan alpha (Bosch et al. 2004, section 3.2), alpha being the slope of the inner
    /// flank. Where that falls below a quarter of tan alpha, a quarter of tan alpha.
    #[default]
    Bosch2004,
    /// Always this slope.
    OuterSlope {
        /// tan beta, 0.001 to 11.4.
        tan_beta: f64,
    },
    /// No peaks at all: what the groove lacks is lost.
    None,
}

/// One peak beside a groove: a triangle that rises from the groove's edge and falls back to the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// Slope of the inner flank, degrees, 0 to 85.
    pub alpha_deg: f64,
    /// Slope of the outer flank, degrees, 0 to 85.
    pub beta_deg: f64,
    /// Height above the surface, mm.
    pub height_mm: f64,
    /// Width of the inner flank, mm.
    pub inner_width_mm: f64,
    /// Width of the outer flank, mm.
    pub outer_width_mm: f64,
}

/// Both peaks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PileUp {
    pub left: Peak,
    pub right: Peak,
}

impl PileUpLaw {
    pub(crate) fn check(self) -> Result<Self> {
        if let Self::OuterSlope { tan_beta } = self {
            in_range("tan_beta", tan_beta, 0.001, 11.4)?;
        }
        Ok(self)
    }

    /// tan beta from tan alpha; nothing where there are no peaks.
    pub(crate) fn outer_slope(self, tan_alpha: f64) -> Option<f64> {
        let slope = match self {
            Self::Bosch2004 => (2.54 * tan_alpha - 0.56).max(0.25 * tan_alpha),
            Self::OuterSlope { tan_beta } => tan_beta,
            Self::None => return None,
        };
        Some(slope.min(steepest_slope()))
    }
}

impl PileUp {
    /// The peaks of a groove: each holds half of what the material piles up of the groove's area
    /// (Bosch et al. 2004, section 3.2, where that is all of it).
    pub(crate) fn of(groove: &Measures, material: &Material) -> Self {
        let area_mm2 = material.pile_up_fraction * groove.area_mm2;
        let peak = |flank_rad: f64| Peak::rising(flank_rad, material.pile_up, area_mm2);
        let [left, right] = groove.flank_rad.map(peak);
        Self { left, right }
    }
}

impl Peak {
    /// A peak that holds half of `area_mm2`.
    pub(super) fn rising(flank_rad: f64, law: PileUpLaw, area_mm2: f64) -> Self {
        let tan_alpha = flank_rad.max(1e-9).min(STEEPEST_DEG.to_radians()).tan();
        let alpha_deg = tan_alpha.atan().to_degrees();
        let Some(tan_beta) = law.outer_slope(tan_alpha) else {
            return Self {
                alpha_deg,
                ..Self::default()
            };
        };
        let height_mm = (area_mm2 / (1.0 / tan_alpha + 1.0 / tan_beta)).sqrt();
        Self {
            alpha_deg,
            beta_deg: tan_beta.atan().to_degrees(),
            height_mm,
            inner_width_mm: height_mm / tan_alpha,
            outer_width_mm: height_mm / tan_beta,
        }
    }
}

fn steepest_slope() -> f64 {
    STEEPEST_DEG.to_radians().tan()
}
