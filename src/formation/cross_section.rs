//! The cross-section of a scratch: a groove and its two peaks, from the process that made them.

use super::facets::{facet_points, facets_needed};
use super::material::Material;
use super::orientation::Orientation;
use super::outline::{Cut, Outline};
use super::penetration::DepthLaw;
use super::pileup::{Peak, PileUp};
use super::tool::Tool;
use crate::error::{Result, in_range};
use glam::DVec2;

/// How a tool is held and pressed at one place of a scratch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Process {
    /// Which law gives the depth.
    pub depth_law: DepthLaw,
    /// Normal force, kgf, 0 to 100000.
    pub force_kgf: f64,
    /// Depth under load, mm, 0 to 1000: counts under [`DepthLaw::Stated`] only.
    pub depth_mm: f64,
    /// How the tool is held.
    pub orientation: Orientation,
}

impl Process {
    /// The outline of `tool` held so, and its depth under load in mm.
    pub(super) fn press(&self, tool: &Tool, material: &Material) -> Result<(Outline, f64)> {
        in_range("force_kgf", self.force_kgf, 0.0, 100_000.0)?;
        in_range("depth_mm", self.depth_mm, 0.0, 1000.0)?;
        material.check()?;
        let outline = tool.outline(self.orientation.check()?)?;
        let loaded_mm = self.depth_law.depth_mm(&outline, self, material)?;
        Ok((outline, loaded_mm))
    }
}

/// A cross-section: points (x, z) in mm, x to the right of travel, z up, the untouched surface at z = 0.
///
/// Where the force leaves no scratch, everything is 0 and all points lie at the origin.
#[derive(Clone, Debug)]
pub struct CrossSection {
    depth_mm: f64,
    groove: Cut,
    peaks: PileUp,
}

impl CrossSection {
    /// What `tool`, held and pressed as `process` says, leaves in `material`.
    ///
    /// Errors: a force, angle or property of the material out of its range; a tool leant onto its flank; a
    /// depth that the tool is too short for.
    pub fn form(tool: &Tool, process: &Process, material: &Material) -> Result<Self> {
        let (outline, loaded_mm) = process.press(tool, material)?;
        let groove = outline.cut(loaded_mm).recovered(material.elastic_recovery);
        let depth_mm = loaded_mm * (1.0 - material.elastic_recovery);
        let peaks = PileUp::of(&groove.measures, material);
        Ok(Self {
            depth_mm,
            groove,
            peaks,
        })
    }

    /// Depth of the groove below the surface, mm.
    pub fn depth_mm(&self) -> f64 {
        self.depth_mm
    }

    /// Area of the groove below the surface, mm².
    pub fn groove_area_mm2(&self) -> f64 {
        self.groove.measures.area_mm2
    }

    /// Width of the groove at the surface, mm.
    pub fn groove_width_mm(&self) -> f64 {
        self.groove.measures.width_mm()
    }

    /// Width between the crests of the two peaks, mm.
    pub fn crest_width_mm(&self) -> f64 {
        self.peaks.left.inner_width_mm + self.groove_width_mm() + self.peaks.right.inner_width_mm
    }

    /// The peak left of travel.
    pub fn left(&self) -> Peak {
        self.peaks.left
    }

    /// The peak right of travel.
    pub fn right(&self) -> Peak {
        self.peaks.right
    }

    /// The whole cross-section from left to right, as fine as the tool's shape is known.
    pub fn vertices(&self) -> Vec<DVec2> {
        self.with_peaks(self.groove.points.clone())
    }

    /// The whole cross-section with the groove as `count` facets: `count + 5` points.
    pub(crate) fn faceted(&self, count: usize) -> Vec<DVec2> {
        self.with_peaks(facet_points(&self.groove, count))
    }

    /// How many facets the groove needs for their slopes to step by `step_rad` at most.
    pub(crate) fn facets_needed(&self, step_rad: f64) -> usize {
        facets_needed(&self.groove, step_rad)
    }

    fn with_peaks(&self, groove: Vec<DVec2>) -> Vec<DVec2> {
        let edge = |point: Option<&DVec2>| point.map_or(0.0, |point| point.x);
        let (from_x, to_x) = (edge(groove.first()), edge(groove.last()));
        let PileUp { left, right } = self.peaks;
        let left_crest = DVec2::new(from_x - left.inner_width_mm, left.height_mm);
        let right_crest = DVec2::new(to_x + right.inner_width_mm, right.height_mm);
        let mut points = vec![
            DVec2::new(left_crest.x - left.outer_width_mm, 0.0),
            left_crest,
        ];
        points.extend(groove);
        points.extend([
            right_crest,
            DVec2::new(right_crest.x + right.outer_width_mm, 0.0),
        ]);
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Metal;

    fn area(points: &[DVec2]) -> f64 {
        points
            .windows(2)
            .map(|w| 0.5 * (w[1].x - w[0].x) * (w[0].y + w[1].y))
            .sum()
    }

    fn soft() -> Material {
        Material {
            hardness_hv: 150.0,
            ..Material::metal(Metal::Brass)
        }
    }

    /// No material is lost: what the groove lacks, the peaks hold.
    #[test]
    fn area_is_conserved() {
        let held = Orientation {
            spin_deg: 20.0,
            tilt_deg: 15.0,
            azimuth_deg: 50.0,
        };
        for tool in [
            Tool::rockwell_c(),
            Tool::vickers(),
            Tool::nail(),
            Tool::screwdriver(),
        ] {
            let process = Process {
                force_kgf: 2.0,
                orientation: held,
                ..Default::default()
            };
            let section = CrossSection::form(&tool, &process, &soft()).unwrap();
            for points in [section.vertices(), section.faceted(9)] {
                let lost = area(&points).abs() / section.groove_area_mm2();
                assert!(lost < 1e-4, "{tool:?}: {lost}");
            }
            let lost = area(&section.faceted(9)).abs() / section.groove_area_mm2();
            assert!(lost < 1e-9, "{tool:?}: {lost}");
        }
    }

    /// Zero force is a valid process that leaves nothing, and its cross-section has its points all the same.
    #[test]
    fn no_force_no_scratch() {
        let section = CrossSection::form(&Tool::nail(), &Process::default(), &soft()).unwrap();
        assert_eq!(section.groove_width_mm(), 0.0);
        assert_eq!(section.faceted(4).len(), 9);
    }
}
