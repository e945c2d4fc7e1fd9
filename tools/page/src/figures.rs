//! The paper's figures again, each beside what the paper says of it.

use maud::{Markup, html};
use std::path::Path;

struct Figure {
    title: &'static str,
    /// Pictures in the folder; those that are not there are left out, and figures without any.
    pictures: &'static [&'static str],
    /// What the paper says of its figure, in our words.
    paper: &'static str,
    /// What is to be seen here.
    here: &'static str,
}

const FIGURES: &[Figure] = &include!("figures.in");

/// All that the folder has pictures of.
pub fn section(folder: &Path) -> Markup {
    let there = |figure: &&Figure| {
        figure
            .pictures
            .iter()
            .any(|name| folder.join(name).exists())
    };
    html! {
        h2 { "Figures" }
        @for figure in FIGURES.iter().filter(there) { (of(folder, figure)) }
    }
}

fn of(folder: &Path, figure: &Figure) -> Markup {
    let pictures: Vec<_> = figure
        .pictures
        .iter()
        .filter(|name| folder.join(name).exists())
        .collect();
    html! {
        figure {
            div.several[pictures.len() > 1] {
                @for name in pictures { a href=(name) { img src=(name) alt=(figure.title) loading="lazy"; } }
            }
            figcaption {
                p { b { (figure.title) ". " } (figure.here) }
                p { b { "The paper: " } (figure.paper) }
            }
        }
    }
}
