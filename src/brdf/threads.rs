//! Highlights of thin lines, each of which mirrors a view onto a cone about itself (Banks 1994, "Illumination in diverse
//! codimensions"): Phong's lobe about the nearest direction of that cone. Of several lines the one that shines most counts.

use super::Local;
use crate::lanes::Number;

/// Directions that a set tells apart, half a turn in all: 2.5 degrees each.
const STEPS: usize = 72;

/// Bits in each of a set's numbers: as many as single precision counts in.
const BITS: usize = 24;

/// Directions of lines, to 1.25 degrees: any number of them.
#[cfg(feature = "files")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Directions([u32; STEPS / BITS]);

#[cfg(feature = "files")]
impl Directions {
    /// Adds a line at this angle, radians counter-clockwise from the local frame's x.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast saturates, and the remainder is in range"
    )]
    pub(crate) fn insert(&mut self, angle_rad: f32) {
        let turn = (angle_rad / core::f32::consts::PI).rem_euclid(1.0);
        let step = (turn * STEPS as f32 + 0.5) as usize % STEPS;
        self.0[step / BITS] |= 1 << (step % BITS);
    }

    /// As numbers that single precision holds.
    pub(super) fn numbers(&self) -> [f32; STEPS / BITS] {
        self.0.map(|bits| bits as f32)
    }
}

/// Sine and cosine of each direction in a set. Whatever the numbers: they may be a damaged file's.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
#[inline(always)]
fn each_direction(directions: [f32; STEPS / BITS], mut visit: impl FnMut(f32, f32)) {
    for (word, bits) in directions.into_iter().enumerate() {
        let mut left = bits as u32 & ((1 << BITS) - 1);
        while left > 0 {
            let step = word * BITS + left.trailing_zeros() as usize;
            let (sin, cos) = (step as f32 * (core::f32::consts::PI / STEPS as f32)).sin_cos();
            visit(sin, cos);
            left &= left - 1;
        }
    }
}

/// The lobe times n · light. Lines lie in the zone's plane; angles are from its second axis away from its first, as those
/// from x are on the flat surface.
#[inline(always)]
pub(super) fn lobe_cos<F: Number>(
    exponent: f32,
    directions: [f32; STEPS / BITS],
    pair: &Local<F>,
) -> F {
    let (view, light) = (&pair.view, &pair.light);
    let none = view.z.like(0.0);
    let across = |along: F| (-(along * along) + 1.0).max(none).sqrt();
    let mut nearest = none;
    each_direction(directions, |sin, cos| {
        let (v, l) = (view.y * cos - view.x * sin, light.y * cos - light.x * sin);
        nearest = nearest.max(across(v) * across(l) - v * l);
    });
    nearest.each(|_, cos| cos.min(1.0).powf(exponent)) * light.z
}

#[cfg(all(test, feature = "files"))]
mod tests {
    use super::*;
    use crate::brdf::{ACROSS_SURFACE, Finish, Pair};
    use glam::Vec3;

    fn highlight(degrees: &[f32], view: Vec3, light: Vec3) -> f32 {
        let mut directions = Directions::default();
        for angle in degrees {
            directions.insert(angle.to_radians());
        }
        let pair = Pair::new(view.normalize(), light.normalize()).turned(ACROSS_SURFACE);
        let finish = Finish::threads([1.0; 3], 40.0, &directions);
        finish.brdf_cos(Vec3::Z, &pair).x / light.normalize().z
    }

    /// A line shines wherever view and light make the same angle with it, whichever way they lean across it; not else.
    #[test]
    fn a_line_shines_on_its_cone() {
        let full = highlight(&[0.0], Vec3::Z, Vec3::Z);
        for (view, light) in [
            (Vec3::new(0.0, 0.8, 1.0), Vec3::new(0.0, -0.3, 1.0)),
            (Vec3::new(0.0, 0.8, 1.0), Vec3::new(0.0, 0.8, 1.0)),
            (Vec3::new(0.5, 0.0, 1.0), Vec3::new(-0.5, 0.0, 1.0)),
        ] {
            let found = highlight(&[0.0], view, light);
            assert!((found / full - 1.0).abs() < 1e-4, "{view} {light}: {found}");
        }
        let beside = highlight(&[0.0], Vec3::new(0.5, 0.0, 1.0), Vec3::Z);
        assert!(beside < 0.02 * full, "{beside} of {full}");
        // Lines turn counter-clockwise from x, and are the same upside down.
        let (view, light) = (Vec3::new(0.3, 0.3, 1.0), Vec3::new(-0.3, -0.3, 1.0));
        let turned = [45.0, -135.0].map(|angle| highlight(&[angle], view, light));
        assert!((turned[0] / full - 1.0).abs() < 1e-3, "{turned:?}");
        assert_eq!(turned[0], turned[1]);
    }

    /// Of several lines the strongest counts, not their sum.
    #[test]
    fn the_strongest_counts() {
        let (view, light) = (Vec3::new(0.4, 0.1, 1.0), Vec3::new(0.1, -0.5, 1.0));
        let alone = [10.0, 50.0, 120.0].map(|angle| highlight(&[angle], view, light));
        let strongest = alone.into_iter().fold(0.0, f32::max);
        assert!(alone.iter().sum::<f32>() > 1.01 * strongest, "{alone:?}");
        assert_eq!(highlight(&[10.0, 50.0, 120.0], view, light), strongest);
    }
}
