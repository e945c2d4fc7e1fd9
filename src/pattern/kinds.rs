//! Kinds of scratch: one tool, held one way, in one material. All scratches of a kind share their
//! cross-sections, which depend on the force (or stated depth) alone.

use super::caps::ENDS;
use super::course::value;
use super::grid::number;
use super::scratch::Scratch;
use super::track::{Track, hard_ends, in_key};
use crate::error::Result;
use crate::formation::{CrossSection, DepthLaw, EndCap, Material, Orientation, Process, Tool};
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
    /// The last one that was asked for: most scratches are like the one before.
    last: usize,
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
    /// Lowest and highest at hard ends, where scratches start and where they stop.
    hard: [[f64; 2]; 2],
}

/// Caps are known at forces (or depths) that grow by no less than this: in between they are interpolated within 1 %.
const CAP_STEP: f64 = 1.25;

/// Of no values at all.
const NO_SPAN: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl Kinds {
    /// The number of a scratch's kind. Its keys, one or more, hold the tool alike.
    ///
    /// Errors: what the keys state leaves no valid cross-section.
    pub(crate) fn place(
        &mut self,
        scratch: &Scratch<'_>,
        is_closed: bool,
        surface: &Material,
    ) -> Result<u32> {
        let material = scratch.material.unwrap_or(surface);
        let orientation = scratch.tool.plainest(scratch.keys[0].orientation);
        let is_same = |kind: &Kind| {
            kind.law == scratch.depth_law
                && kind.orientation == orientation
                && kind.material == *material
                && kind.tool.is_same(scratch.tool)
        };
        if let Some(last) = self.kinds.get_mut(self.last).filter(|last| is_same(last)) {
            last.admit(scratch, is_closed)?;
            return Ok(number(self.last));
        }
        let hash = hash(scratch, orientation, material);
        let known = self.by_hash.entry(hash).or_default();
        let mut known_ones = known.iter().copied();
        if let Some(known) = known_ones.find(|&known| is_same(&self.kinds[known as usize])) {
            self.last = known as usize;
            self.kinds[self.last].admit(scratch, is_closed)?;
            return Ok(known);
        }
        let mut kind = Kind {
            tool: scratch.tool.clone(),
            material: material.clone(),
            law: scratch.depth_law,
            orientation,
            exact: Vec::new(),
            span: NO_SPAN,
            hard: [NO_SPAN; 2],
        };
        kind.admit(scratch, is_closed)?;
        self.last = self.kinds.len();
        known.push(number(self.last));
        self.kinds.push(kind);
        Ok(number(self.last))
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
    fn admit(&mut self, scratch: &Scratch<'_>, is_closed: bool) -> Result<()> {
        let stated = |key| value(key, self.law);
        for key in scratch.keys {
            if stated(key) > self.span[1] {
                self.section(stated(key))
                    .map_err(|error| in_key(error, scratch.keys, key.at))?;
            }
        }
        for key in scratch.keys {
            let value = value(key, self.law);
            self.span = [self.span[0].min(value), self.span[1].max(value)];
            if self.exact.len() < MOST_EXACT
                && let Err(place) = self.exact.binary_search_by(|known| known.total_cmp(&value))
            {
                self.exact.insert(place, value);
            }
        }
        for (span, value) in self.hard.iter_mut().zip(hard_ends(scratch, is_closed)) {
            let value = value.into_iter();
            *span = value.fold(*span, |[low, high], value| {
                [low.min(value), high.max(value)]
            });
        }
        Ok(())
    }

    fn section(&self, value: f64) -> Result<CrossSection> {
        CrossSection::form(&self.tool, &self.process(value), &self.material)
    }

    fn process(&self, value: f64) -> Process {
        let (force_kgf, depth_mm) = match self.law {
            DepthLaw::Stated => (0.0, value),
            _ => (value, 0.0),
        };
        Process {
            depth_law: self.law,
            force_kgf,
            depth_mm,
            orientation: self.orientation,
        }
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
        // The deepest was formed when it was asked for, and no law refuses less: a refusal would show as no scratch.
        let track = Track::over(&spans, &self.material, &|value| self.section(value));
        let Ok(mut track) = track else {
            return Track::bare(&self.material);
        };
        self.add_caps(&mut track);
        track
    }

    /// Caps at as many of the track's stations as are needed around what hard ends state.
    fn add_caps(&self, track: &mut Track) {
        let at = track.at.clone();
        for (end, [low, high]) in self.hard.into_iter().enumerate() {
            if low > high {
                continue;
            }
            let first = at.partition_point(|&at| at <= low).saturating_sub(1);
            let last = at.partition_point(|&at| at < high).min(at.len() - 1);
            let mut stations: Vec<f64> = Vec::new();
            for &value in &at[first..=last] {
                let apart = |&last: &f64| value >= CAP_STEP * last;
                if value == at[last] || stations.last().is_none_or(apart) {
                    stations.push(value);
                }
            }
            let form = |value: f64| {
                let process = self.process(value);
                let cap = EndCap::form(&self.tool, &process, &self.material, ENDS[end]).ok()?;
                Some((value, cap, self.section(value).ok()?))
            };
            let formed: Vec<_> = stations.into_par_iter().filter_map(form).collect();
            for (value, cap, section) in &formed {
                track.push_cap(end, *value, cap, section);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tracks::Tracks;
    use super::*;
    use crate::brdf::Metal;

    /// A kind whose forces could not be formed would leave no scratch, rather than break what is built of it.
    #[test]
    fn what_cannot_be_formed_leaves_no_scratch() {
        let kind = Kind {
            tool: Tool::sphero_cone(60.0, 0.005, 0.01).unwrap(),
            material: Material::metal(Metal::Steel),
            law: DepthLaw::Bosch2004,
            orientation: Orientation::default(),
            exact: vec![1.0],
            span: [1.0, 50.0],
            hard: [[1.0, 50.0]; 2],
        };
        assert!(kind.section(50.0).is_err(), "the tool is tall enough");
        let mut tracks = Tracks::default();
        let number = tracks.push(&kind.track());
        let track = tracks.get(number).expect("a sound track");
        assert_eq!((track.vertex_count(), track.half_width_mm()), (6, 0.0));
    }

    /// No law refuses less than what it allowed: a track is never bare for what `admit` let in.
    #[test]
    fn less_is_never_refused() {
        for law in [
            DepthLaw::Bosch2004,
            DepthLaw::ScratchHardness,
            DepthLaw::Stated,
        ] {
            for tool in [Tool::vickers(), Tool::needle(), Tool::round_graver()] {
                let kind = Kind {
                    tool,
                    material: Material::acrylic(),
                    law,
                    orientation: Orientation {
                        spin_deg: 11.0,
                        tilt_deg: 7.0,
                        azimuth_deg: 50.0,
                    },
                    exact: Vec::new(),
                    span: NO_SPAN,
                    hard: [NO_SPAN; 2],
                };
                let values = (-60..=40).map(|i| 1.25_f64.powi(i));
                let formed: Vec<bool> = values.map(|value| kind.section(value).is_ok()).collect();
                assert!(formed[0] && !formed[100], "{law:?}: nothing to find");
                assert!(formed.is_sorted_by(|a, b| a >= b), "{law:?}: {formed:?}");
            }
        }
    }
}
