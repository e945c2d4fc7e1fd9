//! Metals by name: index of refraction and hardness.

/// A metal whose optical constants and hardness are known.
///
/// Optical constants are read off measured tables at 650, 550 and 450 nm for red, green and blue: aluminium from
/// Rakic 1995 (Appl. Opt. 34), brass (70 Cu 30 Zn) from Querry 1985 (CRDC-CR-85034), copper, gold and silver
/// from Johnson and Christy 1972 (Phys. Rev. B 6), the others from Johnson and Christy 1974 (Phys. Rev. B 9).
/// Hardness of the elements is Samsonov's Vickers hardness (Handbook of the Physicochemical Properties of the
/// Elements, 1968) over 9.80665, of the alloys and of titanium a value typical of the temper named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Metal {
    /// Aluminium alloy 6061-T6, 107 HV.
    Aluminium,
    /// Cartridge brass, half hard, 120 HV.
    Brass,
    /// Low-carbon steel AISI 1018, cold drawn, 131 HV; reflects like iron.
    Steel,
    /// Commercially pure titanium, grade 2, 145 HV.
    Titanium,
    /// Copper, 37.6 HV.
    Copper,
    /// Gold, 22 HV.
    Gold,
    /// Silver, 25.6 HV.
    Silver,
    /// Iron, 62 HV.
    Iron,
    /// Nickel, 65 HV.
    Nickel,
    /// Chromium, 108 HV.
    Chromium,
}

impl Metal {
    /// All metals, in the order of their numbers on the C face.
    pub const ALL: [Self; 10] = [
        Self::Aluminium,
        Self::Brass,
        Self::Steel,
        Self::Titanium,
        Self::Copper,
        Self::Gold,
        Self::Silver,
        Self::Iron,
        Self::Nickel,
        Self::Chromium,
    ];

    /// Complex index of refraction per channel: (eta, k).
    pub fn eta_k(self) -> ([f32; 3], [f32; 3]) {
        match self {
            Self::Aluminium => ([1.558, 1.015, 0.633], [7.712, 6.627, 5.454]),
            Self::Brass => ([0.444, 0.527, 1.094], [3.695, 2.765, 1.829]),
            Self::Steel | Self::Iron => ([2.911, 2.950, 2.584], [3.089, 2.932, 2.767]),
            Self::Titanium => ([2.741, 2.542, 2.267], [3.814, 3.435, 3.038]),
            Self::Copper => ([0.238, 1.007, 1.240], [3.626, 2.582, 2.393]),
            Self::Gold => ([0.156, 0.424, 1.383], [3.602, 2.472, 1.915]),
            Self::Silver => ([0.052, 0.060, 0.040], [4.409, 3.597, 2.648]),
            Self::Nickel => ([1.990, 1.921, 1.729], [4.209, 3.616, 2.944]),
            Self::Chromium => ([3.107, 3.181, 2.323], [3.331, 3.329, 3.135]),
        }
    }

    /// Vickers hardness, kgf/mm².
    pub fn hardness_hv(self) -> f64 {
        match self {
            Self::Aluminium => 107.0,
            Self::Brass => 120.0,
            Self::Steel => 131.0,
            Self::Titanium => 145.0,
            Self::Copper => 37.6,
            Self::Gold => 22.0,
            Self::Silver => 25.6,
            Self::Iron => 62.0,
            Self::Nickel => 65.0,
            Self::Chromium => 108.0,
        }
    }
}
