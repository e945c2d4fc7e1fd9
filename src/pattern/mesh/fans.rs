//! The facets of a scratch's hard end: a fan of half cross-sections between azimuths.

use super::patches::{Patches, Skins, Strip};
use crate::error::Result;
use crate::formation::End;
use crate::pattern::caps::{BEHIND, CapAt, LONGEST_BORDER};
use crate::pattern::track::MOST_VERTICES;
use core::f64::consts::FRAC_PI_2;
use glam::{DVec2, DVec3};

/// Borders that run along the end of the path itself are known to single precision only.
const SAME_RAD: f64 = 1e-5;

impl Patches {
    /// Adds what stands beyond a path's end at `point`, where it travels along `travel`.
    pub(super) fn push_fan(
        &mut self,
        cap: &CapAt<'_>,
        end: End,
        point: DVec2,
        travel: DVec2,
        skins: &Skins,
    ) -> Result<()> {
        // From the right around to the left, or at the start from the left around to the right.
        let middle_rad = match end {
            End::Start => 2.0 * FRAC_PI_2,
            End::Stop => 0.0,
        };
        let first_rad = middle_rad - FRAC_PI_2;
        let mut from_rad = first_rad;
        let mut sectors = cap.sectors().peekable();
        while let Some(sector) = sectors.next() {
            let to_rad = f64::from(sector.wedge.to_rad);
            let last_rad = middle_rad + FRAC_PI_2;
            let is_last = sectors.peek().is_none() || (to_rad - last_rad).abs() < SAME_RAD;
            let to_rad = if is_last { last_rad } else { to_rad };
            let axis_rad = f64::from(sector.wedge.axis_rad);
            let origin = point + sector.offset_mm * DVec2::new(travel.y, -travel.x);
            let (mut xs, mut zs) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
            sector.profile.sample(&mut xs, &mut zs);
            let points = (BEHIND..sector.profile.vertex_count)
                .map(|i| DVec2::new(f64::from(xs[i]).max(0.0), f64::from(zs[i])));
            let points: Vec<DVec2> = points.collect();
            let border = |azimuth_rad: f64| {
                let off_rad = azimuth_rad - axis_rad;
                let stretch = (1.0 / off_rad.cos().max(1e-9)).min(LONGEST_BORDER);
                let along = quarter_exact(azimuth_rad).rotate(travel) * stretch;
                let place = |p: &DVec2| (origin + along * p.x).extend(p.y);
                points.iter().map(place).collect::<Vec<DVec3>>()
            };
            // Outward, with the axis to the right of travel: the border that is reached first, counter-clockwise, is behind.
            let strip = Strip {
                from: &border(from_rad),
                to: &border(to_rad),
                travel: DVec2::from_angle(axis_rad).rotate(travel).perp(),
                skipped: BEHIND,
            };
            self.push(&strip, skins)?;
            from_rad = to_rad;
        }
        Ok(())
    }
}

/// The direction at an angle: exact at right angles, where a fan meets its scratch.
fn quarter_exact(angle_rad: f64) -> DVec2 {
    let quarters = (angle_rad / FRAC_PI_2).round();
    if (angle_rad - quarters * FRAC_PI_2).abs() < 1e-12 {
        return match quarters.rem_euclid(4.0) {
            1.0 => DVec2::Y,
            2.0 => DVec2::NEG_X,
            3.0 => DVec2::NEG_Y,
            _ => DVec2::X,
        };
    }
    DVec2::from_angle(angle_rad)
}
