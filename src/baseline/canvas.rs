//! The rectangle of texture space that an image or a table of lists covers.

use crate::error::{Error, Result, in_range};
use crate::pattern::Pattern;
use glam::{DVec2, USizeVec2};

/// Most texels of one side.
const MOST_SIDE: f64 = 32_768.0;

/// Most texels in all.
const MOST_TEXELS: usize = 1 << 30;

/// Which part of texture space is painted, and how finely. What lies beside it is unscratched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Canvas {
    /// Two opposite corners of a rectangle, (u, v), -1e6 to 1e6, the first one lower in both.
    pub area_uv: [[f64; 2]; 2],
    /// Texels in u and in v, each 1 to 32768, 2^30 at most in all.
    pub texels: [u32; 2],
}

impl Canvas {
    pub(super) fn check(&self) -> Result<()> {
        let [from, to] = self.area_uv;
        for value in [from, to].concat() {
            in_range("area_uv", value, -1e6, 1e6)?;
        }
        for i in 0..2 {
            if from[i] >= to[i] {
                let accepted = "a corner that is lower in u and v, then one that is higher";
                return Err(Error::number("area_uv", from[i], accepted));
            }
        }
        for side in self.texels {
            in_range("texels", f64::from(side), 1.0, MOST_SIDE)?;
        }
        if self.count() > MOST_TEXELS {
            return Err(Error::count(
                "texels",
                self.count(),
                "2^30 in all, or fewer",
            ));
        }
        Ok(())
    }

    /// How many texels it has.
    pub(super) fn count(&self) -> usize {
        self.columns() * self.rows()
    }

    pub(super) fn columns(&self) -> usize {
        self.texels[0] as usize
    }

    pub(super) fn rows(&self) -> usize {
        self.texels[1] as usize
    }

    /// (u, v) in texels from the lowest corner.
    pub(super) fn place(&self, uv: DVec2) -> DVec2 {
        (uv - DVec2::from(self.area_uv[0])) * self.per_uv()
    }

    /// Texels per unit of u and v.
    pub(super) fn per_uv(&self) -> DVec2 {
        let [from, to] = self.area_uv.map(DVec2::from);
        DVec2::new(f64::from(self.texels[0]), f64::from(self.texels[1])) / (to - from)
    }

    /// The texel that holds (u, v), if it lies on the canvas.
    pub(super) fn texel(&self, uv: DVec2) -> Option<USizeVec2> {
        let place = self.place(uv).floor();
        let inside = place.cmpge(DVec2::ZERO).all()
            && place.x < f64::from(self.texels[0])
            && place.y < f64::from(self.texels[1]);
        inside.then(|| place.as_usizevec2())
    }
}

/// The straight line that takes a scratch's place, on the canvas; nothing where it has no length.
pub(super) fn straight(pattern: &Pattern, canvas: &Canvas, scratch: u32) -> Option<[DVec2; 2]> {
    let mut way = pattern.way(scratch);
    let first = way.next()?;
    let last = way.last().unwrap_or(first);
    let line = [first[0], last[3]].map(|uv| canvas.place(uv));
    (line[0] != line[1]).then_some(line)
}
