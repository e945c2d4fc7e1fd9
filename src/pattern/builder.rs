//! From stated scratches to a pattern that can be queried.

use super::Scratch;
use super::along::Along;
use super::course::{self, Courses};
use super::kinds::Kinds;
use super::pattern::{Pattern, Strand};
use super::pieces::{Chains, Piece};
use super::scratch::{Held, Key};
use super::track::{Ground, Track, check_keys};
use crate::error::{Error, Result, in_range};
use crate::formation::{HardnessMap, Material};
use crate::single;
use glam::DVec2;
use rayon::prelude::*;

/// Scratches that are prepared at once.
pub(crate) const PORTION: usize = 16_384;

/// Collects scratches. Each is checked as it is added.
#[derive(Clone, Debug)]
pub struct PatternBuilder {
    pub(super) material: Material,
    hardness: Option<HardnessMap>,
    pub(super) mm_per_scene_unit: f64,
    pub(super) units_per_uv: DVec2,
    pub(super) chains: Chains,
    pub(super) courses: Courses,
    pub(super) kinds: Kinds,
    /// Cross-sections of scratches that share theirs with no other.
    pub(super) own: Vec<Track>,
    pub(super) scratches: Vec<Added>,
}

/// A scratch as the builder keeps it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Added {
    pub strand: Strand,
    /// The strand's track is a number of `own`, not of `kinds`.
    pub is_own: bool,
}

/// What can be made of a scratch without knowing the others.
struct Prepared {
    chains: Chains,
    own: Option<Track>,
    length: f64,
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
        material.check()?;
        Ok(Self {
            material,
            hardness: None,
            mm_per_scene_unit,
            units_per_uv: DVec2::from(units_per_uv),
            chains: Chains::default(),
            courses: Courses::default(),
            kinds: Kinds::default(),
            own: Vec::new(),
            scratches: Vec::new(),
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
        let prepared = self.prepare(scratch)?;
        self.keep(scratch, prepared)
    }

    /// Adds scratches in their order, prepared on all cores: the result is that of adding one by one. If one is
    /// refused, the builder is as it was; the error names its number.
    pub fn add_all(&mut self, scratches: &[Scratch<'_>]) -> Result<()> {
        self.all_or_none(|builder| {
            // In portions: what is prepared and not yet kept takes memory.
            for (i, portion) in scratches.chunks(PORTION).enumerate() {
                builder.add_portion(portion, i * PORTION)?;
            }
            Ok(())
        })
    }

    /// Adds scratches, the first of which has this number in what its author states.
    pub(crate) fn add_portion(&mut self, scratches: &[Scratch<'_>], first: usize) -> Result<()> {
        let prepared: Vec<_> = scratches.par_iter().map(|one| self.prepare(one)).collect();
        for (i, (scratch, prepared)) in scratches.iter().zip(prepared).enumerate() {
            let kept = prepared.and_then(|prepared| self.keep(scratch, prepared));
            kept.map_err(|error| error.within("scratches", first + i))?;
        }
        Ok(())
    }

    /// Calls `add`; if that fails, takes back what it added.
    pub(crate) fn all_or_none<E>(
        &mut self,
        add: impl FnOnce(&mut Self) -> core::result::Result<(), E>,
    ) -> core::result::Result<(), E> {
        let (points, pieces) = (self.chains.points.len(), self.chains.pieces.len());
        let (own, scratches) = (self.own.len(), self.scratches.len());
        let added = add(self);
        if added.is_err() {
            self.chains.points.truncate(points);
            self.chains.pieces.truncate(pieces);
            self.own.truncate(own);
            self.scratches.truncate(scratches);
        }
        added
    }

    fn prepare(&self, scratch: &Scratch<'_>) -> Result<Prepared> {
        let curves = scratch.path.curves(self.units_per_uv)?;
        let length = curves.iter().map(|curve| curve.length).sum();
        let chains = Chains::of_path(&curves, self.units_per_uv);
        check_keys(scratch.keys)?;
        let material = scratch.material.unwrap_or(&self.material);
        material.check()?;
        let hardness = self.hardness.as_ref();
        let alike = |pair: &[Key]| pair[0].orientation == pair[1].orientation;
        let varies = (hardness.is_some() && scratch.material.is_none())
            || scratch.held == Held::ToSurface
            || !scratch.keys.windows(2).all(alike);
        let own = varies.then(|| {
            let length_mm = length * self.mm_per_scene_unit;
            let ground = Ground {
                along: Along::new(chains.curves(), self.units_per_uv, length_mm),
                surface: &self.material,
                hardness,
                is_closed: chains.is_closed(),
            };
            Track::along(scratch, &ground)
        });
        Ok(Prepared {
            own: own.transpose()?,
            chains,
            length,
        })
    }

    fn keep(&mut self, scratch: &Scratch<'_>, prepared: Prepared) -> Result<()> {
        let Prepared {
            chains,
            own,
            length,
        } = prepared;
        let most = f64::from(u32::MAX);
        in_range(
            "scratch_count",
            (self.scratches.len() + 1) as f64,
            0.0,
            most,
        )?;
        let points = self.chains.points.len() + chains.points.len();
        if points > Piece::MOST_POINTS {
            let accepted = "at most 1073741823 control points in all";
            return Err(Error::count("point_count", points, accepted));
        }
        let is_own = own.is_some();
        let (track, knots, scale) = match own {
            Some(track) => {
                self.own.push(track);
                (
                    number(self.own.len() - 1),
                    course::BY_ARC_LENGTH.to_vec(),
                    1.0,
                )
            }
            None => {
                let track = self
                    .kinds
                    .place(scratch, chains.is_closed(), &self.material)?;
                let (knots, scale) = course::of_keys(scratch.keys, scratch.depth_law);
                (track, knots, scale)
            }
        };
        let strand = Strand {
            first_piece: number(self.chains.pieces.len()),
            track,
            first_knot: self.courses.place(&knots),
            knot_count: number(knots.len()),
            scale,
            length: single(length),
        };
        self.chains.append(&chains, number(self.scratches.len()));
        self.scratches.push(Added { strand, is_own });
        Ok(())
    }

    /// The pattern so far. The builder stays usable.
    pub fn build(&self) -> Pattern {
        Pattern::of(self)
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
