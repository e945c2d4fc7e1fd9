//! Materials and hardness maps in pattern files.

use super::super::error::{FileError, Place, Result};
use super::super::image::read_hardness;
use crate::brdf::{Brdf, Fresnel, Metal};
use crate::formation::{HardnessMap, Layer, Material, PileUpLaw, Reading};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A material: a named one, with whatever is stated here instead of its own; or all of its own, and then hardness and
/// both finishes must be stated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialEntry {
    /// The material that this one is like.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub like: Option<MaterialName>,
    /// [`Material::hardness_hv`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness_hv: Option<f64>,
    /// [`Material::pile_up`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pile_up: Option<PileUpLaw>,
    /// [`Material::pile_up_fraction`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pile_up_fraction: Option<f64>,
    /// [`Material::elastic_recovery`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elastic_recovery: Option<f64>,
    /// [`Material::surface`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<BrdfEntry>,
    /// [`Material::scratched`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scratched: Option<BrdfEntry>,
    /// [`Material::layers`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layers: Option<Vec<LayerEntry>>,
}

/// A layer of a material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LayerEntry {
    /// 1e-6 to 1000.
    pub thickness_mm: f64,
    /// How a scratch's zones reflect where they lie in this layer.
    pub scratched: BrdfEntry,
}

/// A base BRDF.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum BrdfEntry {
    /// Perfectly diffuse.
    Lambert {
        /// Albedo per channel, 0 to 1.
        albedo: [f32; 3],
    },
    /// GGX with Schlick's Fresnel reflectance.
    Schlick {
        /// 0.001 to 1.
        alpha: f32,
        /// Reflectance at normal incidence per channel, 0 to 1.
        f0: [f32; 3],
    },
    /// GGX with a conductor's Fresnel reflectance.
    Conductor {
        /// 0.001 to 1.
        alpha: f32,
        /// Real part of the index of refraction per channel, 0.01 to 20.
        eta: [f32; 3],
        /// Its imaginary part, 0 to 20.
        k: [f32; 3],
    },
    /// GGX with a metal's own Fresnel reflectance.
    Metal {
        /// The metal.
        name: Metal,
        /// 0.001 to 1.
        alpha: f32,
    },
    /// [`Brdf::OrenNayar`].
    OrenNayar {
        /// Albedo per channel, 0 to 1.
        albedo: [f32; 3],
        /// 0 to 1.
        roughness: f32,
    },
    /// [`Brdf::Phong`].
    Phong {
        /// Colour per channel, 0 to 1.
        specular: [f32; 3],
        /// 1 to 100000.
        exponent: f32,
    },
    /// [`Brdf::CookTorrance`].
    CookTorrance {
        /// 0.001 to 1.
        alpha: f32,
        /// Reflectance of a microfacet.
        fresnel: FresnelEntry,
    },
    /// [`Brdf::AnisotropicGgx`].
    AnisotropicGgx {
        /// 0.001 to 1.
        alpha_across: f32,
        /// 0.001 to 1.
        alpha_along: f32,
        /// Reflectance of a microfacet.
        fresnel: FresnelEntry,
    },
}

/// How much a microfacet reflects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FresnelEntry {
    /// [`Fresnel::Schlick`].
    Schlick {
        /// Reflectance at normal incidence per channel, 0 to 1.
        f0: [f32; 3],
    },
    /// [`Fresnel::Conductor`].
    Conductor {
        /// Real part of the index of refraction per channel, 0.01 to 20.
        eta: [f32; 3],
        /// Its imaginary part, 0 to 20.
        k: [f32; 3],
    },
    /// A metal's own.
    Metal(Metal),
}

impl From<FresnelEntry> for Fresnel {
    fn from(entry: FresnelEntry) -> Self {
        match entry {
            FresnelEntry::Schlick { f0 } => Self::Schlick { f0 },
            FresnelEntry::Conductor { eta, k } => Self::Conductor { eta, k },
            FresnelEntry::Metal(metal) => Self::metal(metal),
        }
    }
}

impl From<BrdfEntry> for Brdf {
    fn from(entry: BrdfEntry) -> Self {
        let ggx = |alpha, fresnel| Self::Ggx { alpha, fresnel };
        match entry {
            BrdfEntry::Lambert { albedo } => Self::Lambert { albedo },
            BrdfEntry::Schlick { alpha, f0 } => ggx(alpha, Fresnel::Schlick { f0 }),
            BrdfEntry::Conductor { alpha, eta, k } => ggx(alpha, Fresnel::Conductor { eta, k }),
            BrdfEntry::Metal { name, alpha } => Self::metal(name, alpha),
            BrdfEntry::OrenNayar { albedo, roughness } => Self::OrenNayar { albedo, roughness },
            BrdfEntry::Phong { specular, exponent } => Self::Phong { specular, exponent },
            BrdfEntry::CookTorrance { alpha, fresnel } => Self::CookTorrance {
                alpha,
                fresnel: fresnel.into(),
            },
            BrdfEntry::AnisotropicGgx {
                alpha_across,
                alpha_along,
                fresnel,
            } => Self::AnisotropicGgx {
                alpha_across,
                alpha_along,
                fresnel: fresnel.into(),
            },
        }
    }
}

/// Makes the enumeration of names from the expressions that make the materials.
macro_rules! material_names {
    ($($name:ident = $make:expr,)+) => {
        /// Materials by name: the metals of [`Metal`], acrylic glass, glass and ceramic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[expect(missing_docs, reason = "the names say it")]
        pub enum MaterialName {
            $($name,)+
        }

        impl MaterialName {
            /// All names.
            pub const ALL: &[Self] = &[$(Self::$name),+];

            fn material(self) -> Material {
                match self {
                    $(Self::$name => $make,)+
                }
            }
        }
    };
}

material_names! {
    Aluminium = Material::metal(Metal::Aluminium),
    Brass = Material::metal(Metal::Brass),
    Steel = Material::metal(Metal::Steel),
    Titanium = Material::metal(Metal::Titanium),
    Copper = Material::metal(Metal::Copper),
    Gold = Material::metal(Metal::Gold),
    Silver = Material::metal(Metal::Silver),
    Iron = Material::metal(Metal::Iron),
    Nickel = Material::metal(Metal::Nickel),
    Chromium = Material::metal(Metal::Chromium),
    Acrylic = Material::acrylic(),
    Glass = Material::glass(),
    Ceramic = Material::ceramic(),
}

impl MaterialEntry {
    /// The material, checked.
    pub(super) fn material(&self) -> Result<Material> {
        let mut material = match (self.like, self.hardness_hv, self.surface, self.scratched) {
            (Some(like), ..) => like.material(),
            (None, Some(hardness_hv), Some(surface), Some(scratched)) => {
                Material::new(hardness_hv, surface.into(), scratched.into())
            }
            (None, hardness_hv, surface, _) => {
                let missing = match (hardness_hv, surface) {
                    (None, _) => "hardness_hv is missing",
                    (_, None) => "surface is missing",
                    _ => "scratched is missing",
                };
                let accepted = "hardness_hv, surface and scratched, or like";
                return Err(FileError::new(Place::Whole, missing, accepted));
            }
        };
        let set = |to: &mut f64, stated: Option<f64>| *to = stated.unwrap_or(*to);
        set(&mut material.hardness_hv, self.hardness_hv);
        set(&mut material.pile_up_fraction, self.pile_up_fraction);
        set(&mut material.elastic_recovery, self.elastic_recovery);
        material.pile_up = self.pile_up.unwrap_or(material.pile_up);
        material.surface = self.surface.map_or(material.surface, Brdf::from);
        material.scratched = self.scratched.map_or(material.scratched, Brdf::from);
        let layers = self.layers.iter().flatten();
        material.layers = layers
            .map(|layer| Layer {
                thickness_mm: layer.thickness_mm,
                scratched: layer.scratched.into(),
            })
            .collect();
        material.check()?;
        Ok(material)
    }
}

/// Hardness that varies over the surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum HardnessEntry {
    /// [`read_hardness`].
    Image {
        /// A PNG or EXR file, relative to the pattern file's folder.
        file: String,
        /// What values of 0 and 1 mean, 0.01 to 20000 each.
        range_hv: [f64; 2],
    },
    /// [`HardnessMap::readings`].
    Readings(Vec<ReadingEntry>),
}

/// One indentation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReadingEntry {
    /// Texture coordinates, -1e9 to 1e9.
    pub uv: [f64; 2],
    /// 0.01 to 20000.
    pub hardness_hv: f64,
}

impl HardnessEntry {
    pub(super) fn map(&self, folder: &Path) -> Result<HardnessMap> {
        match self {
            Self::Image { file, range_hv } => read_hardness(&folder.join(file), *range_hv),
            Self::Readings(readings) => {
                let reading = |entry: &ReadingEntry| Reading {
                    uv: entry.uv,
                    hardness_hv: entry.hardness_hv,
                };
                let readings: Vec<Reading> = readings.iter().map(reading).collect();
                Ok(HardnessMap::readings(&readings)?)
            }
        }
    }
}
