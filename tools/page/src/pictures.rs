//! Three panels side by side, as a comparison writes them (ours, the judge's, their difference), and what the eye makes of them.

use std::error::Error;
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

const PANELS: usize = 3;
/// Pixels between panels, before a picture is enlarged.
const GUTTER: usize = 2;

/// Mean absolute difference of the first two panels over the second's mean.
pub fn difference(sheet: &Path) -> Result<f64> {
    let image = exr::prelude::read_first_rgba_layer_from_file(
        sheet,
        |size, _| (size.width(), vec![[0.0_f32; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b]
        },
    )?;
    let (width, pixels) = &image.layer_data.channel_data.pixels;
    let panel = panel_width(*width, 1)?;
    let (mut apart, mut mean) = (0.0, 0.0);
    for row in pixels.chunks(*width) {
        for (ours, judge) in row[..panel].iter().zip(&row[panel + GUTTER..]) {
            for (a, b) in ours.iter().zip(judge) {
                apart += f64::from(a - b).abs();
                mean += f64::from(*b);
            }
        }
    }
    Ok(apart / mean)
}

/// Writes the FLIP map (Andersson et al. 2020) of the first two panels of a sheet enlarged so many times; the map's mean.
pub fn write_flip(sheet: &Path, enlarged: usize, map: &Path) -> Result<f64> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(sheet)?)).read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large a picture")?];
    let info = reader.next_frame(&mut bytes)?;
    if info.color_type != png::ColorType::Rgb || info.bit_depth != png::BitDepth::Eight {
        return Err("not a picture of 8-bit RGB".into());
    }
    let (width, height) = (info.width as usize, info.height as usize);
    let panel = panel_width(width, enlarged)?;
    let panels = [0, panel + GUTTER * enlarged].map(|first| {
        let rows = bytes.chunks(3 * width).take(height);
        rows.flat_map(|row| row[3 * first..3 * (first + panel)].iter().copied())
            .collect::<Vec<u8>>()
    });
    let (columns, rows) = (u32::try_from(panel)?, info.height);
    let [ours, judge] =
        panels.map(|panel| nv_flip::FlipImageRgb8::with_data(columns, rows, &panel));
    let error = nv_flip::flip(judge, ours, nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    let values = error.to_vec();
    let mean = values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len() as f64;
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(map)?), columns, rows);
    encoder.set_color(png::ColorType::Rgb);
    let visible = error.apply_color_lut(&nv_flip::magma_lut()).to_vec();
    encoder.write_header()?.write_image_data(&visible)?;
    Ok(mean)
}

fn panel_width(width: usize, enlarged: usize) -> Result<usize> {
    let panels = width
        .checked_sub((PANELS - 1) * GUTTER * enlarged)
        .filter(|left| left % PANELS == 0);
    Ok(panels.ok_or("not a picture of three panels")? / PANELS)
}
