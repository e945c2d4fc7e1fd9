//! The hard end of a scratch: the tool's own print closes the groove, and pile-up stands around it.
//!
//! The half plane beyond the end is a fan of sectors around the tip, each of which is a short straight scratch
//! with half a cross-section. At the end of a scratch the tool stopped here; at its start it went in here. In both
//! cases the surface is what the tool cut on its way to or from this place: at each distance to the side, as
//! far ahead as the tool reaches there.

use super::cross_section::Process;
use super::facets::{Measured, facet_points};
use super::imprint::Imprint;
use super::material::Material;
use super::outline::{Cut, Measures, Outline, Piece};
use super::pileup::Peak;
use super::tool::Tool;
use crate::error::Result;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::{DMat3, DVec2, DVec3};

/// Sectors of the half plane.
pub(crate) const SECTORS: usize = 8;

/// Share of length in the measure by which borders are placed along the contact area's rim; the rest is turning.
/// With eight sectors a corner of 60 degrees or more gets a border of its own.
const LENGTH_SHARE: f64 = 0.6;

/// Sections reach this much above the level, so that the flank's angle there can be taken.
const ABOVE: f64 = 1.05;

/// Stands for no depth at all where only azimuths are asked for, as a share of the tool's height.
const SHALLOWEST: f64 = 1e-6;

/// Which end of a scratch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// Where the tool went in.
    Start,
    /// Where it stopped.
    Stop,
}

/// The cap of a scratch's hard end.
#[derive(Clone, Debug)]
pub(crate) struct EndCap {
    offset_mm: f64,
    parts: Vec<Part>,
}

/// A sector before its groove is cut into facets.
#[derive(Clone, Debug)]
struct Part {
    from_rad: f64,
    to_rad: f64,
    axis_rad: f64,
    groove: Cut,
    peak: Peak,
}

/// A sector of a cap: a half cross-section, the same on all lines across `axis_rad` between two azimuths.
#[derive(Clone, Debug)]
pub(crate) struct Sector {
    /// The sector's borders, radians from the travel direction, counter-clockwise from above; `from_rad <= to_rad`.
    pub from_rad: f64,
    pub to_rad: f64,
    /// Direction of the cross-section, outward.
    pub axis_rad: f64,
    /// Points (outward from the tip along the axis, up), mm: the groove from its bottom to the surface, crest, foot.
    pub points: Vec<DVec2>,
}

/// The swept groove that a cap has to meet, measured from the tip to the right and to the left.
struct Sides {
    width_mm: [f64; 2],
    /// What a side's peak holds over what the groove lacks on that side.
    share: [f64; 2],
}

impl EndCap {
    /// What `tool` leaves beyond an end of a scratch where it is held and pressed as `process` says.
    ///
    /// Errors: as [`super::CrossSection::form`].
    pub(crate) fn form(
        tool: &Tool,
        process: &Process,
        material: &Material,
        end: End,
    ) -> Result<Self> {
        let (outline, loaded_mm) = process.press(tool, material)?;
        // The start is the end of the same scratch made by a mirrored tool.
        let mirror = match end {
            End::Start => DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)),
            End::Stop => DMat3::IDENTITY,
        };
        let imprint = tool.imprint(mirror * process.orientation.rotation());
        let depth_mm = loaded_mm.max(SHALLOWEST * outline.height_mm());
        let sides = Sides::of(&outline, imprint.tip().x, depth_mm);
        let front = sides.joined(imprint.front(depth_mm));
        let mut parts = front.fan(|rim| {
            let groove = section(&imprint, &rim, depth_mm).recovered(material.elastic_recovery);
            let peak = sides.peak(&rim, &groove, material, end);
            (groove, peak)
        });
        if loaded_mm == 0.0 {
            parts.iter_mut().for_each(Part::clear);
        }
        if end == End::Start {
            parts.iter_mut().for_each(Part::mirror);
            parts.reverse();
        }
        Ok(Self {
            offset_mm: imprint.tip().x,
            parts,
        })
    }

    /// Where the tip is: this far to the right of the path's end, mm. It depends on the tool and how it is held, not on
    /// the force.
    pub(crate) fn offset_mm(&self) -> f64 {
        self.offset_mm
    }

    /// The sectors, counter-clockwise, with `groove_facets` facets from bottom to surface: `groove_facets + 3` points
    /// each.
    pub(crate) fn sectors(&self, groove_facets: usize) -> Vec<Sector> {
        let sector = |part: &Part| Sector {
            from_rad: part.from_rad,
            to_rad: part.to_rad,
            axis_rad: part.axis_rad,
            points: part.points(groove_facets),
        };
        self.parts.iter().map(sector).collect()
    }
}

impl Part {
    fn points(&self, groove_facets: usize) -> Vec<DVec2> {
        let mut points = facet_points(&self.groove, groove_facets);
        let edge_x = points.last().map_or(0.0, |edge| edge.x);
        let crest = DVec2::new(edge_x + self.peak.inner_width_mm, self.peak.height_mm);
        points.extend([crest, DVec2::new(crest.x + self.peak.outer_width_mm, 0.0)]);
        points
    }

    fn clear(&mut self) {
        self.groove.points.clear();
        self.groove.measures = Measures::default();
        self.peak = Peak::default();
    }

    fn mirror(&mut self) {
        (self.from_rad, self.to_rad) = (PI - self.to_rad, PI - self.from_rad);
        self.axis_rad = PI - self.axis_rad;
    }
}

/// The contact area's front from right to left, as the tool leaves it and stretched across the travel to be as wide
/// as the groove.
struct Front {
    points: Vec<DVec2>,
    /// By how much it was stretched, right and left.
    stretch: [f64; 2],
}

/// The place on the contact area's rim that a sector's section goes through.
struct Rim {
    place: DVec2,
    stretch: f64,
    axis_rad: f64,
}

impl Sides {
    fn of(outline: &Outline, tip_x: f64, depth_mm: f64) -> Self {
        let cut = outline.cut(depth_mm);
        let [from_x, to_x] = cut.measures.edges_mm;
        let area_right: f64 = cut
            .points
            .windows(2)
            .map(|pair| [pair[0] - DVec2::X * tip_x, pair[1] - DVec2::X * tip_x])
            .filter(|[_, to]| to.x > 0.0)
            .map(|[from, to]| {
                let share = if from.x < 0.0 {
                    from.x / (from.x - to.x)
                } else {
                    0.0
                };
                let from = from.lerp(to, share);
                -0.5 * (to.x - from.x) * (from.y + to.y)
            })
            .sum();
        let half = 0.5 * cut.measures.area_mm2;
        let areas = [area_right, cut.measures.area_mm2 - area_right];
        Self {
            width_mm: [to_x - tip_x, tip_x - from_x],
            share: areas.map(|area| if area > 1e-6 * half { half / area } else { 1.0 }),
        }
    }

    /// The front of a contact area, made to meet the groove's edges: straight lines stay straight. A front that is narrower
    /// than the groove belongs to a tool that is widest behind its tip.
    fn joined(&self, mut points: Vec<DVec2>) -> Front {
        let ends = [points.first(), points.last()].map(|end| end.map_or(0.0, |end| end.x.abs()));
        let stretch = [0, 1].map(|side| {
            let thin = ends[side] <= 1e-9 * self.width_mm[side] || self.width_mm[side] <= 0.0;
            if thin {
                1.0
            } else {
                self.width_mm[side] / ends[side]
            }
        });
        for point in &mut points {
            point.x *= stretch[usize::from(point.x < 0.0)];
        }
        Front { points, stretch }
    }

    /// The peak beyond a section. At the groove's sides it holds what the groove's own peaks do: half of the whole,
    /// however the groove is divided by its deepest line.
    ///
    /// At the start the tool was pressed in and pushed nothing backward: there the peak's height fades from its
    /// whole at the sides to nothing right behind, by the squared sine of the azimuth. No source says so; our choice.
    fn peak(&self, rim: &Rim, groove: &Cut, material: &Material, end: End) -> Peak {
        let sideways = if rim.place == DVec2::ZERO {
            0.0
        } else {
            rim.place.x.powi(2) / rim.place.length_squared()
        };
        let side = usize::from(rim.place.x < 0.0);
        let share = 1.0 + (self.share[side] - 1.0) * sideways;
        let fade = match end {
            End::Start => sideways * sideways,
            End::Stop => 1.0,
        };
        let half_mm2 = groove.measures.area_mm2 * share * fade;
        let area_mm2 = 2.0 * half_mm2 * material.pile_up_fraction;
        Peak::rising(groove.measures.flank_rad[1], material.pile_up, area_mm2)
    }
}

impl Front {
    /// The half plane cut into sectors, right to left, each with what `leave` says of its place on the rim.
    fn fan(&self, leave: impl Fn(Rim) -> (Cut, Peak)) -> Vec<Part> {
        let reach = self.points.iter().map(|point| point.y).fold(0.0, f64::max);
        let width = self
            .points
            .iter()
            .map(|point| point.x.abs())
            .fold(0.0, f64::max);
        // A sheet has nothing ahead of its tip: any azimuths will do.
        let sheet = reach <= 1e-9 * width || width <= 1e-9 * reach;
        let measured = Measured::new(&self.points, LENGTH_SHARE);
        let at = |half_steps: usize| {
            let share = half_steps as f64 / (2 * SECTORS) as f64;
            if sheet {
                DVec2::ZERO
            } else {
                measured.at(share)
            }
        };
        let mut to_rad = -FRAC_PI_2;
        let part = |i: usize| {
            let (from, middle, to) = (at(2 * i), at(2 * i + 1), at(2 * i + 2));
            let from_rad = to_rad;
            let equal = -FRAC_PI_2 + PI * (i + 1) as f64 / SECTORS as f64;
            to_rad = if sheet || i + 1 == SECTORS {
                equal
            } else {
                azimuth_rad(to).clamp(from_rad, FRAC_PI_2)
            };
            let chord = to - from;
            let level = chord.length() <= 1e-9 * (width + reach);
            let axis_rad = if sheet {
                0.5 * (from_rad + to_rad)
            } else if level {
                azimuth_rad(middle)
            } else {
                azimuth_rad(DVec2::new(chord.y, -chord.x))
            };
            // Through the chord's middle: there a face of the tool is as high as it is on the mean.
            let place = self.beyond(from.midpoint(to)).unwrap_or(middle);
            let rim = Rim {
                place,
                stretch: self.stretch[usize::from(place.x < 0.0)],
                axis_rad,
            };
            let (groove, peak) = leave(rim);
            Part {
                from_rad,
                to_rad,
                axis_rad,
                groove,
                peak,
            }
        };
        (0..SECTORS).map(part).collect()
    }

    /// Where the ray from the tip through `place` leaves the contact area.
    fn beyond(&self, place: DVec2) -> Option<DVec2> {
        self.points.windows(2).find_map(|pair| {
            let [from, to] = [0, 1].map(|i| place.perp_dot(pair[i]));
            let crossed = from <= 0.0 && to > 0.0;
            crossed.then(|| pair[0].lerp(pair[1], from / (from - to)))
        })
    }
}

/// The groove from the tip to a place on the rim, seen across the sector's axis: a flat face shows its true slope.
fn section(imprint: &Imprint<'_>, rim: &Rim, depth_mm: f64) -> Cut {
    let held = DVec2::new(rim.place.x / rim.stretch, rim.place.y);
    let outward = held.normalize_or(DVec2::Y);
    let points = imprint.section(outward, ABOVE * depth_mm);
    let rim_mm = half_outline(&points, 1.0).measures(depth_mm).edges_mm[1];
    let wanted = rim.place.dot(direction(rim.axis_rad)).max(0.0);
    let scale = if rim_mm > 0.0 { wanted / rim_mm } else { 1.0 };
    half_outline(&points, scale).cut(depth_mm)
}

/// An outline that starts at the tip, its distances from there scaled.
fn half_outline(points: &[DVec2], scale: f64) -> Outline {
    let place = |point: DVec2| DVec2::new(point.x * scale, point.y);
    let piece = |pair: &[DVec2]| Piece::Line {
        from: place(pair[0]),
        to: place(pair[1]),
    };
    Outline::new(points.windows(2).map(piece).collect())
}

/// Azimuth of a direction (x to the right, y forward), counter-clockwise from forward.
fn azimuth_rad(direction: DVec2) -> f64 {
    (-direction.x).atan2(direction.y)
}

fn direction(azimuth_rad: f64) -> DVec2 {
    let (sin, cos) = azimuth_rad.sin_cos();
    DVec2::new(-sin, cos)
}

#[cfg(test)]
mod tests {
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
                let exact = fade * (peak.inner_width_mm + peak.outer_width_mm);
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
            inside.then(|| a.z + s * (b.z - a.z) + t * (c.z - a.z))
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
                    let under =
                        |i: i32| tip.truncate() + (place + passed(i)) * DVec2::new(1.0, ahead);
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
                    let place =
                        DVec2::new(rng.random::<f64>() - 0.5, 0.5 * rng.random::<f64>()) * 0.15;
                    let held = DVec2::new(place.x / stretch[usize::from(place.x < 0.0)], place.y);
                    let exact = truth(held);
                    if exact < 0.0 {
                        worst =
                            worst.max((height_at(&sectors, place).min(0.0) - exact).abs() / depth);
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
                let [from_x, to_x] = [f64::min, f64::max]
                    .map(|pick| floor.clone().map(|v| v.x).reduce(pick).unwrap());
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
}
