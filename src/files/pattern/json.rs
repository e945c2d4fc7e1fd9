//! JSON: what is written can be read again; what cannot be read is told by line, column and field.

use super::super::error::{FileError, Place, Result};
use super::super::text::without_mark;
use super::PatternFile;
use core::fmt;
use core::marker::PhantomData;
use serde::de::{Deserializer, Error as _, MapAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use serde_json::ser::{Formatter, PrettyFormatter};
use std::collections::BTreeMap;
use std::io;

/// Longest text of a file's own in a message, characters.
const MOST_CHARS: usize = 160;

/// The version of the form of pattern files, which is 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Version;

impl Serialize for Version {
    fn serialize<S: Serializer>(&self, to: S) -> core::result::Result<S::Ok, S::Error> {
        to.serialize_u32(1)
    }
}

impl<'de> Deserialize<'de> for Version {
    fn deserialize<D: Deserializer<'de>>(from: D) -> core::result::Result<Self, D::Error> {
        match u64::deserialize(from)? {
            1 => Ok(Self),
            other => Err(D::Error::custom(format!("version {other}, expected 1"))),
        }
    }
}

pub(super) fn parse(bytes: &[u8]) -> Result<PatternFile> {
    let mut json = serde_json::Deserializer::from_slice(without_mark(bytes));
    let file = serde_path_to_error::deserialize(&mut json)
        .map_err(|error| refused(&error.path().to_string(), error.inner()))?;
    json.end().map_err(|error| refused(".", &error))?;
    Ok(file)
}

/// A message such as `line 7, column 21: scratches[0].tool: invalid type: integer 3; accepted: a string`.
fn refused(field: &str, error: &serde_json::Error) -> FileError {
    let (line, column) = (error.line(), error.column());
    let text = error.to_string();
    let place = format!(" at line {line} column {column}");
    let text = text.strip_suffix(&place).unwrap_or(&text);
    let (found, accepted) = match text.rsplit_once(", expected ") {
        Some((found, "f64" | "f32")) => (found, "a number"),
        Some((found, "u32" | "u64")) => (found, "a whole number, 0 or more"),
        Some((found, accepted)) => (found, accepted),
        None => (text, "JSON as docs/pattern-file.md describes it"),
    };
    let cut = |text: &str| -> String { text.chars().take(MOST_CHARS).collect() };
    let found = match field {
        // The document itself.
        "." => cut(found),
        field => format!("{}: {}", cut(field), cut(found)),
    };
    FileError::new(Place::Column(line, column), found, accepted.to_owned())
}

pub(super) fn text(file: &PatternFile) -> Result<String> {
    let mut bytes = Vec::new();
    let mut writer = serde_json::Serializer::with_formatter(&mut bytes, Layout::default());
    let written = file.serialize(&mut writer);
    let unwritable = |error: serde_json::Error| {
        FileError::new(Place::Whole, error.to_string(), "what JSON can hold")
    };
    written.map_err(unwritable)?;
    bytes.push(b'\n');
    // A number that is not finite is written as null, which no number is read from.
    parse(&bytes)?;
    String::from_utf8(bytes)
        .map_err(|error| FileError::new(Place::Whole, error.to_string(), "texts in UTF-8"))
}

/// A map in which no name stands twice.
pub(super) fn unique<'de, D: Deserializer<'de>, V: Deserialize<'de>>(
    from: D,
) -> core::result::Result<BTreeMap<String, V>, D::Error> {
    struct Unique<V>(PhantomData<V>);

    impl<'de, V: Deserialize<'de>> Visitor<'de> for Unique<V> {
        type Value = BTreeMap<String, V>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("names, each with what it stands for")
        }

        fn visit_map<A: MapAccess<'de>>(
            self,
            mut map: A,
        ) -> core::result::Result<Self::Value, A::Error> {
            let mut values = BTreeMap::new();
            while let Some(name) = map.next_key::<String>()? {
                let value = map.next_value()?;
                if values.contains_key(&name) {
                    let twice = format!("the name \"{name}\" twice, expected it once");
                    return Err(A::Error::custom(twice));
                }
                values.insert(name, value);
            }
            Ok(values)
        }
    }

    from.deserialize_map(Unique(PhantomData))
}

/// Whether a number need not be written: bit by bit 0.
#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the form that serde wants"
)]
pub(super) fn is_zero(value: &f64) -> bool {
    value.to_bits() == 0
}

pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// JSON for people: the document's parts and their fields on lines of their own, points and keys in a row.
#[derive(Default)]
struct Layout {
    pretty: PrettyFormatter<'static>,
    depth: usize,
}

/// Deeper than this everything stands in a row.
const DEEPEST: usize = 3;

impl Layout {
    fn separate<W: ?Sized + io::Write>(writer: &mut W, first: bool) -> io::Result<()> {
        if first {
            Ok(())
        } else {
            writer.write_all(b", ")
        }
    }
}

/// Hands each event to the indenting formatter down to the deepest indented level.
macro_rules! laid_out {
    ($($begin:ident $begin_text:literal $end:ident $end_text:literal $item:ident $pretty_end:ident;)+) => {$(
        fn $begin<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
            self.depth += 1;
            if self.depth <= DEEPEST {
                return self.pretty.$begin(writer);
            }
            writer.write_all($begin_text)
        }

        fn $end<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
            self.depth -= 1;
            if self.depth < DEEPEST {
                return self.pretty.$end(writer);
            }
            writer.write_all($end_text)
        }

        fn $item<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
            if self.depth <= DEEPEST {
                return self.pretty.$item(writer, first);
            }
            Self::separate(writer, first)
        }

        fn $pretty_end<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
            if self.depth <= DEEPEST {
                return self.pretty.$pretty_end(writer);
            }
            Ok(())
        }
    )+};
}

impl Formatter for Layout {
    laid_out! {
        begin_array b"[" end_array b"]" begin_array_value end_array_value;
        begin_object b"{ " end_object b" }" begin_object_key end_object_value;
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
