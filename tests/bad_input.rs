//! What cannot be is refused, with the argument's name, the value and what is accepted.

mod support;

use striae::Result;
use striae::brdf::{Brdf, Fresnel};
use striae::formation::{CrossSection, Material, Orientation, Process, Tool};
use striae::pattern::PatternBuilder;
use support::refusal::{assert_named, assert_refused};
use support::{dark_sheet, ggx, lambert};

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;

/// Tools of impossible angles, sizes and counts.
#[test]
fn tools() {
    let cone = Tool::sphero_cone;
    assert_refused(
        "half_angle_deg",
        &[NAN, INF, -INF, -60.0, 0.0, 4.9, 85.1, 90.0],
        |x| cone(x, 0.2, 1.0),
    );
    assert_refused("tip_radius_mm", &[NAN, INF, -1e-9, 100.1], |x| {
        cone(60.0, x, 1.0)
    });
    assert_refused("height_mm", &[NAN, INF, -1.0, 0.0, 1e-7, 1001.0], |x| {
        cone(60.0, 0.2, x)
    });
    for sides in [0, 1, 2, 65, u32::MAX] {
        assert_named(Tool::pyramid(sides, 136.0, 1.0), "sides", f64::from(sides));
    }
    assert_refused(
        "angle_deg",
        &[NAN, INF, -136.0, 0.0, 9.9, 170.1, 180.0],
        |x| Tool::pyramid(4, x, 1.0),
    );
    assert_refused("height_mm", &[NAN, 0.0, -1.0, INF], |x| {
        Tool::pyramid(4, 136.0, x)
    });
    assert_refused("width_mm", &[NAN, INF, 0.0, -1.0, 1001.0], |x| {
        Tool::wedge(x, 60.0, 1.0)
    });
    assert_refused("angle_deg", &[NAN, INF, 0.0, -60.0, 180.0], |x| {
        Tool::wedge(1.0, x, 1.0)
    });
    assert_refused("height_mm", &[NAN, 0.0, -1.0, INF], |x| {
        Tool::wedge(1.0, 60.0, x)
    });
}

/// Tools given as points: none, too few, nowhere.
#[test]
fn tools_from_points() {
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
        [-1.0, -1.0, 1.0],
    ];
    let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1]];
    assert!(
        Tool::mesh(&corners, &faces, 1.0).is_ok(),
        "a good mesh is refused"
    );
    assert_refused("mm_per_unit", &[NAN, INF, 0.0, -1.0], |x| {
        Tool::mesh(&corners, &faces, x)
    });
    for x in [NAN, INF, -INF] {
        let mut bad = corners;
        bad[2][1] = x;
        assert!(Tool::mesh(&bad, &faces, 1.0).is_err(), "a corner at {x}");
        assert!(
            Tool::profile(&[[0.0, 0.0], [x, 1.0]]).is_err(),
            "a point at x {x}"
        );
        assert!(
            Tool::profile(&[[0.0, x], [1.0, 1.0]]).is_err(),
            "a point at z {x}"
        );
    }
    assert!(Tool::mesh(&corners, &[], 1.0).is_err(), "no triangle");
    assert!(Tool::mesh(&[], &faces, 1.0).is_err(), "no corner");
    assert!(
        Tool::mesh(&corners, &[[0, 1, 4]], 1.0).is_err(),
        "an index out of range"
    );
    assert!(
        Tool::mesh(&[[0.0; 3]; 3], &[[0, 1, 2]], 1.0).is_err(),
        "a mesh of no size"
    );
    assert!(
        Tool::profile(&[]).is_err() && Tool::profile(&[[0.0, 0.0]]).is_err(),
        "no profile"
    );
}

fn form(process: &Process) -> Result<CrossSection> {
    CrossSection::form(&Tool::rockwell_c(), process, &dark_sheet())
}

/// Forces, hardness and angles that no hand has.
#[test]
fn processes() {
    let with = |change: &dyn Fn(&mut Process)| {
        let mut process = Process {
            force_kgf: 1.0,
            ..Process::default()
        };
        change(&mut process);
        form(&process)
    };
    assert!(with(&|_| ()).is_ok(), "a good process is refused");
    let far = [NAN, INF, -INF, 3601.0, -3601.0];
    assert_refused("force_kgf", &[NAN, INF, -1.0, -1e-12, 100_001.0], |x| {
        with(&|p| p.force_kgf = x)
    });
    assert_refused("tilt_deg", &[NAN, INF, -1.0, 85.1, 90.0, 180.0], |x| {
        with(&|p| p.orientation.tilt_deg = x)
    });
    assert_refused("spin_deg", &far, |x| with(&|p| p.orientation.spin_deg = x));
    assert_refused("azimuth_deg", &far, |x| {
        with(&|p| p.orientation.azimuth_deg = x)
    });
    for hardness in [NAN, INF, -150.0, 0.0, 0.009, 20_001.0] {
        let material = Material::new(hardness, lambert(0.5), lambert(0.5));
        let process = Process::default();
        let formed = CrossSection::form(&Tool::vickers(), &process, &material);
        assert_named(formed, "hardness_hv", hardness);
    }
}

/// A tool that is shorter than its groove would be deep, or leant until its flank lies on the surface.
#[test]
fn tools_too_short_or_too_flat() {
    let short = Tool::sphero_cone(60.0, 0.2, 0.03).unwrap();
    let process = |force_kgf, tilt_deg| Process {
        force_kgf,
        orientation: Orientation {
            tilt_deg,
            ..Orientation::default()
        },
        ..Process::default()
    };
    assert!(
        CrossSection::form(&short, &process(1.0, 0.0), &dark_sheet()).is_ok(),
        "shallow"
    );
    let error = CrossSection::form(&short, &process(100.0, 0.0), &dark_sheet()).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("height") || message.contains("force"),
        "too short: {message}"
    );
    for tilt in [30.1, 60.0, 85.0] {
        let leant = form(&process(1.0, tilt));
        assert_named(leant, "tilt_deg", tilt);
    }
}

/// BRDFs that are none, wherever a material is taken.
#[test]
fn materials() {
    let rgb = |x: f64| [0.5, support::single(x), 0.5];
    let conductor = |eta: f64, k: f64| Brdf::Ggx {
        alpha: 0.1,
        fresnel: Fresnel::Conductor {
            eta: rgb(eta),
            k: rgb(k),
        },
    };
    let schlick = |x| Brdf::Ggx {
        alpha: 0.1,
        fresnel: Fresnel::Schlick { f0: rgb(x) },
    };
    let fraction = [NAN, INF, -0.25, 1.25];
    for scratched in [false, true] {
        let build = |brdf| {
            let [mut a, mut b] = [lambert(0.5), brdf];
            if !scratched {
                std::mem::swap(&mut a, &mut b);
            }
            PatternBuilder::new(Material::new(150.0, a, b), 1.0, [1.0, 1.0])
        };
        assert_refused("albedo", &fraction, |x| {
            build(Brdf::Lambert { albedo: rgb(x) })
        });
        assert_refused("f0", &fraction, |x| build(schlick(x)));
        assert_refused("alpha", &[NAN, INF, -0.5, 0.0, 1.25], |x| {
            build(ggx(support::single(x), 0.5))
        });
        assert_refused("eta", &[NAN, INF, -1.0, 0.0, 21.0], |x| {
            build(conductor(x, 1.0))
        });
        assert_refused("k", &[NAN, INF, -1.0, 21.0], |x| build(conductor(1.0, x)));
    }
}

/// Scales of nothing, or of no number.
#[test]
fn scales() {
    let scales = [NAN, INF, 0.0, -1.0, 1e-10, 1e10];
    let build = |mm, units| PatternBuilder::new(dark_sheet(), mm, units);
    assert_refused("mm_per_scene_unit", &scales, |x| build(x, [1.0, 1.0]));
    assert_refused("units_per_uv", &scales, |x| build(1.0, [x, 1.0]));
    assert_refused("units_per_uv", &scales, |x| build(1.0, [1.0, x]));
}
