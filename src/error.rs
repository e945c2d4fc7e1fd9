//! What a refused argument is answered with.
//!
//! Errors are plain `Copy` data, so that reporting one never allocates, not even while shading.

use core::fmt;

/// An argument that was refused: its name, what was given, and what is accepted.
///
/// `Display` gives one sentence, such as
/// `keys[2].force_kgf is -1; accepted: a finite number from 0 to 100000`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    item: Option<(&'static str, usize)>,
    argument: &'static str,
    given: Given,
    accepted: Accepted,
}

/// What was given for a refused argument.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Given {
    Number(f64),
    Count(usize),
    Text(&'static str),
}

/// What is accepted for a refused argument.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Accepted {
    Range(f64, f64),
    Text(&'static str),
}

/// The crate's result.
pub type Result<T> = core::result::Result<T, Error>;

impl Error {
    /// `argument` was the number `given`; `accepted` says in words what is accepted.
    pub const fn number(argument: &'static str, given: f64, accepted: &'static str) -> Self {
        Self {
            item: None,
            argument,
            given: Given::Number(given),
            accepted: Accepted::Text(accepted),
        }
    }

    /// There were `given` of something.
    pub const fn count(argument: &'static str, given: usize, accepted: &'static str) -> Self {
        Self {
            item: None,
            argument,
            given: Given::Count(given),
            accepted: Accepted::Text(accepted),
        }
    }

    /// `argument` was `given`, in words (such as `NULL`).
    pub const fn text(argument: &'static str, given: &'static str, accepted: &'static str) -> Self {
        Self {
            item: None,
            argument,
            given: Given::Text(given),
            accepted: Accepted::Text(accepted),
        }
    }

    /// The same error, about element `index` of the array `array`.
    pub const fn within(mut self, array: &'static str, index: usize) -> Self {
        self.item = Some((array, index));
        self
    }

    /// The name of the refused argument.
    pub const fn argument(&self) -> &'static str {
        self.argument
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((array, index)) = self.item {
            write!(f, "{array}[{index}]")?;
            if !self.argument.is_empty() {
                write!(f, ".")?;
            }
        }
        write!(f, "{} is ", self.argument)?;
        match self.given {
            Given::Number(value) => write!(f, "{}", Short(value))?,
            Given::Count(count) => write!(f, "{count}")?,
            Given::Text(text) => write!(f, "{text}")?,
        }
        match self.accepted {
            Accepted::Range(from, to) => {
                let (from, to) = (Short(from), Short(to));
                write!(f, "; accepted: a finite number from {from} to {to}")
            }
            Accepted::Text(text) => write!(f, "; accepted: {text}"),
        }
    }
}

impl core::error::Error for Error {}

/// A number that takes no more room than needed: with an exponent where hundreds of digits would be zeros.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        if value == 0.0 || !value.is_finite() || (1e-12..1e16).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

/// `value` if it lies in `from..=to` (so never NaN), else an error that names `argument`.
pub(crate) fn in_range(argument: &'static str, value: f64, from: f64, to: f64) -> Result<f64> {
    if (from..=to).contains(&value) {
        return Ok(value);
    }
    Err(Error {
        item: None,
        argument,
        given: Given::Number(value),
        accepted: Accepted::Range(from, to),
    })
}

/// Nothing if all `values` are finite, else an error that names `argument` and the first that is not.
pub(crate) fn all_finite(argument: &'static str, values: &[f32]) -> Result<()> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => {
            let accepted = "finite numbers only";
            Err(Error::number(argument, f64::from(value), accepted))
        }
        None => Ok(()),
    }
}

/// As [`in_range`], for each of three channels.
pub(crate) fn rgb_in_range(
    argument: &'static str,
    rgb: [f32; 3],
    from: f64,
    to: f64,
) -> Result<[f32; 3]> {
    for channel in rgb {
        in_range(argument, f64::from(channel), from, to)?;
    }
    Ok(rgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message names the argument, the value and what is accepted.
    #[test]
    fn message_names_all_three() {
        let error = in_range("force_kgf", -1.0, 0.0, 5.0)
            .unwrap_err()
            .within("keys", 2);
        assert_eq!(
            error.to_string(),
            "keys[2].force_kgf is -1; accepted: a finite number from 0 to 5"
        );
    }

    /// Numbers of hundreds of digits leave room for what is accepted.
    #[test]
    fn numbers_are_short() {
        let error = in_range("radius", -1e-300, f64::MIN_POSITIVE, f64::MAX).unwrap_err();
        assert_eq!(
            error.to_string(),
            "radius is -1e-300; accepted: a finite number from 2.2250738585072014e-308 to 1.7976931348623157e308"
        );
    }

    /// NaN and infinities are in no range.
    #[test]
    fn not_a_number_is_refused() {
        assert!(in_range("x", f64::NAN, 0.0, 1.0).is_err(), "NaN passed");
        assert!(
            in_range("x", f64::INFINITY, 0.0, 1.0).is_err(),
            "infinity passed"
        );
    }
}
