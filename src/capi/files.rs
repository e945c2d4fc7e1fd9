//! Files for C.

use super::handle::{array, borrowed, exclusive, make_shared};
use super::hardness::StriaeHardnessMap;
use super::host_brdf::StriaeHostBrdf;
use super::pattern::{StriaePattern, StriaePatternBuilder};
use super::relief_mesh::StriaeReliefMesh;
use super::status::{Refusal, StriaeStatus, guard_any};
use super::tool::StriaeTool;
use crate::error::{Error, Result};
use crate::files::{FileError, read_hardness, read_pattern, read_tool};
use crate::pattern::Pattern;
use core::ffi::{CStr, c_char};
use std::path::Path;

impl Refusal for FileError {
    fn status(&self) -> StriaeStatus {
        match self.argument() {
            Some(_) => StriaeStatus::InvalidArgument,
            None => StriaeStatus::File,
        }
    }
}

/// Makes a tool from a 3D model: OBJ, STL (text or binary) or PLY (text or binary), by the end of the file's name.
///
/// z points up, the tip down; polygons become fans of triangles, and the mesh is then what striae_tool_mesh() takes.
/// At most 1 GiB. A file that is missing, broken, empty, cut short, too large, holds a number that is not finite or
/// claims more than it contains is answered with STRIAE_STATUS_FILE; striae_last_error() then names the file, the
/// line (from 1) or byte (from 0), what was found and what is accepted.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param mm_per_unit the file's unit, 1e-9 to 1e9: 1 for mm, 25.4 for inches, 1000 for metres
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_load(
    path: *const c_char,
    mm_per_unit: f64,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    let make = || {
        // SAFETY: NULL or NUL-terminated, as the header asks.
        let path = unsafe { path_from("path", path) }?;
        read_tool(path, mm_per_unit).map(StriaeTool)
    };
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard_any(|| unsafe { make_shared::<_, FileError>("tool", tool, make) })
}

/// Makes a hardness map from an image over u and v from 0 to 1, its top row at v = 1: PNG or EXR.
///
/// Of a PNG the first channel counts, 0 to its largest value meaning 0 to 1; of an EXR the channel Y, else R, else the
/// first. At most 2^26 texels. A file that is missing, neither, broken or too large is answered with
/// STRIAE_STATUS_FILE; striae_last_error() then names the file, what was found and what is accepted.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param from_hv hardness that a value of 0 means, 0.01 to 20000
/// @param to_hv hardness that a value of 1 means, 0.01 to 20000; every texel must lead into that range
/// @param map receives a handle to release with striae_hardness_map_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_hardness_map_load(
    path: *const c_char,
    from_hv: f64,
    to_hv: f64,
    map: *mut *mut StriaeHardnessMap,
) -> StriaeStatus {
    let make = || {
        // SAFETY: NULL or NUL-terminated, as the header asks.
        let path = unsafe { path_from("path", path) }?;
        read_hardness(path, [from_hv, to_hv]).map(StriaeHardnessMap)
    };
    // SAFETY: `map` is NULL or writable, as the header asks.
    guard_any(|| unsafe { make_shared::<_, FileError>("map", map, make) })
}

/// Begins a pattern with all that a pattern file holds: surface, scratches and generators. JSON; its form is described in
/// docs/pattern-file.md. Files that it names are looked for from its own folder.
///
/// A file that is missing, broken or of another version, that names what it does not hold, or in which a value is out of
/// its range is answered with STRIAE_STATUS_FILE; striae_last_error() then names the file, the line, column and field or the
/// scratch, what was found and what is accepted.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param builder receives a builder to add more to, and to free with striae_pattern_builder_free(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_load(
    path: *const c_char,
    builder: *mut *mut StriaePatternBuilder,
) -> StriaeStatus {
    guard_any(|| {
        // SAFETY: NULL or writable, as the header asks.
        let out = unsafe { exclusive("builder", builder)? };
        *out = core::ptr::null_mut();
        // SAFETY: NULL or NUL-terminated, as the header asks.
        let path = unsafe { path_from("path", path)? };
        *out = Box::into_raw(Box::new(StriaePatternBuilder(read_pattern(path)?)));
        Ok::<(), FileError>(())
    })
}

/// Saves a built pattern to be opened again by striae_pattern_open(), on machines of the same byte order and by the same
/// version of the library: a cache, no file to keep. It takes as much room as the pattern's memory. It is written beside
/// and takes the place of an older one all at once; two threads must not save to one path at once, processes may.
///
/// Where it cannot be written the answer is STRIAE_STATUS_FILE, and an older file stays.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param pattern the pattern
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_save(
    pattern: *const StriaePattern,
    path: *const c_char,
) -> StriaeStatus {
    guard_any(|| {
        // SAFETY: NULL or valid, as the header asks.
        let (pattern, path) = unsafe { (borrowed("pattern", pattern)?, path_from("path", path)?) };
        pattern.0.save_cache(path)
    })
}

/// Opens a saved pattern where it lies: what it holds is read when it is needed, so that opening takes no time however
/// large it is, and processes that open one file share its memory. Shading may then have to wait for the disk. Until the
/// pattern is freed the file must not be written to or cut short, or the process may end; putting another one in its place,
/// as striae_pattern_save() does, is fine.
///
/// A file that is missing, no saved pattern, of another version or byte order, cut short or damaged is answered with
/// STRIAE_STATUS_FILE. With `verify` 0 that is the header and all small arrays; a file whose large arrays are damaged opens,
/// and is safe to shade, but shows something else than what was saved.
///
/// So is one that has base BRDFs of the host's own, which no file can hold: striae_pattern_open_with() takes them anew.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param verify 1: check every byte, which takes as long as reading the file; 0: check what takes no time; nothing else
/// @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_open(
    path: *const c_char,
    verify: u32,
    pattern: *mut *mut StriaePattern,
) -> StriaeStatus {
    // SAFETY: as the header asks.
    unsafe { striae_pattern_open_with(path, verify, core::ptr::null(), 0, pattern) }
}

/// As striae_pattern_open(), for a pattern that has base BRDFs of the host's own.
///
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param verify 1: check every byte, which takes as long as reading the file; 0: check what takes no time; nothing else
/// @param hosts tables to reflect by, each that the pattern was built with once: the surface's, then those of its scratches
///     in the order in which they were added (in each material that of the bulk, then the layers' from the surface down; the
///     surface's own material first). The tables are copied
/// @param host_count how many: STRIAE_STATUS_FILE if the file has more or fewer, and the text says how many it has
/// @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_open_with(
    path: *const c_char,
    verify: u32,
    hosts: *const StriaeHostBrdf,
    host_count: usize,
    pattern: *mut *mut StriaePattern,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid, as the header asks.
        let (path, hosts) = unsafe {
            (
                path_from("path", path)?,
                array(["hosts", "host_count"], hosts, host_count)?,
            )
        };
        match verify {
            0 => {}
            1 => Pattern::verify_cache(path)?,
            other => return Err(Error::number("verify", f64::from(other), "0 or 1").into()),
        }
        let known = |(i, host): (usize, &StriaeHostBrdf)| {
            host.known().map_err(|error| error.within("hosts", i))
        };
        let hosts = hosts.iter().enumerate().map(known);
        Pattern::open_cache_with(path, &hosts.collect::<Result<Vec<_>>>()?).map(StriaePattern)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard_any(|| unsafe { make_shared::<_, FileError>("pattern", pattern, make) })
}

/// Writes a mesh to a file, mm: Wavefront OBJ or PLY, by the end of the file's name.
///
/// An OBJ has a group for each scratch (scratch_0 on, surface) and names a material for each base BRDF (brdf_0 on). A PLY
/// (binary, little-endian, coordinates in double precision) has both numbers with each face: scratch, -1 on the unscratched
/// surface, and brdf. A file that cannot be written, and a name that ends otherwise, are answered with STRIAE_STATUS_FILE.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param mesh the mesh
/// @param path the file's path, ending in .obj or .ply, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_relief_mesh_write(
    mesh: *const StriaeReliefMesh,
    path: *const c_char,
) -> StriaeStatus {
    guard_any(|| {
        // SAFETY: NULL or valid, as the header asks.
        let (mesh, path) = unsafe { (borrowed("mesh", mesh)?, path_from("path", path)?) };
        mesh.0.write(path)
    })
}

/// # Safety
/// `pointer` is NULL or points to a NUL-terminated text that lives, unchanged, as long as the call.
pub(super) unsafe fn path_from<'a>(name: &'static str, pointer: *const c_char) -> Result<&'a Path> {
    if pointer.is_null() {
        return Err(Error::text(name, "NULL", "a file's path"));
    }
    // SAFETY: not NULL; the rest as promised by the caller.
    let text = unsafe { CStr::from_ptr(pointer) };
    if text.is_empty() {
        return Err(Error::text(name, "empty", "a file's path"));
    }
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        Ok(Path::new(std::ffi::OsStr::from_bytes(text.to_bytes())))
    }
    #[cfg(not(unix))]
    text.to_str()
        .map(Path::new)
        .map_err(|_| Error::text(name, "not UTF-8", "a file's path in UTF-8"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::{striae_last_error, striae_tool_release};
    use core::ptr::null_mut;

    /// Status, text and handle of a load.
    fn load(path: Option<&CStr>, mm_per_unit: f64) -> (StriaeStatus, String, bool) {
        let mut tool = core::ptr::dangling_mut();
        let path = path.map_or(core::ptr::null(), CStr::as_ptr);
        // SAFETY: a NUL-terminated path or NULL, a writable handle; the text lives until the next failure.
        unsafe {
            let status = striae_tool_load(path, mm_per_unit, &mut tool);
            let text = CStr::from_ptr(striae_last_error());
            let made = !tool.is_null();
            striae_tool_release(tool);
            (status, text.to_string_lossy().into_owned(), made)
        }
    }

    /// Arguments are told apart from files, and nothing is made.
    #[test]
    fn refusals() {
        let (status, text, made) = load(None, 1.0);
        assert_eq!((status, made), (StriaeStatus::InvalidArgument, false));
        assert!(text.starts_with("path is NULL"), "{text}");
        let (status, text, made) = load(Some(c""), 1.0);
        assert_eq!((status, made), (StriaeStatus::InvalidArgument, false));
        assert!(text.starts_with("path is empty"), "{text}");
        let (status, text, made) = load(Some(c"there/is/no.stl"), 0.0);
        assert_eq!((status, made), (StriaeStatus::InvalidArgument, false));
        assert!(text.starts_with("mm_per_unit is 0"), "{text}");
        let (status, text, made) = load(Some(c"there/is/no.stl"), 1.0);
        assert_eq!((status, made), (StriaeStatus::File, false));
        assert!(text.starts_with("there/is/no.stl: is not there"), "{text}");
        // SAFETY: NULL for the handle is refused.
        let status = unsafe { striae_tool_load(c"a.stl".as_ptr(), 1.0, null_mut()) };
        assert_eq!(status, StriaeStatus::InvalidArgument);
    }

    /// A file becomes a handle, through a path that is not UTF-8.
    #[cfg(unix)]
    #[test]
    fn any_path_loads() {
        use std::os::unix::ffi::OsStrExt;
        let mut path = std::env::temp_dir().into_os_string().as_bytes().to_vec();
        path.extend(format!("/striae-{}-", std::process::id()).bytes());
        path.extend(b"\xe9.obj\0");
        let text = CStr::from_bytes_with_nul(&path).unwrap();
        let file = Path::new(std::ffi::OsStr::from_bytes(text.to_bytes()));
        std::fs::write(file, "v 0 0 0\nv 1 0 1\nv 0 1 1\nf 1 2 3\n").unwrap();
        let outcome = load(Some(text), 1.0);
        std::fs::remove_file(file).unwrap();
        assert_eq!(
            (outcome.0, outcome.2),
            (StriaeStatus::Ok, true),
            "{}",
            outcome.1
        );
    }
}
