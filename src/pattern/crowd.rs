//! Scratches by cross-section and direction: what a pixel holds of each, where they are too many to be
//! told apart.

use super::chords::ClassAreas;
use super::palette::{MOST_CLASSES, Palette};
use super::raster::cell_number;
use super::strips::{STRIPS, Strips, shares};
use bytemuck::{Pod, Zeroable};
use core::f32::consts::{FRAC_PI_2, PI, TAU};
use glam::DVec2;

/// Directions of travel, once around. Directions within one are kept as their mean.
pub(crate) const DIRECTIONS: usize = 64;

/// Entries of a prefiltered cell.
pub(crate) const MOST_ENTRIES: usize = KEYS;

const KEYS: usize = MOST_CLASSES * DIRECTIONS;

const STEP_RAD: f64 = core::f64::consts::TAU / DIRECTIONS as f64;

/// Scratched area by class and direction of travel; of one that is told by `BY` = [`STRIPS`] strips across, of each strip.
#[derive(Clone, Debug)]
pub(crate) struct Crowd<const BY: usize> {
    /// Per key: area, mm² in the pattern's own scale, and area times the place within the direction's step
    /// (-1/2 to 1/2).
    sums: [[f32; 2]; KEYS],
    /// What of the area each strip has.
    strips: [[f32; BY]; KEYS],
    /// Bits of the keys that have any, class by class: there are few of many.
    held: [u64; MOST_CLASSES],
    /// How many scratches these are; of prefiltered cells, how many entries.
    pub count: u32,
}

/// One entry of a prefiltered cell: 9 bits of key, 7 of place within the step, and a number's upper 16.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct Packed(u32);

/// One class in one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flock {
    pub class: usize,
    /// Unit direction of travel in texture space, scaled by units per (u, v).
    pub travel: DVec2,
    /// mm² in the pattern's own scale.
    pub area_mm2: f64,
    /// What share of it each strip across has.
    pub strips: Strips,
}

/// Where scratches are told apart, be it only to be added up.
pub(crate) type NearCrowd = Crowd<STRIPS>;

/// Of prefiltered cells: all strips have as much.
pub(crate) type FarCrowd = Crowd<0>;

impl NearCrowd {
    /// Adds scratched areas that travel one way, of which strips across have these shares.
    pub(super) fn add(
        &mut self,
        palette: &Palette,
        areas: ClassAreas,
        heading: Heading,
        strips: &Strips,
    ) {
        let is_symmetric = |class| palette.is_symmetric(class);
        for (key, area_mm2, place) in keys(areas, heading, is_symmetric) {
            self.add_to(key, area_mm2, area_mm2 * place);
            let turned = heading.direction != key % DIRECTIONS;
            let sums = &mut self.strips[key];
            for (i, share) in strips.iter().enumerate() {
                sums[if turned { STRIPS - 1 - i } else { i }] += area_mm2 * share;
            }
        }
    }
}

impl<const BY: usize> Crowd<BY> {
    pub(crate) const fn new() -> Self {
        Self {
            sums: [[0.0; 2]; KEYS],
            strips: [[0.0; BY]; KEYS],
            held: [0; MOST_CLASSES],
            count: 0,
        }
    }

    /// Adds area of one key, and its moment: area times the place within the direction's step.
    pub(super) fn add_to(&mut self, key: usize, area_mm2: f32, moment: f32) {
        if let Some(sum) = self.sums.get_mut(key) {
            sum[0] += area_mm2;
            sum[1] += moment;
            self.held[key / DIRECTIONS] |= 1 << (key % DIRECTIONS);
        }
    }

    /// Adds a share of a prefiltered cell.
    pub(crate) fn add_packed(&mut self, entries: &[Packed], share: f32) {
        for entry in entries {
            let (key, place, area_mm2) = entry.unpacked();
            self.add_to(key, share * area_mm2, share * area_mm2 * place);
        }
    }

    /// What is in it, for a prefiltered cell.
    pub(crate) fn packed(&self) -> impl Iterator<Item = Packed> {
        self.groups(1).filter_map(|(class, direction)| {
            let key = class * DIRECTIONS + direction;
            let [area_mm2, moment] = self.sums[key];
            (area_mm2 > 0.0).then(|| Packed::new(key, moment / area_mm2, area_mm2))
        })
    }

    /// How many there are of [`Self::flocks`].
    pub(crate) fn flock_count(&self, coarser: usize) -> usize {
        self.groups(coarser).count()
    }

    /// All classes and directions held, class by class; `coarser` neighbouring directions (a power of two) counting as one.
    pub(crate) fn flocks(&self, coarser: usize) -> impl Iterator<Item = Flock> {
        self.groups(coarser).filter_map(move |(class, first)| {
            let (mut area, mut angle) = (0.0, 0.0);
            let mut strips = Strips::default();
            for direction in first..first + coarser {
                let key = class * DIRECTIONS + direction;
                let [own, moment] = self.sums[key].map(f64::from);
                for (sum, strip) in strips.iter_mut().zip(&self.strips[key]) {
                    *sum += strip;
                }
                area += own;
                angle += own * direction as f64 + 0.5 * own + moment;
            }
            (area > 0.0).then(|| Flock {
                class,
                travel: DVec2::from_angle(angle / area * STEP_RAD),
                area_mm2: area,
                strips: shares(strips),
            })
        })
    }

    /// Class and first direction of neighbouring directions that hold any.
    fn groups(&self, coarser: usize) -> impl Iterator<Item = (usize, usize)> {
        self.held.iter().enumerate().flat_map(move |(class, held)| {
            let mut held = *held;
            core::iter::from_fn(move || {
                let first = held.trailing_zeros() as usize / coarser * coarser;
                let own =
                    (u64::MAX >> (DIRECTIONS - coarser)).checked_shl(u32::try_from(first).ok()?)?;
                held &= !own;
                Some((class, first))
            })
        })
    }
}

/// Where something travels: a direction, and the place within that direction's step (-1/2 to 1/2).
#[derive(Clone, Copy, Debug)]
pub(super) struct Heading {
    /// Once around.
    direction: usize,
    place: f32,
}

impl Heading {
    /// Along `travel` (any length).
    pub(super) fn of(travel: DVec2) -> Self {
        Self::at(angle(travel))
    }

    /// At an angle of 0 to 2 pi.
    pub(super) fn at(angle_rad: f32) -> Self {
        let (direction, place) = step(angle_rad);
        Self { direction, place }
    }
}

/// Keys of areas that travel one way, the area of each, and the place within the direction's step.
pub(super) fn keys(
    areas: ClassAreas,
    heading: Heading,
    is_symmetric: impl Fn(usize) -> bool,
) -> impl Iterator<Item = (usize, f32, f32)> {
    let held = areas.into_iter().enumerate();
    held.filter(|(_, area_mm2)| *area_mm2 > 0.0)
        .map(move |(class, area_mm2)| {
            // To and fro are one.
            let direction = match is_symmetric(class) {
                true => heading.direction % (DIRECTIONS / 2),
                false => heading.direction,
            };
            (class * DIRECTIONS + direction, area_mm2, heading.place)
        })
}

/// The angle of a direction, 0 to 2 pi, within 1e-5: a hundredth of what is kept of it (Hastings 1955).
pub(super) fn angle(DVec2 { x, y }: DVec2) -> f32 {
    let (low, high) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    let slope = crate::single(if high > 0.0 { low / high } else { 0.0 });
    let square = slope * slope;
    let fine = -0.085_133 + 0.020_835_1 * square;
    let angle =
        slope * (0.999_866 + square * (-0.330_299_5 + square * (0.180_141 + square * fine)));
    let steep = if y.abs() > x.abs() {
        FRAC_PI_2 - angle
    } else {
        angle
    };
    let turned = if x < 0.0 { PI - steep } else { steep };
    if y < 0.0 { TAU - turned } else { turned }
}

/// The direction that an angle in 0 to 2 pi falls into, and its place within that step.
fn step(angle: f32) -> (usize, f32) {
    const PER_RAD: f32 = DIRECTIONS as f32 / TAU;
    let at = angle * PER_RAD;
    let direction = (cell_number(at.into()) as usize).min(DIRECTIONS - 1);
    (direction, at - direction as f32 - 0.5)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn floor(at: f64) -> usize {
    at as usize
}

impl Packed {
    fn new(key: usize, place: f32, area_mm2: f32) -> Self {
        let key = u32::try_from(key).unwrap_or(0) & 0x1ff;
        let place = floor(f64::from((place + 0.5).clamp(0.0, 1.0)) * 127.0 + 0.5);
        // Rounded to the nearest: cut off, sums would fall short.
        let area = area_mm2.to_bits().saturating_add(0x8000) >> 16;
        Self(key << 23 | (u32::try_from(place).unwrap_or(0) & 0x7f) << 16 | area)
    }

    fn unpacked(self) -> (usize, f32, f32) {
        let place = f32::from(u8::try_from(self.0 >> 16 & 0x7f).unwrap_or(0)) / 127.0 - 0.5;
        ((self.0 >> 23) as usize, place, f32::from_bits(self.0 << 16))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::chords::add_shares;
    use crate::pattern::strips::EVEN;

    /// Packing keeps class, direction and area; nothing is lost on the way through a cell.
    #[test]
    fn packing_keeps_what_matters() {
        let palette = Palette::default();
        let mut crowd = NearCrowd::new();
        for (i, degrees) in [0.0, 13.0, 90.0, 181.0, 359.9].into_iter().enumerate() {
            let travel = DVec2::from_angle(f64::to_radians(degrees));
            let mut areas = ClassAreas::default();
            add_shares(&mut areas, &[(i, 0.25), (5, 0.75)], 3.7e-4);
            crowd.add(&palette, areas, Heading::of(travel), &EVEN);
        }
        let packed: Vec<Packed> = crowd.packed().collect();
        let mut again = FarCrowd::new();
        again.add_packed(&packed, 0.5);
        for (a, b) in crowd.flocks(1).zip(again.flocks(1)) {
            assert_eq!(a.class, b.class, "class");
            assert!(a.travel.angle_to(b.travel).abs() < 5e-4, "{a:?} {b:?}");
            assert!((b.area_mm2 / a.area_mm2 - 0.5).abs() < 2e-3, "{a:?} {b:?}");
        }
        assert_eq!(
            crowd.flocks(1).count(),
            again.flocks(1).count(),
            "lost some"
        );
    }

    /// Strips keep to their side of a cross-section whichever way it travels, also where to and fro are one: flocks cover as
    /// much of each place as was added.
    #[test]
    fn strips_keep_their_side() {
        let palette = crate::pattern::palette::symmetric();
        assert!(palette.is_symmetric(0), "to and fro are not one");
        let left: Strips = [8.0, 4.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0].map(|strip| strip / 15.0);
        let mut right = left;
        right.reverse();
        let mut areas = ClassAreas::default();
        add_shares(&mut areas, &[(0, 1.0)], 0.5);
        for degrees in [10.0_f64, 100.0, 190.0, 280.0] {
            let travel = DVec2::from_angle(degrees.to_radians());
            let mut crowd = NearCrowd::new();
            crowd.add(&palette, areas, Heading::of(travel), &left);
            crowd.add(&palette, areas, Heading::of(-travel), &right);
            let flocks: Vec<Flock> = crowd.flocks(1).collect();
            assert_eq!(flocks.len(), 1, "{flocks:?}");
            let wanted = if flocks[0].travel.dot(travel) > 0.0 {
                left
            } else {
                right
            };
            for (found, wanted) in flocks[0].strips.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-6, "{degrees}: {flocks:?}");
            }
        }
    }
}
