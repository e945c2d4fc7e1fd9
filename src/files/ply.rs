//! PLY, by ply-rs-bw, which caps what it allocates by a file's word. Around it: element counts are checked against
//! the file's size, lines and header are bounded, and what it would misread (two elements of one name) is refused.

use super::error::{FileError, Place, Result};
use super::polygons::Polygons;
use super::text::{Lines, excerpt, words};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};
use std::io::{Cursor, ErrorKind};

/// Most bytes of a header.
const MOST_HEADER_BYTES: usize = 1 << 20;

/// What lists of a face's corners are called.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The vertices and faces of a PLY file.
pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let (head, body) = split(bytes)?;
    let header = header(head)?;
    let mut polygons = Polygons::counted_from(0);
    let mut source = Source {
        encoding: header.encoding,
        size: bytes.len(),
        rest: body,
        lines: Lines::new(body, head.split(|&byte| byte == b'\n').count()),
    };
    for element in header.elements.values() {
        source.check_claim(element)?;
        let kind = Kind::of(element)?;
        for i in 0..element.count {
            let place = source.place();
            let row = source.row(element, i)?;
            // A line's number is known once it has been read.
            let place = source.line().unwrap_or(place);
            match kind {
                Kind::Vertex => polygons.vertex(row.position, place)?,
                Kind::Face => polygons.polygon(&row.corners(place)?, place)?,
                Kind::Other => {}
            }
        }
    }
    Ok(polygons)
}

/// The header, its last line included, and what follows.
fn split(bytes: &[u8]) -> Result<(&[u8], &[u8])> {
    if !bytes.starts_with(b"ply") {
        let found = format!("begins with {}", excerpt(&bytes[..bytes.len().min(16)]));
        return Err(FileError::new(Place::Line(1), found, "ply"));
    }
    let mut end = 0;
    for line in bytes[..bytes.len().min(MOST_HEADER_BYTES)].split_inclusive(|&byte| byte == b'\n') {
        end += line.len();
        if line.ends_with(b"\n") && line.trim_ascii_end() == b"end_header" {
            return Ok(bytes.split_at(end));
        }
    }
    Err(FileError::new(
        Place::Whole,
        format!("a header without end within {MOST_HEADER_BYTES} bytes"),
        "a header that ends in a line end_header",
    ))
}

fn header(head: &[u8]) -> Result<Header> {
    // Comments may hold anything; what is read of the header is ASCII.
    let text = String::from_utf8_lossy(head);
    let parser = Parser::<Row>::new();
    let header = parser
        .read_header(&mut Reader::new(Cursor::new(text.as_bytes())))
        .map_err(|error| {
            let number = error.line().unwrap_or(1);
            let line = head.split(|&byte| byte == b'\n').nth(number - 1);
            FileError::new(
                error.line().map_or(Place::Whole, Place::Line),
                format!("{} in the header", excerpt(line.unwrap_or_default())),
                "format, comment, obj_info, element and property lines of PLY 1.0",
            )
        })?;
    let lines_of = |keyword: &[u8]| {
        let lines = head.split(|&byte| byte == b'\n');
        lines
            .filter(|line| words(line).next() == Some(keyword))
            .count()
    };
    let properties = header
        .elements
        .values()
        .map(|element| element.properties.len());
    if lines_of(b"element") != header.elements.len()
        || lines_of(b"property") != properties.sum::<usize>()
    {
        return Err(FileError::new(
            Place::Whole,
            "two elements, or two properties of an element, with the same name",
            "a name for each",
        ));
    }
    Ok(header)
}

/// What is read of an element.
#[derive(Clone, Copy)]
enum Kind {
    Vertex,
    Face,
    Other,
}

impl Kind {
    fn of(element: &ElementDef) -> Result<Self> {
        let is_list = |name: &str| {
            let property = element.properties.get(name);
            property.map(|property| matches!(property.data_type, PropertyType::List(..)))
        };
        match element.name.as_str() {
            "vertex" if ["x", "y", "z"].map(is_list) == [Some(false); 3] => Ok(Self::Vertex),
            "vertex" => Err(FileError::new(
                Place::Whole,
                "an element vertex without x, y and z",
                "properties x, y and z, no lists",
            )),
            "face" if CORNERS.iter().any(|name| is_list(name) == Some(true)) => Ok(Self::Face),
            "face" => Err(FileError::new(
                Place::Whole,
                "an element face without a list of its vertices",
                "a property list vertex_indices or vertex_index",
            )),
            _ => Ok(Self::Other),
        }
    }
}

/// What follows the header.
struct Source<'a> {
    encoding: Encoding,
    size: usize,
    /// Binary files are read from here,
    rest: &'a [u8],
    /// text files from here.
    lines: Lines<'a>,
}

impl Source<'_> {
    /// The header's word on an element must fit into the file.
    fn check_claim(&self, element: &ElementDef) -> Result<()> {
        let (name, count) = (&element.name, element.count);
        if count > 0 && element.properties.is_empty() {
            return Err(FileError::new(
                Place::Whole,
                format!("{count} elements {name} without properties"),
                "one property or more",
            ));
        }
        let properties = element.properties.values();
        let least: usize = match self.encoding {
            // A digit and what parts it from the next.
            Encoding::Ascii => 2 * properties.len(),
            _ => properties
                .map(|property| least_bytes(&property.data_type))
                .sum(),
        };
        let left = self.left();
        // The last digit may be the file's last byte.
        if count.saturating_mul(least) > left + 1 {
            return Err(FileError::new(
                Place::Whole,
                format!("claims {count} of element {name}, with {left} bytes left for them"),
                format!("{least} bytes or more for each"),
            ));
        }
        Ok(())
    }

    fn left(&self) -> usize {
        match self.encoding {
            Encoding::Ascii => self.lines.left(),
            _ => self.rest.len(),
        }
    }

    /// Where what is read next begins.
    fn place(&self) -> Place {
        Place::Byte(self.size - self.left())
    }

    /// The line that was read last, in a text file.
    fn line(&self) -> Option<Place> {
        (self.encoding == Encoding::Ascii).then(|| self.lines.place())
    }

    /// The next element, number `i` of its kind.
    fn row(&mut self, element: &ElementDef, i: usize) -> Result<Row> {
        let parser = Parser::<Row>::new();
        let place = self.place();
        let result = match self.encoding {
            Encoding::Ascii => {
                let Some(line) = self.lines.next()? else {
                    return Err(ends_early(self.lines.place(), element, i));
                };
                let text = str::from_utf8(line).unwrap_or("not UTF-8");
                return parser.read_ascii_element(text, element).map_err(|_| {
                    FileError::new(
                        self.lines.place(),
                        format!(
                            "{} is not what the header says of a {}",
                            excerpt(line),
                            element.name
                        ),
                        "finite numbers of the types in the header, all of an element on one line",
                    )
                });
            }
            Encoding::BinaryLittleEndian => {
                parser.read_little_endian_element(&mut self.rest, element)
            }
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.rest, element),
        };
        result.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => ends_early(place, element, i),
            _ => FileError::new(
                place,
                format!("{} {i} is not what the header says", element.name),
                "lists with a length of 0 or more, of the types in the header",
            ),
        })
    }
}

fn ends_early(place: Place, element: &ElementDef, i: usize) -> FileError {
    let (name, count) = (&element.name, element.count);
    FileError::new(
        place,
        format!("the file ends in {name} {i} of the {count} that it claims"),
        "as many as it claims",
    )
}

fn least_bytes(property: &PropertyType) -> usize {
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = property;
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// What is kept of an element.
struct Row {
    position: [f64; 3],
    /// None if the list's numbers are not whole or negative.
    corners: Option<Vec<u32>>,
}

impl Row {
    fn corners(self, place: Place) -> Result<Vec<u32>> {
        self.corners.ok_or_else(|| {
            let found = "a face with a corner that is negative or not whole";
            FileError::new(place, found, "numbers of vertices, from 0")
        })
    }
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self {
            position: [0.0; 3],
            corners: Some(Vec::new()),
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match name {
            "x" => self.position[0] = scalar(&property),
            "y" => self.position[1] = scalar(&property),
            "z" => self.position[2] = scalar(&property),
            _ if CORNERS.contains(&name) => self.corners = property.to_u32_list(),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

fn scalar(property: &Property) -> f64 {
    match *property {
        Property::Double(value) => value,
        Property::Int(value) => f64::from(value),
        Property::UInt(value) => f64::from(value),
        // Exact: the other types are no wider than f32's digits.
        ref other => other.to_f32_lossy().map_or(f64::NAN, f64::from),
    }
}
