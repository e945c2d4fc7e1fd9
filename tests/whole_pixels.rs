//! Whole pixels against the paper's pairwise shadowing and masking formula, and that against rays.

mod support;

use rand::Rng;
use striae::scattering::{CrossFootprint, Output};
use support::caster::{Caster, Finish, Vector, any_profile, dot, shade, unit};
use support::{any_direction, random};

/// The paper's section 4 for a whole pixel, read correctly: g of a facet by itself and of the
/// facet past each vertex, higher ones only.
fn pairwise(caster: &Caster, l: Vector, v: Vector) -> f64 {
    let vertices: Vec<[f64; 2]> = std::iter::once(caster.segments[0][0])
        .chain(caster.segments.iter().map(|s| s[1]))
        .collect();
    let pixel_mm = vertices[vertices.len() - 1][0] - vertices[0][0];
    let mut f = 0.0;
    for (k, &[a, b]) in caster.segments.iter().enumerate() {
        let n = caster.normal(k);
        let cos_alpha = n[2];
        let length = b[0] - a[0];
        let gs = (1.0 / dot(n, l)).min(1.0 / dot(n, v)).clamp(0.0, 1.0);
        let g = |w: Vector, distance: f64, rise: f64, side: f64| {
            1.0 + distance / length * cos_alpha * (w[2] - side * rise / distance * w[0]) / dot(n, w)
        };
        let (mut left, mut right) = (1.0_f64, 1.0_f64);
        for w in [l, v] {
            for p in vertices[k + 2..].iter().filter(|p| p[1] > b[1]) {
                right = right.min(g(w, p[0] - b[0], p[1] - b[1], 1.0));
            }
            for p in vertices[..k].iter().filter(|p| p[1] > a[1]) {
                left = left.min(g(w, a[0] - p[0], p[1] - a[1], -1.0));
            }
        }
        let share = (gs * (left.max(0.0) + right.max(0.0) - 1.0)).max(0.0);
        if share > 0.0 {
            let r = length / pixel_mm * dot(n, l) * dot(n, v) / (cos_alpha * l[2] * v[2]);
            f += caster.reflected(k, l, v) / dot(n, l) * r * share;
        }
    }
    f
}

/// A whole pixel by rays from points spread along each facet.
fn cast_facets(caster: &Caster, l: Vector, v: Vector) -> f64 {
    const POINTS: u32 = 2000;
    let last = caster.segments.len() - 1;
    let pixel_mm = caster.segments[last][1][0] - caster.segments[0][0][0];
    let mut f = 0.0;
    for (k, &[a, b]) in caster.segments.iter().enumerate() {
        let open = (0..POINTS)
            .map(|i| (f64::from(i) + 0.5) / f64::from(POINTS))
            .map(|s| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])])
            .filter(|&p| caster.clear(k, p, l) && caster.clear(k, p, v))
            .count();
        if open > 0 {
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let share = f64::from(u32::try_from(open).unwrap()) / f64::from(POINTS);
            let cos = dot(caster.normal(k), v) / (l[2] * v[2]);
            f += caster.reflected(k, l, v) * cos * length * share / pixel_mm;
        }
    }
    f
}

/// Whole pixels against the paper's pairwise formula, and that against rays: a check of the caster, too.
#[test]
fn whole_pixels_and_pairwise_formula() {
    let mut random = random(3);
    let (mut worst_rays, mut worst_ours) = (0.0_f64, 0.0_f64);
    for _ in 0..200 {
        let points = any_profile(&mut random);
        let width = points[points.len() - 1][0] - points[0][0];
        let zone = Finish::Ggx(random.random_range(0.1..1.0), 0.5);
        let flat = Finish::Lambert(random.random_range(0.1..1.0));
        let (l, v) = (
            any_direction(&mut random, 85.0),
            any_direction(&mut random, 85.0),
        );
        let margin_mm = width * 10_f32.powf(random.random_range(-2.0..1.0));
        let caster = Caster::new(&points, f64::from(margin_mm), zone, flat);
        let truth = pairwise(&caster, unit(l), unit(v));
        let rays = cast_facets(&caster, unit(l), unit(v));
        let pixel = CrossFootprint::Whole { margin_mm };
        let ours = shade(&points, [zone, flat], pixel, l, v, Output::Brdf);
        worst_rays = worst_rays.max((rays - truth).abs() / truth.max(1e-3));
        let deviation = (ours - truth).abs() / truth.max(1e-3);
        worst_ours = worst_ours.max(deviation);
        assert!(
            deviation < 1e-4,
            "{ours} against {truth}: {points:?}, {margin_mm}, light {l:?}, view {v:?}"
        );
    }
    println!("whole pixels: ours {worst_ours:.1e}, rays {worst_rays:.1e} from pairwise");
    // Each facet's two ends of its open part are found to half a sample.
    assert!(
        worst_rays < 2e-3,
        "rays and pairwise formula differ by {worst_rays}"
    );
}
