//! Pictures of cross-sections: what they say and show is what the cross-section is.

use roxmltree::{Document, Node};
use std::path::Path;
use striae::brdf::Metal;
use striae::files::{Plot, PlotStyle};
use striae::formation::{CrossSection, Material, Orientation, PileUpLaw, Process, Tool};

fn section(tool: &Tool, force_kgf: f64, tilt_deg: f64) -> CrossSection {
    let process = Process {
        force_kgf,
        orientation: Orientation {
            tilt_deg,
            azimuth_deg: 90.0,
            ..Orientation::default()
        },
        ..Process::default()
    };
    CrossSection::form(tool, &process, &Material::metal(Metal::Steel)).unwrap()
}

fn nail() -> CrossSection {
    section(&Tool::nail(), 2.0, 0.0)
}

/// 0.4 mm across and 0.1 mm high in 800 x 400 pixels: 2 px/µm by 4 px/µm.
fn strip(section: &CrossSection) -> Plot<'_> {
    Plot {
        style: PlotStyle::Strip,
        x_mm: Some([-0.2, 0.2]),
        z_mm: Some([-0.04, 0.06]),
        ..Plot::new(section, 800, 400)
    }
}

fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("not well formed");
    let elements = document.descendants();
    let texts = elements.filter(|node| node.has_tag_name("text"));
    texts
        .map(|node| node.text().unwrap_or_default().to_owned())
        .collect()
}

fn with_class<'a>(document: &'a Document<'a>, class: &str) -> Vec<Node<'a, 'a>> {
    let elements = document.descendants();
    elements
        .filter(|node| node.attribute("class") == Some(class))
        .collect()
}

fn points(node: &Node<'_, '_>) -> Vec<[f64; 2]> {
    let numbers = |pair: &str| -> [f64; 2] {
        let (x, y) = pair.split_once(',').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    let points = node.attribute("points").unwrap();
    points.split(' ').map(numbers).collect()
}

/// Area of a polygon.
fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    let sum: f64 = points
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum();
    0.5 * sum.abs()
}

struct Image {
    size: [u32; 2],
    rgba: Vec<u8>,
}

fn decoded(png: &[u8]) -> Image {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgba).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgba, "not RGBA");
    Image {
        size: [info.width, info.height],
        rgba,
    }
}

impl Image {
    fn count(&self, rgb: [u8; 3]) -> usize {
        let (pixels, _) = self.rgba.as_chunks::<4>();
        pixels.iter().filter(|pixel| pixel[..3] == rgb).count()
    }
}

const OUTER: [u8; 3] = [0x2f, 0x62, 0xb5];
const INNER: [u8; 3] = [0xd9, 0x73, 0x0d];
const GROOVE: [u8; 3] = [0x14, 0x86, 0x6a];
const GROOVE_AREA: [u8; 3] = [0xc5, 0xe8, 0xdb];
const PEAK_AREA: [u8; 3] = [0xf6, 0xd9, 0xb0];
const MATERIAL: [u8; 3] = [0xd9, 0xde, 0xe5];

/// An annotated plot says depth, widths, areas, heights and angles, and names its units.
#[test]
fn everything_is_labelled() {
    let section = nail();
    let svg = Plot::new(&section, 1200, 800).svg().unwrap();
    let texts = texts(&svg).join("\n");
    let peak = section.left();
    let peak_um2 = 0.5e6 * peak.height_mm * (peak.inner_width_mm + peak.outer_width_mm);
    for label in [
        format!("{:.1} µm deep", section.depth_mm() * 1e3),
        format!("{:.1} µm wide", section.groove_width_mm() * 1e3),
        format!("{:.0} µm between crests", section.crest_width_mm() * 1e3),
        format!("groove {:.0} µm²", section.groove_area_mm2() * 1e6),
        format!("peak {peak_um2:.0} µm²"),
        format!("{:.1} µm high", peak.height_mm * 1e3),
        format!("α = {:.1}°", peak.alpha_deg),
        format!("β = {:.1}°", peak.beta_deg),
        "across the scratch, to the right of travel (µm)".to_owned(),
        "height (µm), exaggerated ×".to_owned(),
    ] {
        assert!(texts.contains(&label), "{label} is not in:\n{texts}");
    }
}

/// The drawn areas, divided by the scale, are the cross-section's.
#[test]
fn areas_are_true() {
    let section = nail();
    let svg = strip(&section).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let um2 = |class| -> Vec<f64> {
        let polygons = with_class(&document, class);
        polygons
            .iter()
            .map(|node| area(&points(node)) / 8.0)
            .collect()
    };
    let groove = section.groove_area_mm2() * 1e6;
    let drawn = um2("groove-area");
    assert!((drawn[0] / groove - 1.0).abs() < 1e-3, "{drawn:?} {groove}");
    let peaks = um2("peak-area");
    assert_eq!(peaks.len(), 2);
    for peak in peaks {
        assert!((2.0 * peak / groove - 1.0).abs() < 1e-3, "{peak} {groove}");
    }
}

/// A strip spans what it is told to span: the groove's edges lie where its width says.
#[test]
fn a_strip_is_to_scale() {
    let section = nail();
    let svg = strip(&section).svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let groove = points(&with_class(&document, "groove")[0]);
    let half_um = 0.5e3 * section.groove_width_mm();
    let (first, last) = (groove[0], groove[groove.len() - 1]);
    let expected = [400.0 - 2.0 * half_um, 400.0 + 2.0 * half_um];
    assert!((first[0] - expected[0]).abs() < 0.02, "{first:?}");
    assert!((last[0] - expected[1]).abs() < 0.02, "{last:?}");
    assert!((first[1] - 240.0).abs() < 0.02, "{first:?}");
}

/// The PNG has the size asked for, every zone in its colour, and as many pixels of each area as there should be.
#[test]
fn pixels_are_what_the_svg_says() {
    let section = nail();
    let image = decoded(&strip(&section).png().unwrap());
    assert_eq!(image.size, [800, 400]);
    for (zone, least) in [
        (OUTER, 100),
        (INNER, 100),
        (GROOVE, 300),
        (MATERIAL, 60_000),
    ] {
        let count = image.count(zone);
        assert!(count >= least, "{zone:?}: {count} pixels");
    }
    let area_px = 8.0 * section.groove_area_mm2() * 1e6;
    for area in [GROOVE_AREA, PEAK_AREA] {
        // The lines around them, 7 px wide, take something away.
        let share = image.count(area) as f64 / area_px;
        assert!((0.6..1.0).contains(&share), "{area:?}: {share}");
    }
}

/// Text is set in the library's own font: a title puts dark pixels where there were none.
#[test]
fn text_is_drawn() {
    let section = nail();
    let dark = |title| {
        let plot = Plot {
            title,
            ..strip(&section)
        };
        decoded(&plot.png().unwrap()).count([0x1f, 0x29, 0x33])
    };
    let (without, with) = (dark(None), dark(Some("Härte 131 HV, α = 28°")));
    assert!(with > without + 200, "{with} against {without}");
}

/// Whatever is in a title, the SVG stays well formed and says it.
#[test]
fn titles_are_escaped() {
    let section = nail();
    let title = "<b> & \"nails\" ]]> 'α'\u{1}\u{fffe}\nsecond";
    for style in [PlotStyle::Annotated, PlotStyle::Strip] {
        let plot = Plot {
            title: Some(title),
            style,
            ..Plot::new(&section, 400, 300)
        };
        let texts = texts(&plot.svg().unwrap());
        assert!(
            texts.iter().any(|text| text == "<b> & \"nails\" ]]> 'α'"),
            "{texts:?}"
        );
        plot.png().unwrap();
    }
}

/// Shallow, lopsided, upright-walled, peakless and absent scratches, in pictures of every size.
#[test]
fn every_scratch_can_be_drawn() {
    let peakless = Material {
        pile_up: PileUpLaw::None,
        ..Material::metal(Metal::Gold)
    };
    let press = |force_kgf| Process {
        force_kgf,
        ..Process::default()
    };
    let sections = [
        section(&Tool::screwdriver(), 2.0, 0.0),
        section(&Tool::screwdriver(), 2.0, 15.0),
        section(&Tool::nail(), 2.0, 60.0),
        section(&Tool::vickers(), 0.06, 0.0),
        section(&Tool::nail(), 0.0, 0.0),
        CrossSection::form(&Tool::rockwell_c(), &press(4.0), &peakless).unwrap(),
    ];
    for section in &sections {
        for (width_px, height_px) in [(64, 64), (64, 600), (900, 64), (640, 480)] {
            for style in [PlotStyle::Annotated, PlotStyle::Strip] {
                let plot = Plot {
                    style,
                    title: Some("title\nmore"),
                    ..Plot::new(section, width_px, height_px)
                };
                let svg = plot.svg().unwrap();
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
                Document::parse(&svg).unwrap();
                assert_eq!(
                    decoded(&plot.png().unwrap()).size,
                    [width_px, height_px],
                    "{style:?}"
                );
            }
        }
    }
    let texts = texts(&Plot::new(&sections[4], 640, 480).svg().unwrap());
    assert!(
        texts.iter().any(|text| text.starts_with("no scratch")),
        "{texts:?}"
    );
}

/// Absurd views are drawn, not choked on.
#[test]
fn any_view_can_be_drawn() {
    let section = nail();
    for shown in [[0.0, 1e-9], [-1e4, 1e4], [9_999.0, 9_999.5], [-0.01, 0.3]] {
        let plot = Plot {
            x_mm: Some(shown),
            z_mm: Some(shown),
            ..Plot::new(&section, 300, 200)
        };
        plot.png().unwrap();
        let strip = Plot {
            z_mm: None,
            style: PlotStyle::Strip,
            ..plot
        };
        strip.png().unwrap();
    }
}

/// Sizes and views out of range are named.
#[test]
fn bad_sizes_are_refused() {
    let section = nail();
    let refused = |plot: Plot<'_>, argument: &str| {
        let error = plot.svg().unwrap_err();
        assert_eq!(error.argument(), argument);
        assert_eq!(plot.png().unwrap_err().to_string(), error.to_string());
    };
    refused(Plot::new(&section, 63, 400), "width_px");
    refused(Plot::new(&section, 400, 8193), "height_px");
    for shown in [
        [f64::NAN, 1.0],
        [0.0, f64::INFINITY],
        [1.0, 1.0],
        [1.0, -1.0],
        [0.0, 1e5],
    ] {
        let plot = Plot::new(&section, 400, 400);
        let x_mm = Some(shown);
        refused(Plot { x_mm, ..plot }, "x_mm");
        refused(Plot { z_mm: x_mm, ..plot }, "z_mm");
    }
}

/// The name's end says what is written; what cannot be written is answered, with the file's name.
#[test]
fn files() {
    let section = nail();
    let plot = Plot::new(&section, 300, 200);
    let folder = std::env::temp_dir().join(format!("striae-plot-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (svg, png) = (folder.join("a.SVG"), folder.join("a.png"));
    plot.write(&svg).unwrap();
    plot.write(&png).unwrap();
    assert_eq!(std::fs::read_to_string(&svg).unwrap(), plot.svg().unwrap());
    assert_eq!(std::fs::read(&png).unwrap(), plot.png().unwrap());
    let refused = |path: &Path| {
        let error = plot.write(path).unwrap_err();
        assert_eq!(error.argument(), None);
        error.to_string()
    };
    let text = refused(&folder.join("a.jpg"));
    assert!(
        text.ends_with("accepted: names that end in .png or .svg"),
        "{text}"
    );
    let text = refused(&folder.join("nowhere/a.png"));
    assert!(text.contains("nowhere/a.png: cannot be written"), "{text}");
    std::fs::remove_dir_all(&folder).unwrap();
    let small = Plot::new(&section, 1, 200);
    let error = small.write(Path::new("a.png")).unwrap_err();
    assert_eq!(error.argument(), Some("width_px"));
}
