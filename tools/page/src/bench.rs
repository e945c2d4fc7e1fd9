//! What things cost: all of `bench.json`, and the tables and plots of its programs.

use maud::{Markup, PreEscaped, html};
use serde_json::{Map, Value};
use std::error::Error;
use std::path::Path;

/// The bench's numbers, and what of it is drawn or told at length.
pub fn section(folder: &Path) -> Result<Markup, Box<dyn Error>> {
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).ok();
    let (Some(text), plot) = (read("bench.json"), read("equal-error.svg")) else {
        return Ok(html! {});
    };
    let figures: Map<String, Value> = serde_json::from_str(&text)?;
    Ok(html! {
        h2 { "What it costs" }
        p { "Ratios are of one run on one machine." }
        @for name in ["overhead.txt", "equal-error.txt"] {
            @if let Some(table) = read(name) { pre { (table) } }
        }
        @if let Some(plot) = plot { figure { (PreEscaped(plot)) } }
        table {
            @for (name, value) in &figures { tr { td { (name) } td { (number(value)) } } }
        }
    })
}

fn number(value: &Value) -> String {
    match value.as_f64() {
        Some(value) if value.abs() >= 1000.0 => format!("{value:.0}"),
        Some(value) => format!("{value:.3}"),
        None => value.to_string(),
    }
}
