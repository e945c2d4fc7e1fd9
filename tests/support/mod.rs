//! What several test files share: directions, materials, and pixels of a flat sheet.

#![allow(dead_code, reason = "each test file uses its own part of this")]

pub(crate) mod caster;
pub(crate) mod crowd;
pub(crate) mod inscription;
pub(crate) mod jumps;
pub(crate) mod lines;
pub(crate) mod meshes;
pub(crate) mod process;
pub(crate) mod refusal;
pub(crate) mod reliefs;
pub(crate) mod tool_surface;

use glam::DVec2;
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use striae::brdf::{Brdf, Fresnel};
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, PatternBuilder, Scratch, SurfacePoint};
use striae::scattering::{Output, Shading};

/// The same random numbers in every run.
pub(crate) fn random(seed: u64) -> StdRng {
    StdRng::seed_from_u64(seed)
}

/// Rounds to single precision.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to single is what it is for"
)]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}

/// The unit vector at an angle to the normal and an azimuth from x, degrees.
pub(crate) fn direction(zenith_deg: f64, azimuth_deg: f64) -> [f32; 3] {
    let (sin, cos) = zenith_deg.to_radians().sin_cos();
    let (y, x) = azimuth_deg.to_radians().sin_cos();
    [single(sin * x), single(sin * y), single(cos)]
}

/// A direction with its angle to the normal even in 0 to `most_zenith_deg`, so that grazing ones are common.
pub(crate) fn any_direction(random: &mut StdRng, most_zenith_deg: f64) -> [f32; 3] {
    direction(
        random.random_range(0.0..most_zenith_deg),
        random.random_range(0.0..360.0),
    )
}

pub(crate) fn lambert(albedo: f32) -> Brdf {
    Brdf::Lambert {
        albedo: [albedo; 3],
    }
}

pub(crate) fn ggx(alpha: f32, f0: f32) -> Brdf {
    Brdf::Ggx {
        alpha,
        fresnel: Fresnel::Schlick { f0: [f0; 3] },
    }
}

/// A black matt sheet with white scratches, so that scratches are most of what any pixel shows.
pub(crate) fn dark_sheet() -> Material {
    Material::new(150.0, lambert(0.002), lambert(0.9))
}

/// |a - b| in units of the larger of both.
pub(crate) fn relative(a: f64, b: f64) -> f64 {
    (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE)
}

/// A flat sheet: how texture space lies on it, and who looks at it under what light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sheet {
    pub(crate) dp_du: [f32; 3],
    pub(crate) dp_dv: [f32; 3],
    pub(crate) view: [f32; 3],
    pub(crate) light: [f32; 3],
}

/// One unit of u, and of v, on [`Sheet::UPRIGHT`], mm.
pub(crate) const SHEET_MM: f64 = 1000.0;

impl Sheet {
    /// A square metre, seen from above and lit from 30 degrees.
    pub(crate) const UPRIGHT: Self = Self {
        dp_du: [1000.0, 0.0, 0.0],
        dp_dv: [0.0, 1000.0, 0.0],
        view: [0.0, 0.0, 1.0],
        light: [0.3, 0.4, 0.866],
    };

    /// The shading point of a pixel centred at `uv` with the edges `dx` and `dy`, all in texture space.
    pub(crate) fn point(&self, uv: DVec2, dx: DVec2, dy: DVec2) -> SurfacePoint {
        SurfacePoint {
            uv: uv.to_array(),
            dp_du: self.dp_du,
            dp_dv: self.dp_dv,
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Differentials {
                duv_dx: dx.as_vec2().to_array(),
                duv_dy: dy.as_vec2().to_array(),
            },
        }
    }

    /// A pixel's radiance per unit of irradiance (first channel).
    pub(crate) fn pixel(&self, pattern: &Pattern, uv: DVec2, dx: DVec2, dy: DVec2) -> f64 {
        self.radiance(pattern, &self.point(uv, dx, dy))
    }

    pub(crate) fn radiance(&self, pattern: &Pattern, point: &SurfacePoint) -> f64 {
        let mut shading = Shading::default();
        shading.shade(pattern, point, self.view).unwrap();
        f64::from(shading.eval(self.light, Output::BrdfCos)[0])
    }

    /// The mean over `n` by `n` equal parts of a pixel.
    pub(crate) fn mean_of_parts(
        &self,
        pattern: &Pattern,
        uv: DVec2,
        dx: DVec2,
        dy: DVec2,
        n: u32,
    ) -> f64 {
        let place = |i: u32| (f64::from(i) + 0.5) / f64::from(n) - 0.5;
        let mut sum = 0.0;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let part = uv + place(i) * dx + place(j) * dy;
            sum += self.pixel(pattern, part, dx / f64::from(n), dy / f64::from(n));
        }
        sum / f64::from(n * n)
    }
}

/// A builder for a sheet of one square metre per unit of (u, v)², in millimetres.
pub(crate) fn sheet_of(material: &Material) -> PatternBuilder {
    PatternBuilder::new(material.clone(), 1.0, [SHEET_MM, SHEET_MM]).unwrap()
}

/// A pattern of straight scratches with one force each.
pub(crate) fn straight(
    material: &Material,
    tool: &Tool,
    lines: &[([f64; 2], [f64; 2])],
    force_kgf: f64,
) -> Pattern {
    let mut builder = sheet_of(material);
    for &(from, to) in lines {
        builder
            .add(&Scratch {
                path: Path::Polyline(&[from, to]),
                keys: &[Key::force(0.0, force_kgf)],
                ..Scratch::new(tool)
            })
            .unwrap();
    }
    builder.build()
}
