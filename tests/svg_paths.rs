//! Paths from SVG drawings: where they come to lie, how wide their strokes are, what is no drawing.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use striae::brdf::Metal;
use striae::files::{Pressed, SvgPath, SvgPaths, SvgScratches};
use striae::formation::{CrossSection, DepthLaw, Material, Orientation, Process, Tool, Wanted};
use striae::pattern::PatternBuilder;

const UNIT: [[f64; 2]; 2] = [[0.0; 2], [1.0; 2]];

/// A drawing of 200 x 100 with this content, on the unit square.
fn drawn(content: &str) -> Vec<SvgPath> {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         width='200' height='100' fill='none' stroke='black'>{content}</svg>"
    );
    SvgPaths::parse(&text, UNIT).unwrap().paths
}

/// Points of a path lie where they should, to single precision.
fn assert_points(path: &SvgPath, expected: &[[f64; 2]]) {
    assert_eq!(path.points_uv.len(), expected.len(), "{path:?}");
    for (point, expected) in path.points_uv.iter().zip(expected) {
        for k in 0..2 {
            let off = (point[k] - expected[k]).abs();
            assert!(off < 1e-6, "{point:?} instead of {expected:?} in {path:?}");
        }
    }
}

/// A point of the drawing in texture space.
fn uv(x: f64, y: f64) -> [f64; 2] {
    [x / 200.0, 1.0 - y / 100.0]
}

/// Cubic curves are taken as they are, v upwards.
#[test]
fn cubics_are_exact() {
    let paths = drawn("<path id='c' d='M 20 10 C 40 90 120 -30 180 70'/>");
    assert_eq!((paths.len(), paths[0].id.as_str()), (1, "c"));
    assert_points(
        &paths[0],
        &[
            uv(20.0, 10.0),
            uv(40.0, 90.0),
            uv(120.0, -30.0),
            uv(180.0, 70.0),
        ],
    );
    assert!(!paths[0].closed, "open");
}

/// Lines and quadratic curves become the cubic curves that they are.
#[test]
fn lines_and_quadratics_are_raised() {
    let paths = drawn("<path d='M 0 0 L 30 60'/><path d='M 0 0 Q 30 90 60 0'/>");
    assert_points(
        &paths[0],
        &[uv(0.0, 0.0), uv(10.0, 20.0), uv(20.0, 40.0), uv(30.0, 60.0)],
    );
    assert_points(
        &paths[1],
        &[uv(0.0, 0.0), uv(20.0, 60.0), uv(40.0, 60.0), uv(60.0, 0.0)],
    );
}

/// Nested transforms, a reused element and a nested viewBox, each worked out by hand.
#[test]
fn transforms_add_up() {
    let turned = drawn(
        "<g transform='translate(100 20)'><g transform='rotate(90) scale(2)'>\
         <line x1='0' y1='0' x2='15' y2='5'/></g></g>",
    );
    // (15, 5) doubled is (30, 10), a quarter turn makes it (-10, 30).
    let ends = [turned[0].points_uv[0], turned[0].points_uv[3]];
    let path = |points_uv: &[[f64; 2]]| SvgPath {
        points_uv: points_uv.to_vec(),
        ..turned[0].clone()
    };
    assert_points(&path(&ends), &[uv(100.0, 20.0), uv(90.0, 50.0)]);
    let reused = drawn(
        "<defs><line id='l' x1='0' y1='0' x2='9' y2='9'/></defs>\
         <use xlink:href='#l' x='50' y='10'/><use xlink:href='#l' transform='matrix(1 0 2 1 0 0)'/>",
    );
    assert_eq!(reused.len(), 2);
    assert_points(&path(&[reused[0].points_uv[3]]), &[uv(59.0, 19.0)]);
    assert_points(&path(&[reused[1].points_uv[3]]), &[uv(27.0, 9.0)]);
    let text = "<svg xmlns='http://www.w3.org/2000/svg' width='400' height='200' viewBox='-10 -5 20 10'>\
                <path stroke='red' d='M -10 -5 L 10 5'/></svg>";
    let boxed = SvgPaths::parse(text, [[2.0, 3.0], [4.0, 4.0]])
        .unwrap()
        .paths;
    let ends = [boxed[0].points_uv[0], boxed[0].points_uv[3]];
    assert_points(&path(&ends), &[[2.0, 4.0], [4.0, 3.0]]);
    // A stroke of 1 in a box 20 wide on an area 2 wide.
    assert!(
        (boxed[0].width_uv - 0.1).abs() < 1e-7,
        "{}",
        boxed[0].width_uv
    );
}

/// Shapes are paths; closed ones come back to their first point.
#[test]
fn shapes_are_paths() {
    let paths = drawn(
        "<rect x='10' y='20' width='40' height='30'/><circle cx='100' cy='50' r='25'/>\
         <polyline points='0,0 10,0 10,10'/><polygon points='0,0 10,0 10,10'/><ellipse cx='9' cy='9' rx='3' ry='2'/>",
    );
    let closed: Vec<bool> = paths.iter().map(|path| path.closed).collect();
    assert_eq!(closed, [true, true, false, true, true]);
    for path in paths.iter().filter(|path| path.closed) {
        assert_eq!(path.points_uv.first(), path.points_uv.last(), "{path:?}");
        assert_eq!(path.points_uv.len() % 3, 1, "{path:?}");
    }
    let corner = |i: usize| SvgPath {
        points_uv: vec![paths[0].points_uv[3 * i]],
        ..paths[0].clone()
    };
    for (i, expected) in [
        (0, (10.0, 20.0)),
        (1, (50.0, 20.0)),
        (2, (50.0, 50.0)),
        (3, (10.0, 50.0)),
    ] {
        assert_points(&corner(i), &[uv(expected.0, expected.1)]);
    }
    // A circle on a square that is stretched twofold: all its points at the radius, to what arcs as cubics have.
    for curve in paths[1].points_uv.windows(4).step_by(3) {
        for i in 0..=4 {
            let t = f64::from(i) / 4.0;
            let at = |k: usize| {
                let s = 1.0 - t;
                s * s * s * curve[0][k]
                    + 3.0 * s * s * t * curve[1][k]
                    + 3.0 * s * t * t * curve[2][k]
                    + t * t * t * curve[3][k]
            };
            let radius = (at(0) * 200.0 - 100.0).hypot(at(1) * 100.0 - 50.0);
            assert!((radius / 25.0 - 1.0).abs() < 1e-3, "{radius}");
        }
    }
}

/// A lifted pen begins another path; one that goes on after it was closed begins where that did.
#[test]
fn subpaths_are_paths() {
    let paths = drawn("<path id='p' d='M 0 0 L 10 0 M 20 0 L 30 0 L 30 10 Z L 20 50 M 7 7 Z'/>");
    let ends: Vec<_> = paths
        .iter()
        .map(|path| {
            (
                path.points_uv[0],
                *path.points_uv.last().unwrap(),
                path.closed,
            )
        })
        .collect();
    assert_eq!(ends.len(), 3, "{ends:?}");
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6;
    for (found, expected) in ends.iter().zip([
        (uv(0.0, 0.0), uv(10.0, 0.0), false),
        (uv(20.0, 0.0), uv(20.0, 0.0), true),
        (uv(20.0, 0.0), uv(20.0, 50.0), false),
    ]) {
        let good = near(found.0, expected.0) && near(found.1, expected.1) && found.2 == expected.2;
        assert!(good, "{found:?} instead of {expected:?}");
    }
    assert!(paths.iter().all(|path| path.id == "p"), "{paths:?}");
}

/// What is hidden, filled only or not drawn does not scratch.
#[test]
fn only_visible_strokes_count() {
    let paths = drawn(
        "<path id='seen' d='M 0 0 L 9 9'/><path stroke='none' fill='red' d='M 0 0 L 9 9 L 0 9'/>\
         <path visibility='hidden' d='M 0 0 L 9 9'/><path display='none' d='M 0 0 L 9 9'/>\
         <path stroke-width='0' d='M 0 0 L 9 9'/><defs><path d='M 0 0 L 9 9'/></defs>\
         <image xlink:href='/etc/hostname' width='5' height='5'/><path d='M 3 3 L 3 3'/>",
    );
    let ids: Vec<&str> = paths.iter().map(|path| path.id.as_str()).collect();
    assert_eq!(ids, ["seen"]);
}

fn builder() -> PatternBuilder {
    PatternBuilder::new(Material::metal(Metal::Brass), 2.0, [50.0, 50.0]).unwrap()
}

/// Strokes are as wide as the drawing's scale makes them, and pressing by their width leaves crests that far apart.
#[test]
fn strokes_become_forces() {
    // 100 mm x 100 mm: a drawing unit is 0.5 mm wide and 1 mm high, 0.7071 mm in the mean.
    let paths = drawn(
        "<g stroke-width='0.25'><path d='M 0 0 L 100 50'/>\
         <path transform='scale(2 0.5)' d='M 0 0 L 50 50'/><path transform='rotate(30) scale(0.5)' d='M 0 0 L 9 9'/></g>",
    );
    let (tool, brass) = (Tool::rockwell_c(), Material::metal(Metal::Brass));
    let unit_mm = 0.5_f64.sqrt();
    for (path, wanted_mm) in paths
        .iter()
        .zip([0.25, 0.25, 0.125].map(|width| width * unit_mm))
    {
        let width_mm = path.width_mm(builder().mm_per_uv());
        assert!((width_mm / wanted_mm - 1.0).abs() < 1e-6, "{width_mm}");
        let leant = Orientation {
            tilt_deg: 10.0,
            ..Orientation::default()
        };
        let wanted = Wanted::CrestWidth(width_mm);
        for law in [
            DepthLaw::Bosch2004,
            DepthLaw::ScratchHardness,
            DepthLaw::Stated,
        ] {
            let process = Process::for_wanted(wanted, &tool, &brass, law, leant).unwrap();
            let section = CrossSection::form(&tool, &process, &brass).unwrap();
            let crests = section.crest_width_mm();
            assert!((crests / wanted_mm - 1.0).abs() < 1e-6, "{law:?}: {crests}");
        }
    }
}

/// What a pixel in the middle of the drawing is covered by.
fn coverage(builder: &PatternBuilder) -> f32 {
    use striae::pattern::{Footprint, SurfacePoint};
    use striae::scattering::Shading;
    let point = SurfacePoint {
        uv: [0.5, 0.5],
        dp_du: [50.0, 0.0, 0.0],
        dp_dv: [0.0, 50.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint: Footprint::Radius(0.5),
    };
    let mut shading = Shading::default();
    shading
        .shade(&builder.build(), &point, [0.0, 0.0, 1.0])
        .unwrap();
    shading.coverage()
}

/// The scratch that is added is the one whose cross-section has its crests where the stroke has its edges: the same as one of
/// the force that leaves them.
#[test]
fn scratches_are_as_wide_as_strokes() {
    let text = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>\
                <path stroke='black' stroke-width='0.2' d='M 10 50 L 90 50'/></svg>";
    let paths = SvgPaths::parse(text, UNIT).unwrap();
    let tool = Tool::rockwell_c();
    for material in [None, Some(Material::metal(Metal::Gold))] {
        let surface = Material::metal(Metal::Brass);
        let scratched = material.as_ref().unwrap_or(&surface);
        let by_stroke = SvgScratches {
            material: material.as_ref(),
            taper: [0.1, 0.2],
            ..SvgScratches::new(&tool)
        };
        let wanted = Wanted::CrestWidth(paths.paths[0].width_mm([100.0, 100.0]));
        let law = DepthLaw::default();
        let process =
            Process::for_wanted(wanted, &tool, scratched, law, Orientation::default()).unwrap();
        let by_force = SvgScratches {
            pressed: Pressed::Force(process.force_kgf),
            ..by_stroke
        };
        let by_depth = SvgScratches {
            pressed: Pressed::Depth(process.depth_mm),
            depth_law: DepthLaw::Stated,
            ..by_stroke
        };
        let covered = [by_stroke, by_force, by_depth].map(|scratches| {
            let mut builder = builder();
            paths.add_to(&mut builder, &scratches).unwrap();
            assert_eq!(builder.build().scratch_count(), 1);
            coverage(&builder)
        });
        // Peaks' outer flanks included, of a pixel 2 mm wide.
        assert!(covered[0] > 0.1 && covered[0] == covered[1], "{covered:?}");
        assert!((covered[2] / covered[0] - 1.0).abs() < 1e-5, "{covered:?}");
    }
}

/// A scratch that cannot be is told by its path's number and id, absurd wishes by their names; the builder stays as it was.
#[test]
fn builders_survive() {
    let paths = SvgPaths {
        paths: drawn("<path d='M 0 0 L 9 9'/><path id='wide' stroke-width='90' d='M 0 0 L 9 9'/>"),
    };
    let tool = Tool::rockwell_c();
    let mut builder = builder();
    let mut refused = |scratches: SvgScratches<'_>| {
        let error = paths.add_to(&mut builder, &scratches).unwrap_err();
        assert_eq!(builder.build().scratch_count(), 0, "after {error}");
        error.to_string()
    };
    let plain = SvgScratches::new(&tool);
    let wide = refused(plain);
    assert!(
        wide.starts_with("paths[1] (\"wide\"): crest_width_mm is "),
        "{wide}"
    );
    let taper = refused(SvgScratches {
        taper: [0.75, 0.5],
        ..plain
    });
    assert!(taper.starts_with("taper is 1.25; accepted: "), "{taper}");
    let force = refused(SvgScratches {
        pressed: Pressed::Force(-1.0),
        ..plain
    });
    assert!(force.starts_with("force_kgf is -1; accepted: "), "{force}");
    let depth = refused(SvgScratches {
        pressed: Pressed::Depth(f64::NAN),
        ..plain
    });
    assert!(depth.starts_with("depth_mm is NaN; accepted: "), "{depth}");
    let mut leant = plain;
    leant.orientation.tilt_deg = 88.0;
    let leant = refused(leant);
    assert!(leant.starts_with("tilt_deg is 88; accepted: "), "{leant}");
}

/// What bytes are replaced by.
const BYTES: &[u8] = b"0123456789-.e'<>/&;()MLCQAZ ";

/// Whatever a drawing's text holds, it is read or refused: nothing else happens.
#[test]
fn damaged_drawings_are_answered() {
    let whole = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 50 40'><g transform='scale(2) rotate(30 1 2)'>\
                 <path stroke='red' stroke-width='0.1' d='M 0 0 L 5 5 Q 1 2 3 4 A 3 2 10 0 1 7 7 Z'/></g>\
                 <circle stroke='red' cx='3' cy='4' r='2'/></svg>";
    let mut random = StdRng::seed_from_u64(4);
    let tool = Tool::rockwell_c();
    let (mut read, mut built) = (0, 0);
    for _ in 0..2000 {
        let mut bytes = whole.as_bytes().to_vec();
        for _ in 0..random.random_range(1..5) {
            let at = random.random_range(0..bytes.len());
            bytes[at] = BYTES[random.random_range(0..BYTES.len())];
        }
        let text = String::from_utf8(bytes).unwrap();
        if let Ok(paths) = SvgPaths::parse(&text, UNIT) {
            read += 1;
            let added = paths.add_to(&mut builder(), &SvgScratches::new(&tool));
            built += usize::from(added.is_ok());
        }
    }
    assert!(
        read > 50 && (10..=read).contains(&built),
        "{read} read, {built} built"
    );
}

/// Files that are no drawing, have no size or no stroke are refused with a clear text, never with a panic.
#[test]
fn broken_files_are_refused() {
    let refused = |text: &str| SvgPaths::parse(text, UNIT).unwrap_err().to_string();
    for (text, expected) in [
        ("", "accepted: an SVG drawing"),
        ("solid tool", "line 1, column 1: "),
        (
            "<svg xmlns='http://www.w3.org/2000/svg'>\n<g>\n</svg>",
            "line 3, column ",
        ),
        ("<html></html>", "accepted: "),
        (
            "<svg xmlns='http://www.w3.org/2000/svg' width='0' height='5'/>",
            "is a drawing without a size",
        ),
        (
            "<svg xmlns='http://www.w3.org/2000/svg' width='5' height='5'/>",
            "holds no stroked path",
        ),
        (
            "<svg xmlns='http://www.w3.org/2000/svg' width='5' height='5'><path d='M 0 0 L 5 5'/></svg>",
            "holds no stroked path; accepted: one visible path or more",
        ),
    ] {
        let message = refused(text);
        assert!(
            message.contains(expected) && message.contains("accepted: "),
            "{text}: {message}"
        );
    }
    let whole = "<svg xmlns='http://www.w3.org/2000/svg' width='5' height='5'><path stroke='red' d='M 0 0 L 5 5'/></svg>";
    for length in 0..whole.len() {
        assert!(
            SvgPaths::parse(&whole[..length], UNIT).is_err(),
            "cut at {length}"
        );
    }
    let deep = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='5' height='5'>{}{}</svg>",
        "<g transform='scale(2)'>".repeat(20_000),
        "</g>".repeat(20_000)
    );
    assert!(refused(&deep).contains("accepted: "), "deep");
    let huge = whole.replace("L 5 5", "L 1e38 1e38 L 1e300 5");
    let tool = Tool::nail();
    if let Ok(paths) = SvgPaths::parse(&huge, UNIT) {
        let error = paths
            .add_to(&mut builder(), &SvgScratches::new(&tool))
            .unwrap_err();
        assert!(error.to_string().contains("accepted: "), "{error}");
    }
    for area in [
        [[0.0, 0.0], [0.0, 1.0]],
        [[1.0, 0.0], [0.0, 1.0]],
        [[f64::NAN, 0.0], [1.0, 1.0]],
    ] {
        let error = SvgPaths::parse(whole, area).unwrap_err();
        assert!(error.to_string().starts_with("area_uv is "), "{error}");
    }
    let path = std::env::temp_dir().join(format!("striae-{}-latin.svg", std::process::id()));
    std::fs::write(&path, b"<svg id='\xe9'/>").unwrap();
    let latin = SvgPaths::read(&path, UNIT).unwrap_err().to_string();
    std::fs::remove_file(&path).unwrap();
    assert!(
        latin.contains("latin.svg: byte 9: is not UTF-8; accepted: "),
        "{latin}"
    );
}
