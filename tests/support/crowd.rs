//! Strokes by the dozen.

use super::{SHEET_MM, sheet_of};
use glam::DVec2;
use rand::Rng;
use striae::formation::{Material, Tool};
use striae::pattern::{Key, Path, Pattern, PatternBuilder, Scratch};

/// Adds a stroke across the sheet's middle, `shift_mm` to its left, `turn_deg` from the u axis.
pub(crate) fn add(
    builder: &mut PatternBuilder,
    tool: &Tool,
    material: Option<&Material>,
    shift_mm: f64,
    turn_deg: f64,
    force_kgf: f64,
) {
    let along = DVec2::from_angle(turn_deg.to_radians());
    let middle = DVec2::splat(0.5) + shift_mm / SHEET_MM * along.perp();
    builder
        .add(&Scratch {
            material,
            path: Path::Polyline(&[
                (middle - 0.3 * along).to_array(),
                (middle + 0.3 * along).to_array(),
            ]),
            keys: &[Key::force(0.0, force_kgf)],
            ..Scratch::new(tool)
        })
        .unwrap();
}

/// `count` parallel strokes, `pitch_mm` apart around the middle.
pub(crate) fn comb(material: &Material, count: u32, pitch_mm: f64, force_kgf: f64) -> Pattern {
    let mut builder = sheet_of(material);
    for i in 0..count {
        let shift = pitch_mm * (f64::from(i) - 0.5 * f64::from(count - 1));
        add(
            &mut builder,
            &Tool::rockwell_c(),
            None,
            shift,
            0.0,
            force_kgf,
        );
    }
    builder.build()
}

/// Two dozen wide strokes that cross near the middle, each way.
pub(crate) fn tangle(material: &Material, random: &mut impl Rng) -> Pattern {
    let mut builder = sheet_of(material);
    for _ in 0..24 {
        let shift_mm = random.random_range(-0.5..0.5);
        let turn_deg = random.random_range(0.0..360.0);
        let force_kgf = random.random_range(1.0..3.0);
        add(
            &mut builder,
            &Tool::vickers(),
            None,
            shift_mm,
            turn_deg,
            force_kgf,
        );
    }
    builder.build()
}
