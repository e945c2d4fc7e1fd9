//! Base BRDFs of the host's own: code that the library calls as if it were one of its lobes.
//!
//! A finish is plain numbers, so it cannot hold code; it holds a number, and this list says whose it is. The list only
//! grows: whatever number memory holds, what is called was once given to the library, and looking it up takes no lock.

use super::{Lobe, Local};
use crate::error::{Error, Result, in_range};
use core::any::Any;
use core::fmt;
use glam::Vec3;
use std::sync::{Mutex, OnceLock, PoisonError};

/// A base BRDF of the host's own.
///
/// Directions are in the zone's own frame: x across the scratch, y along it (on the flat surface along dP/du), z the zone's
/// normal. They have unit length and point away from the surface; view and light of [`Self::eval`] are above it. Any
/// rendering thread may call at any time, so nothing here should allocate, lock or panic.
///
/// What it gives is believed but for this: what is negative or no number counts as 0, and a direction of no length as none.
/// For light to be the same both ways, `eval` over the cosine must be: view and light swapped give the same.
pub trait HostBrdf: Any + Send + Sync {
    /// BRDF times the cosine between light and normal, RGB.
    fn eval(&self, view: [f32; 3], light: [f32; 3]) -> [f32; 3];

    /// A light by two numbers from 0 up to (not including) 1; nothing counts as black. It may lie below the zone, from where
    /// it reflects nothing.
    fn sample(&self, u: [f32; 2], view: [f32; 3]) -> Option<[f32; 3]>;

    /// The density of [`Self::sample`] at a light, per steradian, also where that lies below the zone: 0 where `sample`
    /// never goes. It adds up to 1 less the share of samples that are nothing.
    fn pdf(&self, view: [f32; 3], light: [f32; 3]) -> f32;

    /// How it spreads light, asked once: [`Lobe::Diffuse`], or else about the mirrored view.
    fn lobe(&self) -> Lobe;

    /// How far, asked once: the widths of GGX microfacets that spread light about as far across the scratch and along it,
    /// 0.001 to 1. The smaller they are, the more finely grooves are divided into facets.
    fn alphas(&self) -> [f32; 2];
}

/// A base BRDF of the host's own that the library knows. Make one for each of the host's and use it in any number of
/// materials: what it was made of stays until the process ends.
#[derive(Clone, Copy, PartialEq)]
pub struct Hosted {
    pub(super) number: u32,
    pub(super) is_diffuse: bool,
    pub(super) alphas: [f32; 2],
}

impl Hosted {
    /// Makes the library know a base BRDF.
    ///
    /// Errors: an alpha out of its range; more than 4194240 of them in one process.
    pub fn new(brdf: impl HostBrdf) -> Result<Self> {
        let alphas = brdf.alphas();
        for (name, alpha) in ["alpha_across", "alpha_along"].into_iter().zip(alphas) {
            in_range(name, f64::from(alpha), 0.001, 1.0)?;
        }
        Ok(Self {
            is_diffuse: brdf.lobe() == Lobe::Diffuse,
            alphas,
            number: add(Box::new(brdf))?,
        })
    }

    /// Its number in this process.
    pub(crate) fn number(self) -> u32 {
        self.number
    }

    /// What it was made of.
    pub fn brdf(&self) -> Option<&'static dyn HostBrdf> {
        known(self.number)
    }
}

impl fmt::Debug for Hosted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Hosted({})", self.number)
    }
}

/// BRDF times cosine, RGB; the pair in the zone's own frame, both directions above it.
pub(super) fn brdf_cos(number: u32, pair: &Local<f32>) -> Vec3 {
    let told = known(number).map(|host| host.eval(pair.view.to_array(), pair.light.to_array()));
    told.map_or(Vec3::ZERO, |rgb| rgb.map(usable).into())
}

/// A light, which may lie below the zone.
pub(super) fn sample(number: u32, u: [f32; 2], view: Vec3) -> Option<Vec3> {
    let light = known(number)?.sample(u, view.into())?;
    Vec3::from(light).try_normalize()
}

/// The density of [`sample`], per steradian.
pub(super) fn pdf(number: u32, pair: &Local<f32>) -> f32 {
    let told = known(number).map(|host| host.pdf(pair.view.to_array(), pair.light.to_array()));
    told.map_or(0.0, usable)
}

fn usable(value: f32) -> f32 {
    if value.is_finite() {
        value.max(0.0)
    } else {
        0.0
    }
}

/// The list is in blocks that never move, each twice as long as the one before.
const FIRST_BLOCK: u32 = 64;
const BLOCKS: usize = 16;
const MOST: u32 = FIRST_BLOCK * ((1 << BLOCKS) - 1);

type Block = Box<[OnceLock<Box<dyn HostBrdf>>]>;

static ALL: [OnceLock<Block>; BLOCKS] = [const { OnceLock::new() }; BLOCKS];
static COUNT: Mutex<u32> = Mutex::new(0);

/// The block that holds a number, and the place in it.
fn place(number: u32) -> (usize, usize) {
    let block = (number / FIRST_BLOCK + 1).ilog2();
    let first = FIRST_BLOCK * ((1 << block) - 1);
    (block as usize, (number - first) as usize)
}

fn known(number: u32) -> Option<&'static dyn HostBrdf> {
    let (block, i) = place(number);
    Some(&**ALL.get(block)?.get()?.get(i)?.get()?)
}

fn add(brdf: Box<dyn HostBrdf>) -> Result<u32> {
    let mut count = COUNT.lock().unwrap_or_else(PoisonError::into_inner);
    let number = *count;
    if number == MOST {
        let accepted = "at most 4194240 in one process";
        return Err(Error::count("host", number as usize + 1, accepted));
    }
    let (block, i) = place(number);
    let empty = || (0..FIRST_BLOCK << block).map(|_| OnceLock::new()).collect();
    ALL[block].get_or_init(empty)[i].get_or_init(|| brdf);
    *count += 1;
    Ok(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every number has one place, and all places are taken.
    #[test]
    fn blocks_hold_all_numbers() {
        let mut next = (0, 0);
        for number in 0..3000 {
            assert_eq!(place(number), next);
            next.1 += 1;
            if next.1 == (FIRST_BLOCK as usize) << next.0 {
                next = (next.0 + 1, 0);
            }
        }
        let last = (BLOCKS - 1, ((FIRST_BLOCK as usize) << (BLOCKS - 1)) - 1);
        assert_eq!(place(MOST - 1), last);
    }

    /// A number that memory happens to hold is nobody's.
    #[test]
    fn other_numbers_are_unknown() {
        for number in [MOST - 1, MOST, u32::MAX - 1, u32::MAX] {
            assert!(known(number).is_none(), "{number}");
        }
    }
}
