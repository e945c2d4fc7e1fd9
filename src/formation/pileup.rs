//! The two peaks of material that a tool pushes out of its groove.

use super::outline::Cut;

/// Flanks are never steeper than this.
const STEEPEST_DEG: f64 = 85.0;

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

impl PileUp {
    /// The peaks of a groove: each holds half of the groove's area (Bosch et al. 2004, section 3.2).
    pub(crate) fn of(cut: &Cut) -> Self {
        let [left, right] = cut
            .flank_rad
            .map(|flank_rad| Peak::rising(flank_rad, cut.area_mm2));
        Self { left, right }
    }
}

impl Peak {
    fn rising(flank_rad: f64, groove_area_mm2: f64) -> Self {
        let steepest = STEEPEST_DEG.to_radians();
        let tan_alpha = flank_rad.clamp(1e-9, steepest).tan();
        let tan_beta = outer_slope(tan_alpha).min(steepest.tan());
        let height_mm = (groove_area_mm2 / (1.0 / tan_alpha + 1.0 / tan_beta)).sqrt();
        Self {
            alpha_deg: tan_alpha.atan().to_degrees(),
            beta_deg: tan_beta.atan().to_degrees(),
            height_mm,
            inner_width_mm: height_mm / tan_alpha,
            outer_width_mm: height_mm / tan_beta,
        }
    }
}

/// tan beta from tan alpha: the paper's linear relation, which would reach 0 at tan alpha = 0.2205,
/// continued there by a quarter of tan alpha.
fn outer_slope(tan_alpha: f64) -> f64 {
    (2.54 * tan_alpha - 0.56).max(0.25 * tan_alpha)
}
