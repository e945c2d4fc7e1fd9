//! A file's bytes, if it is a file and not too large.

use super::error::{FileError, Place, Result};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// Largest file that is read, bytes: 1 GiB.
const MOST_BYTES: u64 = 1 << 30;

/// A file's content. A folder, a pipe or a device is no file: opening one may block, reading one may never end.
pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    let refused = |found: &'static str, accepted: &'static str| {
        Err(FileError::new(Place::Whole, found, accepted))
    };
    let about = fs::metadata(path).map_err(unreadable)?;
    if about.is_dir() {
        return refused("is a folder", "a file");
    }
    if !about.is_file() {
        return refused("is a pipe or a device", "a file");
    }
    let too_large = |bytes: u64| {
        Err(FileError::new(
            Place::Whole,
            format!("holds {bytes} bytes"),
            format!("at most {MOST_BYTES}"),
        ))
    };
    if about.len() > MOST_BYTES {
        return too_large(about.len());
    }
    let file = File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    if bytes
        .try_reserve(usize::try_from(about.len()).unwrap_or(usize::MAX))
        .is_err()
    {
        return refused("is larger than the memory left", "a smaller file");
    }
    // A file may grow while it is read.
    file.take(MOST_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        return too_large(bytes.len() as u64);
    }
    Ok(bytes)
}

#[expect(clippy::needless_pass_by_value, reason = "the form that map_err wants")]
pub(super) fn unreadable(error: io::Error) -> FileError {
    let found = match error.kind() {
        io::ErrorKind::NotFound => "is not there".to_owned(),
        io::ErrorKind::PermissionDenied => "may not be read".to_owned(),
        _ => format!("cannot be read ({error})"),
    };
    FileError::new(Place::Whole, found, "a file that is there and may be read")
}
