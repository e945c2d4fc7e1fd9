//! From stated scratches to a pattern that can be queried.

use super::Scratch;
use super::along::Along;
use super::grid::Grid;
use super::pieces::{Piece, pieces};
use super::track::{Extent, Ground, Track};
use crate::brdf::Finish;
use crate::error::{Result, in_range};
use crate::formation::{HardnessMap, Material};
use glam::DVec2;

/// A surface with its scratches, immutable: share it between threads as you like.
#[derive(Clone, Debug)]
pub struct Pattern {
    pub(super) pieces: Vec<Piece>,
    pub(super) tracks: Vec<Track>,
    pub(super) grid: Grid,
    pub(crate) surface: Finish,
    pub(crate) mm_per_scene_unit: f64,
    /// How far any scratch reaches from its centre line.
    pub(crate) extent: Extent,
}

/// Collects scratches. Each is checked and its cross-sections are formed as it is added.
#[derive(Clone, Debug)]
pub struct PatternBuilder {
    material: Material,
    hardness: Option<HardnessMap>,
    mm_per_scene_unit: f64,
    units_per_uv: DVec2,
    pieces: Vec<Piece>,
    tracks: Vec<Track>,
}

impl PatternBuilder {
    /// An unscratched surface of `material`. One scene unit is `mm_per_scene_unit` mm (1e-9 to 1e9).
    ///
    /// `units_per_uv` says how many scene units one unit of u and of v spans (1e-9 to 1e9). Arc length along
    /// a path is measured with it, nothing else: while shading, the surface's own dP/du and dP/dv count.
    pub fn new(material: Material, mm_per_scene_unit: f64, units_per_uv: [f64; 2]) -> Result<Self> {
        in_range("mm_per_scene_unit", mm_per_scene_unit, 1e-9, 1e9)?;
        for units in units_per_uv {
            in_range("units_per_uv", units, 1e-9, 1e9)?;
        }
        Ok(Self {
            material: {
                material.check()?;
                material
            },
            hardness: None,
            mm_per_scene_unit,
            units_per_uv: DVec2::from(units_per_uv),
            pieces: Vec::new(),
            tracks: Vec::new(),
        })
    }

    /// Millimetres that one unit of u and of v spans.
    pub fn mm_per_uv(&self) -> [f64; 2] {
        (self.mm_per_scene_unit * self.units_per_uv).to_array()
    }

    /// The surface's material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Lets the surface's hardness vary: scratches added from now on meet `map` along their way instead of the
    /// material's own hardness. Scratches with a material of their own keep that one's.
    pub fn set_hardness(&mut self, map: HardnessMap) {
        self.hardness = Some(map);
    }

    /// Adds a scratch. If it is refused, the builder is as it was.
    pub fn add(&mut self, scratch: &Scratch<'_>) -> Result<()> {
        let number = u32::try_from(self.tracks.len()).unwrap_or(u32::MAX);
        in_range(
            "scratch_count",
            f64::from(number) + 1.0,
            0.0,
            f64::from(u32::MAX),
        )?;
        let curves = scratch.path.curves(self.units_per_uv)?;
        let (pieces, length) = pieces(&curves, self.units_per_uv, number);
        let ground = Ground {
            along: Along::new(&pieces, self.units_per_uv, length * self.mm_per_scene_unit),
            surface: &self.material,
            hardness: self.hardness.as_ref(),
        };
        let track = Track::new(scratch, &ground)?;
        let pieces = ground.along.cut_at(&track.cuts());
        let all = (self.pieces.len() + pieces.len()) as f64;
        in_range("piece_count", all, 0.0, f64::from(u32::MAX))?;
        self.pieces.extend(pieces);
        self.tracks.push(track);
        Ok(())
    }

    /// The pattern so far. The builder stays usable.
    pub fn build(&self) -> Pattern {
        let extents = self.tracks.iter().map(|track| track.extent);
        let extent = extents.fold(Extent::default(), |all, one| Extent {
            half_width_mm: all.half_width_mm.max(one.half_width_mm),
            height_mm: all.height_mm.max(one.height_mm),
        });
        Pattern {
            pieces: self.pieces.clone(),
            tracks: self.tracks.clone(),
            grid: Grid::new(&self.pieces),
            surface: Finish::new(&self.material.surface),
            mm_per_scene_unit: self.mm_per_scene_unit,
            extent,
        }
    }
}

impl Pattern {
    /// How many scratches it holds.
    pub fn scratch_count(&self) -> usize {
        self.tracks.len()
    }
}
