//! Kinds of scratch: one tool, held one way, in one material. All scratches of a kind share their
//! cross-sections, which depend on the force (or stated depth) alone.

use super::course::value;
use super::scratch::Scratch;
use super::track::{Track, in_key};
use crate::error::Result;
use crate::formation::{CrossSection, DepthLaw, Material, Orientation, Process, Tool};
use rayon::prelude::*;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// So many different forces are stations of their own, and exact; further ones are interpolated.
const MOST_EXACT: usize = 256;

/// All kinds of a pattern.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kinds {
    kinds: Vec<Kind>,
    by_hash: HashMap<u64, Vec<u32>>,
}

#[derive(Clone, Debug)]
struct Kind {
    tool: Tool,
    material: Material,
    law: DepthLaw,
    orientation: Orientation,
    /// Forces (or depths) that keys state, ascending.
    exact: Vec<f64>,
    /// Lowest and highest of all.
    span: [f64; 2],
}

impl Kinds {
    /// The number of a scratch's kind. Its keys, one or more, hold the tool alike.
    ///
    /// Errors: what the keys state leaves no valid cross-section.
    pub(crate) fn place(&mut self, scratch: &Scratch<'_>, surface: &Material) -> Result<u32> {
        let material = scratch.material.unwrap_or(surface);
        let orientation = scratch.tool.plainest(scratch.keys[0].orientation);
        let hash = hash(scratch, orientation, material);
        let known = self.by_hash.entry(hash).or_default();
        let same = known.iter().copied().find(|&number| {
            let kind = &self.kinds[number as usize];
            kind.law == scratch.depth_law
                && kind.orientation == orientation
                && kind.material == *material
                && kind.tool.is_same(scratch.tool)
        });
        let mut kind = Kind {
            tool: scratch.tool.clone(),
            material: material.clone(),
            law: scratch.depth_law,
            orientation,
            exact: Vec::new(),
            span: [f64::INFINITY, f64::NEG_INFINITY],
        };
        let Some(number) = same else {
            kind.admit(scratch)?;
            let number = u32::try_from(self.kinds.len()).unwrap_or(u32::MAX);
            known.push(number);
            self.kinds.push(kind);
            return Ok(number);
        };
        self.kinds[number as usize].admit(scratch)?;
        Ok(number)
    }

    /// Each kind's cross-sections by force.
    pub(crate) fn tracks(&self) -> Vec<Track> {
        self.kinds.par_iter().map(Kind::track).collect()
    }
}

fn hash(scratch: &Scratch<'_>, orientation: Orientation, material: &Material) -> u64 {
    let mut hasher = DefaultHasher::new();
    let Orientation {
        spin_deg,
        tilt_deg,
        azimuth_deg,
    } = orientation;
    let numbers = [spin_deg, tilt_deg, azimuth_deg, material.hardness_hv];
    numbers
        .map(|number| (number + 0.0).to_bits())
        .hash(&mut hasher);
    scratch.depth_law.hash(&mut hasher);
    hasher.finish()
}

impl Kind {
    /// Makes room for what a scratch's keys state, if all of it can be formed: only more than was ever asked for
    /// has to be tried.
    fn admit(&mut self, scratch: &Scratch<'_>) -> Result<()> {
        let stated = |key| value(key, self.law);
        for key in scratch.keys {
            if !(stated(key) <= self.span[1]) {
                self.section(stated(key))
                    .map_err(|error| in_key(error, scratch.keys, key.at))?;
            }
        }
        for key in scratch.keys {
            let value = value(key, self.law);
            self.span = [self.span[0].min(value), self.span[1].max(value)];
            if let Err(place) = self.exact.binary_search_by(|known| known.total_cmp(&value)) {
                if self.exact.len() < MOST_EXACT {
                    self.exact.insert(place, value);
                }
            }
        }
        Ok(())
    }

    fn section(&self, value: f64) -> Result<CrossSection> {
        let (force_kgf, depth_mm) = match self.law {
            DepthLaw::Stated => (0.0, value),
            _ => (value, 0.0),
        };
        let process = Process {
            depth_law: self.law,
            force_kgf,
            depth_mm,
            orientation: self.orientation,
        };
        CrossSection::form(&self.tool, &process, &self.material)
    }

    fn track(&self) -> Track {
        let mut stations = self.exact.clone();
        stations.extend(self.span);
        stations.sort_unstable_by(f64::total_cmp);
        stations.dedup();
        let mut spans: Vec<[f64; 2]> = stations.windows(2).map(|w| [w[0], w[1]]).collect();
        if spans.is_empty() {
            spans.push(self.span);
        }
        // The deepest was formed when it was asked for, and less depth is never refused.
        Track::over(&spans, &self.material, &|value| self.section(value)).unwrap_or_default()
    }
}
