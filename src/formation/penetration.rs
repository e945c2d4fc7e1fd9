//! How deep a tool goes under a force: from force and hardness to the groove's depth.

use super::outline::{Cut, Outline};
use super::pileup::PileUp;
use crate::error::{Error, Result};
use core::f64::consts::PI;

/// A law that gives the groove's depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthLaw {
    /// p = 0.182 sqrt(F/HV + 0.0055) - 0.014 mm (Bosch et al. 2004, section 3.2), fitted to scratches made
    /// with a Rockwell C cone in metals. Below F/HV = 4.17e-4 it gives no scratch.
    #[default]
    Bosch2004,
    /// Scratch hardness (ASTM G171): between its two crests, pile-up included, the groove is
    /// w = sqrt(8 F / (pi HS)) wide, HS being the scratch hardness number. Suits any tool.
    ScratchHardness,
}

impl DepthLaw {
    /// Depth of the groove in mm, 0 for no scratch.
    pub(crate) fn depth_mm(
        self,
        outline: &Outline,
        force_kgf: f64,
        hardness_hv: f64,
    ) -> Result<f64> {
        let load_mm2 = force_kgf / hardness_hv;
        let depth_mm = match self {
            Self::Bosch2004 => (0.182 * (load_mm2 + 0.0055).sqrt() - 0.014).max(0.0),
            Self::ScratchHardness => depth_for_crest_width(outline, (8.0 * load_mm2 / PI).sqrt()),
        };
        if depth_mm < outline.height_mm() {
            return Ok(depth_mm);
        }
        Err(Error::number(
            "force_kgf",
            force_kgf,
            "a force that does not push the tool deeper than it is tall (height_mm), at this hardness",
        ))
    }
}

/// Width between the crests of the groove at a depth, mm.
fn crest_width_mm(cut: &Cut) -> f64 {
    let peaks = PileUp::of(cut);
    peaks.left.inner_width_mm + cut.width_mm() + peaks.right.inner_width_mm
}

/// The depth at which the crests are `width_mm` apart; the tool's height where it never gets so wide.
///
/// The width grows with depth, so bisection cannot miss; it stops at the last bit.
fn depth_for_crest_width(outline: &Outline, width_mm: f64) -> f64 {
    let (mut shallow, mut deep) = (0.0, outline.height_mm());
    if width_mm <= 0.0 {
        return 0.0;
    }
    if crest_width_mm(&outline.cut(deep * (1.0 - 1e-12))) <= width_mm {
        return deep;
    }
    loop {
        let middle = 0.5 * (shallow + deep);
        if middle <= shallow || middle >= deep || deep - shallow < 1e-13 * deep {
            return middle;
        }
        if crest_width_mm(&outline.cut(middle)) < width_mm {
            shallow = middle;
        } else {
            deep = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formation::{Orientation, Tool};

    /// The scratch-hardness law puts the crests where it says, for every preset.
    #[test]
    fn crests_are_as_wide_as_the_law_says() {
        let tilted = Orientation {
            spin_deg: 10.0,
            tilt_deg: 12.0,
            azimuth_deg: 70.0,
        };
        for tool in [Tool::rockwell_c(), Tool::vickers(), Tool::nail()] {
            let outline = tool.outline(tilted).unwrap();
            let depth = DepthLaw::ScratchHardness
                .depth_mm(&outline, 1.2, 200.0)
                .unwrap();
            let width = crest_width_mm(&outline.cut(depth));
            let law = (8.0 * 1.2 / (PI * 200.0)).sqrt();
            assert!((width / law - 1.0).abs() < 1e-9, "{width} against {law}");
        }
    }

    /// The 2004 fit gives no scratch below F/HV = 4.17e-4.
    #[test]
    fn light_touch_leaves_nothing() {
        let outline = Tool::nail().outline(Orientation::default()).unwrap();
        assert_eq!(DepthLaw::Bosch2004.depth_mm(&outline, 0.04, 100.0), Ok(0.0));
    }
}
