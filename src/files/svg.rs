//! Paths from SVG drawings: whatever is stroked becomes a scratch.

use super::error::{FileError, Place, Result};
use super::read::read;
use super::text::without_mark;
use crate::error::{Error, in_range};
use crate::formation::{DepthLaw, Material, Orientation, Process, Tool, Wanted};
use crate::pattern::{
    Held, Key, Path as Curves, PatternBuilder, Scratch, Spline, SplineKind, tapered,
};
use glam::{DMat2, DVec2};
use std::path::Path;
use usvg::tiny_skia_path::{PathSegment, Point, Transform};
use usvg::{ImageHrefResolver, Node, Options, Tree};

/// The stroked paths of an SVG drawing, in texture space.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgPaths {
    /// One or more, in the order in which they are drawn.
    pub paths: Vec<SvgPath>,
}

/// A stroked path without interruption: of a path that is lifted (`M`) in between there are several.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgPath {
    /// The element's id, or nothing.
    pub id: String,
    /// Control points of cubic Bézier curves, (u, v): 3 n + 1. Curves of a closed path come back to the first one.
    pub points_uv: Vec<[f64; 2]>,
    /// Ends where it begins.
    pub closed: bool,
    /// The stroke's width, units of texture space; where u and v are stretched differently, the geometric mean of both.
    pub width_uv: f64,
}

/// What scratches are made along a drawing's paths.
#[derive(Clone, Copy, Debug)]
pub struct SvgScratches<'a> {
    /// The tool.
    pub tool: &'a Tool,
    /// What it scratches and how the scratches reflect; `None` for the pattern's own material.
    pub material: Option<&'a Material>,
    /// Which law gives the depth.
    pub depth_law: DepthLaw,
    /// How deep.
    pub pressed: Pressed,
    /// Shares of the length over which force and depth rise from 0 and fall back to it, each 0 to 1, together 1 at
    /// most.
    pub taper: [f64; 2],
    /// How the tool is held.
    pub orientation: Orientation,
    /// What spin and azimuth are relative to.
    pub held: Held,
}

/// How deep a drawing's scratches are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Pressed {
    /// As deep as makes each scratch as wide between its two crests as its stroke:
    /// [`Process::for_wanted`] with [`Wanted::CrestWidth`], at the material's own hardness.
    #[default]
    StrokeWidth,
    /// By this force, kgf, 0 to 100000.
    Force(f64),
    /// To this depth under load, mm, 0 to 1000, under [`DepthLaw::Stated`].
    Depth(f64),
}

impl SvgPaths {
    /// Whatever is stroked in an SVG file of at most 1 GiB: paths, lines, polylines, polygons, rectangles, circles and
    /// ellipses, visible, under their transforms. Lines, quadratic curves and arcs become cubic ones. Dashes are drawn
    /// through; fills, texts, images, clips and masks do not count.
    ///
    /// The drawing's edges (its `width` and `height`, or its `viewBox`) come to lie on `area_uv`: two opposite corners, (u,
    /// v), -1e6 to 1e6, the first one lower in both. The drawing's top is the area's; it is stretched where the two have
    /// other proportions. Points have single precision.
    ///
    /// Errors: a file that cannot be read, that is no SVG, has no size or nothing stroked in it; an area without extent.
    pub fn read(path: &Path, area_uv: [[f64; 2]; 2]) -> Result<Self> {
        let area = Area::new(area_uv)?;
        let bytes = read(path).map_err(|error| error.in_file(path))?;
        drawing(&bytes, area).map_err(|error| error.in_file(path))
    }

    /// As [`Self::read`], from a file's text.
    pub fn parse(text: &str, area_uv: [[f64; 2]; 2]) -> Result<Self> {
        drawing(text.as_bytes(), Area::new(area_uv)?)
    }

    /// Adds a scratch along each path. If one of them is refused, the builder is as it was.
    ///
    /// Errors: what [`PatternBuilder::add`] and [`Process::for_wanted`] refuse, with the path's number and id.
    pub fn add_to(&self, builder: &mut PatternBuilder, scratches: &SvgScratches<'_>) -> Result<()> {
        scratches.check()?;
        let mut keys = Vec::new();
        builder.all_or_none(|builder| {
            for (i, path) in self.paths.iter().enumerate() {
                let added = scratches.full(path, builder).and_then(|full| {
                    tapered(full, scratches.taper, &mut keys);
                    builder.add(&Scratch {
                        material: scratches.material,
                        depth_law: scratches.depth_law,
                        held: scratches.held,
                        path: path.curve(),
                        keys: &keys,
                        ..Scratch::new(scratches.tool)
                    })
                });
                added.map_err(|error| FileError::within(path.named(i), error))?;
            }
            Ok(())
        })
    }
}

impl SvgPath {
    fn curve(&self) -> Curves<'_> {
        // A closed curve's points are told without the first one's repetition.
        let count = self.points_uv.len() - usize::from(self.closed);
        Curves::Spline(Spline {
            kind: SplineKind::CubicBezier,
            points: &self.points_uv[..count],
            closed: self.closed,
        })
    }
}

impl<'a> SvgScratches<'a> {
    /// Scratches by this tool, as wide as their strokes, with nothing else stated.
    pub fn new(tool: &'a Tool) -> Self {
        Self {
            tool,
            material: None,
            depth_law: DepthLaw::default(),
            pressed: Pressed::default(),
            taper: [0.0; 2],
            orientation: Orientation::default(),
            held: Held::default(),
        }
    }

    /// What does not depend on any path.
    fn check(&self) -> crate::Result<()> {
        let [rise, fall] = self.taper;
        for share in [rise, fall, rise + fall] {
            in_range("taper", share, 0.0, 1.0)?;
        }
        match self.pressed {
            Pressed::StrokeWidth => 0.0,
            Pressed::Force(force_kgf) => in_range("force_kgf", force_kgf, 0.0, 100_000.0)?,
            Pressed::Depth(depth_mm) => in_range("depth_mm", depth_mm, 0.0, 1000.0)?,
        };
        self.orientation.check()?;
        self.material.map(Material::check).transpose()?;
        Ok(())
    }

    /// Force and depth between the tapers.
    fn full(&self, path: &SvgPath, builder: &PatternBuilder) -> crate::Result<Key> {
        let key = match self.pressed {
            Pressed::Force(force_kgf) => Key::force(0.0, force_kgf),
            Pressed::Depth(depth_mm) => Key::depth(0.0, depth_mm),
            Pressed::StrokeWidth => {
                let process = Process::for_wanted(
                    Wanted::CrestWidth(path.width_mm(builder.mm_per_uv())),
                    self.tool,
                    self.material.unwrap_or(builder.material()),
                    self.depth_law,
                    self.orientation,
                )?;
                Key {
                    depth_mm: process.depth_mm,
                    ..Key::force(0.0, process.force_kgf)
                }
            }
        };
        Ok(Key {
            orientation: self.orientation,
            ..key
        })
    }
}

impl SvgPath {
    /// The stroke's width on a surface of which one unit of u and of v spans `mm_per_uv`.
    pub fn width_mm(&self, mm_per_uv: [f64; 2]) -> f64 {
        self.width_uv * (mm_per_uv[0] * mm_per_uv[1]).sqrt()
    }

    fn named(&self, number: usize) -> String {
        if self.id.is_empty() {
            return format!("paths[{number}]");
        }
        let id: String = self.id.chars().take(40).collect();
        format!("paths[{number}] (\"{}\")", id.escape_debug())
    }
}

/// The rectangle in texture space that a drawing is laid on.
#[derive(Clone, Copy)]
struct Area {
    from: DVec2,
    to: DVec2,
}

impl Area {
    fn new([from, to]: [[f64; 2]; 2]) -> crate::Result<Self> {
        for value in [from, to].concat() {
            in_range("area_uv", value, -1e6, 1e6)?;
        }
        for i in 0..2 {
            if to[i] - from[i] < 1e-9 {
                let accepted =
                    "a corner that is lower in u and v, then one that is higher, by 1e-9 or more";
                return Err(Error::number("area_uv", from[i], accepted));
            }
        }
        Ok(Self {
            from: from.into(),
            to: to.into(),
        })
    }
}

/// An affine map from an element's own coordinates to texture space.
struct Placed {
    linear: DMat2,
    origin: DVec2,
}

impl Placed {
    /// `transform` leads to the drawing, `size` across.
    fn new(transform: Transform, size: DVec2, area: Area) -> Self {
        let scale = (area.to - area.from) / size;
        let place = |x: f32, y: f32| DVec2::new(f64::from(x) * scale.x, -f64::from(y) * scale.y);
        Self {
            linear: DMat2::from_cols(
                place(transform.sx, transform.ky),
                place(transform.kx, transform.sy),
            ),
            origin: place(transform.tx, transform.ty) + DVec2::new(area.from.x, area.to.y),
        }
    }

    fn point(&self, point: Point) -> DVec2 {
        self.origin + self.linear * DVec2::new(f64::from(point.x), f64::from(point.y))
    }
}

fn drawing(bytes: &[u8], area: Area) -> Result<SvgPaths> {
    let text = str::from_utf8(without_mark(bytes)).map_err(|error| {
        FileError::new(
            Place::Byte(error.valid_up_to()),
            "is not UTF-8",
            "an SVG drawing as text in UTF-8",
        )
    })?;
    // A drawing's images would be read from any path that it names; they have no strokes.
    let options = Options {
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    };
    let tree = Tree::from_str(text, &options).map_err(refused)?;
    let size = DVec2::new(
        f64::from(tree.size().width()),
        f64::from(tree.size().height()),
    );
    let mut paths = Vec::new();
    // Nodes still to be looked at, the next one last.
    let mut nodes: Vec<&Node> = tree.root().children().iter().rev().collect();
    while let Some(node) = nodes.pop() {
        match node {
            Node::Group(group) => nodes.extend(group.children().iter().rev()),
            Node::Path(path) => stroked(path, size, area, &mut paths),
            Node::Image(_) | Node::Text(_) => {}
        }
    }
    if paths.is_empty() {
        return Err(FileError::new(
            Place::Whole,
            "holds no stroked path",
            "one visible path or more with a stroke and a length",
        ));
    }
    Ok(SvgPaths { paths })
}

/// Adds the subpaths of a path, if it is stroked.
fn stroked(path: &usvg::Path, size: DVec2, area: Area, paths: &mut Vec<SvgPath>) {
    let Some(stroke) = path.stroke().filter(|_| path.is_visible()) else {
        return;
    };
    let placed = Placed::new(path.abs_transform(), size, area);
    let width_uv = f64::from(stroke.width().get()) * placed.linear.determinant().abs().sqrt();
    let mut points: Vec<DVec2> = Vec::new();
    let mut finish = |points: &mut Vec<DVec2>, closed: bool| {
        if points.iter().any(|point| *point != points[0]) {
            paths.push(SvgPath {
                id: path.id().to_owned(),
                points_uv: points.iter().map(DVec2::to_array).collect(),
                closed,
                width_uv,
            });
        }
        // A path that goes on after it was closed does so from its beginning.
        points.truncate(1);
    };
    for segment in path.data().segments() {
        match segment {
            PathSegment::MoveTo(to) => {
                finish(&mut points, false);
                points.clear();
                points.push(placed.point(to));
            }
            PathSegment::LineTo(to) => line(&mut points, placed.point(to)),
            PathSegment::QuadTo(handle, to) => {
                let (handle, to) = (placed.point(handle), placed.point(to));
                let from = *points.last().unwrap_or(&to);
                let towards = |end: DVec2| end.lerp(handle, 2.0 / 3.0);
                points.extend([towards(from), towards(to), to]);
            }
            PathSegment::CubicTo(first, second, to) => {
                points.extend([first, second, to].map(|point| placed.point(point)));
            }
            PathSegment::Close => {
                if let (Some(&first), Some(&last)) = (points.first(), points.last())
                    && first != last
                {
                    line(&mut points, first);
                }
                finish(&mut points, true);
            }
        }
    }
    finish(&mut points, false);
}

/// A straight line as a cubic curve.
fn line(points: &mut Vec<DVec2>, to: DVec2) {
    let from = *points.last().unwrap_or(&to);
    points.extend([from.lerp(to, 1.0 / 3.0), from.lerp(to, 2.0 / 3.0), to]);
}

fn refused(error: usvg::Error) -> FileError {
    let whole =
        |found: &'static str, accepted: &'static str| FileError::new(Place::Whole, found, accepted);
    match error {
        usvg::Error::ParsingFailed(error) => {
            let at = error.pos();
            let text = error.to_string();
            let place = format!(" at {}:{}", at.row, at.col);
            let found = text.strip_suffix(&place).unwrap_or(&text).to_owned();
            let place = Place::Column(at.row as usize, at.col as usize);
            FileError::new(place, found, "an SVG drawing")
        }
        usvg::Error::InvalidSize => whole(
            "is a drawing without a size",
            "a width and a height, or a viewBox, above 0",
        ),
        usvg::Error::ElementsLimitReached => {
            whole("holds too many elements", "a million elements or fewer")
        }
        _ => whole("is not UTF-8", "an SVG drawing as text in UTF-8"),
    }
}
