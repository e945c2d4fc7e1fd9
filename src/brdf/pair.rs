//! View and light together: what every base BRDF looks at.

use crate::lanes::{Number, Vector};
use glam::{Vec2, Vec3};

/// A direction of view and one of light, and what every zone's base BRDF needs of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub view: Vec3,
    pub light: Vec3,
    /// The unit half vector.
    pub half: Vec3,
    /// view · half
    pub view_half: f32,
}

/// A pair as one zone sees it, or eight do: in the zone's own frame (across, along, normal). Or as scratches do, in theirs.
#[derive(Clone, Copy)]
pub(crate) struct Local<F> {
    pub view: Vector<F>,
    pub light: Vector<F>,
    pub half: Vector<F>,
    pub view_half: F,
}

impl<F: Number> Local<F> {
    /// What one of the zones sees.
    pub(crate) fn lane(&self, lane: usize) -> Local<f32> {
        let of = |w: &Vector<F>| Vector {
            x: w.x.lane(lane),
            y: w.y.lane(lane),
            z: w.z.lane(lane),
        };
        Local {
            view: of(&self.view),
            light: of(&self.light),
            half: of(&self.half),
            view_half: self.view_half.lane(lane),
        }
    }

    /// Pairs in the frames (across, along, up) of scratches, as zones of this normal see them.
    #[inline(always)]
    pub(crate) fn tilted(&self, [x, z]: [f32; 2]) -> Self {
        Self {
            view: onto_zone(self.view, x, z),
            light: onto_zone(self.light, x, z),
            half: onto_zone(self.half, x, z),
            view_half: self.view_half,
        }
    }
}

impl Pair {
    #[inline(always)]
    pub(crate) fn new(view: Vec3, light: Vec3) -> Self {
        let sum = view + light;
        // Opposite directions (their sum 0) have no half vector; they are never both above a zone.
        let length = sum.length();
        Self {
            view,
            light,
            half: sum * (1.0 / length.max(1e-6)),
            // Half their sum's length: the same whichever is which, also once both are rounded.
            view_half: (0.5 * length).min(1.0),
        }
    }

    /// The same view, with the light mirrored at the surface.
    pub(crate) fn below(&self) -> Self {
        Self::new(self.view, self.light * Vec3::new(1.0, 1.0, -1.0))
    }

    /// In the frame of a scratch, which this pair is in, what [`Self::below`] makes of the pair in the local frame: view and
    /// light differ in nothing from this one's but the light's sign.
    #[inline(always)]
    pub(crate) fn below_turned(&self, below: &Self, across: Vec2) -> Self {
        Self {
            view: self.view,
            light: self.light * Vec3::new(1.0, 1.0, -1.0),
            ..below.turned(across)
        }
    }

    /// The same pair, component by component.
    #[inline(always)]
    pub(crate) fn local(&self) -> Local<f32> {
        let vector = |w: Vec3| Vector {
            x: w.x,
            y: w.y,
            z: w.z,
        };
        Local {
            view: vector(self.view),
            light: vector(self.light),
            half: vector(self.half),
            view_half: self.view_half,
        }
    }

    /// The same pair in the frames of zones whose normals are (x, 0, z).
    #[inline(always)]
    pub(crate) fn tilted<F: Number>(&self, x: F, z: F) -> Local<F> {
        Local {
            view: onto_zones(self.view, x, z),
            light: onto_zones(self.light, x, z),
            half: onto_zones(self.half, x, z),
            view_half: x.like(self.view_half),
        }
    }

    /// The same pair in the frame of a scratch that runs along x: as the flat surface sees it.
    #[inline(always)]
    pub(crate) fn level(&self) -> Self {
        let turned = |w: Vec3| Vec3::new(-w.y, w.x, w.z);
        Self {
            view: turned(self.view),
            light: turned(self.light),
            half: turned(self.half),
            view_half: self.view_half,
        }
    }

    /// The same pair in the frame (across, along, up) of a scratch.
    #[inline(always)]
    pub(crate) fn turned(&self, across: Vec2) -> Self {
        let along = Vec2::new(-across.y, across.x);
        let turn = |w: Vec3| Vec3::new(w.truncate().dot(across), w.truncate().dot(along), w.z);
        Self {
            view: turn(self.view),
            light: turn(self.light),
            half: turn(self.half),
            view_half: self.view_half,
        }
    }

    /// The same pair in the frames of several scratches.
    #[inline(always)]
    pub(crate) fn turned_each<F: Number>(&self, across: [F; 2]) -> Local<F> {
        Local {
            view: turned_each(self.view, across),
            light: turned_each(self.light, across),
            half: turned_each(self.half, across),
            view_half: across[0].like(self.view_half),
        }
    }
}

/// One view and several lights.
#[derive(Clone, Copy)]
pub(crate) struct Pairs<F> {
    pub view: Vec3,
    pub light: Vector<F>,
    half: Vector<F>,
    pub view_half: F,
}

impl<F: Number> Pairs<F> {
    #[inline(always)]
    pub(crate) fn new(view: Vec3, light: Vector<F>) -> Self {
        let sum = Vector {
            x: light.x + view.x,
            y: light.y + view.y,
            z: light.z + view.z,
        };
        let length = sum.dot(sum).sqrt();
        let over = length.max(length.like(1e-6));
        Self {
            view,
            light,
            half: Vector {
                x: sum.x / over,
                y: sum.y / over,
                z: sum.z / over,
            },
            view_half: (length * 0.5).min(length.like(1.0)),
        }
    }

    /// The same pairs in the frame (across, along, up) of a scratch.
    #[inline(always)]
    pub(crate) fn turned(&self, across: Vec2) -> Self {
        let view = self.view.truncate();
        Self {
            view: Vec3::new(view.dot(across), across.perp_dot(view), self.view.z),
            light: turned(self.light, across),
            half: turned(self.half, across),
            view_half: self.view_half,
        }
    }

    /// The same pairs, component by component.
    #[inline(always)]
    pub(crate) fn local(&self) -> Local<F> {
        let like = |value| self.view_half.like(value);
        Local {
            view: Vector {
                x: like(self.view.x),
                y: like(self.view.y),
                z: like(self.view.z),
            },
            light: self.light,
            half: self.half,
            view_half: self.view_half,
        }
    }

    /// The same pairs in the frame of a zone whose normal is (x, 0, z).
    #[inline(always)]
    pub(crate) fn tilted(&self, normal: [f32; 2]) -> Local<F> {
        self.local().tilted(normal)
    }
}

/// One direction in the frames of several zones whose normals are (x, 0, z).
#[inline(always)]
fn onto_zones<F: Number>(w: Vec3, x: F, z: F) -> Vector<F> {
    Vector {
        x: z * w.x - x * w.z,
        y: x.like(w.y),
        z: x * w.x + z * w.z,
    }
}

/// Several directions in the frame of one zone.
#[inline(always)]
fn onto_zone<F: Number>(w: Vector<F>, x: f32, z: f32) -> Vector<F> {
    Vector {
        x: w.x * z - w.z * x,
        y: w.y,
        z: w.x * x + w.z * z,
    }
}

/// Several directions in the frame of a scratch.
#[inline(always)]
fn turned<F: Number>(w: Vector<F>, across: Vec2) -> Vector<F> {
    Vector {
        x: w.x * across.x + w.y * across.y,
        y: w.y * across.x - w.x * across.y,
        z: w.z,
    }
}

/// One direction in the frames of several scratches.
#[inline(always)]
pub(crate) fn turned_each<F: Number>(w: Vec3, [x, y]: [F; 2]) -> Vector<F> {
    Vector {
        x: x * w.x + y * w.y,
        y: x * w.y - y * w.x,
        z: x.like(w.z),
    }
}
