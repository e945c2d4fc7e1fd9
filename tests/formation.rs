//! What the process laws promise of a cross-section: area, flanks, depth, width and growth.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::formation::{DepthLaw, Orientation, Peak, Tool};
use support::process::{HV, UPRIGHT, any_hold, any_tool, form};
use support::{random, relative};

fn peak_area(peak: Peak) -> f64 {
    0.5 * peak.height_mm * (peak.inner_width_mm + peak.outer_width_mm)
}

/// Nothing is lost: each peak holds half of the groove, and all vertices enclose as much above the surface as
/// below.
#[test]
fn area_is_conserved() {
    let mut random = random(41);
    for _ in 0..300 {
        let (tool, _) = any_tool(&mut random);
        let force = 10_f64.powf(random.random_range(-0.5..2.0));
        let section = form(&tool, DepthLaw::Bosch2004, force, any_hold(&mut random));
        let area = section.groove_area_mm2();
        for peak in [section.left(), section.right()] {
            assert!(
                relative(peak_area(peak), 0.5 * area) < 1e-9,
                "a peak of {} beside a groove of {area}",
                peak_area(peak)
            );
        }
        let vertices = section.vertices();
        let enclosed: f64 = vertices
            .windows(2)
            .map(|pair| 0.5 * (pair[0].y + pair[1].y) * (pair[1].x - pair[0].x))
            .sum();
        assert!(
            enclosed.abs() < 1e-3 * area,
            "{enclosed} left over of {area}: {section:?}"
        );
        assert_eq!(vertices[0].y, 0.0, "left end");
        assert_eq!(vertices[vertices.len() - 1].y, 0.0, "right end");
    }
}

/// Peaks follow the relation between the flanks, with its continuation and limits.
#[test]
fn peaks_follow_the_relation() {
    let mut random = random(42);
    let (mut steep, mut shallow, mut between) = (0, 0, 0);
    for _ in 0..500 {
        let half_angle = random.random_range(5.0..85.0);
        let tool = Tool::sphero_cone(half_angle, 0.0, 5.0).unwrap();
        let section = form(&tool, DepthLaw::Bosch2004, 2.0, UPRIGHT);
        let peak = section.left();
        assert!(
            (peak.alpha_deg - (90.0 - half_angle)).abs() < 1e-9,
            "alpha {}",
            peak.alpha_deg
        );
        let tan_alpha = peak.alpha_deg.to_radians().tan();
        let line = -0.56 + 2.54 * tan_alpha;
        let beta = line.max(0.25 * tan_alpha).atan().to_degrees();
        assert!(
            (peak.beta_deg - beta.min(85.0)).abs() < 1e-9,
            "beta {}, not {beta} at alpha {}",
            peak.beta_deg,
            peak.alpha_deg
        );
        *(if beta > 85.0 {
            &mut steep
        } else if line < 0.25 * tan_alpha {
            &mut shallow
        } else {
            &mut between
        }) += 1;
        let (cot_alpha, cot_beta) = (1.0 / tan_alpha, 1.0 / peak.beta_deg.to_radians().tan());
        let height = (section.groove_area_mm2() / (cot_alpha + cot_beta)).sqrt();
        for (ours, expected) in [
            (peak.height_mm, height),
            (peak.inner_width_mm, height * cot_alpha),
            (peak.outer_width_mm, height * cot_beta),
        ] {
            assert!(
                relative(ours, expected) < 1e-9,
                "{ours}, not {expected}: {peak:?}"
            );
        }
    }
    assert!(steep > 5 && shallow > 5 && between > 5, "not all cases met");
}

/// A wedge across the travel ploughs a flat-bottomed groove as wide as its edge; along the travel, a V of its
/// own angle; its azimuth 90 corner leads on the left.
#[test]
fn wedges() {
    let tool = Tool::wedge(0.4, 100.0, 5.0).unwrap();
    let spun = |spin_deg| Orientation {
        spin_deg,
        ..UPRIGHT
    };
    let across = form(&tool, DepthLaw::Bosch2004, 3.0, UPRIGHT);
    let depth = across.depth_mm();
    assert!(relative(across.groove_width_mm(), 0.4) < 1e-9, "{across:?}");
    assert!(
        relative(across.groove_area_mm2(), 0.4 * depth) < 1e-9,
        "{across:?}"
    );
    assert!(
        (across.left().alpha_deg - 85.0).abs() < 1e-9,
        "upright walls: {across:?}"
    );
    let along = form(&tool, DepthLaw::Bosch2004, 3.0, spun(90.0));
    assert!((along.left().alpha_deg - 40.0).abs() < 1e-6, "{along:?}");
    let width = 2.0 * depth * 50.0_f64.to_radians().tan();
    assert!(relative(along.groove_width_mm(), width) < 1e-6, "{along:?}");
    let turned = form(&tool, DepthLaw::Bosch2004, 3.0, spun(30.0));
    assert!(
        turned.groove_width_mm() > 0.4 * 30.0_f64.to_radians().cos(),
        "{turned:?}"
    );
    // Leant to the left, its left end goes deepest.
    let leant = Orientation {
        tilt_deg: 5.0,
        azimuth_deg: 90.0,
        ..UPRIGHT
    };
    let leant = form(&tool, DepthLaw::Bosch2004, 3.0, leant);
    let lowest = leant
        .vertices()
        .into_iter()
        .min_by(|a, b| a.y.total_cmp(&b.y))
        .unwrap();
    assert!(
        lowest.x < -0.19 && leant.left().alpha_deg > leant.right().alpha_deg,
        "{leant:?}"
    );
    assert!((leant.right().alpha_deg - 5.0).abs() < 1e-6, "{leant:?}");
}

/// The 2004 fit, to the letter, and no scratch below its threshold.
#[test]
fn bosch_2004_depth() {
    for force in [0.01, 0.0625, 0.0627, 0.51, 1.0, 10.0, 300.0] {
        let fit = 0.182 * (force / HV + 0.0055_f64).sqrt() - 0.014;
        let section = form(&Tool::vickers(), DepthLaw::Bosch2004, force, UPRIGHT);
        assert!(
            (section.depth_mm() - fit.max(0.0)).abs() < 1e-12,
            "{} at {force} kgf, not {fit}",
            section.depth_mm()
        );
        if fit < 0.0 {
            assert_eq!(section.crest_width_mm(), 0.0, "a scratch at {force} kgf");
            assert!(
                section.vertices().iter().all(|p| *p == DVec2::ZERO),
                "{section:?}"
            );
        }
    }
}

/// Scratch hardness: crest to crest, pile-up included, w = sqrt(8 F / (π HS)), for any tool in any hand.
#[test]
fn scratch_hardness_width() {
    let mut random = random(44);
    let mut worst = 0.0_f64;
    for _ in 0..300 {
        // A blunt edge is never narrower than itself, whatever the force.
        let tool = match any_tool(&mut random) {
            (_, true) => Tool::berkovich(),
            (tool, false) => tool,
        };
        let force = 10_f64.powf(random.random_range(-3.0..1.0));
        let section = form(
            &tool,
            DepthLaw::ScratchHardness,
            force,
            any_hold(&mut random),
        );
        let width = (8.0 * force / (std::f64::consts::PI * HV)).sqrt();
        worst = worst.max(relative(section.crest_width_mm(), width));
    }
    println!("scratch hardness: {worst:.1e}");
    assert!(worst < 1e-6, "{worst} off");
}

/// More force, more of everything; but the crests of a straight edge draw nearer as its far corner passes the
/// surface, and the flank there stands up.
#[test]
fn all_grows_with_force() {
    let mut random = random(45);
    for law in [DepthLaw::Bosch2004, DepthLaw::ScratchHardness] {
        for _ in 0..40 {
            let ((tool, cornered), hold) = (any_tool(&mut random), any_hold(&mut random));
            let mut before = [0.0; 4];
            for i in 0..60 {
                let force = 10_f64.powf(-3.0 + 0.08 * f64::from(i));
                let section = form(&tool, law, force, hold);
                let now = [
                    section.depth_mm(),
                    section.groove_area_mm2(),
                    section.groove_width_mm(),
                    if cornered {
                        0.0
                    } else {
                        section.crest_width_mm()
                    },
                ];
                for (before, now) in before.into_iter().zip(now) {
                    // A wall that stands upright is as wide at any depth.
                    assert!(
                        now >= before * (1.0 - 1e-9),
                        "{before}, then {now} at {force} kgf, {section:?}"
                    );
                }
                before = now;
            }
        }
    }
}
