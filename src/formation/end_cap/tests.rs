//! Caps against the shapes that they should have.

use super::*;
use crate::brdf::Metal;
use crate::formation::{CrossSection, DepthLaw, Orientation};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

fn material() -> Material {
    Material::metal(Metal::Steel)
}

fn pressed(depth_mm: f64, spin_deg: f64, tilt_deg: f64, azimuth_deg: f64) -> Process {
    Process {
        depth_law: DepthLaw::Stated,
        depth_mm,
        orientation: Orientation {
            spin_deg,
            tilt_deg,
            azimuth_deg,
        },
        ..Process::default()
    }
}

fn sectors(tool: &Tool, process: &Process, end: End) -> Vec<Sector> {
    let cap = EndCap::form(tool, process, &material(), end).unwrap();
    cap.sectors(14)
}

/// Distance from the tip to the groove's edge, along the axis.
fn edge_mm(sector: &Sector) -> f64 {
    sector.points[sector.points.len() - 3].x
}

/// Area of the contact in plan: a sector's edge is straight across its axis.
fn contact_mm2(sectors: &[Sector]) -> f64 {
    let part = |s: &Sector| {
        let turn = (s.to_rad - s.axis_rad).tan() - (s.from_rad - s.axis_rad).tan();
        0.5 * edge_mm(s).powi(2) * turn
    };
    let wide = sectors.iter().filter(|s| s.to_rad - s.from_rad > 1e-9);
    wide.map(part).sum()
}

fn height_at(sectors: &[Sector], place: DVec2) -> f64 {
    let azimuth = azimuth_rad(place);
    let over = |s: &&Sector| s.from_rad <= azimuth && azimuth <= s.to_rad;
    let sector = sectors.iter().find(over).unwrap();
    let x = place.dot(direction(sector.axis_rad));
    let mut facets = sector.points.windows(2);
    facets
        .find(|w| w[0].x <= x && x < w[1].x)
        .map_or(0.0, |w| w[0].lerp(w[1], (x - w[0].x) / (w[1].x - w[0].x)).y)
}

/// An upright cone's cap shows half of the scratch's own cross-section in every direction.
#[test]
fn upright_cone_is_half_its_cross_section_all_around() {
    for end in [End::Stop, End::Start] {
        let mut material = material();
        material.elastic_recovery = 0.2;
        let process = pressed(0.02, 0.0, 0.0, 0.0);
        let tool = Tool::rockwell_c();
        let cap = EndCap::form(&tool, &process, &material, end).unwrap();
        let section = CrossSection::form(&tool, &process, &material).unwrap();
        for (i, sector) in cap.sectors(28).iter().enumerate() {
            let edge = edge_mm(sector);
            assert!(
                (2.0 * edge / section.groove_width_mm() - 1.0).abs() < 1e-9,
                "{edge}"
            );
            let equal = PI / SECTORS as f64 * (i as f64 + 0.5)
                + [-FRAC_PI_2, FRAC_PI_2][usize::from(end == End::Start)];
            assert!(
                (sector.axis_rad - equal).abs() < 1e-6,
                "{}",
                sector.axis_rad
            );
            for &point in &sector.points[..29] {
                // The tip's sphere; 0.016 deep it is still below the cone.
                let exact = (0.2 - (0.04 - point.x * point.x).sqrt() - 0.02) * 0.8;
                assert!((point.y - exact).abs() < 2e-3 * 0.02, "{point} {exact}");
            }
            let crest = sector.points[29];
            let peak = section.right();
            let fade = match end {
                End::Stop => 1.0,
                End::Start => sector.axis_rad.sin().powi(2),
            };
            assert!(
                (crest.y / (fade * peak.height_mm) - 1.0).abs() < 2e-3,
                "{crest} {peak:?}"
            );
            let width = sector.points[30].x - edge;
            // The peak of a start is lower right behind, not narrower.
            let exact = peak.inner_width_mm + peak.outer_width_mm;
            assert!((width / exact - 1.0).abs() < 2e-2, "{width} {exact}");
        }
    }
}

/// A Vickers pyramid shows its faces' true slope whichever way it is held upright, over the half of its square.
#[test]
fn pyramid_shows_its_faces() {
    let tool = Tool::vickers();
    let depth = 0.03;
    let side = 2.0 * depth * 68_f64.to_radians().tan();
    for spin_deg in [0.0, 45.0] {
        for end in [End::Start, End::Stop] {
            let sectors = sectors(&tool, &pressed(depth, spin_deg, 0.0, 0.0), end);
            for sector in sectors.iter().filter(|s| s.to_rad - s.from_rad > 1e-9) {
                let slope = depth / edge_mm(sector);
                let exact = 22_f64.to_radians().tan();
                assert!((slope / exact - 1.0).abs() < 1e-9, "{spin_deg}: {slope}");
                let turned = (sector.axis_rad.to_degrees() + spin_deg).rem_euclid(90.0);
                assert!(turned.min(90.0 - turned) < 1e-6, "{spin_deg}: {sector:?}");
            }
            let area = contact_mm2(&sectors);
            let exact = 0.5 * side * side;
            assert!(
                (area / exact - 1.0).abs() < 1e-9,
                "{spin_deg}: {area} against {exact}"
            );
        }
    }
}

/// A pyramid's borders do not depend on the force, and those of an upright cone neither.
#[test]
fn borders_stay() {
    let cases = [
        (Tool::vickers(), 45.0, 0.0),
        (Tool::vickers(), 20.0, 10.0),
        (Tool::berkovich(), 30.0, 0.0),
        (Tool::nail(), 0.0, 0.0),
    ];
    for (tool, spin_deg, tilt_deg) in cases {
        let at = |depth| sectors(&tool, &pressed(depth, spin_deg, tilt_deg, 30.0), End::Stop);
        for depth in [0.0, 1e-4, 0.05] {
            for (a, b) in at(depth).iter().zip(&at(0.01)) {
                let moved = (a.to_rad - b.to_rad)
                    .abs()
                    .max((a.axis_rad - b.axis_rad).abs());
                assert!(
                    moved < 1e-6 || b.to_rad - b.from_rad < 1e-6,
                    "{tool:?} {depth}: {moved}"
                );
            }
        }
    }
}

/// A cone with a rounded tip as triangles: a disc of rings around its foot, `rings` on the sphere.
fn cone_triangles(half_angle: f64, radius: f64, rings: u32, turn: DMat3) -> Vec<[DVec3; 3]> {
    let spokes = 192;
    let place = |ring: u32, spoke: u32| {
        let around = core::f64::consts::TAU * f64::from(spoke) / f64::from(spokes);
        let polar = (FRAC_PI_2 - half_angle) * f64::from(ring.min(rings)) / f64::from(rings);
        let mut r = radius * polar.sin();
        let mut z = radius * (1.0 - polar.cos());
        if ring > rings {
            (r, z) = (r + half_angle.sin(), z + half_angle.cos());
        }
        turn * DVec3::new(r * around.cos(), r * around.sin(), z)
    };
    let mut triangles = Vec::new();
    for ring in 0..=rings {
        for spoke in 0..spokes {
            let [a, b] = [place(ring, spoke), place(ring, spoke + 1)];
            let [c, d] = [place(ring + 1, spoke), place(ring + 1, spoke + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    triangles
}

/// Height at which an upward ray first meets a triangle.
fn cast(triangles: &[[DVec3; 3]], place: DVec2) -> f64 {
    let hit = |[a, b, c]: &[DVec3; 3]| {
        let (u, v) = ((*b - *a).truncate(), (*c - *a).truncate());
        let area = u.perp_dot(v);
        let from = place - a.truncate();
        let (s, t) = (from.perp_dot(v) / area, u.perp_dot(from) / area);
        let inside = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
        inside.then_some(a.z + s * (b.z - a.z) + t * (c.z - a.z))
    };
    triangles
        .iter()
        .filter_map(hit)
        .fold(f64::INFINITY, f64::min)
}

/// A tilted cone's cap has the height of what the tool cut on its way, by upward rays into a mesh of it; where the
/// groove is wider than the tool beside its tip, of that stretched to the groove's width.
#[test]
fn tilted_cone_by_ray_casting() {
    let mut rng = StdRng::seed_from_u64(5);
    let tool = Tool::sphero_cone(50.0, 0.05, 3.0).unwrap();
    let depth = 0.03;
    for (tilt_deg, azimuth_deg) in [(20.0, 90.0), (25.0, 0.0), (15.0, 180.0), (25.0, -50.0)] {
        let process = pressed(depth, 0.0, tilt_deg, azimuth_deg);
        let turn = process.orientation.rotation();
        let tip = 0.05 * (turn * DVec3::Z - DVec3::Z);
        let triangles = cone_triangles(50_f64.to_radians(), 0.05, 48, turn);
        let vertices = CrossSection::form(&tool, &process, &material())
            .unwrap()
            .vertices();
        let edges = [
            vertices[vertices.len() - 3].x - tip.x,
            vertices[2].x - tip.x,
        ];
        for (end, ahead) in [(End::Stop, 1.0), (End::Start, -1.0)] {
            let mut sectors = sectors(&tool, &process, end);
            if end == End::Start {
                sectors = sectors.iter().map(flipped).collect();
            }
            let truth = |place: DVec2| {
                let passed = |i: i32| DVec2::Y * 0.003 * f64::from(i);
                let under = |i: i32| tip.truncate() + (place + passed(i)) * DVec2::new(1.0, ahead);
                let lowest = (0..32).map(|i| cast(&triangles, under(i)));
                lowest.fold(f64::INFINITY, f64::min) - tip.z - depth
            };
            let stretch = edges.map(|edge| {
                let (mut low, mut high) = (0.0, 1.2);
                for _ in 0..14 {
                    let middle = 0.5 * (low + high);
                    let below = truth(DVec2::new(middle * edge, 1e-6)) < 0.0;
                    *(if below { &mut low } else { &mut high }) = middle;
                }
                1.0 / low
            });
            let (mut worst, mut count) = (0.0_f64, 0);
            for _ in 0..80 {
                let place = DVec2::new(rng.random::<f64>() - 0.5, 0.5 * rng.random::<f64>()) * 0.15;
                let held = DVec2::new(place.x / stretch[usize::from(place.x < 0.0)], place.y);
                let exact = truth(held);
                if exact < 0.0 {
                    worst = worst.max((height_at(&sectors, place).min(0.0) - exact).abs() / depth);
                    count += 1;
                }
            }
            // Within half a sector's turn the axis differs from the outward direction: 1 - cos(11.25 deg) = 2 %
            // of the way out, which is 4 % of the depth on a parabola.
            assert!(
                worst < 0.06 && count > 15,
                "{tilt_deg} {azimuth_deg} {end:?}: {worst}"
            );
        }
    }
}

fn flipped(sector: &Sector) -> Sector {
    Sector {
        from_rad: PI - sector.to_rad,
        to_rad: PI - sector.from_rad,
        axis_rad: PI - sector.axis_rad,
        points: sector.points.clone(),
    }
}

/// The peak in front holds as much as the section lacks, times the material's share.
#[test]
fn peak_in_front_holds_the_section() {
    let mut material = material();
    material.pile_up_fraction = 0.7;
    for tool in [Tool::rockwell_c(), Tool::vickers(), Tool::screwdriver()] {
        let process = pressed(0.02, 0.0, 0.0, 0.0);
        let cap = EndCap::form(&tool, &process, &material, End::Stop).unwrap();
        for sector in cap.sectors(9) {
            let area = |points: &[DVec2]| -> f64 {
                let part = |w: &[DVec2]| 0.5 * (w[1].x - w[0].x) * (w[0].y + w[1].y);
                points.windows(2).map(part).sum()
            };
            let (groove, peak) = (area(&sector.points[..10]), area(&sector.points[9..]));
            assert!(
                (peak / groove + 0.7).abs() < 2e-3,
                "{tool:?}: {groove} {peak}"
            );
        }
    }
}

fn presets() -> Vec<(Tool, f64, f64, f64)> {
    vec![
        (Tool::rockwell_c(), 0.0, 0.0, 0.0),
        (Tool::rockwell_c(), 0.0, 20.0, 60.0),
        (Tool::nail(), 0.0, 50.0, 0.0),
        (Tool::vickers(), 45.0, 0.0, 0.0),
        (Tool::vickers(), 20.0, 10.0, 130.0),
        (Tool::berkovich(), 30.0, 0.0, 0.0),
        (Tool::screwdriver(), 0.0, 0.0, 0.0),
        (Tool::screwdriver(), 0.0, 20.0, 90.0),
        (Tool::wedge(0.5, 60.0, 3.0).unwrap(), 0.0, 0.0, 0.0),
        (Tool::square_graver(), 0.0, 0.0, 0.0),
        (Tool::round_graver(), 10.0, 20.0, 0.0),
        (Tool::abrasive_grain(), 30.0, 10.0, 20.0),
    ]
}

/// No force, no cap, but all of its sectors and points; the same counts at any force and in both directions.
#[test]
fn counts_are_equal_at_any_force() {
    for (tool, spin, tilt, azimuth) in presets() {
        for end in [End::Start, End::Stop] {
            for depth in [0.0, 1e-6, 1e-3, 0.01] {
                let sectors = sectors(&tool, &pressed(depth, spin, tilt, azimuth), end);
                assert_eq!(sectors.len(), SECTORS, "{tool:?}");
                let quarter = if end == End::Start {
                    FRAC_PI_2
                } else {
                    -FRAC_PI_2
                };
                let mut from = quarter;
                for sector in &sectors {
                    assert_eq!(sector.points.len(), 17, "{tool:?}");
                    assert!((sector.from_rad - from).abs() < 1e-12, "{tool:?}: a gap");
                    assert!(sector.to_rad >= sector.from_rad, "{tool:?}: turned over");
                    from = sector.to_rad;
                    let all = sector.points.iter().flat_map(|p| p.to_array());
                    let fine = |v: f64| v.is_finite() && (depth > 0.0 || v == 0.0);
                    assert!(all.into_iter().all(fine), "{tool:?} at {depth}: {sector:?}");
                    let rises = sector.points.windows(2).all(|w| w[0].x <= w[1].x);
                    assert!(rises, "{tool:?} at {depth}: {sector:?}");
                }
                assert!(
                    (from - quarter - PI).abs() < 1e-12,
                    "{tool:?}: no half plane"
                );
            }
        }
    }
}

/// A little more depth moves every point and border a little.
#[test]
fn moves_continuously_with_depth() {
    for (tool, spin, tilt, azimuth) in presets() {
        let at = |depth: f64| sectors(&tool, &pressed(depth, spin, tilt, azimuth), End::Stop);
        let mut before = at(0.001);
        for i in 1..=400 {
            let depth = 0.001 * 1.005_f64.powi(i);
            let now = at(depth);
            let size = now
                .iter()
                .flat_map(|s| &s.points)
                .map(|p| p.length())
                .fold(0.0, f64::max);
            for (a, b) in before.iter().zip(&now) {
                let turned = (a.from_rad - b.from_rad).abs();
                assert!(turned < 0.03, "{tool:?} at {depth}: border by {turned}");
                // A sector opens at a corner of the tool, where what it shows turns quickly while it is narrow:
                // a move counts by the sector's share of an equal one.
                let wide = (a.to_rad - a.from_rad).max(b.to_rad - b.from_rad);
                let weight = (wide * SECTORS as f64 / PI).min(1.0);
                for (p, q) in a.points.iter().zip(&b.points) {
                    let moved = weight * p.distance(*q) / size;
                    assert!(moved < 0.03, "{tool:?} at {depth}: {a:?} to {b:?}");
                }
            }
            before = now;
        }
    }
}

/// A rounded cone given as a mesh leaves what the analytic one leaves, upright and tilted.
#[test]
fn cone_as_a_mesh() {
    let half_angle = 50_f64.to_radians();
    let triangles = cone_triangles(half_angle, 0.05, 64, DMat3::IDENTITY);
    let positions: Vec<[f64; 3]> = triangles.iter().flatten().map(|p| p.to_array()).collect();
    let count = u32::try_from(positions.len()).unwrap();
    let numbers: Vec<[u32; 3]> = (0..count / 3)
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect();
    let mesh = Tool::mesh(&positions, &numbers, 1.0).unwrap();
    let cone = Tool::sphero_cone(50.0, 0.05, 3.0).unwrap();
    for tilt_deg in [0.0, 20.0] {
        let process = pressed(0.02, 0.0, tilt_deg, 40.0);
        let (ours, truth) = (
            sectors(&mesh, &process, End::Stop),
            sectors(&cone, &process, End::Stop),
        );
        for (a, b) in ours.iter().zip(&truth) {
            let turned = (a.axis_rad - b.axis_rad).abs();
            assert!(turned < 0.02, "{a:?} {b:?}");
            for p in &a.points[..15] {
                let under = |w: &&[DVec2]| w[0].x <= p.x && p.x <= w[1].x;
                let w = b.points.windows(2).find(under).unwrap();
                let height = w[0].lerp(w[1], (p.x - w[0].x) / (w[1].x - w[0].x)).y;
                assert!((p.y - height).abs() < 0.01 * 0.02, "{p}: {height}");
            }
            let [p, q] = [a.points[15], b.points[15]];
            assert!(p.distance(q) < 0.01 * q.length(), "{p} {q}");
        }
    }
}

/// At the sides the cap is as wide as the scratch's groove, and as high as its crests.
#[test]
fn meets_the_scratch() {
    for (i, (tool, spin, tilt, azimuth)) in presets().into_iter().enumerate() {
        let process = pressed(0.01, spin, tilt, azimuth);
        let section = CrossSection::form(&tool, &process, &material()).unwrap();
        let vertices = section.vertices();
        let lowest = vertices.iter().map(|v| v.y).fold(0.0, f64::min);
        for end in [End::Start, End::Stop] {
            let cap = EndCap::form(&tool, &process, &material(), end).unwrap();
            let floor = vertices
                .iter()
                .filter(|v| v.y < lowest + 1e-4 * section.depth_mm());
            let [from_x, to_x] =
                [f64::min, f64::max].map(|pick| floor.clone().map(|v| v.x).reduce(pick).unwrap());
            let slack = 0.02 * section.groove_width_mm();
            let tip_x = cap.offset_mm();
            assert!(
                tip_x > from_x - slack && tip_x < to_x + slack,
                "{tool:?}: {tip_x}"
            );
            let sectors = cap.sectors(14);
            let mut sides = [&sectors[0], &sectors[SECTORS - 1]];
            if end == End::Start {
                sides.reverse();
            }
            let last = vertices.len() - 3;
            let edges = [vertices[last].x - tip_x, tip_x - vertices[2].x];
            let peaks = [section.right(), section.left()];
            for ((sector, edge), peak) in sides.into_iter().zip(edges).zip(peaks) {
                let border = if (sector.from_rad.cos()).abs() < 1e-9 {
                    sector.from_rad
                } else {
                    sector.to_rad
                };
                let ours = edge_mm(sector) / (border - sector.axis_rad).cos();
                let crest = sector.points[15].y;
                // A sheet ends in an upright wall with nothing ahead of it.
                if sector.points[14].x > 0.0 {
                    // The chord of a round rim stands outside it by 1 / cos(11.25 deg).
                    assert!((ours / edge - 1.0).abs() < 0.025, "{tool:?}: {ours} {edge}");
                }
                if end == End::Stop && i < 3 {
                    assert!(
                        (crest / peak.height_mm - 1.0).abs() < 0.02,
                        "{tool:?}: {crest}"
                    );
                }
            }
        }
    }
}
