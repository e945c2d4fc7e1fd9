//! Generators by name, to begin with.

use super::{Amount, Distribution, Generator};
use crate::formation::{DepthLaw, Orientation};
use crate::pattern::Held;

/// Generators by name. All numbers are of our choosing: somewhere to begin.
///
/// Forces suit metals, scratch hardness as the depth law, and a sharp tool such as
/// [`Tool::abrasive_grain`](crate::formation::Tool::abrasive_grain) or a needle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Style {
    /// Straight scratches in every direction: 20 on a cm², 2 to 20 mm long.
    #[default]
    Straight,
    /// A brushed finish: fine, dense, nearly parallel to u.
    Brushed,
    /// What a buffing wheel or a cloth moved in circles leaves: fine arcs, all bent to the left.
    Swirls,
    /// Years of handling: fine scratches of every size and direction, mostly short and light, few long and deep.
    Handling,
}

impl Style {
    /// All styles, in the order of their numbers on the C face.
    pub const ALL: [Self; 4] = [Self::Straight, Self::Brushed, Self::Swirls, Self::Handling];
}

impl Generator {
    /// A generator by name, for the unit square.
    pub fn style(style: Style) -> Self {
        match style {
            Style::Straight => Self::straight(),
            Style::Brushed => Self {
                amount: Amount::PerCm2(2000.0),
                length_mm: log_normal(1.0, 60.0, 8.0, 0.5),
                force_kgf: log_normal(1e-4, 0.02, 2e-3, 0.5),
                spread_deg: 2.0,
                taper: [0.3; 2],
                ..Self::straight()
            },
            Style::Swirls => Self {
                amount: Amount::PerCm2(150.0),
                length_mm: Distribution::Normal {
                    from: 3.0,
                    to: 40.0,
                    middle: 15.0,
                    deviation: 6.0,
                },
                force_kgf: log_normal(1e-5, 0.01, 2e-4, 0.6),
                turn_deg: 120.0,
                turn_spread_deg: 40.0,
                wander_deg: 2.0,
                curves: 4,
                taper: [0.3; 2],
                ..Self::straight()
            },
            Style::Handling => Self {
                amount: Amount::PerCm2(400.0),
                length_mm: Distribution::PowerLaw {
                    from: 0.2,
                    to: 30.0,
                    exponent: 1.8,
                },
                force_kgf: Distribution::PowerLaw {
                    from: 2e-5,
                    to: 0.05,
                    exponent: 2.0,
                },
                turn_spread_deg: 15.0,
                wander_deg: 3.0,
                curves: 4,
                taper: [0.25; 2],
                ..Self::straight()
            },
        }
    }

    fn straight() -> Self {
        Self {
            amount: Amount::PerCm2(20.0),
            area_uv: [[0.0; 2], [1.0; 2]],
            length_mm: Distribution::Uniform {
                from: 2.0,
                to: 20.0,
            },
            force_kgf: Distribution::Uniform {
                from: 0.005,
                to: 0.1,
            },
            depth_mm: Distribution::constant(0.001),
            direction_deg: 0.0,
            spread_deg: 360.0,
            turn_deg: 0.0,
            turn_spread_deg: 0.0,
            wander_deg: 0.0,
            curves: 1,
            taper: [0.15; 2],
            orientation: Orientation::default(),
            spin_spread_deg: 0.0,
            held: Held::ToPath,
            depth_law: DepthLaw::ScratchHardness,
        }
    }
}

fn log_normal(from: f64, to: f64, middle: f64, deviation: f64) -> Distribution {
    Distribution::LogNormal {
        from,
        to,
        middle,
        deviation,
    }
}
