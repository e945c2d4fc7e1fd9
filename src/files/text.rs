//! Lines and numbers of text files, bounded and numbered.

use super::error::{FileError, Place, Result};

/// Most bytes of one line, so that what is made of a line stays small.
const MOST_LINE_BYTES: usize = 1 << 20;

/// Longest piece of a file in a message.
const EXCERPT_CHARS: usize = 40;

/// The lines of a text file, without their ends.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Lines<'a> {
    /// The lines of `bytes`, the first of which has the number `first`.
    pub(super) fn new(bytes: &'a [u8], first: usize) -> Self {
        Self {
            rest: bytes,
            number: first - 1,
        }
    }

    /// The next line, blank or not, while there is one.
    pub(super) fn next(&mut self) -> Result<Option<&'a [u8]>> {
        if self.rest.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        let mut halves = self.rest.splitn(2, |&byte| byte == b'\n');
        let line = halves.next().unwrap_or_default();
        self.rest = halves.next().unwrap_or_default();
        if line.len() > MOST_LINE_BYTES {
            let found = format!("a line of {} bytes", line.len());
            return Err(FileError::new(
                self.place(),
                found,
                format!("at most {MOST_LINE_BYTES} bytes a line"),
            ));
        }
        Ok(Some(line))
    }

    /// Bytes of the lines that are still to come.
    pub(super) fn left(&self) -> usize {
        self.rest.len()
    }

    /// Where the line that was read last is.
    pub(super) fn place(&self) -> Place {
        Place::Line(self.number)
    }
}

/// The text after the mark that some editors begin UTF-8 files with.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The words of a line, between white space.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// A word as a finite number.
pub(super) fn number(word: &[u8], place: Place) -> Result<f64> {
    str::from_utf8(word)
        .ok()
        .and_then(|text| text.parse().ok())
        .filter(|value: &f64| value.is_finite())
        .ok_or_else(|| {
            let found = format!("{} is not a finite number", excerpt(word));
            FileError::new(place, found, "finite numbers, such as -0.25 or 2.5e-1")
        })
}

/// The next three of `words` as finite numbers.
pub(super) fn position<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    place: Place,
) -> Result<[f64; 3]> {
    let mut position = [0.0; 3];
    for (i, value) in position.iter_mut().enumerate() {
        let word = words.next().ok_or_else(|| {
            let found = format!("a vertex with {i} coordinates");
            FileError::new(place, found, "three coordinates")
        })?;
        *value = number(word, place)?;
    }
    Ok(position)
}

/// A piece of a file as it may stand in a message: quoted, escaped, cut.
pub(super) fn excerpt(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(4 * EXCERPT_CHARS)]);
    let short: String = text.trim().chars().take(EXCERPT_CHARS).collect();
    let more = if short.len() < text.trim().len() {
        "..."
    } else {
        ""
    };
    format!("\"{}{more}\"", short.escape_debug())
}
