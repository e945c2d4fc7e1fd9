//! Wavefront OBJ, by hand: of the crates that read it, tobj 4.0 overflows on `f 1/-5 2 3`, refuses a `vt` of one
//! number and names no line; obj-rs 0.7 panics on curves.

use super::error::{FileError, Place, Result};
use super::polygons::Polygons;
use super::text::{Lines, excerpt, number, position, without_mark, words};

/// The vertices and faces of an OBJ file. A face may name vertices that come after it.
pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let mut polygons = Polygons::counted_from(1);
    let mut lines = Lines::new(without_mark(bytes), 1);
    let mut corners = Vec::new();
    while let Some(line) = lines.next()? {
        let place = lines.place();
        let line = without_comment(line);
        match words(line).next() {
            Some(b"v") => {
                let arguments = statement(line, &mut lines)?;
                polygons.vertex(vertex(&arguments, place)?, place)?;
            }
            Some(b"f" | b"fo") => {
                corners.clear();
                for corner in statement(line, &mut lines)? {
                    corners.push(vertex_number(corner, &polygons, place)?);
                }
                polygons.polygon(&corners, place)?;
            }
            _ => {}
        }
    }
    Ok(polygons)
}

/// The words after the keyword, also of the lines that a backslash joins to this one.
fn statement<'a>(line: &'a [u8], lines: &mut Lines<'a>) -> Result<Vec<&'a [u8]>> {
    let mut arguments: Vec<&[u8]> = Vec::new();
    let mut line = line.trim_ascii_end();
    while let Some(start) = line.strip_suffix(b"\\") {
        arguments.extend(words(start));
        line = without_comment(lines.next()?.unwrap_or_default()).trim_ascii_end();
    }
    arguments.extend(words(line));
    arguments.remove(0);
    Ok(arguments)
}

fn without_comment(line: &[u8]) -> &[u8] {
    line.split(|&byte| byte == b'#').next().unwrap_or_default()
}

/// Three coordinates. What follows may be a weight, which only curves have, or a colour.
fn vertex(arguments: &[&[u8]], place: Place) -> Result<[f64; 3]> {
    if let &[_, _, _, weight] = arguments
        && number(weight, place)? != 1.0
    {
        let found = format!("a vertex of weight {}", excerpt(weight));
        return Err(FileError::new(place, found, "no weight, or 1"));
    }
    position(&mut arguments.iter().copied(), place)
}

/// A corner's vertex, counted from 0. It is the number before the first slash: from 1 for the file's first
/// vertex, or down from -1 for the last one so far.
fn vertex_number(corner: &[u8], polygons: &Polygons, place: Place) -> Result<u32> {
    let word = corner.split(|&byte| byte == b'/').next();
    let text = word.and_then(|word| str::from_utf8(word).ok());
    let Some(number) = text.and_then(|text| text.parse::<i64>().ok()) else {
        let found = format!("{} is not a corner of a face", excerpt(corner));
        let accepted = "numbers of vertices, such as 7, -1, 7/2 or 7/2/3";
        return Err(FileError::new(place, found, accepted));
    };
    let counted = match number {
        1.. => number - 1,
        0 => -1,
        _ => number.saturating_add(i64::from(polygons.vertex_count())),
    };
    u32::try_from(counted).map_err(|_| polygons.no_such_vertex(&number.to_string(), place))
}
