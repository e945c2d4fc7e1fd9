//! What a renderer is told of the scratches in a footprint is what was scratched.

mod coverage;
mod many;
mod places;
mod refused;
#[path = "../support/mod.rs"]
mod support;

use glam::DVec2;
use striae::formation::Tool;
use striae::pattern::{Footprint, Pattern, ScratchHit, SurfacePoint};
use support::{SHEET_MM, Sheet, dark_sheet, sheet_of, straight};

const NONE: ScratchHit = ScratchHit {
    scratch: u32::MAX,
    coverage: -1.0,
    arc_length: -1.0,
    offset_mm: 0.0,
    travel: [0.0; 3],
    depth_mm: 0.0,
    deepest_mm: 0.0,
};

fn hits(pattern: &Pattern, point: &SurfacePoint) -> Vec<ScratchHit> {
    let mut hits = vec![NONE; 400];
    let found = pattern.hits(point, &mut hits).unwrap();
    assert!(found.complete, "too many to tell apart at {point:?}");
    assert_eq!(found.written, found.count, "room for all");
    hits[..found.written].to_vec()
}

fn only(pattern: &Pattern, point: &SurfacePoint) -> ScratchHit {
    let hits = hits(pattern, point);
    assert_eq!(hits.len(), 1, "{hits:?} at {point:?}");
    hits[0]
}

/// A pixel around a place of the upright sheet, (u, v), with edges in mm.
fn pixel(uv: DVec2, dx_mm: DVec2, dy_mm: DVec2) -> SurfacePoint {
    Sheet::UPRIGHT.point(uv, dx_mm / SHEET_MM, dy_mm / SHEET_MM)
}

fn there(uv: DVec2) -> SurfacePoint {
    SurfacePoint {
        footprint: Footprint::Point,
        ..pixel(uv, DVec2::X, DVec2::Y)
    }
}

/// Nothing is found beside a scratch, beyond its ends, or on a bare sheet.
#[test]
fn nothing_there() {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0);
    for uv in [[0.5, 0.502], [0.81, 0.5], [0.19, 0.5], [7.0, -3.0]] {
        assert!(hits(&pattern, &there(uv.into())).is_empty(), "{uv:?}");
    }
    let bare = sheet_of(&dark_sheet()).build();
    assert!(
        hits(&bare, &there(DVec2::splat(0.5))).is_empty(),
        "a bare sheet"
    );
}
