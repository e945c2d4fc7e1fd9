//! Densities against areas and counted points.

use super::*;
use crate::pattern::{CenterLine, Left, Region};
use crate::single;
use glam::DVec2;

/// Any region weighs its share of the pixel, whichever way the scratch runs.
#[test]
fn weighs_its_area() {
    let pixel = Region::parallelogram(DVec2::new(0.3, 0.04), DVec2::new(-0.02, 0.15));
    let part = pixel
        .clipped(DVec2::new(0.03, 0.0), DVec2::new(0.9, 0.3))
        .unwrap();
    for degrees in [0.0_f64, 17.0, 90.0, 133.0] {
        let across = DVec2::from_angle(degrees.to_radians());
        let mut densities = <Densities>::EMPTY;
        let origin = DVec2::new(0.1, -0.2);
        let line = CenterLine::even(origin, across.perp());
        let weight = densities.add_regions(&[part], &line, pixel.area());
        let all = densities.between(&weight.unwrap(), -10.0, 10.0);
        let share = single(part.area() / pixel.area());
        assert!(
            (all - share).abs() < 1e-6,
            "{degrees}: {all} against {share}"
        );
    }
}

/// A whole pixel's density across, which is told at once, is that of the polygon: what of the pixel lies on one side of a
/// line weighs its area.
#[test]
fn sides_of_a_line_weigh_their_areas() {
    let edges = [
        [0.3, 0.04, -0.02, 0.15],
        [0.3, 0.0, 0.0, 0.3],
        [0.01, 0.2, 0.2, 0.01],
    ];
    for [ax, ay, bx, by] in edges {
        let pixel = Region::parallelogram(DVec2::new(ax, ay), DVec2::new(bx, by));
        for degrees in [0.0_f64, 17.0, 45.0, 90.0, 133.0, 201.0] {
            let across = DVec2::from_angle(degrees.to_radians());
            let (mut densities, origin) = (<Densities>::EMPTY, DVec2::new(0.1, -0.2));
            let line = CenterLine::even(origin, across.perp());
            let weight = densities.add_regions(&[pixel], &line, pixel.area());
            let weight = weight.unwrap();
            for place in (-30..30).map(|i| f64::from(i) * 0.013) {
                let side = pixel.clipped(origin + across * place, -across);
                let share = side.map_or(0.0, |side| side.area() / pixel.area());
                let ours = densities.between(&weight, -10.0, single(place));
                let off = (f64::from(ours) - share).abs();
                assert!(off < 2e-6, "{degrees}, {place}: {ours} against {share}");
            }
        }
    }
}

/// Across a run that tapers, what lies between its centre line and any line that leads to where it would end weighs the share
/// of the points of the pixel that lie there.
#[test]
fn points_of_a_tapering_run_weigh_their_share() {
    const SIDE: u32 = 500;
    let pixel = Region::parallelogram(DVec2::new(0.3, 0.04), DVec2::new(-0.02, 0.15));
    let cut = pixel.clipped(DVec2::new(0.03, 0.0), DVec2::new(0.9, 0.3));
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
    let points = (0..SIDE * SIDE).map(|i| {
        share(i % SIDE) * DVec2::new(0.3, 0.04) + share(i / SIDE) * DVec2::new(-0.02, 0.15)
    });
    let points: Vec<DVec2> = points.collect();
    for (region, taper) in [(pixel, 1.7), (pixel, -1.9), (cut.unwrap(), 1.9)] {
        for degrees in [0.0_f64, 17.0, 45.0, 90.0, 133.0, 201.0] {
            let travel = DVec2::from_angle(degrees.to_radians());
            let origin = DVec2::new(0.03, -0.02);
            let line = CenterLine::even(origin, travel).tapering(taper, [-0.05, 0.04], &region);
            let mut densities = <Densities>::EMPTY;
            let weight = densities.add_regions(&[region], &line, pixel.area());
            let weight = weight.unwrap();
            let across = |point: &DVec2| {
                let off = *point - origin;
                travel.perp_dot(-off) / (1.0 + taper * travel.dot(off))
            };
            let inside = points.iter().filter(|point| region.holds(**point));
            let mut all: Vec<f64> = inside.map(across).collect();
            all.sort_unstable_by(f64::total_cmp);
            for place in (-30..30).map(|i| f64::from(i) * 0.013) {
                let before = all.partition_point(|x| *x < place);
                let truth = before as f64 / f64::from(SIDE * SIDE);
                let ours = f64::from(densities.between(&weight, -10.0, single(place)));
                assert!(
                    (ours - truth).abs() < 3e-3,
                    "{taper}, {degrees}, {place}: {ours} against {truth}"
                );
            }
        }
    }
}

/// What strips leave of a pixel weighs, up to any place across, the strips' shares of what lay in them before.
#[test]
fn strips_weigh_what_is_left() {
    let pixel = Region::parallelogram(DVec2::new(0.3, 0.04), DVec2::new(-0.02, 0.15));
    let (low, step, shares) = (-0.03, 0.01, [1.0, 0.3, 0.3, 0.0, 0.5, 0.7, 0.9, 0.2]);
    let left = Left::new([low, step], shares, [1.0; 8]);
    for degrees in [0.0_f64, 17.0, 45.0, 133.0] {
        let travel = DVec2::from_angle(degrees.to_radians()).perp();
        let line = CenterLine::even(DVec2::new(0.01, 0.02), travel);
        let mut densities = <Densities>::EMPTY;
        let mut add = |left: &Left| {
            let weight = densities.add_left(&[pixel], Some(left), &line, pixel.area());
            weight.unwrap()
        };
        let [whole, cut] = [Left::even(1.0), left].map(|left| add(&left));
        for to in (-40..40).map(|i| single(0.005 * f64::from(i))) {
            let strip = |i: usize| {
                let ends = [i, i + 1].map(|k| match k {
                    0 => -10.0,
                    8 => 10.0,
                    _ => single(low + step * k as f64),
                });
                shares[i] * densities.between(&whole, ends[0], ends[1].min(to))
            };
            let wanted: f32 = (0..8).map(strip).sum();
            let ours = densities.between(&cut, -10.0, to);
            assert!(
                (ours - wanted).abs() < 2e-6,
                "{degrees}, {to}: {ours} against {wanted}"
            );
        }
    }
}

/// However small the pixel beside its distance from the centre line, all of it weighs 1.
#[test]
fn tiny_pixel_weighs_one() {
    for size in [1e-3, 1e-6, 1e-9] {
        let edge = |x: f64, y: f64| DVec2::new(x, y) * size;
        let pixel = Region::parallelogram(edge(1.0, 0.3), edge(-0.2, 0.9));
        let far = DVec2::new(-37.0, 5.0);
        let mut densities = <Densities>::EMPTY;
        let across = DVec2::from_angle(0.3);
        let line = CenterLine::even(far, across.perp());
        let weight = densities.add_regions(&[pixel], &line, pixel.area());
        let all = densities.between(&weight.unwrap(), -100.0, 100.0);
        assert!((all - 1.0).abs() < 1e-6, "{size}: {all}");
    }
}

/// An upright box of width 2 weighs x/2 up to x.
#[test]
fn box_is_linear() {
    let pixel = Region::parallelogram(DVec2::new(2.0, 0.0), DVec2::new(0.0, 5.0));
    let mut densities = <Densities>::EMPTY;
    let line = CenterLine::even(DVec2::ZERO, DVec2::Y);
    let weight = densities.add_regions(&[pixel], &line, pixel.area());
    let between = |from, to| densities.between(&weight.unwrap(), from, to);
    assert!((between(-1.0, 0.5) - 0.75).abs() < 1e-6, "not linear");
    assert_eq!(between(0.5, -1.0), 0.0, "swapped");
}
