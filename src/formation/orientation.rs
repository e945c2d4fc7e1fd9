//! How the tool is held: spin about its axis, then a lean.

use crate::error::{Result, in_range};
use glam::{DMat3, DVec3};

/// The tool's orientation, relative to the direction of travel.
///
/// Tool frame: +x right of travel, +y forward, +z up along the untilted axis. First the tool spins by
/// `spin_deg` about z (counter-clockwise from above), then its axis leans by `tilt_deg` towards
/// `azimuth_deg` (0 = forward, 90 = left of travel).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Orientation {
    /// Spin about the tool's own axis, degrees, -3600 to 3600.
    pub spin_deg: f64,
    /// Angle between the tool's axis and the surface normal, degrees, 0 to 85.
    pub tilt_deg: f64,
    /// Where the axis leans to, degrees, -3600 to 3600.
    pub azimuth_deg: f64,
}

impl Orientation {
    /// Itself, if every angle lies in its range.
    pub(crate) fn check(self) -> Result<Self> {
        in_range("spin_deg", self.spin_deg, -3600.0, 3600.0)?;
        in_range("tilt_deg", self.tilt_deg, 0.0, 85.0)?;
        in_range("azimuth_deg", self.azimuth_deg, -3600.0, 3600.0)?;
        Ok(self)
    }

    /// Rotation from the tool's own frame into the frame of travel.
    pub(crate) fn rotation(self) -> DMat3 {
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        let lean = DVec3::new(-sin, cos, 0.0);
        let hinge = DVec3::Z.cross(lean);
        DMat3::from_axis_angle(hinge, self.tilt_deg.to_radians())
            * DMat3::from_rotation_z(self.spin_deg.to_radians())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Azimuth 0 leans the axis forward, 90 to the left of travel.
    #[test]
    fn axis_leans_to_the_azimuth() {
        let axis = |azimuth_deg| {
            let held = Orientation {
                tilt_deg: 30.0,
                azimuth_deg,
                ..Default::default()
            };
            held.rotation() * DVec3::Z
        };
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        assert!(
            axis(0.0).abs_diff_eq(DVec3::new(0.0, sin, cos), 1e-12),
            "forward"
        );
        assert!(
            axis(90.0).abs_diff_eq(DVec3::new(-sin, 0.0, cos), 1e-12),
            "left"
        );
    }
}
