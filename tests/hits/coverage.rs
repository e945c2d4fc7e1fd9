//! What share of a footprint each scratch covers.

use super::support::lines::{Line, pattern};
use super::support::process::{UPRIGHT, form};
use super::support::{SHEET_MM, dark_sheet, random, straight};
use super::{hits, only, pixel, there};
use glam::DVec2;
use rand::Rng;
use striae::formation::{DepthLaw, Tool};
use striae::pattern::{Key, Pattern};
use striae::scattering::Shading;

/// Where two scratches cross, the later one covers, the earlier one has what is left; of equal ones the later one
/// comes first.
#[test]
fn later_scratches_cut_earlier_ones() {
    let lines = [([0.2, 0.5], [0.8, 0.5]), ([0.5, 0.2], [0.5, 0.8])];
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &lines, 2.0);
    let middle = DVec2::splat(0.5);
    let crossing = only(&pattern, &there(middle));
    assert_eq!(
        (crossing.scratch, crossing.coverage),
        (1, 1.0),
        "{crossing:?}"
    );
    let section = form(&Tool::rockwell_c(), DepthLaw::default(), 2.0, UPRIGHT);
    let points = section.vertices();
    let width = points[points.len() - 1].x - points[0].x;
    for side in [2.0 * width, 5.0 * width] {
        let hits = hits(&pattern, &pixel(middle, side * DVec2::X, side * DVec2::Y));
        let shares = [width / side, width * (side - width) / (side * side)];
        assert_eq!(hits.len(), 2, "{hits:?}");
        for (i, (hit, share)) in hits.iter().zip(shares).enumerate() {
            assert_eq!(hit.scratch as usize, 1 - i, "{hit:?}");
            assert!(
                (f64::from(hit.coverage) - share).abs() < 1e-5,
                "{hit:?}: {share}"
            );
        }
    }
    let corner = middle + DVec2::splat(2.0 / SHEET_MM);
    let both = hits(&pattern, &pixel(corner, 5.0 * DVec2::X, 5.0 * DVec2::Y));
    let order: Vec<u32> = both.iter().map(|hit| hit.scratch).collect();
    assert_eq!(order, [1, 0], "{both:?}");
    let apart = [([0.2, 0.5], [0.8, 0.5]), ([0.2, 0.501], [0.8, 0.501])];
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &apart, 2.0);
    let both = hits(
        &pattern,
        &pixel(DVec2::new(0.5, 0.5005), 4.0 * DVec2::X, 4.0 * DVec2::Y),
    );
    assert_eq!(
        both.iter().map(|hit| hit.scratch).collect::<Vec<_>>(),
        [1, 0],
        "{both:?}"
    );
}

/// Bent, crossing and cornered scratches, some crossing themselves.
fn tangle() -> Pattern {
    let lines = [
        Line::Straight(&[[-5.0, -0.2], [5.0, 0.3]]),
        Line::Curve(&[[-1.0, -1.0], [3.0, 2.0], [-3.0, 2.0], [1.0, -1.0]]),
        Line::Straight(&[[-2.0, 0.9], [0.2, 0.9], [0.4, -2.0]]),
    ];
    let keys = [Key::force(0.0, 0.5), Key::force(1.0, 3.0)];
    pattern(&dark_sheet(), &lines, &keys)
}

/// What a footprint says that a scratch covers is the share of its points that find the scratch; runs of one
/// scratch are one hit.
#[test]
fn coverage_is_the_share_of_points() {
    let pattern = tangle();
    for (center_mm, side_mm) in [([0.0, 0.1], 1.0), ([0.3, 0.9], 1.0), ([0.05, -0.2], 0.5)] {
        assert_covers_its_points(&pattern, center_mm, side_mm);
    }
}

/// So it is where scratches set in and run out.
#[test]
fn tips_cover_their_points() {
    let lines = [
        Line::Straight(&[[0.0, 0.0], [1.2, 0.3]]),
        Line::Curve(&[[0.1, 0.4], [0.2, 0.3], [0.1, 0.1], [0.3, -0.3]]),
    ];
    let forces = [(0.0, 0.0), (0.3, 1.5), (0.6, 1.5), (1.0, 0.0)];
    let keys = forces.map(|(at, force_kgf)| Key::force(at, force_kgf));
    let pattern = pattern(&dark_sheet(), &lines, &keys);
    for center_mm in [
        [0.0, 0.0],
        [0.1, 0.03],
        [0.2, 0.07],
        [1.1, 0.27],
        [0.12, 0.3],
    ] {
        for side_mm in [0.03, 0.1, 0.3] {
            assert_covers_its_points(&pattern, center_mm, side_mm);
        }
    }
}

fn assert_covers_its_points(pattern: &Pattern, center_mm: [f64; 2], side_mm: f64) {
    const SIDE: u32 = 120;
    let center = DVec2::splat(0.5) + DVec2::from(center_mm) / SHEET_MM;
    let (dx, dy) = (
        side_mm * DVec2::new(0.9, 0.2),
        side_mm * DVec2::new(-0.3, 0.8),
    );
    let mut shares = [0.0; 3];
    for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
        let [a, b] = [i, j].map(|i| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5);
        for hit in hits(pattern, &there(center + (a * dx + b * dy) / SHEET_MM)) {
            shares[hit.scratch as usize] += f64::from(hit.coverage) / f64::from(SIDE * SIDE);
        }
    }
    let hits = hits(pattern, &pixel(center, dx, dy));
    println!("{center_mm:?}, {side_mm} mm: {shares:?} by points, {hits:?}");
    assert!(
        hits.windows(2)
            .all(|pair| pair[0].coverage >= pair[1].coverage),
        "order"
    );
    for (i, share) in shares.into_iter().enumerate() {
        let mut own = hits.iter().filter(|hit| hit.scratch as usize == i);
        let coverage = own.next().map_or(0.0, |hit| f64::from(hit.coverage));
        assert!(
            (coverage - share).abs() < 2e-3,
            "scratch {i}: {coverage}, by points {share}"
        );
        assert!(own.next().is_none(), "scratch {i} twice: {hits:?}");
    }
}

/// Seen from above, a pixel shows of scratches what they cover of it.
#[test]
fn coverage_is_what_shading_shows_from_above() {
    let mm = |x: f64, y: f64| [0.5 + x / SHEET_MM, 0.5 + y / SHEET_MM];
    let lines = [
        (mm(-9.0, -1.0), mm(9.0, 1.5)),
        (mm(-9.0, 2.0), mm(9.0, -2.5)),
        (mm(0.3, -9.0), mm(-0.4, 9.0)),
    ];
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &lines, 2.0);
    let (mut random, mut shading) = (random(72), Shading::default());
    let mut worst = 0.0_f32;
    for _ in 0..300 {
        let place = DVec2::new(
            random.random_range(-2.0..2.0),
            random.random_range(-2.0..2.0),
        );
        let side = 10.0_f64.powf(random.random_range(-3.0..0.3));
        let turn = side * DVec2::from_angle(random.random_range(0.0..6.3));
        let point = pixel(
            DVec2::splat(0.5) + place / SHEET_MM,
            turn,
            0.8 * turn.perp(),
        );
        shading.shade(&pattern, &point, [0.0, 0.0, 1.0]).unwrap();
        let sum: f32 = hits(&pattern, &point).iter().map(|hit| hit.coverage).sum();
        worst = worst.max((sum - shading.coverage()).abs());
    }
    println!("worst difference {worst:.1e}");
    assert!(worst < 1e-5, "{worst}");
}
