//! What scratches may do in a region of a sheet, a millimetre about its middle: patterns to make reliefs of.

use super::lines::{Line, STEADY, add, pattern};
use super::{dark_sheet, lambert, sheet_of};
use striae::formation::{Layer, Material, Tool};
use striae::pattern::{Key, Pattern, Scratch};

pub(crate) const LEVEL: &[[f64; 2]] = &[[-9.0, 0.02], [9.0, 0.03]];
pub(crate) const STEEP: &[[f64; 2]] = &[[-0.4, -9.0], [0.5, 9.0]];
pub(crate) const BOW: &[[f64; 2]] = &[[-3.0, -1.0], [-1.0, 0.34], [1.0, 0.34], [3.0, -1.0]];
const WINDING: &[[f64; 2]] = &[[-3.0, -1.0], [2.0, 3.0], [-2.0, -3.0], [3.0, 1.0]];
const ANGLE: &[[f64; 2]] = &[[-0.9, -0.3], [0.0, 0.03], [0.9, -0.1]];
const LOOP: &[[f64; 2]] = &[[-0.7, -0.8], [0.1, 0.3], [0.9, -0.6], [-0.8, 0.2]];
const SHORT: &[[f64; 2]] = &[[-0.31, -0.2], [0.4, 0.25]];
const TO_AND_FRO: &[Key] = &[
    Key::force(0.0, 0.0),
    Key::force(0.5, 3.0),
    Key::force(1.0, 0.0),
];

fn brass() -> Material {
    Material {
        layers: vec![
            Layer {
                thickness_mm: 0.004,
                scratched: lambert(0.3),
            },
            Layer {
                thickness_mm: 0.006,
                scratched: lambert(0.5),
            },
        ],
        ..dark_sheet()
    }
}

/// Patterns by name: what a scratch may do in a region.
pub(crate) fn patterns() -> Vec<(&'static str, Pattern)> {
    use Line::{Curve, Straight};
    let plain = dark_sheet();
    let all = [
        ("straight", vec![Straight(LEVEL)], STEADY, &plain),
        ("curved", vec![Curve(BOW)], STEADY, &plain),
        ("corners", vec![Straight(ANGLE)], STEADY, &plain),
        ("crossing itself", vec![Straight(LOOP)], STEADY, &plain),
        ("hard ends", vec![Straight(SHORT)], STEADY, &plain),
        (
            "soft ends",
            vec![Straight(SHORT), Curve(BOW)],
            TO_AND_FRO,
            &plain,
        ),
        (
            "crossing",
            vec![Straight(LEVEL), Straight(STEEP)],
            STEADY,
            &plain,
        ),
        (
            "all at once",
            vec![
                Straight(LEVEL),
                Curve(WINDING),
                Straight(SHORT),
                Curve(BOW),
                Straight(LOOP),
                Straight(STEEP),
            ],
            STEADY,
            &plain,
        ),
        (
            "twice the same",
            vec![Straight(LEVEL), Straight(LEVEL)],
            STEADY,
            &plain,
        ),
    ];
    let made = all
        .into_iter()
        .map(|(name, lines, keys, material)| (name, pattern(material, &lines, keys)));
    let layered = pattern(&brass(), &[Straight(LEVEL), Straight(SHORT)], TO_AND_FRO);
    made.chain([("layers", layered), ("leaning ends", leaning())])
        .collect()
}

/// Ends of tools that are not round, held askew: their fans' facets do not meet.
fn leaning() -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    let mut key = Key::force(0.0, 2.0);
    key.orientation.spin_deg = 20.0;
    key.orientation.tilt_deg = 12.0;
    key.orientation.azimuth_deg = 60.0;
    for (tool, line) in [
        (Tool::vickers(), SHORT),
        (Tool::screwdriver(), &[[0.2, -0.4], [-0.3, 0.5]]),
    ] {
        let like = Scratch {
            keys: &[key],
            ..Scratch::new(&tool)
        };
        add(&mut builder, &Line::Straight(line), like);
    }
    builder.build()
}
