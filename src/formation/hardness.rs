//! Hardness that varies over a surface.

use crate::error::{Error, Result, in_range};
use glam::DVec2;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};
use std::collections::BTreeMap;

/// Vickers hardness as a function of (u, v).
#[derive(Clone, Debug)]
pub struct HardnessMap {
    source: Source,
}

#[derive(Clone, Debug)]
enum Source {
    Texture {
        width: usize,
        height: usize,
        hardness_hv: Vec<f64>,
    },
    Readings {
        triangulation: DelaunayTriangulation<Reading>,
        readings: Vec<Reading>,
    },
}

/// One indentation: where it was made and what it gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Texture coordinates, -1e9 to 1e9.
    pub uv: [f64; 2],
    /// Vickers hardness, kgf/mm², 0.01 to 20000.
    pub hardness_hv: f64,
}

impl HasPosition for Reading {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.uv[0], self.uv[1])
    }
}

/// Most texels of a hardness texture.
const MOST_TEXELS: usize = 1 << 28;

impl HardnessMap {
    /// A texture over u and v from 0 to 1, its first row at v = 1 (as images are stored), `width` texels a row. A
    /// value x means `range_hv[0] + x (range_hv[1] - range_hv[0])`, each end 0.01 to 20000; values must lead
    /// to hardness in that range. Bilinear between texel centres, clamped beyond the edge.
    pub fn texture(
        values: &[f32],
        width: usize,
        height: usize,
        range_hv: [f64; 2],
    ) -> Result<Self> {
        in_range("width", width as f64, 1.0, MOST_TEXELS as f64)?;
        in_range("height", height as f64, 1.0, MOST_TEXELS as f64)?;
        if width.checked_mul(height) != Some(values.len()) || values.len() > MOST_TEXELS {
            let accepted = "width times height values, 2^28 at most";
            return Err(Error::number("value_count", values.len() as f64, accepted));
        }
        let [from, to] = range_hv;
        in_range("range_hv[0]", from, 0.01, 20_000.0)?;
        in_range("range_hv[1]", to, 0.01, 20_000.0)?;
        let mut hardness_hv = Vec::with_capacity(values.len());
        for (i, &value) in values.iter().enumerate() {
            let hardness = from + f64::from(value) * (to - from);
            in_range("hardness_hv", hardness, 0.01, 20_000.0)
                .map_err(|error| error.within("values", i))?;
            hardness_hv.push(hardness);
        }
        Ok(Self {
            source: Source::Texture {
                width,
                height,
                hardness_hv,
            },
        })
    }

    /// Indentation readings anywhere on the surface, one or more: natural-neighbour interpolation between them
    /// (Sibson 1981), the value at the nearest point of their hull outside. Of readings at the same place the
    /// last counts.
    pub fn readings(readings: &[Reading]) -> Result<Self> {
        in_range("reading_count", readings.len() as f64, 1.0, 10_000_000.0)?;
        for (i, reading) in readings.iter().enumerate() {
            let [u, v] = reading.uv;
            in_range("u", u, -1e9, 1e9)
                .and_then(|_| in_range("v", v, -1e9, 1e9))
                .and_then(|_| in_range("hardness_hv", reading.hardness_hv, 0.01, 20_000.0))
                .map_err(|error| error.within("readings", i))?;
        }
        // spade refuses coordinates too small to square; they mean 0.
        let whole = |x: f64| if x.abs() < 1e-100 { 0.0 } else { x };
        let places: BTreeMap<[u64; 2], Reading> = readings
            .iter()
            .map(|reading| Reading {
                uv: reading.uv.map(whole),
                ..*reading
            })
            .map(|reading| (reading.uv.map(f64::to_bits), reading))
            .collect();
        let readings: Vec<Reading> = places.into_values().collect();
        let triangulation = DelaunayTriangulation::bulk_load(readings.clone())
            .map_err(|_| Error::text("readings", "not usable", "finite texture coordinates"))?;
        Ok(Self {
            source: Source::Readings {
                triangulation,
                readings,
            },
        })
    }

    /// Hardness at (u, v), HV.
    pub fn at(&self, uv: impl Into<DVec2>) -> f64 {
        let uv = uv.into();
        match &self.source {
            Source::Texture {
                width,
                height,
                hardness_hv,
            } => bilinear(hardness_hv, *width, *height, uv),
            Source::Readings {
                triangulation,
                readings,
            } => {
                let inside = |p: DVec2| {
                    let natural = triangulation.natural_neighbor();
                    natural.interpolate(|vertex| vertex.data().hardness_hv, Point2::new(p.x, p.y))
                };
                let plane = !triangulation.all_vertices_on_line();
                let found = if plane { inside(uv) } else { None };
                found.unwrap_or_else(|| on_hull(triangulation, readings, uv))
            }
        }
    }
}

/// Between the four texel centres around (u, v).
fn bilinear(values: &[f64], width: usize, height: usize, uv: DVec2) -> f64 {
    let place = |at: f64, count: usize| {
        let x = (at * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
        (x.floor(), x - x.floor())
    };
    let ((column, right), (row, down)) = (place(uv.x, width), place(1.0 - uv.y, height));
    let texel =
        |row: usize, column: usize| values[row.min(height - 1) * width + column.min(width - 1)];
    let (row, column) = (index(row), index(column));
    let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let upper = lerp(texel(row, column), texel(row, column + 1), right);
    let lower = lerp(texel(row + 1, column), texel(row + 1, column + 1), right);
    lerp(upper, lower, down)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number from 0 to 2^28"
)]
fn index(at: f64) -> usize {
    at as usize
}

/// Outside the readings' hull, or where all lie on one line: linear along the nearest edge.
fn on_hull(triangulation: &DelaunayTriangulation<Reading>, readings: &[Reading], uv: DVec2) -> f64 {
    let place = |reading: &Reading| DVec2::from(reading.uv);
    let mut best = (f64::INFINITY, readings[0].hardness_hv);
    let mut consider = |a: &Reading, b: &Reading| {
        let (from, edge) = (place(a), place(b) - place(a));
        let share = ((uv - from).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
        let share = if share.is_finite() { share } else { 0.0 };
        let distance = (from + share * edge).distance_squared(uv);
        if distance < best.0 {
            best = (
                distance,
                a.hardness_hv + (b.hardness_hv - a.hardness_hv) * share,
            );
        }
    };
    if triangulation.all_vertices_on_line() {
        triangulation.undirected_edges().for_each(|edge| {
            let [a, b] = edge.vertices();
            consider(a.data(), b.data());
        });
    } else {
        triangulation
            .convex_hull()
            .for_each(|edge| consider(edge.from().data(), edge.to().data()));
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Natural neighbours reproduce a linear field exactly inside the hull and clamp outside.
    #[test]
    fn readings_reproduce_a_plane() {
        let field = |u: f64, v: f64| 200.0 + 30.0 * u - 50.0 * v;
        let places = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [0.4, 0.55],
            [0.7, 0.2],
        ];
        let readings = places.map(|[u, v]| Reading {
            uv: [u, v],
            hardness_hv: field(u, v),
        });
        let map = HardnessMap::readings(&readings).unwrap();
        for [u, v] in [[0.3, 0.3], [0.81, 0.64], [0.05, 0.9]] {
            let ours = map.at([u, v]);
            assert!((ours - field(u, v)).abs() < 1e-9, "({u}, {v}): {ours}");
        }
        assert!(
            (map.at([3.0, 0.5]) - field(1.0, 0.5)).abs() < 1e-9,
            "outside"
        );
    }

    /// One reading is a constant; two are a line; the same place twice is its last value.
    #[test]
    fn few_readings() {
        let reading = |u: f64, hardness_hv| Reading {
            uv: [u, 0.5],
            hardness_hv,
        };
        let one = HardnessMap::readings(&[reading(0.2, 150.0)]).unwrap();
        assert_eq!(one.at([0.9, 0.1]), 150.0);
        let two = HardnessMap::readings(&[reading(0.0, 100.0), reading(1.0, 200.0)]).unwrap();
        assert!(
            (two.at([0.25, 0.9]) - 125.0).abs() < 1e-9,
            "{}",
            two.at([0.25, 0.9])
        );
        let twice = HardnessMap::readings(&[reading(0.2, 150.0), reading(0.2, 90.0)]).unwrap();
        assert_eq!(twice.at([0.2, 0.5]), 90.0);
    }

    /// Texel centres give their own values; the first row is at the top.
    #[test]
    fn texture_is_bilinear() {
        let map = HardnessMap::texture(&[0.0, 1.0, 0.5, 0.5], 2, 2, [100.0, 300.0]).unwrap();
        assert_eq!(map.at([0.25, 0.75]), 100.0);
        assert_eq!(map.at([0.75, 0.75]), 300.0);
        assert_eq!(map.at([0.5, 0.75]), 200.0);
        assert_eq!(map.at([0.1, 0.0]), 200.0);
        assert!(
            HardnessMap::texture(&[f32::NAN], 1, 1, [100.0, 300.0]).is_err(),
            "NaN"
        );
    }
}
