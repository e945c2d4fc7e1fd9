//! One static page of all figures, comparisons and benches that a folder holds, with FLIP maps of each pair compared.

mod bench;
mod comparisons;
mod figures;
mod pictures;

use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

const STYLE: &str = include_str!("style.css");

fn main() -> ExitCode {
    let Some(folder) = std::env::args().nth(1) else {
        eprintln!(
            "usage: striae-page FOLDER\n  FOLDER  what `make figures`, `make compare` and `make bench` wrote"
        );
        return ExitCode::from(2);
    };
    match write_page(Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{folder}: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write_page(folder: &Path) -> Result<(), Box<dyn Error>> {
    let page = page(&[
        figures::section(folder),
        comparisons::section(folder)?,
        bench::section(folder)?,
    ]);
    let path = folder.join("index.html");
    std::fs::write(&path, page.into_string())?;
    println!("page: {}", path.display());
    Ok(())
}

fn page(sections: &[Markup]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "striae: figures and proof" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { "striae" }
                    p { "Scratches as they are made, where they run, and what light does in them: the figures and tables of "
                        "Bosch, Pueyo, Mérillou and Ghazanfarpour 2004 again, and judges that see every facet as a triangle." }
                }
                @for section in sections { (section) }
            }
        }
    }
}
