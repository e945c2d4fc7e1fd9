//! Which way polishing lines run on the surface, and that scratches reflect what their facets do.

use super::{anisotropic, any_direction, cook_torrance, facet, oren_nayar, phong, single};
use rand::SeedableRng;
use rand::rngs::StdRng;
use striae::brdf::Brdf;
use striae::scattering::{CrossFootprint, Output, Shading};

/// A pixel that holds nothing but one flat strip of a scratch along y, or the flat surface beside it.
fn shaded(scratched: Brdf, surface: Brdf, center_mm: f64, view: [f32; 3]) -> Shading {
    let pixel = CrossFootprint::Box {
        center_mm,
        extents_mm: [0.1, 0.1],
    };
    let mut shading = Shading::default();
    let strip = [[-1.0, 0.0], [1.0, 0.0]];
    shading
        .shade_cross_section(&strip, &scratched, &surface, pixel, view)
        .unwrap();
    shading
}

/// Lines run along a scratch (y here), and on the flat surface along the local frame's x.
#[test]
fn lines_run_along() {
    let mut random = StdRng::seed_from_u64(61);
    for brdf in [
        anisotropic(0.5, 0.1),
        cook_torrance(0.3),
        oren_nayar(0.7),
        phong(9.0),
    ] {
        let facet = facet(brdf, 0.0);
        for _ in 0..300 {
            let [view, light] = [any_direction(&mut random), any_direction(&mut random)];
            let [view, light] = [view, light].map(single);
            let black = Brdf::Lambert { albedo: [0.0; 3] };
            let strip = shaded(brdf, black, 0.0, view).eval(light, Output::BrdfCos)[0];
            let flat = shaded(black, brdf, 5.0, view).eval(light, Output::BrdfCos)[0];
            let across = facet.eval(view, light)[0];
            // A quarter turn takes the surface's x to a scratch's y.
            let [view, light] = [view, light].map(|[x, y, z]| [-y, x, z]);
            let along = facet.eval(view, light)[0];
            assert!(
                (strip - across).abs() <= 1e-4 * across + 1e-6,
                "{brdf:?}: strip {strip}, facet {across}"
            );
            assert!(
                (flat - along).abs() <= 1e-4 * along + 1e-6,
                "{brdf:?}: surface {flat}, facet {along}"
            );
        }
    }
}
