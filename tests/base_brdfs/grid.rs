//! Integrals over all lights above a facet, and cells to sort them into: polar coordinates about the mirrored view, finer
//! towards it, that end at the facet's horizon.

use super::{Direction, direction, single, tilted};
use std::f64::consts::TAU;
use std::sync::LazyLock;
use striae::brdf::Facet;

/// Cells of statistics, by distance from the mirrored view and by azimuth about it.
pub(crate) const CELLS: [usize; 2] = [40, 16];

/// Each cell is integrated over so many places by so many, or more.
const PLACES: [usize; 2] = [12, 24];

/// Distances are shares to this power of the way to the horizon: a mirror's lobe fills several cells.
const POWER: f64 = 4.0;

/// A facet, seen from somewhere.
pub(crate) struct Seen {
    pub facet: Facet,
    pub tilt_deg: f64,
    /// In the frame of the scratch.
    pub view: [f32; 3],
    /// In the facet's own frame: the mirrored view, and two directions at right angles to it.
    axes: [Direction; 3],
}

/// What [`Seen::integrals`] gives.
pub(crate) struct Integrals {
    /// Of the density, cell by cell.
    pub pdf: Vec<f64>,
    /// Of BRDF times cosine, the first channel.
    pub albedo: f64,
}

impl Seen {
    /// `view_deg`: zenith and azimuth in the facet's own frame.
    pub(crate) fn new(facet: Facet, tilt_deg: f64, view_deg: [f64; 2]) -> Self {
        let [zenith, azimuth] = view_deg;
        Self {
            facet,
            tilt_deg,
            view: single(tilted(tilt_deg, direction(zenith, azimuth))),
            axes: [
                direction(zenith, azimuth + 180.0),
                direction(zenith + 90.0, azimuth + 180.0),
                direction(90.0, azimuth + 270.0),
            ],
        }
    }

    /// Places of a cell round the mirrored view. Seen from the side, lobes are slim and the horizon is near.
    fn places_round(&self) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small positive number"
        )]
        let places = (PLACES[1] as f64 / self.axes[0][2].sqrt()) as usize;
        places
    }

    /// How far the horizon is from the mirrored view at an azimuth about it, radians.
    fn horizon(&self, azimuth: f64) -> f64 {
        let (y, x) = azimuth.sin_cos();
        let [m, a, b] = self.axes.map(|axis| axis[2]);
        m.atan2(-(a * x + b * y))
    }

    /// The light at an angle from the mirrored view.
    fn light(&self, angle: f64, azimuth: f64) -> [f32; 3] {
        let (sin, cos) = angle.sin_cos();
        let (y, x) = azimuth.sin_cos();
        let [m, a, b] = self.axes;
        let w = [0, 1, 2].map(|i| m[i] * cos + (a[i] * x + b[i] * y) * sin);
        single(tilted(self.tilt_deg, w))
    }

    /// The cell that a light lies in.
    pub(crate) fn cell(&self, light: [f32; 3]) -> usize {
        let light = tilted(-self.tilt_deg, light.map(f64::from));
        let [m, a, b] = self.axes.map(|axis| super::dot(axis, light));
        let t = b.atan2(a).rem_euclid(TAU) / TAU;
        let s = (a.hypot(b).atan2(m) / self.horizon(b.atan2(a))).powf(1.0 / POWER);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 1 times a small count"
        )]
        let number = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
        number(s, CELLS[0]) * CELLS[1] + number(t, CELLS[1])
    }

    pub(crate) fn integrals(&self) -> Integrals {
        let places = [PLACES[0], self.places_round()];
        let counts = [CELLS[0] * places[0], CELLS[1] * places[1]];
        let mut all = Integrals {
            pdf: vec![0.0; CELLS[0] * CELLS[1]],
            albedo: 0.0,
        };
        for j in 0..counts[1] {
            let azimuth = TAU * (j as f64 + 0.5) / counts[1] as f64;
            let horizon = self.horizon(azimuth);
            for i in 0..counts[0] {
                let s = (i as f64 + 0.5) / counts[0] as f64;
                let angle = horizon * s.powf(POWER);
                let step = horizon * POWER * s.powf(POWER - 1.0) / counts[0] as f64;
                let solid_angle = step * angle.sin() * TAU / counts[1] as f64;
                let light = self.light(angle, azimuth);
                let cell = i / places[0] * CELLS[1] + j / places[1];
                all.pdf[cell] += f64::from(self.facet.pdf(self.view, light)) * solid_angle;
                all.albedo += f64::from(self.facet.eval(self.view, light)[0]) * solid_angle;
            }
        }
        all
    }
}

/// Every white base BRDF on a few facets from a few sides.
pub(crate) static ALL: LazyLock<Vec<(String, Seen, Integrals)>> = LazyLock::new(|| {
    let views = [
        [0.0, 0.0],
        [30.0, 0.0],
        [55.0, 70.0],
        [75.0, 200.0],
        [85.0, 300.0],
        [89.0, 45.0],
    ];
    let mut all = Vec::new();
    for brdf in super::white() {
        for (i, view_deg) in views.into_iter().enumerate() {
            // Every side of the facet, and both ways of leaning, in turns.
            let tilt_deg = [0.0, 35.0, -60.0][i % 3];
            let name = format!("{brdf:?}, tilted {tilt_deg}, seen from {view_deg:?}");
            let facet = super::facet(brdf, tilt_deg);
            let seen = Seen::new(facet, tilt_deg, view_deg);
            let integrals = seen.integrals();
            all.push((name, seen, integrals));
        }
    }
    all
});
