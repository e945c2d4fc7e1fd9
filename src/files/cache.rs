//! Built patterns saved as they lie in memory, to be opened again without being built.
//!
//! A header (magic, byte order, version, length, table of arrays, the pattern's numbers, checksum), then the arrays, each
//! from a multiple of 64 bytes on, in the byte order of the machine. Each byte counts for exactly one checksum (CRC-32).

use super::error::{FileError, Place, Result};
use super::map::map;
use super::read::unreadable;
use crate::brdf::Hosted;
use crate::lanes;
use crate::pattern::{FACTS, Pattern, SECTIONS, Section, Sections};
use bytemuck::{Pod, Zeroable, bytes_of, cast_slice, pod_read_unaligned};
use core::ops::Range;
use memmap2::Mmap;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::Arc;

/// The line ends tell files that were taken for text on their way.
const MAGIC: [u8; 8] = *b"STRIAE\r\n";

/// Changes with the meaning of any byte.
const VERSION: u32 = 6;

const BYTE_ORDER: u32 = 0x0102_0304;

/// Arrays begin at multiples of this.
const ALIGNMENT: usize = 64;

/// Arrays of so many bytes at most are checked whenever a file is opened: that takes no time.
const SMALL: usize = 1 << 16;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Head {
    magic: [u8; 8],
    byte_order: u32,
    version: u32,
    file_bytes: u64,
    section_count: u32,
    facts_bytes: u32,
    /// Of the head with 0 in this place, the table and the facts.
    checksum: u32,
    padding: u32,
}

/// Where an array lies.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
struct Entry {
    first: u64,
    bytes: u64,
    element_bytes: u32,
    /// Of the array and of the zeros up to the next one.
    checksum: u32,
}

const TABLE: Range<usize> = size_of::<Head>()..size_of::<Head>() + SECTIONS * size_of::<Entry>();
const HEADER: usize = TABLE.end + FACTS;

impl Pattern {
    /// Saves the pattern to be opened again by [`Self::open_cache`], on machines of the same byte order and by the same
    /// version of the library: a cache, no file to keep. It takes as much room as the pattern's memory, and is the same
    /// to the byte whenever the same pattern is saved.
    ///
    /// The file takes the place of an older one all at once; whoever has that one open keeps it.
    pub fn save_cache(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let mut part = path.as_os_str().to_owned();
        part.push(format!(".{}.part", std::process::id()));
        let part = Path::new(&part);
        let saved = self.write(part).and_then(|()| fs::rename(part, path));
        saved.map_err(|error| {
            // What is left of it is of no use; an error in removing it says no more than the first one.
            let _ = fs::remove_file(part);
            let found = format!("cannot be written ({error})");
            FileError::new(Place::Whole, found, "a place that may be written to").in_file(path)
        })
    }

    /// Opens a saved pattern where it lies: its arrays are read when they are needed, so that opening takes no time
    /// however large it is, and processes that open one file share its memory.
    ///
    /// Checked are the header, what it says of the file, and small arrays. A file whose large arrays are damaged opens,
    /// and is safe to shade, but shows something else than what was saved: [`Self::verify_cache`] tells. The
    /// file must not be written to while it is open (putting another one in its place is fine).
    ///
    /// Errors: no file, not a saved pattern, one of another version, byte order or build, cut short, or damaged; or one
    /// that has base BRDFs of the host's own, which are code, and no file's: [`Self::open_cache_with`].
    pub fn open_cache(path: impl AsRef<Path>) -> Result<Self> {
        Self::open_cache_with(path, &[])
    }

    /// The same for a pattern that has base BRDFs of the host's own: they are given anew, as many and in the same order as
    /// [`Self::hosted`] of the one that was saved.
    ///
    /// Errors: those of [`Self::open_cache`]; more of them or fewer than the pattern has.
    pub fn open_cache_with(path: impl AsRef<Path>, hosts: &[Hosted]) -> Result<Self> {
        let path = path.as_ref();
        // What the processor has is found out here, not while shading.
        lanes::level();
        let opened = || {
            let opened = open(path)?;
            opened.check_hosts(hosts)?;
            opened.pattern(hosts)
        };
        opened().map_err(|error| error.in_file(path))
    }

    /// Checks every byte of a saved pattern: as long as it takes to read it.
    ///
    /// Errors: those of [`Self::open_cache`], and any array that is not what was saved.
    pub fn verify_cache(path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let verify = || {
            let opened = open(path)?;
            opened.verify(usize::MAX)?;
            opened.pattern(&[]).map(|_| ())
        };
        verify().map_err(|error| error.in_file(path))
    }

    fn write(&self, path: &Path) -> io::Result<()> {
        let sections = self.sections();
        let mut out = BufWriter::new(File::create(path)?);
        out.write_all(&header(&sections, &self.facts()))?;
        let mut at = HEADER;
        for section in &sections {
            out.write_all(&ZEROS[..padding(at)])?;
            out.write_all(section.bytes)?;
            at += padding(at) + section.bytes.len();
        }
        out.write_all(&ZEROS[..padding(at)])?;
        out.into_inner()
            .map_err(io::IntoInnerError::into_error)?
            .sync_all()
    }
}

const ZEROS: [u8; ALIGNMENT] = [0; ALIGNMENT];

/// Bytes from here to where an array may begin.
fn padding(at: usize) -> usize {
    at.next_multiple_of(ALIGNMENT) - at
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

fn header(sections: &[Section<'_>; SECTIONS], facts: &[u8; FACTS]) -> Vec<u8> {
    let mut table = [Entry::default(); SECTIONS];
    let mut at = HEADER;
    for (entry, section) in table.iter_mut().zip(sections) {
        at += padding(at);
        let bytes = section.bytes.len();
        let mut checksum = crc32fast::Hasher::new();
        checksum.update(section.bytes);
        checksum.update(&ZEROS[..padding(bytes)]);
        *entry = Entry {
            first: at as u64,
            bytes: bytes as u64,
            element_bytes: number(section.element_bytes),
            checksum: checksum.finalize(),
        };
        at += bytes;
    }
    let mut head = Head {
        magic: MAGIC,
        byte_order: BYTE_ORDER,
        version: VERSION,
        file_bytes: (at + padding(at)) as u64,
        section_count: number(SECTIONS),
        facts_bytes: number(FACTS),
        checksum: 0,
        padding: 0,
    };
    let rest = [cast_slice(&table), facts.as_slice()].concat();
    head.checksum = header_checksum(head, &rest);
    [bytes_of(&head), &rest].concat()
}

fn header_checksum(head: Head, rest: &[u8]) -> u32 {
    let mut checksum = crc32fast::Hasher::new();
    checksum.update(bytes_of(&Head {
        checksum: 0,
        ..head
    }));
    checksum.update(rest);
    // What lies between the header and the first array is zeros.
    checksum.update(&ZEROS[..padding(HEADER)]);
    checksum.finalize()
}

/// A file whose header has been checked.
struct Opened {
    file: Arc<Mmap>,
    table: [Entry; SECTIONS],
}

fn open(path: &Path) -> Result<Opened> {
    let about = fs::metadata(path).map_err(unreadable)?;
    if !about.is_file() {
        return Err(FileError::new(Place::Whole, "is no file", "a file"));
    }
    let file = File::open(path).map_err(unreadable)?;
    let file = map(&file).map_err(unreadable)?;
    let table = check_header(&file)?;
    Ok(Opened {
        file: Arc::new(file),
        table,
    })
}

fn refused<T>(
    found: impl Into<std::borrow::Cow<'static, str>>,
    accepted: &'static str,
) -> Result<T> {
    Err(FileError::new(Place::Whole, found, accepted))
}

/// The table of arrays, if the header says of the file what is so.
fn check_header(file: &[u8]) -> Result<[Entry; SECTIONS]> {
    const WHOLE: &str = "a saved pattern as it was written";
    if !file.starts_with(&MAGIC) {
        return refused(
            "is no saved pattern",
            "a file that Pattern::save_cache wrote",
        );
    }
    let Some(head) = file.get(..size_of::<Head>()) else {
        return refused(format!("ends after {} bytes", file.len()), WHOLE);
    };
    let head: Head = pod_read_unaligned(head);
    if head.byte_order == BYTE_ORDER.swap_bytes() {
        return refused(
            "was saved on a machine of the other byte order",
            "a pattern saved on a machine like this one",
        );
    }
    if head.byte_order != BYTE_ORDER {
        return refused("has a damaged header", WHOLE);
    }
    if head.version != VERSION {
        return refused(format!("has version {}", head.version), "version 6");
    }
    if head.file_bytes != file.len() as u64 {
        let (stated, found) = (head.file_bytes, file.len());
        return refused(format!("holds {found} bytes and claims {stated}"), WHOLE);
    }
    let is_ours = head.section_count as usize == SECTIONS && head.facts_bytes as usize == FACTS;
    let rest = file.get(size_of::<Head>()..HEADER + padding(HEADER));
    let Some(rest) = rest.filter(|_| is_ours) else {
        return refused(
            format!("has {} arrays", head.section_count),
            "a pattern saved by this version of the library",
        );
    };
    let own = size_of::<Head>()..HEADER;
    let is_zero = rest[own.len()..].iter().all(|&byte| byte == 0);
    if head.padding != 0 || !is_zero || head.checksum != header_checksum(head, &rest[..own.len()]) {
        return refused("has a damaged header", WHOLE);
    }
    let table: [Entry; SECTIONS] = pod_read_unaligned(&file[TABLE]);
    if !follow(&table, file.len()) {
        return refused("has arrays that do not lie one after the other", WHOLE);
    }
    Ok(table)
}

/// Whether the arrays fill the file.
fn follow(table: &[Entry; SECTIONS], file_bytes: usize) -> bool {
    let mut at = HEADER as u64;
    for entry in table {
        at = at.next_multiple_of(ALIGNMENT as u64);
        if entry.first != at || entry.bytes > file_bytes as u64 {
            return false;
        }
        at += entry.bytes;
    }
    at.next_multiple_of(ALIGNMENT as u64) == file_bytes as u64
}

impl Opened {
    /// The block of numbers.
    fn facts(&self) -> &[u8] {
        &self.file[TABLE.end..HEADER]
    }

    fn check_hosts(&self, hosts: &[Hosted]) -> Result<()> {
        let own = Pattern::host_count(self.facts()).unwrap_or(0);
        if own as usize == hosts.len() {
            return Ok(());
        }
        let given = hosts.len();
        refused(
            format!("has {own} base BRDFs of the host's own, and {given} are given"),
            "as many as it has, in the order of the pattern that was saved",
        )
    }

    fn pattern(&self, hosts: &[Hosted]) -> Result<Pattern> {
        self.verify(SMALL)?;
        let facts = self.facts();
        let places = self.table.iter();
        let mut sections = Sections {
            file: &self.file,
            places: places.map(|entry| (entry.place(), entry.element_bytes as usize)),
        };
        match Pattern::of_sections(facts, &mut sections, hosts) {
            Some(pattern) => Ok(pattern),
            None => refused(
                "holds arrays that do not fit together",
                "a pattern saved by this version of the library",
            ),
        }
    }

    /// Checks arrays of so many bytes at most.
    fn verify(&self, most_bytes: usize) -> Result<()> {
        for (number, entry) in self.table.iter().enumerate() {
            let place = entry.place();
            if place.len() > most_bytes {
                continue;
            }
            let with_padding = place.start..place.end.next_multiple_of(ALIGNMENT);
            let bytes = self.file.get(with_padding).unwrap_or(&[]);
            if crc32fast::hash(bytes) != entry.checksum {
                return Err(FileError::new(
                    Place::Byte(place.start),
                    format!("array {number} is damaged"),
                    "a saved pattern as it was written",
                ));
            }
        }
        Ok(())
    }
}

impl Entry {
    fn place(&self) -> Range<usize> {
        let [first, bytes] = [self.first, self.bytes].map(|n| usize::try_from(n).unwrap_or(0));
        first..first.saturating_add(bytes)
    }
}
