//! An inscription in stroke letters, as a jeweller cuts it, laid around a ring.

use super::meshes::on_torus;
use glam::{DVec2, DVec3};

/// A stroke's points in its letter's cell (0 to 1, baseline to cap height), and whether they are a smooth curve's.
pub(crate) type Stroke = (&'static [[f64; 2]], bool);

/// The strokes of a letter; none of one that is not known.
pub(crate) fn letter(letter: char) -> &'static [Stroke] {
    const O: &[[f64; 2]] = &[
        [0.5, 1.0],
        [0.1, 0.75],
        [0.1, 0.25],
        [0.5, 0.0],
        [0.9, 0.25],
        [0.9, 0.75],
        [0.5, 1.0],
    ];
    const S: &[[f64; 2]] = &[
        [0.85, 0.85],
        [0.5, 1.0],
        [0.15, 0.8],
        [0.4, 0.55],
        [0.7, 0.42],
        [0.85, 0.2],
        [0.5, 0.0],
        [0.12, 0.15],
    ];
    const BOWL: &[[f64; 2]] = &[[0.2, 1.0], [0.6, 1.0], [0.85, 0.76], [0.6, 0.5], [0.2, 0.5]];
    const STEM: Stroke = (&[[0.2, 0.0], [0.2, 1.0]], false);
    match letter {
        'A' => &[
            (&[[0.05, 0.0], [0.5, 1.0], [0.95, 0.0]], false),
            (&[[0.25, 0.4], [0.75, 0.4]], false),
        ],
        'E' => &[
            (&[[0.85, 1.0], [0.2, 1.0], [0.2, 0.0], [0.85, 0.0]], false),
            (&[[0.2, 0.5], [0.7, 0.5]], false),
        ],
        'I' => &[(&[[0.5, 0.0], [0.5, 1.0]], false)],
        'O' => &[(O, true)],
        'R' => &[STEM, (BOWL, true), (&[[0.5, 0.5], [0.9, 0.0]], false)],
        'S' => &[(S, true)],
        'T' => &[
            (&[[0.05, 1.0], [0.95, 1.0]], false),
            (&[[0.5, 1.0], [0.5, 0.0]], false),
        ],
        _ => &[],
    }
}

/// The strokes of a text around a torus' outer equator: letters `height` tall, from `start` (share of a turn) on. Straight
/// lines are told by points close enough to bend with the ring.
pub(crate) fn around_ring(
    text: &str,
    [major, minor]: [f64; 2],
    height: f64,
    start: f64,
) -> Vec<(Vec<[f64; 3]>, bool)> {
    let round = std::f64::consts::TAU;
    let on_ring = |pen: f64, p: DVec2| {
        let along = start + (pen + 0.7 * p.x) * height / (round * (major + minor));
        let across = (p.y - 0.5) * height / (round * minor);
        on_torus(major, minor, DVec2::new(along, across)).to_array()
    };
    let mut strokes = Vec::new();
    for (i, each) in (0_u32..).zip(text.chars()) {
        for (points, smooth) in letter(each) {
            let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
            let told = if *smooth {
                points
            } else {
                let part = |pair: &[DVec2], k: u32| pair[0].lerp(pair[1], f64::from(k) / 8.0);
                let mut all: Vec<DVec2> = points
                    .windows(2)
                    .flat_map(|pair| (0..8).map(|k| part(pair, k)))
                    .collect();
                all.extend(points.last());
                all
            };
            let placed = told.iter().map(|&p| on_ring(f64::from(i), p));
            strokes.push((placed.collect(), *smooth));
        }
    }
    strokes
}

/// The length of the lines from point to point.
pub(crate) fn length(points: &[[f64; 3]]) -> f64 {
    let sides = points.windows(2);
    sides
        .map(|pair| DVec3::from(pair[0]).distance(pair[1].into()))
        .sum()
}
