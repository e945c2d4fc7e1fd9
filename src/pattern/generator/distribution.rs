//! How a quantity varies from scratch to scratch.

use super::normal;
use crate::error::{Error, Result, in_range};

/// How a quantity varies from scratch to scratch: always between `from` and `to`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "files",
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum Distribution {
    /// Every value alike; the same for all where `from` is `to`.
    Uniform {
        /// Least.
        from: f64,
        /// Most.
        to: f64,
    },
    /// A normal distribution, cut at both ends.
    Normal {
        /// Least.
        from: f64,
        /// Most.
        to: f64,
        /// Mean before the cut, between `from` and `to`.
        middle: f64,
        /// Standard deviation before the cut, 0 to 1e9.
        deviation: f64,
    },
    /// A normal distribution of the logarithm, cut at both ends.
    LogNormal {
        /// Least.
        from: f64,
        /// Most.
        to: f64,
        /// Median before the cut, above 0, between `from` and `to`.
        middle: f64,
        /// Standard deviation of the natural logarithm before the cut, 0 to 10.
        deviation: f64,
    },
    /// A density that falls like the value to the power of `-exponent`: many small ones, few large ones.
    PowerLaw {
        /// Least, above 0.
        from: f64,
        /// Most.
        to: f64,
        /// -10 (rising) to 10 (falling).
        exponent: f64,
    },
    /// A density that falls by a factor e with every `decay`.
    Exponential {
        /// Least.
        from: f64,
        /// Most.
        to: f64,
        /// 1e-9 to 1e9.
        decay: f64,
    },
}

/// What the fields of one distribution are called in errors.
pub(super) struct Fields {
    pub from: &'static str,
    pub to: &'static str,
    pub middle: &'static str,
    pub deviation: &'static str,
    pub exponent: &'static str,
    pub decay: &'static str,
}

macro_rules! fields {
    ($name:literal) => {
        $crate::pattern::generator::distribution::Fields {
            from: concat!($name, ".from"),
            to: concat!($name, ".to"),
            middle: concat!($name, ".middle"),
            deviation: concat!($name, ".deviation"),
            exponent: concat!($name, ".exponent"),
            decay: concat!($name, ".decay"),
        }
    };
}
pub(super) use fields;

impl Distribution {
    /// The same for all.
    pub const fn constant(value: f64) -> Self {
        Self::Uniform {
            from: value,
            to: value,
        }
    }

    fn ends(&self) -> [f64; 2] {
        match *self {
            Self::Uniform { from, to }
            | Self::Normal { from, to, .. }
            | Self::LogNormal { from, to, .. }
            | Self::PowerLaw { from, to, .. }
            | Self::Exponential { from, to, .. } => [from, to],
        }
    }

    /// Nothing if its ends lie in order between `least` and `most`, and all else in its range.
    pub(super) fn check(&self, fields: &Fields, least: f64, most: f64) -> Result<()> {
        let [from, to] = self.ends();
        in_range(fields.from, from, least, most)?;
        in_range(fields.to, to, from, most)?;
        let above_zero = |argument, value: f64| {
            let accepted = "more than 0";
            if value > 0.0 {
                Ok(value)
            } else {
                Err(Error::number(argument, value, accepted))
            }
        };
        match *self {
            Self::Uniform { .. } => Ok(0.0),
            Self::Normal {
                middle, deviation, ..
            } => in_range(fields.middle, middle, from, to).and(in_range(
                fields.deviation,
                deviation,
                0.0,
                1e9,
            )),
            Self::LogNormal {
                middle, deviation, ..
            } => in_range(fields.middle, middle, from, to)
                .and(above_zero(fields.middle, middle))
                .and(in_range(fields.deviation, deviation, 0.0, 10.0)),
            Self::PowerLaw { exponent, .. } => {
                above_zero(fields.from, from).and(in_range(fields.exponent, exponent, -10.0, 10.0))
            }
            Self::Exponential { decay, .. } => in_range(fields.decay, decay, 1e-9, 1e9),
        }
        .map(drop)
    }
}

/// A distribution's inverse, with what does not change from draw to draw worked out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inverse {
    ends: [f64; 2],
    form: Form,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    Uniform,
    Normal {
        middle: f64,
        deviation: f64,
        cut: Cut,
    },
    LogNormal {
        middle: f64,
        deviation: f64,
        cut: Cut,
    },
    /// `power` is 1 - exponent, `rise` (to / from)^power - 1.
    Power {
        power: f64,
        rise: f64,
    },
    /// exponent 1, where the logarithm is uniform: `rise` is ln (to / from).
    Logarithm {
        rise: f64,
    },
    /// `rise` is exp(-(to - from) / decay) - 1.
    Exponential {
        decay: f64,
        rise: f64,
    },
}

/// The part of a normal distribution that a cut leaves, as probabilities.
#[derive(Clone, Copy, Debug)]
struct Cut {
    below: f64,
    left: f64,
}

impl Cut {
    fn new(from: f64, to: f64) -> Self {
        let below = normal::probability(from);
        Self {
            below,
            left: normal::probability(to) - below,
        }
    }

    fn at(self, share: f64) -> f64 {
        normal::quantile(self.below + share * self.left)
    }
}

impl Inverse {
    pub(super) fn new(distribution: &Distribution) -> Self {
        let ends @ [from, to] = distribution.ends();
        let form = match *distribution {
            Distribution::Normal {
                middle, deviation, ..
            } if deviation > 0.0 => Form::Normal {
                middle,
                deviation,
                cut: Cut::new((from - middle) / deviation, (to - middle) / deviation),
            },
            Distribution::LogNormal {
                middle, deviation, ..
            } if deviation > 0.0 => {
                let deviations = |value: f64| libm::log(value / middle) / deviation;
                Form::LogNormal {
                    middle,
                    deviation,
                    cut: Cut::new(deviations(from), deviations(to)),
                }
            }
            // No deviation: the middle for all.
            Distribution::Normal { middle, .. } | Distribution::LogNormal { middle, .. } => {
                return Self {
                    ends: [middle; 2],
                    form: Form::Uniform,
                };
            }
            Distribution::PowerLaw { exponent: 1.0, .. } => Form::Logarithm {
                rise: libm::log(to / from),
            },
            Distribution::PowerLaw { exponent, .. } => {
                let power = 1.0 - exponent;
                Form::Power {
                    power,
                    rise: libm::expm1(power * libm::log(to / from)),
                }
            }
            Distribution::Exponential { decay, .. } => Form::Exponential {
                decay,
                rise: libm::expm1(-(to - from) / decay),
            },
            Distribution::Uniform { .. } => Form::Uniform,
        };
        Self { ends, form }
    }

    /// The value below which `share` of all values lie; `share` is above 0 and below 1.
    pub(super) fn at(&self, share: f64) -> f64 {
        let [from, to] = self.ends;
        let value = match self.form {
            Form::Uniform => from + share * (to - from),
            Form::Normal {
                middle,
                deviation,
                cut,
            } => middle + deviation * cut.at(share),
            Form::LogNormal {
                middle,
                deviation,
                cut,
            } => middle * libm::exp(deviation * cut.at(share)),
            Form::Power { power, rise } => from * libm::exp(libm::log1p(share * rise) / power),
            Form::Logarithm { rise } => from * libm::exp(share * rise),
            Form::Exponential { decay, rise } => from - decay * libm::log1p(share * rise),
        };
        value.clamp(from, to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cut far from the middle, the exponent 1 and no deviation are ordinary values.
    #[test]
    fn limits_are_continuous() {
        let at = |distribution: Distribution| Inverse::new(&distribution).at(0.3);
        let (from, to) = (2.0, 50.0);
        let power = |exponent| at(Distribution::PowerLaw { from, to, exponent });
        assert!(
            (power(1.0) - power(1.0 + 1e-9)).abs() < 1e-7,
            "{}",
            power(1.0)
        );
        let normal = |deviation| {
            at(Distribution::Normal {
                from,
                to,
                middle: 3.0,
                deviation,
            })
        };
        assert_eq!(normal(0.0), 3.0);
        assert!((normal(1e-9) - 3.0).abs() < 1e-8, "{}", normal(1e-9));
        // So wide that only the cut shows.
        let flat = at(Distribution::Uniform { from, to });
        assert!((normal(1e9) - flat).abs() < 1e-3, "{} {flat}", normal(1e9));
        let exponential = |decay| at(Distribution::Exponential { from, to, decay });
        assert!(
            (exponential(1e9) - flat).abs() < 1e-5,
            "{}",
            exponential(1e9)
        );
        let zero = Distribution::LogNormal {
            from: 0.0,
            to: 1.0,
            middle: 0.5,
            deviation: 1.0,
        };
        assert!((0.0..0.5).contains(&at(zero)), "{}", at(zero));
    }
}
