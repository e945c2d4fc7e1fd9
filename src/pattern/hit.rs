//! One scratch's way through a pixel's footprint.

use super::center_line::CenterLine;
use super::profile::Profile;
use super::region::Region;
use super::tracks::TrackRef;
use glam::DVec2;

/// One scratch's way through a footprint: a run of it, or a sector of the cap at its hard end, which is a run
/// across the sector's axis. Lengths in mm, in the local frame around the footprint's centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit<'p> {
    pub track: TrackRef<'p>,
    /// Where on the track its cross-section is, or the one that the cap closes.
    pub place: f64,
    pub profile: Profile<'p>,
    /// Where what it covers begins and ends, mm across from the centre line.
    pub ends_mm: [f64; 2],
    pub scratch: u32,
    /// Share of the scratch's arc length at the line's origin.
    pub at: f64,
    pub line: CenterLine,
    /// Point and unit direction, forwards, of the lines across which this run begins and ends.
    pub parting: [[DVec2; 2]; 2],
    /// What of the footprint lies between those lines, beside the run too, unless all of it does.
    pub part: Option<Region>,
    /// The number of the piece that it is on, or begins on.
    pub piece: usize,
    /// How much of it counts as a scratch of its own: the rest of a thin cap is left to a crowd.
    pub alone: f64,
}

impl Hit<'_> {
    /// Vertices of its cross-section, once it is cut into layers.
    pub(crate) fn most_vertices(&self) -> usize {
        self.profile.vertex_count + 2 * self.track.layers().len()
    }

    /// What of a footprint lies between the lines across which it begins and ends.
    #[inline(always)]
    pub(crate) fn region<'r>(&'r self, footprint: &'r Region) -> &'r Region {
        self.part.as_ref().unwrap_or(footprint)
    }

    /// What it covers of the footprint.
    pub(crate) fn cover(&self, footprint: &Region) -> Option<Region> {
        let sides = self.line.sides(self.ends_mm);
        self.region(footprint).within(&sides)
    }

    /// Whether it covers nothing of the footprint, but lies beside it.
    #[inline(always)]
    pub(crate) fn is_beside(&self, footprint: &Region) -> bool {
        let [low, high] = self.line.extent(self.region(footprint));
        let [left, right] = self.ends_mm;
        low >= right || high <= left
    }

    /// Whether any of a region may lie between two distances across from the run, and between its ends.
    pub(super) fn may_cover(&self, [left, right]: [f64; 2], region: &Region) -> bool {
        let [low, high] = self.line.extent(region);
        let is_across = low < right && high > left;
        is_across
            && self.parting_lines().iter().all(|&[start, inward]| {
                let [_, most] = region.extent(start, inward);
                most > 0.0
            })
    }

    /// The four lines that bound what the run covers between two distances across.
    pub(crate) fn borders(&self, across_mm: [f64; 2]) -> [[DVec2; 2]; 4] {
        let [left, right] = self.line.sides(across_mm);
        let [start, end] = self.parting_lines();
        [left, right, start, end]
    }

    /// Point and inward direction of the lines across which this run begins and ends.
    pub(crate) fn parting_lines(&self) -> [[DVec2; 2]; 2] {
        let [start, [end, onwards]] = self.parting;
        [start, [end, -onwards]]
    }

    /// Whether one of two runs goes on where the other ends.
    pub(crate) fn adjoins(&self, other: &Self) -> bool {
        let [[start, _], [end, _]] = self.parting;
        let [[other_start, _], [other_end, _]] = other.parting;
        self.scratch == other.scratch && (start == other_end || end == other_start)
    }
}
