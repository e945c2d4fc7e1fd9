//! The lower envelope of an oriented tool, seen along its travel (the groove's shape before depth is known).

use glam::DVec2;

/// Chords an arc below the surface is drawn with; its area is exact all the same.
const ARC_CHORDS: usize = 128;

/// The flank's angle at the surface is its mean over this share of the depth above and below.
const FLANK_SHARE: f64 = 0.01;

/// One piece of an outline, from left to right. Coordinates are (x right of travel, z up), mm.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Piece {
    Line {
        from: DVec2,
        to: DVec2,
    },
    /// The lower part of a circle; a point at angle a is `center + radius (sin a, -cos a)`, its slope tan a.
    Arc {
        center: DVec2,
        radius: f64,
        from_rad: f64,
        to_rad: f64,
    },
}

/// Connected pieces from left to right. The tool's tip is at x = 0; the lowest point is at z = 0.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    pieces: Vec<Piece>,
}

/// What of an outline lies below a level: the groove.
#[derive(Clone, Debug)]
pub(crate) struct Cut {
    /// The groove from its left to its right edge, relative to the level (z <= 0), mm.
    pub points: Vec<DVec2>,
    pub measures: Measures,
}

/// Measures of a groove.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Measures {
    /// Where the groove begins and ends at the level, x, mm.
    pub edges_mm: [f64; 2],
    /// Area below the level, mm².
    pub area_mm2: f64,
    /// Flank angles where the groove meets the level, left and right, radians in (0, pi/2].
    pub flank_rad: [f64; 2],
}

impl Outline {
    /// An outline from pieces in order, moved so that its lowest point lies at z = 0.
    pub(crate) fn new(pieces: Vec<Piece>) -> Self {
        let lowest = pieces
            .iter()
            .map(Piece::lowest)
            .fold(f64::INFINITY, f64::min);
        let pieces = pieces
            .into_iter()
            .map(|piece| piece.lowered(lowest))
            .collect();
        Self { pieces }
    }

    /// How deep the tool can go: the lower of its two ends, mm.
    pub(crate) fn height_mm(&self) -> f64 {
        match (self.pieces.first(), self.pieces.last()) {
            (Some(first), Some(last)) => first.start().y.min(last.end().y),
            _ => 0.0,
        }
    }

    /// The groove that the tool leaves at a depth above 0 and below [`Self::height_mm`].
    pub(crate) fn cut(&self, depth_mm: f64) -> Cut {
        let mut points = Vec::new();
        for below in self.below(depth_mm) {
            below.draw(&mut points);
        }
        for point in &mut points {
            point.y -= depth_mm;
        }
        Cut {
            points,
            measures: self.measures(depth_mm),
        }
    }

    /// The measures of that groove alone.
    pub(crate) fn measures(&self, depth_mm: f64) -> Measures {
        let mut measures = Measures::default();
        let mut crossed = None;
        for (i, piece) in self.pieces.iter().enumerate() {
            let Some(below) = piece.below(depth_mm) else {
                continue;
            };
            measures.area_mm2 += below.area_below(depth_mm);
            measures.edges_mm[1] = below.end().x;
            let first = crossed.map_or(i, |[first, _]: [usize; 2]| first);
            if crossed.is_none() {
                measures.edges_mm[0] = below.start().x;
            }
            crossed = Some([first, i]);
        }
        if let Some([first, last]) = crossed {
            let left = self.pieces[..=first].iter().rev().map(Piece::mirrored);
            let inward = self.pieces[first..].iter().map(Piece::mirrored);
            let right = self.pieces[last..].iter().copied();
            let back = self.pieces[..=last].iter().rev().copied();
            measures.flank_rad = [
                flank_rad(left, inward, depth_mm),
                flank_rad(right, back, depth_mm),
            ];
        }
        measures
    }

    fn below(&self, level: f64) -> impl Iterator<Item = Piece> {
        self.pieces
            .iter()
            .filter_map(move |piece| piece.below(level))
    }
}

/// The angle of the right flank about the level: the mean over a small part of the depth on both sides of it, so
/// that it changes continuously as the level passes a corner of the tool.
///
/// `outward` and `inward` are the pieces from the one that crosses the level, in both directions.
fn flank_rad(
    mut outward: impl Iterator<Item = Piece>,
    mut inward: impl Iterator<Item = Piece>,
    level: f64,
) -> f64 {
    let (low, high) = (level * (1.0 - FLANK_SHARE), level * (1.0 + FLANK_SHARE));
    let inner = inward
        .find_map(|piece| piece.below(low))
        .map(|piece| piece.end());
    let mut outer = None;
    for piece in &mut outward {
        if let Some(below) = piece.below(high) {
            outer = Some(below.end());
        }
        if piece.end().y >= high {
            break;
        }
    }
    match (inner, outer) {
        (Some(inner), Some(outer)) => (outer.y - inner.y).atan2((outer.x - inner.x).max(0.0)),
        _ => 0.0,
    }
}

impl Cut {
    /// The groove after a share of its depth has sprung back: as wide, less deep, less steep.
    pub(crate) fn recovered(mut self, share: f64) -> Self {
        self.points
            .iter_mut()
            .for_each(|point| point.y *= 1.0 - share);
        self.measures = self.measures.recovered(share);
        self
    }
}

impl Measures {
    /// As [`Cut::recovered`].
    pub(crate) fn recovered(mut self, share: f64) -> Self {
        let left = 1.0 - share;
        self.area_mm2 *= left;
        // An upright wall stays upright.
        self.flank_rad = self
            .flank_rad
            .map(|flank| (left * flank.sin()).atan2(flank.cos()));
        self
    }

    /// Width of the groove at the level, mm.
    pub(crate) fn width_mm(&self) -> f64 {
        self.edges_mm[1] - self.edges_mm[0]
    }
}

impl Piece {
    fn on_arc(center: DVec2, radius: f64, angle_rad: f64) -> DVec2 {
        let (sin, cos) = angle_rad.sin_cos();
        center + radius * DVec2::new(sin, -cos)
    }

    fn start(&self) -> DVec2 {
        match *self {
            Self::Line { from, .. } => from,
            Self::Arc {
                center,
                radius,
                from_rad,
                ..
            } => Self::on_arc(center, radius, from_rad),
        }
    }

    fn end(&self) -> DVec2 {
        match *self {
            Self::Line { to, .. } => to,
            Self::Arc {
                center,
                radius,
                to_rad,
                ..
            } => Self::on_arc(center, radius, to_rad),
        }
    }

    fn lowest(&self) -> f64 {
        match *self {
            Self::Line { from, to } => from.y.min(to.y),
            Self::Arc {
                center,
                radius,
                from_rad,
                to_rad,
            } => Self::on_arc(center, radius, 0_f64.clamp(from_rad, to_rad)).y,
        }
    }

    fn lowered(self, by: f64) -> Self {
        let down = DVec2::new(0.0, by);
        match self {
            Self::Line { from, to } => Self::Line {
                from: from - down,
                to: to - down,
            },
            Self::Arc {
                center,
                radius,
                from_rad,
                to_rad,
            } => Self::Arc {
                center: center - down,
                radius,
                from_rad,
                to_rad,
            },
        }
    }

    /// The part at or below z = level, if any. (A convex piece has one such part.)
    fn below(&self, level: f64) -> Option<Self> {
        match *self {
            Self::Line { from, to } => {
                if from.y.min(to.y) >= level {
                    return None;
                }
                let cross = |a: DVec2, b: DVec2| a.lerp(b, (level - a.y) / (b.y - a.y));
                Some(Self::Line {
                    from: if from.y > level {
                        cross(from, to)
                    } else {
                        from
                    },
                    to: if to.y > level { cross(to, from) } else { to },
                })
            }
            Self::Arc {
                center,
                radius,
                from_rad,
                to_rad,
            } => {
                let half = ((center.y - level) / radius).clamp(-1.0, 1.0).acos();
                let (from_rad, to_rad) = (from_rad.max(-half), to_rad.min(half));
                (from_rad < to_rad).then_some(Self::Arc {
                    center,
                    radius,
                    from_rad,
                    to_rad,
                })
            }
        }
    }

    /// The same seen from the other side: x reversed.
    fn mirrored(&self) -> Self {
        let flip = |p: DVec2| DVec2::new(-p.x, p.y);
        match *self {
            Self::Line { from, to } => Self::Line {
                from: flip(to),
                to: flip(from),
            },
            Self::Arc {
                center,
                radius,
                from_rad,
                to_rad,
            } => Self::Arc {
                center: flip(center),
                radius,
                from_rad: -to_rad,
                to_rad: -from_rad,
            },
        }
    }

    /// Area between the piece and z = level, exact.
    fn area_below(&self, level: f64) -> f64 {
        let (start, end) = (self.start(), self.end());
        let under_chord = (end.x - start.x) * (level - 0.5 * (start.y + end.y));
        match *self {
            Self::Line { .. } => under_chord,
            Self::Arc {
                radius,
                from_rad,
                to_rad,
                ..
            } => {
                let turn = to_rad - from_rad;
                under_chord + 0.5 * radius * radius * sine_defect(turn)
            }
        }
    }

    /// Appends the piece's points, without its start if that is the last point already there.
    fn draw(&self, points: &mut Vec<DVec2>) {
        let mut push = |point: DVec2| {
            let known = points
                .last()
                .is_some_and(|last: &DVec2| last.abs_diff_eq(point, 1e-12));
            if !known {
                points.push(point);
            }
        };
        match *self {
            Self::Line { from, to } => [from, to].into_iter().for_each(push),
            Self::Arc {
                center,
                radius,
                from_rad,
                to_rad,
            } => {
                for i in 0..=ARC_CHORDS {
                    let angle = from_rad + (to_rad - from_rad) * i as f64 / ARC_CHORDS as f64;
                    push(Self::on_arc(center, radius, angle));
                }
            }
        }
    }
}

/// a - sin a without cancellation for small a (the area of a thin circular segment).
fn sine_defect(a: f64) -> f64 {
    if a.abs() > 0.1 {
        return a - a.sin();
    }
    let a2 = a * a;
    a * a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0 * (1.0 - a2 / 72.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A half circle's groove has the area of its circular segment, also when very shallow.
    #[test]
    fn arc_area_is_exact() {
        let radius = 0.2;
        let outline = Outline::new(vec![Piece::Arc {
            center: DVec2::ZERO,
            radius,
            from_rad: -1.5,
            to_rad: 1.5,
        }]);
        for depth in [1e-8, 1e-4, 0.05] {
            let half = (1.0 - depth / radius).acos();
            let shallow = 4.0 / 3.0 * depth * (2.0 * radius * depth).sqrt();
            let exact = if depth < 1e-5 {
                shallow
            } else {
                radius * radius * (half - half.sin() * half.cos())
            };
            let area = outline.cut(depth).measures.area_mm2;
            assert!(
                (area / exact - 1.0).abs() < 1e-6,
                "{depth}: {area} against {exact}"
            );
        }
    }
}
