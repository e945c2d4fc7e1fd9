//! Tools from files: the same pyramid in every format, and what is not a tool.

mod damaged;
mod pyramid;
mod refused;

use pyramid::*;
use std::fs;
use std::path::{Path, PathBuf};
use striae::brdf::Metal;
use striae::files::{MeshFormat, read_tool, tool_from_bytes};
use striae::formation::{CrossSection, Material, Orientation, Process, Tool};

/// A folder of this test's own, gone at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("striae-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, bytes).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn section(tool: &Tool) -> striae::Result<CrossSection> {
    let process = Process {
        force_kgf: 2.0,
        orientation: Orientation {
            spin_deg: 20.0,
            tilt_deg: 8.0,
            azimuth_deg: 130.0,
        },
        ..Default::default()
    };
    CrossSection::form(tool, &process, &Material::metal(Metal::Titanium))
}

/// Depth, width and area of what a tool leaves.
fn measures(tool: &Tool) -> [f64; 3] {
    let section = section(tool).unwrap();
    [
        section.depth_mm(),
        section.groove_width_mm(),
        section.groove_area_mm2(),
    ]
}

/// In every format, unit and spelling the pyramid leaves what the built-in one leaves.
#[test]
fn one_pyramid_in_every_format() {
    let folder = Folder::new("formats");
    let truth = measures(&Tool::pyramid(4, ANGLE_DEG, HEIGHT_MM).unwrap());
    for mm_per_unit in [1.0, 25.4, 1000.0] {
        for (name, bytes) in every_form(mm_per_unit) {
            let path = folder.file(name, &bytes);
            let tool = read_tool(&path, mm_per_unit).unwrap_or_else(|error| panic!("{error}"));
            for (ours, truth) in measures(&tool).into_iter().zip(truth) {
                let off = (ours / truth - 1.0).abs();
                assert!(off < 2e-5, "{name}, {mm_per_unit}: {ours} against {truth}");
            }
        }
    }
}

/// A file in another unit is another tool.
#[test]
fn the_unit_counts() {
    let bytes = stl_binary(1.0, "");
    let [mm, inch] = [1.0, 25.4].map(|unit| tool_from_bytes(&bytes, MeshFormat::Stl, unit));
    assert_ne!(mm.unwrap(), inch.unwrap(), "the unit has no effect");
    let error = tool_from_bytes(&bytes, MeshFormat::Stl, 0.0).unwrap_err();
    assert_eq!(error.argument(), Some("mm_per_unit"));
    assert!(error.to_string().starts_with("mm_per_unit is 0"), "{error}");
}

/// What the file system answers is said with the file's name.
#[test]
fn what_is_no_file() {
    let folder = Folder::new("no-file");
    let says = |path: &Path, expected: &str| {
        let message = read_tool(path, 1.0).unwrap_err().to_string();
        assert!(message.contains(expected), "{message:?} lacks {expected:?}");
    };
    says(
        &folder.0.join("none.stl"),
        "none.stl: is not there; accepted: ",
    );
    fs::create_dir(folder.0.join("folder.obj")).unwrap();
    says(
        &folder.0.join("folder.obj"),
        "folder.obj: is a folder; accepted: a file",
    );
    says(
        &folder.file("tool.3mf", b"PK"),
        "tool.3mf: a name that ends otherwise",
    );
    says(
        &folder.file("tool", b"PK"),
        "accepted: names that end in .obj, .stl or .ply",
    );
    says(&folder.file("empty.ply", b""), "empty.ply: holds no bytes");
    says(
        &folder.file("bad.obj", b"\nf 1"),
        "bad.obj: line 2: a face with 1 corners",
    );
    // A sparse file: it takes no room.
    let huge = folder.file("huge.stl", b"solid");
    let file = fs::OpenOptions::new().write(true).open(&huge).unwrap();
    file.set_len((1 << 30) + 1).unwrap();
    says(
        &huge,
        "huge.stl: holds 1073741825 bytes; accepted: at most 1073741824",
    );
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", folder.0.join("endless.stl")).unwrap();
        says(&folder.0.join("endless.stl"), "is a pipe or a device");
    }
}
