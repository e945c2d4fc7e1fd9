//! A file's bytes where they lie: the system reads what is looked at, when it is looked at.

use memmap2::Mmap;
use std::fs::File;
use std::io;

/// A file as memory, read-only.
#[expect(
    unsafe_code,
    reason = "the one thing that no safe function of any library does: a file may be changed by others while it is mapped"
)]
pub(super) fn map(file: &File) -> io::Result<Mmap> {
    // SAFETY: the mapping is private to readers that take whatever bytes they find, at any time, for plain numbers (all
    // bits are valid) and look at each index before they use it. Saving puts a new file in the old one's place instead
    // of writing into it, so that a file changes or shrinks in use only by other programs' hands; the documentation of
    // opening forbids that.
    unsafe { Mmap::map(file) }
}
