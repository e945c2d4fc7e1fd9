//! Scratches in pattern files.

use super::super::error::Result;
use super::json::{is_default, is_zero};
use super::{Made, named};
use crate::error::Error;
use crate::formation::{DepthLaw, Material, Orientation, Tool};
use crate::pattern::{Held, Key, Path, PatternBuilder, Scratch, Spline, SplineKind};
use serde::{Deserialize, Serialize};

/// A scratch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScratchEntry {
    /// The tool, a name in `tools`.
    pub tool: String,
    /// What is scratched, a name in `materials`; without, the surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Which law gives the depth.
    #[serde(default, skip_serializing_if = "is_default")]
    pub depth_law: DepthLaw,
    /// What spin and azimuth are relative to.
    #[serde(default, skip_serializing_if = "is_default")]
    pub held: Held,
    /// What lies between the points.
    #[serde(default, skip_serializing_if = "is_default")]
    pub curve: CurveKind,
    /// The path ends where it begins.
    #[serde(default, skip_serializing_if = "is_default")]
    pub closed: bool,
    /// Knots of a `non_uniform_b_spline`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub knots: Vec<f64>,
    /// The path's points, (u, v).
    pub points_uv: Vec<[f64; 2]>,
    /// Force and orientation along the path, one or more.
    pub keys: Vec<KeyEntry>,
}

/// Force and orientation at one place: what is not stated is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeyEntry {
    /// Share of the path's arc length, 0 to 1.
    pub at: f64,
    /// 0 to 100000.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub force_kgf: f64,
    /// 0 to 1000: counts under the depth law `stated` only.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub depth_mm: f64,
    /// -3600 to 3600.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub spin_deg: f64,
    /// 0 to 85.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tilt_deg: f64,
    /// -3600 to 3600.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub azimuth_deg: f64,
}

/// What lies between a path's points: see [`SplineKind`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CurveKind {
    /// [`SplineKind::Polyline`].
    #[default]
    Polyline,
    /// [`SplineKind::CubicBezier`].
    CubicBezier,
    /// [`SplineKind::CatmullRom`].
    CatmullRom,
    /// [`SplineKind::BSpline`].
    BSpline,
    /// [`SplineKind::NonUniformBSpline`], with the scratch's knots.
    NonUniformBSpline,
}

impl ScratchEntry {
    fn path(&self) -> Result<Path<'_>> {
        let knots = &self.knots;
        if self.curve != CurveKind::NonUniformBSpline && !knots.is_empty() {
            let accepted = "none, or a non_uniform_b_spline";
            return Err(Error::count("knots", knots.len(), accepted).into());
        }
        let kind = match self.curve {
            CurveKind::Polyline => SplineKind::Polyline,
            CurveKind::CubicBezier => SplineKind::CubicBezier,
            CurveKind::CatmullRom => SplineKind::CatmullRom,
            CurveKind::BSpline => SplineKind::BSpline,
            CurveKind::NonUniformBSpline => SplineKind::NonUniformBSpline { knots },
        };
        Ok(Path::Spline(Spline {
            kind,
            points: &self.points_uv,
            closed: self.closed,
        }))
    }
}

impl From<&KeyEntry> for Key {
    fn from(entry: &KeyEntry) -> Self {
        Self {
            at: entry.at,
            force_kgf: entry.force_kgf,
            depth_mm: entry.depth_mm,
            orientation: Orientation {
                spin_deg: entry.spin_deg,
                tilt_deg: entry.tilt_deg,
                azimuth_deg: entry.azimuth_deg,
            },
        }
    }
}

impl ScratchEntry {
    pub(super) fn add_to(
        &self,
        builder: &mut PatternBuilder,
        tools: &Made<'_, Tool>,
        materials: &Made<'_, Material>,
    ) -> Result<()> {
        let keys: Vec<Key> = self.keys.iter().map(Key::from).collect();
        let scratch = Scratch {
            material: material(self.material.as_deref(), materials)?,
            depth_law: self.depth_law,
            held: self.held,
            path: self.path()?,
            keys: &keys,
            ..Scratch::new(named("tool", &self.tool, tools, "tools")?)
        };
        Ok(builder.add(&scratch)?)
    }
}

pub(super) fn material<'a>(
    name: Option<&str>,
    materials: &'a Made<'_, Material>,
) -> Result<Option<&'a Material>> {
    name.map(|name| named("material", name, materials, "materials"))
        .transpose()
}
