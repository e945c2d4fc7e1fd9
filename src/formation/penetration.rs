//! How deep a tool goes under a force: from force and hardness to the groove's depth, and back.

use super::cross_section::Process;
use super::material::Material;
use super::orientation::Orientation;
use super::outline::{Measures, Outline};
use super::pileup::PileUp;
use super::tool::Tool;
use crate::error::{Error, Result, in_range};
use core::f64::consts::PI;
use kurbo::common::solve_itp;

/// A law that gives the groove's depth under load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum DepthLaw {
    /// p = 0.182 sqrt(F/HV + 0.0055) - 0.014 mm (Bosch et al. 2004, section 3.2), fitted to scratches made
    /// with a Rockwell C cone in metals. Below F/HV = 4.17e-4 it gives no scratch.
    #[default]
    Bosch2004,
    /// Scratch hardness (ASTM G171): between its two crests, pile-up included, the groove is
    /// w = sqrt(8 F / (pi HS)) wide, HS being the scratch hardness number. Suits any tool.
    ScratchHardness,
    /// The depth is stated, whatever the force.
    Stated,
}

/// A measure of a scratch that its author wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// Depth of the groove below the surface, mm.
    Depth(f64),
    /// Width of the groove at the surface, mm.
    GrooveWidth(f64),
    /// Width between the crests of the peaks, mm.
    CrestWidth(f64),
}

impl DepthLaw {
    /// Depth of the groove under load in mm, 0 for no scratch.
    pub(crate) fn depth_mm(
        self,
        outline: &Outline,
        process: &Process,
        material: &Material,
    ) -> Result<f64> {
        let load_mm2 = process.force_kgf / material.hardness_hv;
        let (depth_mm, argument, given) = match self {
            Self::Bosch2004 => {
                let depth_mm = (0.182 * (load_mm2 + 0.0055).sqrt() - 0.014).max(0.0);
                (depth_mm, "force_kgf", process.force_kgf)
            }
            Self::ScratchHardness => {
                let width = |groove: &Measures| crest_width_mm(groove, material);
                let wanted = (8.0 * load_mm2 / PI).sqrt();
                (
                    depth_where(outline, material, wanted, width),
                    "force_kgf",
                    process.force_kgf,
                )
            }
            Self::Stated => (process.depth_mm, "depth_mm", process.depth_mm),
        };
        if depth_mm < outline.height_mm() {
            return Ok(depth_mm);
        }
        let accepted =
            "no more than pushes the tool as deep as it is tall (height_mm), at this hardness";
        Err(Error::number(argument, given, accepted))
    }

    /// The force that leaves a groove `depth_mm` deep under load.
    fn force_kgf(self, depth_mm: f64, outline: &Outline, material: &Material) -> Result<f64> {
        let load_mm2 = match self {
            Self::Bosch2004 => ((depth_mm + 0.014) / 0.182).powi(2) - 0.0055,
            Self::ScratchHardness => {
                let groove = outline
                    .measures(depth_mm)
                    .recovered(material.elastic_recovery);
                PI * crest_width_mm(&groove, material).powi(2) / 8.0
            }
            Self::Stated => {
                let accepted = "a law that relates depth to force";
                return Err(Error::text("depth_law", "a stated depth", accepted));
            }
        };
        Ok(load_mm2 * material.hardness_hv)
    }
}

impl Process {
    /// The process of this law and orientation that leaves what is wanted: the exact inverse of
    /// [`super::CrossSection::form`]. Under [`DepthLaw::Stated`] it states the depth, else the force.
    ///
    /// Errors: a measure out of the range 1e-9 to 1000 mm, or one that the tool cannot leave.
    pub fn for_wanted(
        wanted: Wanted,
        tool: &Tool,
        material: &Material,
        depth_law: DepthLaw,
        orientation: Orientation,
    ) -> Result<Self> {
        let outline = tool.outline(orientation.check()?)?;
        material.check()?;
        let (argument, value) = match wanted {
            Wanted::Depth(value) => ("depth_mm", value),
            Wanted::GrooveWidth(value) => ("groove_width_mm", value),
            Wanted::CrestWidth(value) => ("crest_width_mm", value),
        };
        in_range(argument, value, 1e-9, 1000.0)?;
        let depth_mm = match wanted {
            Wanted::Depth(depth_mm) => depth_mm / (1.0 - material.elastic_recovery),
            Wanted::GrooveWidth(width) => {
                depth_where(&outline, material, width, Measures::width_mm)
            }
            Wanted::CrestWidth(width) => depth_where(&outline, material, width, |groove| {
                crest_width_mm(groove, material)
            }),
        };
        if depth_mm >= outline.height_mm() || depth_mm <= 0.0 {
            let accepted = "what this tool can leave without going deeper than it is tall";
            return Err(Error::number(argument, value, accepted));
        }
        let force_kgf = match depth_law {
            DepthLaw::Stated => 0.0,
            law => law.force_kgf(depth_mm, &outline, material)?,
        };
        Ok(Self {
            depth_law,
            force_kgf,
            depth_mm,
            orientation,
        })
    }
}

/// Width between the crests of the groove, mm.
fn crest_width_mm(groove: &Measures, material: &Material) -> f64 {
    let peaks = PileUp::of(groove, material);
    peaks.left.inner_width_mm + groove.width_mm() + peaks.right.inner_width_mm
}

/// The depth under load at which the recovered groove is `wanted` wide by some measure of width; the tool's
/// height where it never gets so wide, 0 where it is always wider.
///
/// Widths grow with depth. A width may start like the root of the depth (a round tip) or like the depth (a sharp
/// one): the search runs over the root of the depth, in which both are smooth.
fn depth_where(
    outline: &Outline,
    material: &Material,
    wanted: f64,
    width_mm: impl Fn(&Measures) -> f64,
) -> f64 {
    if wanted <= 0.0 {
        return 0.0;
    }
    let missing = |root: f64| {
        let groove = outline
            .measures(root * root)
            .recovered(material.elastic_recovery);
        width_mm(&groove) - wanted
    };
    let highest = outline.height_mm() * (1.0 - 1e-12);
    let (from, to) = (1e-6_f64.min(0.5 * highest.sqrt()), highest.sqrt());
    let (at_from, at_to) = (missing(from), missing(to));
    if at_to <= 0.0 {
        return outline.height_mm();
    }
    if at_from >= 0.0 {
        return from * from;
    }
    let root = solve_itp(
        missing,
        from,
        to,
        1e-15 * to,
        1,
        0.2 / (to - from),
        at_from,
        at_to,
    );
    root * root
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Metal;
    use crate::formation::CrossSection;

    fn springy() -> Material {
        let mut material = Material::metal(Metal::Steel);
        material.elastic_recovery = 0.2;
        material.pile_up_fraction = 0.7;
        material
    }

    const TILTED: Orientation = Orientation {
        spin_deg: 10.0,
        tilt_deg: 12.0,
        azimuth_deg: 70.0,
    };

    /// The scratch-hardness law puts the crests where it says, for every tool and material.
    #[test]
    fn crests_are_as_wide_as_the_law_says() {
        for tool in [Tool::rockwell_c(), Tool::vickers(), Tool::nail()] {
            let process = Process {
                depth_law: DepthLaw::ScratchHardness,
                force_kgf: 1.2,
                orientation: TILTED,
                ..Process::default()
            };
            let section = CrossSection::form(&tool, &process, &springy()).unwrap();
            let law = (8.0 * 1.2 / (PI * springy().hardness_hv)).sqrt();
            let width = section.crest_width_mm();
            assert!((width / law - 1.0).abs() < 1e-9, "{width} against {law}");
        }
    }

    /// From a wanted measure to a process and back, by every law.
    #[test]
    fn inverse_is_exact() {
        let tool = Tool::rockwell_c();
        for law in [
            DepthLaw::Bosch2004,
            DepthLaw::ScratchHardness,
            DepthLaw::Stated,
        ] {
            for wanted in [
                Wanted::Depth(0.01),
                Wanted::GrooveWidth(0.08),
                Wanted::CrestWidth(0.1),
            ] {
                let process = Process::for_wanted(wanted, &tool, &springy(), law, TILTED).unwrap();
                let section = CrossSection::form(&tool, &process, &springy()).unwrap();
                let (value, got) = match wanted {
                    Wanted::Depth(value) => (value, section.depth_mm()),
                    Wanted::GrooveWidth(value) => (value, section.groove_width_mm()),
                    Wanted::CrestWidth(value) => (value, section.crest_width_mm()),
                };
                assert!(
                    (got / value - 1.0).abs() < 1e-9,
                    "{law:?} {wanted:?}: {got}"
                );
            }
        }
    }

    /// The 2004 fit gives no scratch below F/HV = 4.17e-4.
    #[test]
    fn light_touch_leaves_nothing() {
        let soft = Material {
            hardness_hv: 100.0,
            ..springy()
        };
        let process = Process {
            force_kgf: 0.04,
            ..Process::default()
        };
        let section = CrossSection::form(&Tool::nail(), &process, &soft).unwrap();
        assert_eq!(section.depth_mm(), 0.0);
    }
}
