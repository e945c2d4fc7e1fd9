//! Figures of all benches, in one file: a flat object of numbers.

use serde_json::{Map, Value};
use std::path::PathBuf;

/// Prints each figure, and writes them to `out/bench.json` beside what other benches wrote there.
pub(crate) fn write(figures: &[(String, f64)]) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("out/bench.json");
    let known = std::fs::read(&path)
        .ok()
        .and_then(|text| serde_json::from_slice(&text).ok());
    let mut all: Map<String, Value> = known.unwrap_or_default();
    for (name, figure) in figures {
        println!("{name} = {figure:.4}");
        all.insert(name.clone(), Value::from(*figure));
    }
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("out/ can be made");
    let text = serde_json::to_string_pretty(&all).expect("numbers are JSON");
    std::fs::write(&path, text + "\n").expect("out/bench.json can be written");
}
