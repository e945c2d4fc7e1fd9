//! Metals by name: index of refraction and hardness.

/// A metal whose optical constants and hardness are known.
///
/// Optical constants are sampled at 650, 550 and 450 nm for red, green and blue: aluminium from Rakic 1995,
/// brass from Querry 1985, steel (as iron) and titanium from Johnson and Christy 1974.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metal {
    /// Aluminium alloy 6061-T6, 107 HV.
    Aluminium,
    /// Cartridge brass, half hard, 120 HV.
    Brass,
    /// Low-carbon steel AISI 1018, cold drawn, 131 HV.
    Steel,
    /// Commercially pure titanium, grade 2, 145 HV.
    Titanium,
}

impl Metal {
    /// Complex index of refraction per channel: (eta, k).
    pub fn eta_k(self) -> ([f32; 3], [f32; 3]) {
        match self {
            Self::Aluminium => ([1.3456, 0.96521, 0.61722], [7.4746, 6.3995, 5.3031]),
            Self::Brass => ([0.444, 0.527, 1.094], [3.695, 2.765, 1.829]),
            Self::Steel => ([2.9114, 2.9497, 2.5845], [3.0893, 2.9318, 2.7670]),
            Self::Titanium => ([2.7407, 2.5418, 2.2370], [3.8143, 3.4345, 3.0235]),
        }
    }

    /// Vickers hardness, kgf/mm².
    pub fn hardness_hv(self) -> f64 {
        match self {
            Self::Aluminium => 107.0,
            Self::Brass => 120.0,
            Self::Steel => 131.0,
            Self::Titanium => 145.0,
        }
    }
}
