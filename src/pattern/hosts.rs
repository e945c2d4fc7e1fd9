//! The host's own base BRDFs that a pattern's zones have.
//!
//! The pattern's arrays name them by their place in this list, not by their number in the process: arrays may be a file's.
//! Whatever those hold, a zone reflects like one of this list, or not at all.

use crate::brdf::{Brdf, Finish, Hosted};
use crate::formation::{Layer, Material};

/// Each once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Hosts(pub Vec<Hosted>);

impl Hosts {
    /// Takes in what a scratch in this material may have: the bulk's, then the layers' from the surface down.
    pub(crate) fn admit(&mut self, material: &Material) {
        self.admit_one(material.scratched);
        let layers = material.layers.iter();
        layers.for_each(|&Layer { scratched, .. }| self.admit_one(scratched));
    }

    pub(crate) fn admit_one(&mut self, brdf: Brdf) {
        if let Brdf::Hosted(host) = brdf
            && !self.0.contains(&host)
        {
            self.0.push(host);
        }
    }

    /// A finish as the arrays keep it.
    pub(crate) fn kept(&self, finish: Finish) -> Finish {
        let number = finish.hosted();
        let place = self
            .0
            .iter()
            .position(|host| Some(host.number()) == number)
            .and_then(|place| u32::try_from(place).ok());
        finish.renumbered(place.unwrap_or(u32::MAX))
    }

    /// A finish of the arrays as it reflects.
    #[inline(always)]
    pub(crate) fn found(&self, finish: &Finish) -> Finish {
        match finish.hosted() {
            None => *finish,
            Some(place) => self.own(place),
        }
    }

    /// The host's own at a place of the list, or black.
    #[inline(never)]
    fn own(&self, place: u32) -> Finish {
        let host = self.0.get(place as usize).copied();
        host.map_or(Finish::BLACK, |host| Finish::new(&Brdf::Hosted(host)))
    }
}
