//! STL, by hand: `stl_io` 0.11 passes over every solid of a text file but the first, takes a text file whose solid
//! has no name for a binary one, and names no line. Binary STL is 50 bytes a triangle.

use super::error::{FileError, Place, Result};
use super::polygons::Polygons;
use super::text::{Lines, excerpt, position, without_mark, words};

/// A binary file's header and count of triangles.
const HEAD_BYTES: usize = 84;
/// Normal, three corners, two spare bytes.
const TRIANGLE_BYTES: usize = 50;

/// The triangles of an STL file, text or binary.
///
/// A file whose size is what a binary one of its count would have is binary, also if it begins with `solid`: the
/// count's bytes would be at least 150 million triangles as text. A few spare bytes at the end do no harm.
pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let claimed = bytes
        .get(HEAD_BYTES - 4..HEAD_BYTES)
        .and_then(|count| count.try_into().ok())
        .map(|count| u64::from(u32::from_le_bytes(count)));
    let body = bytes.get(HEAD_BYTES..).unwrap_or_default();
    let held = (body.len() / TRIANGLE_BYTES) as u64;
    if claimed == Some(held) {
        return binary(body);
    }
    if begins_as_text(bytes) {
        return text(bytes);
    }
    let accepted = "84 bytes and 50 for each triangle, or a text that begins with solid";
    Err(match claimed {
        Some(count) => FileError::new(
            Place::Byte(HEAD_BYTES - 4),
            format!("claims {count} triangles, holds {held}"),
            accepted,
        ),
        None => FileError::new(
            Place::Whole,
            format!("holds {} bytes", bytes.len()),
            accepted,
        ),
    })
}

fn binary(body: &[u8]) -> Result<Polygons> {
    let mut polygons = Polygons::counted_from(0);
    let (triangles, _) = body.as_chunks::<TRIANGLE_BYTES>();
    for (i, triangle) in triangles.iter().enumerate() {
        let place = Place::Byte(HEAD_BYTES + i * TRIANGLE_BYTES);
        let (numbers, _) = triangle[12..].as_chunks::<4>();
        let (corners, _) = numbers.as_chunks::<3>();
        for corner in corners {
            polygons.vertex(corner.map(|n| f64::from(f32::from_le_bytes(n))), place)?;
        }
        close(&mut polygons, place)?;
    }
    Ok(polygons)
}

/// Whether the first word is `solid`, and the beginning has no byte that text has not.
fn begins_as_text(bytes: &[u8]) -> bool {
    let bytes = without_mark(bytes);
    let start = &bytes[..bytes.len().min(512)];
    let is_text = |&byte: &u8| byte.is_ascii_whitespace() || !byte.is_ascii_control();
    is(words(start).next(), "solid") && start.iter().all(is_text)
}

fn text(bytes: &[u8]) -> Result<Polygons> {
    let mut polygons = Polygons::counted_from(0);
    let mut lines = Lines::new(without_mark(bytes), 1);
    let mut in_solid = false;
    // Corners read of the facet that is open.
    let mut facet: Option<u32> = None;
    while let Some(line) = lines.next()? {
        let place = lines.place();
        let mut line_words = words(line);
        let Some(first) = line_words.next() else {
            continue;
        };
        let keyword = first.to_ascii_lowercase();
        match (keyword.as_slice(), facet) {
            (b"solid", None) => in_solid = true,
            (b"endsolid", None) => in_solid = false,
            (b"end", None) if is(line_words.next(), "solid") => in_solid = false,
            (b"facet", None) if in_solid => facet = Some(0),
            (b"outer", Some(0)) | (b"endloop", Some(3)) => {}
            (b"vertex", Some(corners @ 0..3)) => {
                let position = position(&mut line_words, place)?;
                if let Some(word) = line_words.next() {
                    let found = format!("{} after three coordinates", excerpt(word));
                    return Err(FileError::new(place, found, "nothing after them"));
                }
                polygons.vertex(position, place)?;
                facet = Some(corners + 1);
            }
            (b"endfacet", Some(3)) => {
                close(&mut polygons, place)?;
                facet = None;
            }
            (_, facet) => {
                let accepted = match facet {
                    None if in_solid => "facet or endsolid",
                    None => "solid",
                    Some(0..3) => "outer loop, then vertex and three numbers, three times",
                    Some(_) => "endloop, then endfacet",
                };
                let found = format!("{} does not belong here", excerpt(line));
                return Err(FileError::new(place, found, accepted));
            }
        }
    }
    if in_solid || facet.is_some() {
        let found = "the file ends within a solid";
        return Err(FileError::new(lines.place(), found, "endsolid at the end"));
    }
    Ok(polygons)
}

fn is(word: Option<&[u8]>, keyword: &str) -> bool {
    word.is_some_and(|word| word.eq_ignore_ascii_case(keyword.as_bytes()))
}

/// A triangle of the last three vertices.
fn close(polygons: &mut Polygons, place: Place) -> Result<()> {
    let count = polygons.vertex_count();
    polygons.polygon(&[count - 3, count - 2, count - 1], place)
}
