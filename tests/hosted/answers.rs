//! What hosts are asked, and what becomes of what they say.

use super::hosts::{Odd, Satin, hosted};
use super::support::lambert;
use super::{both, pattern, point};
use std::sync::Mutex;
use striae::brdf::{Brdf, Facet, HostBrdf, Hosted, Lobe};
use striae::scattering::{Bounces, Output, Shading};

const NONE: Brdf = Brdf::Lambert { albedo: [0.0; 3] };

/// What is negative or no number counts as 0, each channel by itself; a light of no direction as none.
#[test]
fn nonsense_is_black() {
    let (nan, infinite) = (f32::NAN, f32::INFINITY);
    let facet = |f, light, pdf| Facet::new(hosted(Odd { f, light, pdf }), 10.0).unwrap();
    let up = [0.0, 0.0, 1.0];
    let good = facet([0.25, -0.5, nan], Some([0.0, 0.0, 7.0]), 2.0);
    assert_eq!(good.eval(up, up), [0.25, 0.0, 0.0]);
    assert_eq!(good.pdf(up, up), 2.0);
    let light = good.sample([0.5; 2], up).unwrap();
    assert!((light[0].hypot(light[2]) - 1.0).abs() < 1e-6, "{light:?}");
    for light in [
        None,
        Some([0.0; 3]),
        Some([nan, 0.0, 1.0]),
        Some([infinite; 3]),
    ] {
        assert_eq!(facet([1.0; 3], light, 1.0).sample([0.5; 2], up), None);
    }
    for pdf in [nan, infinite, -infinite, -3.0] {
        assert_eq!(facet([1.0; 3], Some(up), pdf).pdf(up, up), 0.0);
    }
    assert_eq!(
        facet([infinite, -infinite, 1.0], None, 1.0).eval(up, up),
        [0.0, 0.0, 1.0]
    );
}

/// The same in whole pixels, with one bounce and with all: numbers, none below 0.
#[test]
fn nonsense_spoils_no_pixel() {
    let (nan, infinite) = (f32::NAN, f32::INFINITY);
    let values = [nan, infinite, -infinite, -1.0, 0.0, 1e-45, 1e30, f32::MAX];
    for (i, &value) in values.iter().enumerate() {
        let other = values[(i + 3) % values.len()];
        let odd = hosted(Odd {
            f: [value, other, 0.5],
            light: [None, Some([value, other, 1.0]), Some([0.3, 0.0, -0.5])][i % 3],
            pdf: [other, 0.7][i % 2],
        });
        for crowd in [0, 300] {
            let pattern = pattern([odd, lambert(0.5), odd], crowd);
            let mut shading = Shading::default();
            for place in 0..6 {
                shading
                    .shade(&pattern, &point(place), [0.3, 0.1, 1.0])
                    .unwrap();
                for bounces in [Bounces::One, Bounces::All] {
                    shading.set_bounces(bounces);
                    let light = [-0.2, 0.4, 1.0];
                    let both = shading.eval_pdf(light);
                    let sample = shading.sample([0.4, 0.2, 0.6]);
                    let (weight, pdf) = sample.map_or(([0.0; 3], 0.0), |s| (s.weight, s.pdf));
                    let told = [shading.albedo(), weight, both.brdf_cos].concat();
                    let densities = [pdf, both.pdf, shading.pdf_reverse(light)];
                    for number in told.into_iter().chain(densities) {
                        assert!(number.is_finite() && number >= 0.0, "{value}: {number}");
                    }
                }
            }
        }
    }
}

/// Directions that a host was asked about.
static ASKED: Mutex<Vec<[[f32; 3]; 2]>> = Mutex::new(Vec::new());

struct Listening;

impl HostBrdf for Listening {
    fn eval(&self, view: [f32; 3], light: [f32; 3]) -> [f32; 3] {
        ASKED.lock().unwrap().push([view, light]);
        [light[2]; 3]
    }

    fn sample(&self, _: [f32; 2], _: [f32; 3]) -> Option<[f32; 3]> {
        None
    }

    fn pdf(&self, _: [f32; 3], _: [f32; 3]) -> f32 {
        0.0
    }

    fn lobe(&self) -> Lobe {
        Lobe::Diffuse
    }

    fn alphas(&self) -> [f32; 2] {
        [1.0; 2]
    }
}

fn assert_near(ours: [f32; 3], truth: [f32; 3]) {
    let off = (0..3).map(|i| (ours[i] - truth[i]).abs());
    assert!(off.fold(0.0, f32::max) < 1e-6, "{ours:?}, not {truth:?}");
}

/// Hosts see x across the scratch, y along it, z the zone's normal; the flat surface is a zone that runs along dP/du. All
/// asked directions are unit vectors above the zone.
#[test]
fn directions_are_the_zones_own() {
    let listening = hosted(Listening);
    let asked = || core::mem::take(&mut *ASKED.lock().unwrap());
    // Leaning by 30 degrees, the scratch's "up" leans back.
    let facet = Facet::new(listening, 30.0).unwrap();
    facet.eval([0.0, 0.0, 2.0], [0.0, 0.6, 0.8]);
    let [view, light] = asked()[0];
    assert_near(view, [-0.5, 0.0, 0.75_f32.sqrt()]);
    assert_near(light, [-0.4, 0.6, 0.8 * 0.75_f32.sqrt()]);
    // The flat surface: x is across its polishing lines, to the right of dP/du.
    let mut shading = Shading::default();
    let pattern = pattern([listening, NONE, NONE], 0);
    let mut far = point(0);
    far.uv = [0.9, 0.9];
    shading.shade(&pattern, &far, [0.6, 0.0, 0.8]).unwrap();
    shading.eval([0.0, 0.6, 0.8], Output::BrdfCos);
    let [view, light] = asked()[0];
    assert_near(view, [0.0, 0.6, 0.8]);
    assert_near(light, [-0.6, 0.0, 0.8]);
    // Nothing is asked about directions below the zone.
    facet.eval([-1.0, 0.0, 0.1], [0.0, 0.0, 1.0]);
    facet.eval([0.0, 0.0, 1.0], [-1.0, 0.0, 0.1]);
    assert!(asked().is_empty(), "asked about what is below");
}

/// A point names the zones' own base BRDFs again, whoever's they are.
#[test]
fn zones_name_them() {
    let [_, own] = both();
    let pattern = pattern(own, 0);
    assert_eq!(pattern.hosted().len(), 3);
    let mut shading = Shading::default();
    shading.shade(&pattern, &point(1), [0.0, 0.0, 1.0]).unwrap();
    assert_eq!(shading.zone_brdf(0), Some(own[0]));
    let named: Vec<_> = (1..3).filter_map(|i| shading.zone_brdf(i)).collect();
    assert!(
        named.contains(&own[1]) && named.contains(&own[2]),
        "{named:?}"
    );
}

/// Threads that make them known at once, while others ask, get each its own.
#[test]
fn known_by_many_threads() {
    std::thread::scope(|scope| {
        for thread in 0..8_u8 {
            scope.spawn(move || {
                for i in 0..100_u8 {
                    let value = f32::from(i) + 100.0 * f32::from(thread);
                    let told = Odd {
                        f: [value; 3],
                        light: None,
                        pdf: value,
                    };
                    let facet = Facet::new(hosted(told), 0.0).unwrap();
                    let up = [0.0, 0.0, 1.0];
                    assert_eq!(facet.eval(up, up), [value; 3], "{thread}, {i}");
                }
            });
        }
    });
}

/// Widths out of range are refused by name.
#[test]
fn ranges() {
    for (alphas, name) in [
        ([0.0, 0.5], "alpha_across"),
        ([0.5, 1.5], "alpha_along"),
        ([f32::NAN, 0.5], "alpha_across"),
    ] {
        let refused = Hosted::new(Satin {
            alphas,
            eta_k: None,
        });
        assert_eq!(refused.unwrap_err().argument(), name);
    }
}

/// A point outlives the pattern that it was prepared from.
#[test]
fn points_outlive_patterns() {
    let [_, own] = both();
    let mut shading = Shading::default();
    let pattern = pattern(own, 0);
    shading.shade(&pattern, &point(1), [0.0, 0.0, 1.0]).unwrap();
    let light = [0.3, 0.2, 1.0];
    let before = shading.eval(light, Output::Brdf);
    drop(pattern);
    assert_eq!(shading.eval(light, Output::Brdf), before);
    assert!(before[0] > 0.0, "{before:?}");
}
