//! More scratches than the caller has room for, or than are told apart.

use super::support::process::{UPRIGHT, form};
use super::support::{dark_sheet, sheet_of};
use super::{NONE, hits, pixel};
use glam::DVec2;
use striae::formation::{DepthLaw, Tool};
use striae::pattern::{Found, Key, Path, Pattern, Scratch};

/// The one of so many parallel scratches, 0.9 mm apart, whose forces grow.
pub(crate) fn parallel(count: u32) -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    let tool = Tool::rockwell_c();
    for i in 0..count {
        let v = 0.5 + 0.0009 * f64::from(i) - 0.00045 * f64::from(count);
        let scratch = Scratch {
            path: Path::Polyline(&[[0.4, v], [0.6, v]]),
            keys: &[Key::force(
                0.0,
                1.0 + f64::from(i * 37 % count) / f64::from(count),
            )],
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
    }
    builder.build()
}

/// However short the caller's array, the count is that of all, and the largest ones are written in their order; what
/// is beyond the last one stays as it was.
#[test]
fn capacities() {
    let (pattern, point) = (
        parallel(150),
        pixel(DVec2::splat(0.5), 180.0 * DVec2::X, 180.0 * DVec2::Y),
    );
    let all = hits(&pattern, &point);
    assert_eq!(all.len(), 150, "scratches");
    assert!(
        all.windows(2)
            .all(|pair| pair[0].coverage >= pair[1].coverage),
        "order"
    );
    let mut numbers: Vec<u32> = all.iter().map(|hit| hit.scratch).collect();
    numbers.sort_unstable();
    assert!(numbers.into_iter().eq(0..150), "each once");
    for hit in &all {
        let force = 1.0 + f64::from(hit.scratch * 37 % 150) / 150.0;
        let section = form(&Tool::rockwell_c(), DepthLaw::default(), force, UPRIGHT);
        let points = section.vertices();
        let share = (points[points.len() - 1].x - points[0].x) / 180.0;
        assert!(
            (f64::from(hit.coverage) / share - 1.0).abs() < 1e-4,
            "{hit:?}: {share}"
        );
    }
    for capacity in [0, 1, 2, 149, 150, 200] {
        let mut written = vec![NONE; capacity];
        let found = pattern.hits(&point, &mut written).unwrap();
        let expected = Found {
            written: capacity.min(150),
            count: 150,
            complete: true,
        };
        assert_eq!(found, expected, "capacity {capacity}");
        assert_eq!(
            written[..found.written],
            all[..found.written],
            "capacity {capacity}"
        );
        assert!(
            written[found.written..].iter().all(|hit| *hit == NONE),
            "the rest"
        );
    }
}

/// A footprint over more scratches than can be told apart says so.
#[test]
fn too_many_to_tell_apart() {
    let (pattern, mut hits) = (parallel(4000), [NONE; 8]);
    let point = pixel(DVec2::splat(0.5), 5000.0 * DVec2::X, 5000.0 * DVec2::Y);
    let found = pattern.hits(&point, &mut hits).unwrap();
    assert!(!found.complete && found.count < 4000, "{found:?}");
    assert!(
        hits[found.written..].iter().all(|hit| *hit == NONE),
        "{found:?}"
    );
}
