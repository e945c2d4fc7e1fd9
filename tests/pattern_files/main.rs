//! Pattern files: read and written without loss, refused with the place and the name of what is wrong.

mod random;
mod refused;

use rand::SeedableRng;
use rand::rngs::StdRng;
use std::path::{Path, PathBuf};
use striae::files::{PatternFile, read_pattern};

const SMALL: &str = r#"{
  "striae_pattern": 1,
  "scale": { "mm_per_scene_unit": 1.0, "units_per_uv": [60.0, 40.0] },
  "surface": "plate",
  "materials": { "plate": { "like": "titanium" } },
  "tools": { "nail": { "preset": "nail" } },
  "scratches": [
    { "tool": "nail", "points_uv": [[0.1, 0.5], [0.9, 0.5]], "keys": [{ "at": 0.0, "force_kgf": 2.0 }] }
  ]
}"#;

/// A folder of this test's own, gone with it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("striae-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The page's example is a pattern file, uses every kind of part, and comes back as it was.
#[test]
fn documented_example() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pattern-file.md");
    let page = std::fs::read_to_string(page).unwrap();
    let example = page.split("```json\n").nth(1).unwrap();
    let example = example.split("```").next().unwrap();
    let file = PatternFile::parse(example).unwrap();
    let written = file.to_json().unwrap();
    assert_eq!(PatternFile::parse(&written).unwrap(), file);
    // 60 mm x 40 mm: a hundredth of it at 400 on a cm², twelve, and two.
    let pattern = file.builder(Path::new("")).unwrap().build();
    assert_eq!(pattern.scratch_count(), 96 + 12 + 2);
}

/// The page lists every field and name that a file may hold.
#[test]
fn documented_names() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pattern-file.md");
    let page = std::fs::read_to_string(page).unwrap();
    let mut random = StdRng::seed_from_u64(1);
    let files: Vec<_> = (0..40).map(|_| random::document(&mut random)).collect();
    let text: String = files.iter().map(|file| file.to_json().unwrap()).collect();
    let named = text.split('"').skip(1).step_by(2);
    for name in named.filter(|name| !name.starts_with('~')) {
        let listed = page.contains(&format!("`{name}`"))
            || page.contains(&format!("`\"{name}\"`"))
            || page.contains(&format!("\"{name}\": "));
        assert!(listed, "{name} is not in docs/pattern-file.md");
    }
}

/// Files are written and read again, and hold one scratch's points in one line.
#[test]
fn files_come_back() {
    let folder = Folder::new("round");
    let path = folder.0.join("wear.striae.json");
    let file = PatternFile::parse(SMALL).unwrap();
    file.write(&path).unwrap();
    assert_eq!(PatternFile::read(&path).unwrap(), file);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(
        text.contains("\n      \"points_uv\": [[0.1, 0.5], [0.9, 0.5]],\n"),
        "{text}"
    );
    let marked = format!("\u{feff}{SMALL}");
    assert_eq!(
        PatternFile::parse(&marked).unwrap(),
        file,
        "byte order mark"
    );
    let nowhere = file
        .write(&folder.0.join("no/such/folder.json"))
        .unwrap_err();
    assert!(
        nowhere
            .to_string()
            .contains("folder.json: cannot be written"),
        "{nowhere}"
    );
}

/// What JSON has no word for is not written.
#[test]
fn not_a_number_is_not_written() {
    let mut file = PatternFile::parse(SMALL).unwrap();
    file.scratches[0].keys[0].at = f64::NAN;
    let error = file.to_json().unwrap_err().to_string();
    assert!(
        error.contains("scratches[0].keys[0].at") && error.contains("accepted: a number"),
        "{error}"
    );
}

/// Meshes are looked for from the pattern file's own folder, wherever the program runs.
#[test]
fn meshes_lie_beside_the_file() {
    let folder = Folder::new("meshes");
    std::fs::create_dir(folder.0.join("chips")).unwrap();
    let mesh =
        "v 0 0 0\nv 1 0 1\nv -1 0 1\nv 0 1 1\nv 0 -1 1\nf 1 2 4\nf 1 4 3\nf 1 3 5\nf 1 5 2\n";
    std::fs::write(folder.0.join("chips/chip.obj"), mesh).unwrap();
    let with_mesh = SMALL.replace(
        "\"preset\": \"nail\"",
        "\"mesh\": { \"file\": \"chips/chip.obj\", \"mm_per_unit\": 2.0 }",
    );
    let path = folder.0.join("chips.striae.json");
    std::fs::write(&path, &with_mesh).unwrap();
    assert_eq!(read_pattern(&path).unwrap().build().scratch_count(), 1);
    std::fs::write(&path, with_mesh.replace("chip.obj", "none.obj")).unwrap();
    let message = read_pattern(&path).unwrap_err().to_string();
    assert!(
        message.contains("chips.striae.json: tools.nail: ")
            && message.contains("none.obj: is not there"),
        "{message}"
    );
}

/// Every kind of curve that the page names can be built, and knots belong to one kind only.
#[test]
fn every_kind_of_curve() {
    let file = |curve: &str, rest: &str| {
        let square = "[[0, 0], [0.1, 0], [0.1, 0.1], [0, 0.1]]";
        let path = format!(r#""curve": "{curve}", {rest} "points_uv": {square}"#);
        let text = SMALL.replace(r#""points_uv": [[0.1, 0.5], [0.9, 0.5]]"#, &path);
        PatternFile::parse(&text).unwrap().builder(Path::new("."))
    };
    for (curve, rest) in [
        ("polyline", ""),
        ("polyline", r#""closed": true,"#),
        ("cubic_bezier", ""),
        ("catmull_rom", r#""closed": true,"#),
        ("b_spline", r#""closed": true,"#),
        ("b_spline", ""),
        (
            "non_uniform_b_spline",
            r#""knots": [0, 0, 0, 0, 1, 1, 1, 1],"#,
        ),
    ] {
        assert!(file(curve, rest).is_ok(), "{curve} {rest}");
    }
    let refused = file("b_spline", r#""knots": [0, 1],"#)
        .unwrap_err()
        .to_string();
    assert!(refused.contains("knots"), "{refused}");
}
