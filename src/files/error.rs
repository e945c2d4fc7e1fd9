//! What a refused file is answered with.

use crate::error::Error;
use core::fmt;
use std::borrow::Cow;
use std::path::Path;

/// Longest name of a file in a message; of a longer one the end is given.
const NAME_BYTES: usize = 160;

/// A file that could not be read or used: its name, the line or byte, what was found, and what is accepted.
///
/// `Display` gives one sentence, such as
/// `tool.stl: byte 80: claims 4294967295 triangles in 684 bytes; accepted: 84 bytes and 50 for each triangle`.
/// Lines count from 1, bytes from 0.
#[derive(Clone, Debug, PartialEq)]
pub struct FileError {
    file: String,
    place: Place,
    // Boxed, so that results stay small.
    fault: Box<Fault>,
}

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    Whole,
    Line(usize),
    Byte(usize),
    /// Line and column, both from 1.
    Column(usize, usize),
}

#[derive(Clone, Debug, PartialEq)]
enum Fault {
    /// An argument of the call, not the file.
    Argument(Error),
    /// The file is in order, but no tool can be made of it.
    Unusable(Error),
    /// A part of the file was refused: which one, and why.
    Within(String),
    Refused {
        found: Cow<'static, str>,
        accepted: Cow<'static, str>,
    },
}

/// The room's result.
pub(super) type Result<T> = core::result::Result<T, FileError>;

impl FileError {
    /// `found`, at `place`, was refused; `accepted` says in words what is accepted.
    pub(super) fn new(
        place: Place,
        found: impl Into<Cow<'static, str>>,
        accepted: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self::of(
            place,
            Fault::Refused {
                found: found.into(),
                accepted: accepted.into(),
            },
        )
    }

    /// No tool can be made of what the file holds.
    pub(super) fn unusable(error: Error) -> Self {
        Self::of(Place::Whole, Fault::Unusable(error))
    }

    /// `part` of a file was refused, with this error.
    pub(super) fn within(part: impl fmt::Display, error: impl fmt::Display) -> Self {
        Self::of(Place::Whole, Fault::Within(format!("{part}: {error}")))
    }

    /// The same error, about the file at `path`.
    pub(crate) fn in_file(mut self, path: &Path) -> Self {
        let name = path.to_string_lossy();
        let mut start = name.len().saturating_sub(NAME_BYTES);
        start = name.ceil_char_boundary(start);
        let ellipsis = if start > 0 { "..." } else { "" };
        self.file = format!("{ellipsis}{}", &name[start..]);
        self
    }

    /// The argument of the call that was refused, if it was not the file.
    pub fn argument(&self) -> Option<&'static str> {
        match &*self.fault {
            Fault::Argument(error) => Some(error.argument()),
            _ => None,
        }
    }

    fn of(place: Place, fault: Fault) -> Self {
        Self {
            file: String::new(),
            place,
            fault: Box::new(fault),
        }
    }
}

impl From<Error> for FileError {
    /// An argument was refused before the file was looked at.
    fn from(error: Error) -> Self {
        Self::of(Place::Whole, Fault::Argument(error))
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Fault::Argument(error) = &*self.fault {
            return error.fmt(f);
        }
        if !self.file.is_empty() {
            write!(f, "{}: ", self.file)?;
        }
        match self.place {
            Place::Whole => {}
            Place::Line(number) => write!(f, "line {number}: ")?,
            Place::Byte(offset) => write!(f, "byte {offset}: ")?,
            Place::Column(line, column) => write!(f, "line {line}, column {column}: ")?,
        }
        match &*self.fault {
            Fault::Argument(error) | Fault::Unusable(error) => error.fmt(f),
            Fault::Within(text) => f.write_str(text),
            Fault::Refused { found, accepted } => write!(f, "{found}; accepted: {accepted}"),
        }
    }
}

impl core::error::Error for FileError {}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message names file, place, what was found and what is accepted; of a long path the file's own name stays.
    #[test]
    fn message_names_all_four() {
        let error = FileError::new(Place::Line(3), "\"nan\" is not finite", "finite numbers");
        assert_eq!(
            error.clone().in_file(Path::new("a/tool.obj")).to_string(),
            "a/tool.obj: line 3: \"nan\" is not finite; accepted: finite numbers"
        );
        let long = format!("{}/tool.obj", "é".repeat(500));
        let message = error.in_file(Path::new(&long)).to_string();
        assert!(
            message.len() < 230 && message.contains("é/tool.obj: line 3"),
            "{message}"
        );
    }
}
