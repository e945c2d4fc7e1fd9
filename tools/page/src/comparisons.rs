//! The library's pictures beside those of its judges.

use crate::pictures::{difference, write_flip};
use maud::{Markup, html};
use serde_json::{Map, Value};
use std::error::Error;
use std::path::Path;

/// How many times its sheets are enlarged.
const ENLARGED: usize = 5;

/// Limits that the project has set itself, by name in `compare.json`, and what each is about.
const LIMITS: [(&str, &str, f64); 6] = [
    (
        "geometry_worst",
        "brute force, light that comes straight from the lamp",
        0.01,
    ),
    (
        "geometry_crossings_worst",
        "the same, with crossings and ends",
        0.03,
    ),
    ("interreflection_worst", "brute force, all light", 0.01),
    (
        "interreflection_crossings_worst",
        "the same, with crossings and ends",
        0.03,
    ),
    (
        "povray_lambert_worst",
        "POV-Ray, Lambert's reflection",
        0.005,
    ),
    ("povray_worst", "POV-Ray, its own phong and specular", 0.01),
];

/// A sheet: `PLATE-JUDGE-8.0px-75deg`.
struct Pair {
    name: String,
    plate: String,
    difference: f64,
    flip: f64,
}

/// All sheets of `compare/`; nothing if there is none.
pub fn section(folder: &Path) -> Result<Markup, Box<dyn Error>> {
    let sheets = folder.join("compare");
    let mut pairs = Vec::new();
    let entries = std::fs::read_dir(&sheets).into_iter().flatten();
    let mut paths: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.sort();
    for path in paths
        .iter()
        .filter(|path| path.extension().is_some_and(|ending| ending == "exr"))
    {
        let picture = path.with_extension("png");
        if picture.exists() {
            pairs.push(
                pair(path, &picture).map_err(|error| format!("{}: {error}", path.display()))?,
            );
        }
    }
    Ok(html! {
        @if !pairs.is_empty() {
            h2 { "Against explicit geometry" }
            p { "Plates rendered by the library at one sample per pixel, and by judges that are shown every facet of the relief as "
                "triangles: brute force with thousands of rays per pixel, and POV-Ray. In each row: the library, the judge, ten times "
                "their difference, and the FLIP map of the two (black: none to be seen; as on a screen of 67 pixels per degree). A "
                "pixel of these pictures is drawn " (ENLARGED) " pixels wide." }
            (worst(folder)?)
            @for plate in plates(&pairs) {
                h3 { (plate) }
                div.pairs { @for pair in pairs.iter().filter(|pair| pair.plate == plate) { (row(pair)) } }
            }
        }
    })
}

fn pair(sheet: &Path, picture: &Path) -> Result<Pair, Box<dyn Error>> {
    let name = sheet
        .file_stem()
        .ok_or("no name")?
        .to_string_lossy()
        .into_owned();
    let map = sheet.with_file_name(format!("{name}-flip.png"));
    let judges = ["-direct-", "-all-", "-povray-"];
    let cut = judges
        .iter()
        .find_map(|judge| name.find(judge))
        .unwrap_or(name.len());
    Ok(Pair {
        plate: name[..cut].to_owned(),
        difference: difference(sheet)?,
        flip: write_flip(picture, ENLARGED, &map)?,
        name,
    })
}

fn plates(pairs: &[Pair]) -> Vec<&str> {
    let mut plates: Vec<&str> = pairs.iter().map(|pair| pair.plate.as_str()).collect();
    plates.dedup();
    plates
}

fn row(pair: &Pair) -> Markup {
    html! {
        div.pair {
            img src=(format!("compare/{}.png", pair.name)) alt="" loading="lazy"; " "
            img src=(format!("compare/{}-flip.png", pair.name)) alt="FLIP map" loading="lazy";
            p { (pair.name[pair.plate.len()..].trim_start_matches('-')) ": mean absolute difference "
                (format!("{:.2} %", 100.0 * pair.difference)) ", mean FLIP " (format!("{:.4}", pair.flip)) }
        }
    }
}

/// The worst of each kind beside its limit.
fn worst(folder: &Path) -> Result<Markup, Box<dyn Error>> {
    let Ok(text) = std::fs::read_to_string(folder.join("compare.json")) else {
        return Ok(html! {});
    };
    let figures: Map<String, Value> = serde_json::from_str(&text)?;
    let percent = |share: f64| format!("{:.2} %", 100.0 * share);
    Ok(html! {
        table {
            tr { th { "judged by" } th { "worst plate: mean absolute difference over its mean" } th { "limit" } }
            @for (name, what, limit) in LIMITS {
                @if let Some(value) = figures.get(name).and_then(Value::as_f64) {
                    tr { td { (what) } td { (percent(value)) } td { (percent(limit)) } }
                }
            }
        }
    })
}
