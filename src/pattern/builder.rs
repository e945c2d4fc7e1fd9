//! From stated scratches to a pattern that can be queried.

use super::Scratch;
use super::along::Along;
use super::course::{self, Courses};
use super::hosts::Hosts;
use super::kinds::Kinds;
use super::pattern::{Pattern, Strand};
use super::pieces::{Chains, Piece};
use super::scratch::{Held, Key};
use super::track::{Ground, Track, check_keys};
use crate::error::{Error, Result, in_range};
use crate::formation::{HardnessMap, Material};
use crate::lanes;
use crate::single;
use glam::DVec2;
use rayon::prelude::*;

/// Scratches that one thread prepares at once.
const BATCH: usize = 128;

/// Batches that are prepared while those before them are kept.
const TOGETHER: usize = 64;

/// Collects scratches. Each is checked as it is added.
#[derive(Clone, Debug)]
pub struct PatternBuilder {
    pub(super) plate: Plate,
    pub(super) kept: Kept,
}

/// What scratches are prepared for.
#[derive(Clone, Debug)]
pub(super) struct Plate {
    pub material: Material,
    hardness: Option<HardnessMap>,
    pub mm_per_scene_unit: f64,
    pub units_per_uv: DVec2,
}

/// All scratches so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Kept {
    pub chains: Chains,
    pub courses: Courses,
    pub kinds: Kinds,
    /// Cross-sections of scratches that share theirs with no other.
    pub own: Vec<Track>,
    pub scratches: Vec<Added>,
    pub hosts: Hosts,
}

/// A scratch as the builder keeps it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Added {
    pub strand: Strand,
    /// The strand's track is a number of `own`, not of `kinds`.
    pub is_own: bool,
}

/// What can be made of a scratch without knowing the others; its pieces lie with those of its batch.
struct Prepared {
    own: Option<Box<Track>>,
    /// How many of its batch's knots are its own, and their largest value.
    course: (usize, f32),
    length: f64,
    is_closed: bool,
    points: usize,
    pieces: usize,
}

/// Scratches in their order that one thread prepared, up to the first that is refused.
struct Batch {
    chains: Chains,
    /// How force runs along each.
    knots: Vec<[f32; 2]>,
    prepared: Vec<Prepared>,
    refused: Option<Error>,
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
        // What the processor has is found out here, not while shading.
        lanes::level();
        let mut hosts = Hosts::default();
        hosts.admit_one(material.surface);
        hosts.admit(&material);
        Ok(Self {
            plate: Plate {
                material,
                hardness: None,
                mm_per_scene_unit,
                units_per_uv: DVec2::from(units_per_uv),
            },
            kept: Kept {
                hosts,
                ..Kept::default()
            },
        })
    }

    /// Millimetres that one unit of u and of v spans.
    pub fn mm_per_uv(&self) -> [f64; 2] {
        (self.plate.mm_per_scene_unit * self.plate.units_per_uv).to_array()
    }

    /// The surface's material.
    pub fn material(&self) -> &Material {
        &self.plate.material
    }

    /// Lets the surface's hardness vary: scratches added from now on meet `map` along their way instead of the
    /// material's own hardness. Scratches with a material of their own keep that one's.
    pub fn set_hardness(&mut self, map: HardnessMap) {
        self.plate.hardness = Some(map);
    }

    /// Adds a scratch. If it is refused, the builder is as it was.
    pub fn add(&mut self, scratch: &Scratch<'_>) -> Result<()> {
        let one = core::slice::from_ref(scratch);
        self.all_or_none(|builder| {
            let batch = builder.plate.prepare_all(one);
            let kept = builder.kept.keep_all(one, batch, &builder.plate.material);
            kept.map_err(|(_, error)| error)
        })
    }

    /// Adds scratches in their order, prepared on all cores: the result is that of adding one by one. If one is
    /// refused, the builder is as it was; the error names its number.
    pub fn add_all(&mut self, scratches: &[Scratch<'_>]) -> Result<()> {
        self.all_or_none(|builder| builder.add_portion(scratches, 0))
    }

    /// How many scratches were added so far: the next one's number.
    pub fn scratch_count(&self) -> usize {
        self.kept.scratches.len()
    }

    /// Adds scratches, the first of which has this number in what its author states.
    pub(crate) fn add_portion(&mut self, scratches: &[Scratch<'_>], first: usize) -> Result<()> {
        let Self { plate, kept } = self;
        let mut prepared: Option<(usize, &[Scratch<'_>], Vec<Batch>)> = None;
        let parts = scratches.chunks(TOGETHER * BATCH).map(Some);
        let mut first = first;
        for part in parts.chain([None]) {
            let before = prepared.take();
            let keep = || match before {
                Some((first, part, batches)) => kept.keep_each(part, first, batches, plate),
                None => Ok(()),
            };
            let prepare = |part: &[Scratch<'_>]| {
                let batches = part.par_chunks(BATCH);
                batches.map(|batch| plate.prepare_all(batch)).collect()
            };
            let (done, batches) = rayon::join(keep, || part.map(prepare));
            done?;
            prepared = part
                .zip(batches)
                .map(|(part, batches)| (first, part, batches));
            first += part.map_or(0, <[_]>::len);
        }
        Ok(())
    }

    /// Calls `add`; if that fails, takes back what it added.
    pub(crate) fn all_or_none<E>(
        &mut self,
        add: impl FnOnce(&mut Self) -> core::result::Result<(), E>,
    ) -> core::result::Result<(), E> {
        let kept = &self.kept;
        let (points, pieces) = (kept.chains.points.len(), kept.chains.pieces.len());
        let (own, scratches) = (kept.own.len(), kept.scratches.len());
        let added = add(self);
        if added.is_err() {
            let kept = &mut self.kept;
            kept.chains.truncate(points, pieces);
            kept.own.truncate(own);
            kept.scratches.truncate(scratches);
        }
        added
    }

    /// The pattern so far. The builder stays usable.
    pub fn build(&self) -> Pattern {
        Pattern::of(self)
    }
}

impl Plate {
    fn prepare_all(&self, scratches: &[Scratch<'_>]) -> Batch {
        let mut batch = Batch {
            chains: Chains::default(),
            knots: Vec::new(),
            prepared: Vec::with_capacity(scratches.len()),
            refused: None,
        };
        for scratch in scratches {
            let own = number(batch.prepared.len());
            match self.prepare(scratch, &mut batch, own) {
                Ok(prepared) => batch.prepared.push(prepared),
                Err(error) => {
                    batch.refused = Some(error);
                    break;
                }
            }
        }
        batch
    }

    fn prepare(&self, scratch: &Scratch<'_>, batch: &mut Batch, own: u32) -> Result<Prepared> {
        let Batch { chains, knots, .. } = batch;
        let curves = scratch.path.curves(self.units_per_uv)?;
        check_keys(scratch.keys)?;
        scratch.material.map(Material::check).transpose()?;
        let length = curves.iter().map(|curve| curve.length).sum();
        let points = chains.points.len();
        let pieces = chains.push_path(&curves, self.units_per_uv, own);
        let points = pieces.points.len() - points;
        let hardness = self.hardness.as_ref();
        let alike = |pair: &[Key]| pair[0].orientation == pair[1].orientation;
        let varies = (hardness.is_some() && scratch.material.is_none())
            || scratch.held == Held::ToSurface
            || !scratch.keys.windows(2).all(alike);
        let own = varies.then(|| {
            let length_mm = length * self.mm_per_scene_unit;
            let ground = Ground {
                along: Along::new(pieces, self.units_per_uv, length_mm),
                surface: &self.material,
                hardness,
                is_closed: pieces.is_closed(),
            };
            Track::along(scratch, &ground).map(Box::new)
        });
        let own = own.transpose()?;
        let before = knots.len();
        let scale = match varies {
            true => {
                knots.extend(course::BY_ARC_LENGTH);
                1.0
            }
            false => course::of_keys(scratch.keys, scratch.depth_law, knots),
        };
        Ok(Prepared {
            own,
            course: (knots.len() - before, scale),
            length,
            is_closed: pieces.is_closed(),
            points,
            pieces: pieces.pieces.len(),
        })
    }
}

impl Kept {
    /// Keeps batches of scratches, the first of which has this number.
    fn keep_each(
        &mut self,
        scratches: &[Scratch<'_>],
        first: usize,
        batches: Vec<Batch>,
        plate: &Plate,
    ) -> Result<()> {
        for (i, (scratches, batch)) in scratches.chunks(BATCH).zip(batches).enumerate() {
            let number = |own: usize| first + i * BATCH + own;
            let kept = self.keep_all(scratches, batch, &plate.material);
            kept.map_err(|(own, error)| error.within("scratches", number(own)))?;
        }
        Ok(())
    }

    /// Keeps a batch up to the first scratch that is refused, of which it tells the number in the batch.
    fn keep_all(
        &mut self,
        scratches: &[Scratch<'_>],
        batch: Batch,
        material: &Material,
    ) -> core::result::Result<(), (usize, Error)> {
        let first = self.scratches.len();
        let (mut points, mut pieces) = (self.chains.points.len(), self.chains.pieces.len());
        let count = batch.prepared.len();
        let mut knots = &batch.knots[..];
        for (i, (scratch, prepared)) in scratches.iter().zip(batch.prepared).enumerate() {
            points += prepared.points;
            let first_piece = pieces;
            pieces += prepared.pieces;
            let (own, rest) = knots.split_at(prepared.course.0);
            knots = rest;
            self.keep(scratch, prepared, own, points, first_piece, material)
                .map_err(|error| (i, error))?;
        }
        if let Some(error) = batch.refused {
            return Err((count, error));
        }
        self.chains.append(&batch.chains, number(first));
        Ok(())
    }

    fn keep(
        &mut self,
        scratch: &Scratch<'_>,
        prepared: Prepared,
        knots: &[[f32; 2]],
        points: usize,
        first_piece: usize,
        material: &Material,
    ) -> Result<()> {
        let most = f64::from(u32::MAX);
        in_range(
            "scratch_count",
            (self.scratches.len() + 1) as f64,
            0.0,
            most,
        )?;
        if points > Piece::MOST_POINTS {
            let accepted = "at most 1073741823 control points in all";
            return Err(Error::count("point_count", points, accepted));
        }
        if let Some(material) = scratch.material {
            self.hosts.admit(material);
        }
        let is_own = prepared.own.is_some();
        let track = match prepared.own {
            Some(track) => {
                self.own.push(*track);
                number(self.own.len() - 1)
            }
            None => self.kinds.place(scratch, prepared.is_closed, material)?,
        };
        let strand = Strand {
            first_piece: number(first_piece),
            track,
            first_knot: self.courses.place(knots),
            knot_count: number(knots.len()),
            scale: prepared.course.1,
            length: single(prepared.length),
        };
        self.scratches.push(Added { strand, is_own });
        Ok(())
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}
