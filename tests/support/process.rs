//! Cross-sections of any tool in any hand.

use super::dark_sheet;
use rand::Rng;
use rand::rngs::StdRng;
use striae::formation::{CrossSection, DepthLaw, Orientation, Process, Tool};

/// Hardness of [`dark_sheet`].
pub(crate) const HV: f64 = 150.0;

pub(crate) fn form(
    tool: &Tool,
    depth_law: DepthLaw,
    force_kgf: f64,
    orientation: Orientation,
) -> CrossSection {
    let process = Process {
        depth_law,
        force_kgf,
        orientation,
        ..Process::default()
    };
    CrossSection::form(tool, &process, &dark_sheet())
        .unwrap_or_else(|error| panic!("{process:?}: {error}"))
}

pub(crate) const UPRIGHT: Orientation = Orientation {
    spin_deg: 0.0,
    tilt_deg: 0.0,
    azimuth_deg: 0.0,
};

/// A tool, and whether it has a straight edge (with corners apart) instead of a tip.
pub(crate) fn any_tool(random: &mut StdRng) -> (Tool, bool) {
    let angle = random.random_range(100.0..160.0);
    match random.random_range(0..4) {
        0 => (Tool::sphero_cone(0.5 * angle, 0.1, 5.0).unwrap(), false),
        1 => (
            Tool::pyramid(random.random_range(3..7), angle, 5.0).unwrap(),
            false,
        ),
        2 => (
            Tool::wedge(random.random_range(0.05..0.5), angle, 5.0).unwrap(),
            true,
        ),
        _ => (Tool::rockwell_c(), false),
    }
}

/// An orientation that no tool of [`any_tool`] is refused in.
pub(crate) fn any_hold(random: &mut StdRng) -> Orientation {
    Orientation {
        spin_deg: random.random_range(-180.0..180.0),
        tilt_deg: random.random_range(0.0..9.0),
        azimuth_deg: random.random_range(-180.0..180.0),
    }
}
