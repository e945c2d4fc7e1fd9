//! A small writer of SVG.

use glam::DVec2;
use std::fmt::Write;

/// Which end of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// An SVG document being written. Places and lengths are in pixels, y downwards.
pub(super) struct Svg {
    document: String,
}

impl Svg {
    pub(super) fn new(width: u32, height: u32, style: &str) -> Self {
        let mut svg = Self {
            document: String::new(),
        };
        svg.put(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\">\n<style>{style}</style>\n"
        ));
        svg
    }

    pub(super) fn rectangle(&mut self, class: &str, from: DVec2, to: DVec2) {
        let size = to - from;
        self.put(format_args!(
            "<rect class=\"{class}\" x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\"/>\n",
            from.x, from.y, size.x, size.y
        ));
    }

    pub(super) fn polyline(&mut self, class: &str, points: &[DVec2]) {
        self.points("polyline", class, points);
    }

    pub(super) fn polygon(&mut self, class: &str, points: &[DVec2]) {
        self.points("polygon", class, points);
    }

    fn points(&mut self, element: &str, class: &str, points: &[DVec2]) {
        self.put(format_args!("<{element} class=\"{class}\" points=\""));
        for (i, point) in points.iter().enumerate() {
            let space = if i > 0 { " " } else { "" };
            self.put(format_args!("{space}{:.2},{:.2}", point.x, point.y));
        }
        self.put(format_args!("\"/>\n"));
    }

    pub(super) fn text(&mut self, class: &str, at: DVec2, anchor: Anchor, text: &str) {
        self.put(format_args!("<text x=\"{:.2}\" y=\"{:.2}\"", at.x, at.y));
        self.text_content(class, anchor, text);
    }

    /// A text that runs upwards.
    pub(super) fn text_upwards(&mut self, class: &str, at: DVec2, anchor: Anchor, text: &str) {
        let DVec2 { x, y } = at;
        self.put(format_args!(
            "<text transform=\"translate({x:.2} {y:.2}) rotate(-90)\""
        ));
        self.text_content(class, anchor, text);
    }

    fn text_content(&mut self, class: &str, anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = escaped(text);
        self.put(format_args!(
            " class=\"{class}\" text-anchor=\"{anchor}\">{text}</text>\n"
        ));
    }

    /// All until the matching [`Self::end_clip`] is cut off at a rectangle.
    pub(super) fn begin_clip(&mut self, from: DVec2, to: DVec2) {
        self.put(format_args!("<clipPath id=\"frame\">"));
        self.rectangle("clip", from, to);
        self.put(format_args!("</clipPath>\n<g clip-path=\"url(#frame)\">\n"));
    }

    pub(super) fn end_clip(&mut self) {
        self.put(format_args!("</g>\n"));
    }

    pub(super) fn finish(mut self) -> String {
        self.put(format_args!("</svg>\n"));
        self.document
    }

    fn put(&mut self, what: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.document.write_fmt(what);
    }
}

/// Text as XML takes it: markup escaped; characters that XML has no place for, left out.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\t' => escaped.push(' '),
            '\0'..='\x1f' | '\x7f'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => {}
            other => escaped.push(other),
        }
    }
    escaped
}
