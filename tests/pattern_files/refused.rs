//! What is no pattern file, and what no pattern can be made of: told by place and name.

use super::{Folder, SMALL};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::path::Path;
use striae::files::PatternFile;

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

/// What bytes are replaced by.
const BYTES: &[u8] = b"0123456789-+.eE\"[]{}:, ntax";

/// Whatever bytes a file holds, it is read or refused: nothing else happens.
#[test]
fn damaged_files_are_answered() {
    let mut random = StdRng::seed_from_u64(3);
    let (mut read, mut built) = (0, 0);
    for _ in 0..5000 {
        let mut bytes = SMALL.as_bytes().to_vec();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..bytes.len());
            bytes[at] = BYTES[random.random_range(0..BYTES.len())];
        }
        let text = String::from_utf8(bytes).unwrap();
        if let Ok(file) = PatternFile::parse(&text) {
            read += 1;
            built += usize::from(file.builder(Path::new("")).is_ok());
        }
    }
    assert!(
        read > 50 && (10..read).contains(&built),
        "{read} read, {built} built"
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

/// A base BRDF's values out of range are told by their names.
#[test]
fn base_brdfs_are_checked() {
    for (entry, text) in [
        (
            r#"{ "oren_nayar": { "albedo": [1, 1, 1], "roughness": 1.5 } }"#,
            "roughness is 1.5; accepted: ",
        ),
        (
            r#"{ "oren_nayar": { "albedo": [1, 2, 1], "roughness": 1 } }"#,
            "albedo is 2; accepted: ",
        ),
        (
            r#"{ "phong": { "specular": [1, 1, -1], "exponent": 9 } }"#,
            "specular is -1; accepted: ",
        ),
        (
            r#"{ "phong": { "specular": [1, 1, 1], "exponent": 0.5 } }"#,
            "exponent is 0.5; accepted: ",
        ),
        (
            r#"{ "cook_torrance": { "alpha": 0, "fresnel": { "metal": "gold" } } }"#,
            "alpha is 0; accepted: ",
        ),
        (
            r#"{ "cook_torrance": { "alpha": 0.1, "fresnel": { "schlick": { "f0": [0, 7, 0] } } } }"#,
            "f0 is 7; accepted: ",
        ),
        (
            r#"{ "anisotropic_ggx": { "alpha_across": 3, "alpha_along": 0.1, "fresnel": { "metal": "gold" } } }"#,
            "alpha_across is 3; accepted: ",
        ),
        (
            r#"{ "anisotropic_ggx": { "alpha_across": 0.1, "alpha_along": -1, "fresnel": { "metal": "gold" } } }"#,
            "alpha_along is -1; accepted: ",
        ),
        (
            r#"{ "anisotropic_ggx": { "alpha_across": 0.1, "alpha_along": 0.1, "fresnel": { "conductor": { "eta": [0, 1, 1], "k": [0, 0, 0] } } } }"#,
            "eta is 0; accepted: ",
        ),
    ] {
        let like = "\"like\": \"titanium\"";
        assert!(SMALL.contains(like), "{like}");
        let stated = format!("{like}, \"scratched\": {entry}");
        let file = PatternFile::parse(&SMALL.replace(like, &stated)).unwrap();
        let message = file.builder(Path::new("here")).unwrap_err().to_string();
        let expected = format!("materials.plate: {text}");
        assert!(message.starts_with(&expected), "{entry}: {message}");
    }
}
