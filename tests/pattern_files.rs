//! Pattern files: read and written without loss, refused with the place and the name of what is wrong.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use striae::brdf::Metal;
use striae::files::pattern::{
    BrdfEntry, CurveKind, GeneratorEntry, HardnessEntry, KeyEntry, LayerEntry, MaterialEntry,
    MaterialName, ReadingEntry, Scale, ScratchEntry, ToolEntry, ToolName, Version,
};
use striae::files::{PatternFile, read_pattern};
use striae::formation::{DepthLaw, PileUpLaw};
use striae::pattern::{Amount, Distribution, Held, Style};

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
    let files: Vec<_> = (0..40).map(|_| document(&mut random)).collect();
    let text: String = files.iter().map(|file| file.to_json().unwrap()).collect();
    let named = text.split('"').skip(1).step_by(2);
    for name in named.filter(|name| !name.starts_with('~')) {
        let listed = page.contains(&format!("`{name}`"))
            || page.contains(&format!("`\"{name}\"`"))
            || page.contains(&format!("\"{name}\": "));
        assert!(listed, "{name} is not in docs/pattern-file.md");
    }
}

fn pick<T: Clone>(random: &mut StdRng, from: &[T]) -> T {
    from[random.random_range(0..from.len())].clone()
}

/// Any finite number: tiny, huge, negative, without end in binary.
fn number(random: &mut StdRng) -> f64 {
    match random.random_range(0..4) {
        0 => random.random_range(-1.0..1.0),
        1 => f64::from(random.random_range(-1000..1000)),
        2 => pick(
            random,
            &[
                0.0,
                -0.0,
                5e-324,
                f64::MAX,
                f64::MIN_POSITIVE,
                0.1,
                1.0 / 3.0,
            ],
        ),
        _ => Some(f64::from_bits(random.random()))
            .filter(|value| value.is_finite())
            .unwrap_or(1e300),
    }
}

fn single(random: &mut StdRng) -> f32 {
    Some(f32::from_bits(random.random()))
        .filter(|value| value.is_finite())
        .unwrap_or(0.1)
}

fn maybe<T>(random: &mut StdRng, value: impl FnOnce(&mut StdRng) -> T) -> Option<T> {
    random.random_bool(0.5).then(|| value(random))
}

fn some<T>(random: &mut StdRng, value: impl Fn(&mut StdRng) -> T) -> Vec<T> {
    (0..random.random_range(0..5))
        .map(|_| value(random))
        .collect()
}

fn name(random: &mut StdRng) -> String {
    let names = ["~nail", "~", "~über/..\\ \u{7}", "~a.b[3]", "~🔨"];
    pick(random, &names).to_owned()
}

fn pair(random: &mut StdRng) -> [f64; 2] {
    [number(random), number(random)]
}

fn rgb(random: &mut StdRng) -> [f32; 3] {
    [single(random), single(random), single(random)]
}

fn brdf(random: &mut StdRng) -> BrdfEntry {
    let alpha = single(random);
    match random.random_range(0..4) {
        0 => BrdfEntry::Lambert {
            albedo: rgb(random),
        },
        1 => BrdfEntry::Schlick {
            alpha,
            f0: rgb(random),
        },
        2 => BrdfEntry::Conductor {
            alpha,
            eta: rgb(random),
            k: rgb(random),
        },
        _ => BrdfEntry::Metal {
            name: pick(random, &Metal::ALL),
            alpha,
        },
    }
}

fn material(random: &mut StdRng) -> MaterialEntry {
    let tan_beta = number(random);
    let laws = [
        PileUpLaw::Bosch2004,
        PileUpLaw::OuterSlope { tan_beta },
        PileUpLaw::None,
    ];
    MaterialEntry {
        like: maybe(random, |random| pick(random, MaterialName::ALL)),
        hardness_hv: maybe(random, number),
        pile_up: maybe(random, |random| pick(random, &laws)),
        pile_up_fraction: maybe(random, number),
        elastic_recovery: maybe(random, number),
        surface: maybe(random, brdf),
        scratched: maybe(random, brdf),
        layers: maybe(random, |random| {
            some(random, |random| LayerEntry {
                thickness_mm: number(random),
                scratched: brdf(random),
            })
        }),
    }
}

fn tool(random: &mut StdRng) -> ToolEntry {
    let (height_mm, angle_deg) = (number(random), number(random));
    match random.random_range(0..6) {
        0 => ToolEntry::Preset(pick(random, ToolName::ALL)),
        1 => ToolEntry::SpheroCone {
            half_angle_deg: angle_deg,
            tip_radius_mm: number(random),
            height_mm,
        },
        2 => ToolEntry::Pyramid {
            sides: random.random(),
            angle_deg,
            height_mm,
        },
        3 => ToolEntry::Wedge {
            width_mm: number(random),
            angle_deg,
            height_mm,
        },
        4 => ToolEntry::Profile {
            points_mm: some(random, pair),
        },
        _ => ToolEntry::Mesh {
            file: name(random),
            mm_per_unit: number(random),
        },
    }
}

fn scratch(random: &mut StdRng) -> ScratchEntry {
    let laws = [
        DepthLaw::Bosch2004,
        DepthLaw::ScratchHardness,
        DepthLaw::Stated,
    ];
    ScratchEntry {
        tool: name(random),
        material: maybe(random, name),
        depth_law: pick(random, &laws),
        held: pick(random, &[Held::ToPath, Held::ToSurface]),
        curve: pick(random, &[CurveKind::Polyline, CurveKind::CubicBezier]),
        points_uv: some(random, pair),
        keys: some(random, |random| KeyEntry {
            at: number(random),
            force_kgf: number(random),
            depth_mm: number(random),
            spin_deg: number(random),
            tilt_deg: number(random),
            azimuth_deg: number(random),
        }),
    }
}

fn distribution(random: &mut StdRng) -> Distribution {
    let ([from, to], [middle, deviation]) = (pair(random), pair(random));
    let all = [
        Distribution::Uniform { from, to },
        Distribution::Normal {
            from,
            to,
            middle,
            deviation,
        },
        Distribution::LogNormal {
            from,
            to,
            middle,
            deviation,
        },
        Distribution::PowerLaw {
            from,
            to,
            exponent: middle,
        },
        Distribution::Exponential {
            from,
            to,
            decay: middle,
        },
    ];
    pick(random, &all)
}

fn generator(random: &mut StdRng) -> GeneratorEntry {
    let amounts = [
        Amount::Count(random.random()),
        Amount::PerCm2(number(random)),
    ];
    let style = pick(random, &Style::ALL);
    GeneratorEntry {
        material: maybe(random, name),
        amount: maybe(random, |random| pick(random, &amounts)),
        area_uv: maybe(random, |random| [pair(random), pair(random)]),
        length_mm: maybe(random, distribution),
        force_kgf: maybe(random, distribution),
        depth_mm: maybe(random, distribution),
        direction_deg: maybe(random, number),
        spread_deg: maybe(random, number),
        turn_deg: maybe(random, number),
        turn_spread_deg: maybe(random, number),
        wander_deg: maybe(random, number),
        curves: maybe(random, Rng::random),
        taper: maybe(random, pair),
        spin_deg: maybe(random, number),
        spin_spread_deg: maybe(random, number),
        tilt_deg: maybe(random, number),
        azimuth_deg: maybe(random, number),
        held: maybe(random, |_| Held::ToSurface),
        depth_law: maybe(random, |_| DepthLaw::ScratchHardness),
        ..GeneratorEntry::new(&name(random), style, random.random())
    }
}

/// A document of anything that the form allows, sensible or not.
fn document(random: &mut StdRng) -> PatternFile {
    let readings = |random: &mut StdRng| {
        HardnessEntry::Readings(some(random, |random| ReadingEntry {
            uv: pair(random),
            hardness_hv: number(random),
        }))
    };
    let image = |random: &mut StdRng| HardnessEntry::Image {
        file: name(random),
        range_hv: pair(random),
    };
    let named = |random: &mut StdRng| some(random, |random| (name(random), material(random)));
    PatternFile {
        striae_pattern: Version,
        scale: Scale {
            mm_per_scene_unit: number(random),
            units_per_uv: pair(random),
        },
        surface: name(random),
        hardness: if random.random_bool(0.3) {
            maybe(random, readings)
        } else {
            maybe(random, image)
        },
        materials: BTreeMap::from_iter(named(random)),
        tools: BTreeMap::from_iter(some(random, |random| (name(random), tool(random)))),
        scratches: some(random, scratch),
        generators: some(random, generator),
    }
}

/// Any document comes back equal, and is written the same again: no digit is lost.
#[test]
fn random_documents_come_back() {
    let mut random = StdRng::seed_from_u64(2);
    for i in 0..500 {
        let file = document(&mut random);
        let text = file.to_json().unwrap();
        let back = PatternFile::parse(&text).unwrap();
        assert_eq!(back, file, "document {i}: {text}");
        // Equal numbers may differ in the sign of 0: their texts may not.
        assert_eq!(back.to_json().unwrap(), text, "document {i}");
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

/// The refusal of `SMALL` with `from` replaced by `to`.
fn refused(from: &str, to: &str) -> String {
    assert!(SMALL.contains(from), "{from}");
    let error = PatternFile::parse(&SMALL.replace(from, to)).unwrap_err();
    error.to_string()
}

/// Wrong types, unknown and missing fields, other versions and broken numbers are told by line, column and name.
#[test]
fn form_is_checked() {
    for (from, to, place, field, rest) in [
        (
            "0.1",
            "\"NaN\"",
            "line 8, column ",
            "scratches[0].points_uv[0][0]: ",
            "accepted: a number",
        ),
        (
            "0.1",
            "null",
            "line 8, ",
            "scratches[0].points_uv[0][0]: ",
            "accepted: a number",
        ),
        (
            "[0.1, 0.5]",
            "[0.1, 0.5, 0.0]",
            "line 8, ",
            "scratches[0].points_uv[0]",
            "accepted: ",
        ),
        (
            "[0.1, 0.5]",
            "[0.1]",
            "line 8, ",
            "scratches[0].points_uv[0]",
            "accepted: an array of length 2",
        ),
        (
            "force_kgf",
            "force",
            "line 8, ",
            "scratches[0].keys[0].force: unknown field",
            "accepted: one of `at`, `force_kgf`",
        ),
        (
            "\"at\": 0.0, ",
            "",
            "line 8, ",
            "scratches[0].keys[0]: missing field `at`",
            "accepted: ",
        ),
        (
            "\"tool\": \"nail\"",
            "\"tool\": 3",
            "line 8, column 15: ",
            "scratches[0].tool: invalid type: integer `3`",
            "accepted: a string",
        ),
        (
            "\"preset\": \"nail\"",
            "\"preset\": \"nial\"",
            "line 6, ",
            "tools.nail.preset: unknown variant `nial`",
            "`abrasive_grain`",
        ),
        ("preset", "shape", "line 6, ", "tools.nail", "`sphero_cone`"),
        (
            "titanium",
            "unobtainium",
            "line 5, ",
            "materials.plate.like: unknown variant `unobtainium`",
            "`ceramic`",
        ),
        (
            "\"surface\": \"plate\",",
            "",
            "line 10, ",
            "missing field `surface`",
            "accepted: ",
        ),
        (
            "\"striae_pattern\": 1,",
            "",
            "line 10, ",
            "missing field `striae_pattern`",
            "accepted: ",
        ),
        (
            "\"striae_pattern\": 1",
            "\"striae_pattern\": 2",
            "line 2, ",
            "striae_pattern: version 2",
            "accepted: 1",
        ),
        (
            "\"striae_pattern\": 1",
            "\"striae_pattern\": \"1\"",
            "line 2, ",
            "striae_pattern: invalid type",
            "accepted: a whole number",
        ),
        (
            "60.0",
            "1e999",
            "line 3, ",
            "scale.units_per_uv[0]: number out of range",
            "accepted: ",
        ),
        (
            "60.0",
            "NaN",
            "line 3, ",
            "scale.units_per_uv[0]: ",
            "accepted: ",
        ),
        ("60.0", "06", "line 3, ", "invalid number", "accepted: "),
        (
            "\"nail\": {",
            "\"nail\": { \"preset\": \"key\" }, \"nail\": {",
            "line 6, ",
            "tools: the name \"nail\" twice",
            "accepted: it once",
        ),
        (
            "\"tool\": \"nail\"",
            "\"tool\": \"nail\", \"tool\": \"nail\"",
            "line 8, ",
            "duplicate field `tool`",
            "accepted: ",
        ),
        (
            "\"surface\"",
            "\"color\": 1, \"surface\"",
            "line 4, ",
            "color: unknown field `color`",
            "`surface`",
        ),
    ] {
        let message = refused(from, to);
        assert!(
            message.starts_with(place) && message.contains(field) && message.contains(rest),
            "{from} as {to}: {message}"
        );
    }
}

/// A file that is cut short, no JSON, empty or followed by more is refused wherever that happens.
#[test]
fn broken_files_are_refused() {
    for length in 0..SMALL.len() {
        let error = PatternFile::parse(&SMALL[..length])
            .unwrap_err()
            .to_string();
        assert!(
            error.starts_with("line ") && error.contains("accepted"),
            "{error}"
        );
    }
    let trailing = PatternFile::parse(&format!("{SMALL} 7"))
        .unwrap_err()
        .to_string();
    assert!(
        trailing.contains("line 10, column 3: trailing"),
        "{trailing}"
    );
    let foreign = PatternFile::parse("# Tools").unwrap_err().to_string();
    assert!(
        foreign.contains("line 1, column 1: expected value"),
        "{foreign}"
    );
    let deep = PatternFile::parse(&"[".repeat(100_000))
        .unwrap_err()
        .to_string();
    assert!(deep.contains("accepted"), "{deep}");
    let long = refused("nail", &"n".repeat(1_000_000));
    assert!(long.len() < 600, "{} characters", long.len());
    let folder = Folder::new("broken");
    let path = folder.0.join("latin.json");
    std::fs::write(&path, b"{ \"striae_pattern\": 1, \"surface\": \"\xe9\" }").unwrap();
    let latin = PatternFile::read(&path).unwrap_err().to_string();
    assert!(
        latin.contains("latin.json: line 1, column ") && latin.contains("accepted"),
        "{latin}"
    );
    let nowhere = PatternFile::read(Path::new("no/such.json"))
        .unwrap_err()
        .to_string();
    assert!(
        nowhere.starts_with("no/such.json: is not there"),
        "{nowhere}"
    );
}

/// Values out of range and names that nothing has are told by the part of the document.
#[test]
fn values_are_checked() {
    for (from, to, text) in [
        (
            "\"tool\": \"nail\"",
            "\"tool\": \"nial\"",
            "scratches[0]: tool is \"nial\"; accepted: a name in tools: \"nail\"",
        ),
        (
            "\"surface\": \"plate\"",
            "\"surface\": \"sheet\"",
            "surface is \"sheet\"; accepted: a name in materials: \"plate\"",
        ),
        (
            "\"tool\": \"nail\"",
            "\"tool\": \"nail\", \"material\": \"x\"",
            "scratches[0]: material is \"x\"; accepted: ",
        ),
        (
            "\"force_kgf\": 2.0",
            "\"force_kgf\": -2.0",
            "scratches[0]: keys[0].force_kgf is -2; accepted: ",
        ),
        (
            "[0.9, 0.5]",
            "[0.9, 1e300]",
            "scratches[0]: points_uv[1] is 1",
        ),
        ("[60.0,", "[0.0,", "scale: units_per_uv is 0; accepted: "),
        (
            "\"like\": \"titanium\"",
            "\"like\": \"titanium\", \"hardness_hv\": -3",
            "materials.plate: hardness_hv is -3; accepted: ",
        ),
        (
            "\"like\": \"titanium\"",
            "\"hardness_hv\": 3",
            "materials.plate: surface is missing; accepted: ",
        ),
        (
            "\"preset\": \"nail\"",
            "\"wedge\": { \"width_mm\": 0, \"angle_deg\": 60, \"height_mm\": 1 }",
            "tools.nail: width_mm is 0; accepted: ",
        ),
        (
            "\"preset\": \"nail\"",
            "\"mesh\": { \"file\": \"no.stl\", \"mm_per_unit\": 1 }",
            "tools.nail: here/no.stl: is not there; accepted: ",
        ),
        (
            "\"scratches\"",
            "\"generators\": [{ \"tool\": \"nail\", \"seed\": 1, \"curves\": 99 }], \"scratches\"",
            "generators[0]: curves is 99; accepted: ",
        ),
        (
            "\"materials\"",
            "\"hardness\": { \"readings\": [] }, \"materials\"",
            "hardness: reading_count is 0; accepted: ",
        ),
    ] {
        assert!(SMALL.contains(from), "{from}");
        let file = PatternFile::parse(&SMALL.replace(from, to)).unwrap();
        let message = file.builder(Path::new("here")).unwrap_err().to_string();
        assert!(message.starts_with(text), "{from} as {to}: {message}");
    }
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
