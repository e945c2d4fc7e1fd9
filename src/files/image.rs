//! Images that carry numbers: hardness from PNG and EXR.

use super::error::{FileError, Place, Result};
use super::read::read;
use crate::error::in_range;
use crate::formation::HardnessMap;
use exr::prelude::{ReadChannels, ReadLayers};
use std::io::Cursor;
use std::path::Path;

/// Most texels that are read.
const MOST_TEXELS: usize = 1 << 26;

/// More texels than this for each byte of a file are not believed: no compression packs that tightly.
const MOST_TEXELS_PER_BYTE: usize = 2048;

/// One channel of an image, row by row from the top.
struct Gray {
    values: Vec<f32>,
    width: usize,
    height: usize,
}

/// A hardness map from an image over u and v from 0 to 1, its top row at v = 1: PNG or EXR, by what the file
/// holds.
///
/// Of a PNG the first channel counts, 0 to its largest value meaning 0 to 1, without any colour management; of an
/// EXR the channel Y, else R, else the first one, as it is. A value x means `range_hv[0] + x (range_hv[1] -
/// range_hv[0])`, each end 0.01 to 20000. At most 2^26 texels and 1 GiB.
///
/// Errors: a file that cannot be read, or that is neither, broken or too large; what [`HardnessMap::texture`] refuses.
pub fn read_hardness(path: &Path, range_hv: [f64; 2]) -> Result<HardnessMap> {
    in_range("range_hv[0]", range_hv[0], 0.01, 20_000.0)?;
    in_range("range_hv[1]", range_hv[1], 0.01, 20_000.0)?;
    read(path)
        .and_then(|bytes| hardness_from_bytes(&bytes, range_hv))
        .map_err(|error| error.in_file(path))
}

/// As [`read_hardness`], from a file's content.
pub fn hardness_from_bytes(bytes: &[u8], range_hv: [f64; 2]) -> Result<HardnessMap> {
    let Gray {
        values,
        width,
        height,
    } = if bytes.starts_with(b"\x89PNG") {
        from_png(bytes)?
    } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        from_exr(bytes)?
    } else {
        return Err(FileError::new(
            Place::Byte(0),
            "no image's beginning",
            "a PNG or EXR image",
        ));
    };
    HardnessMap::texture(&values, width, height, range_hv).map_err(FileError::unusable)
}

fn check_size(width: usize, height: usize, bytes: usize) -> Result<()> {
    let texels = width
        .checked_mul(height)
        .filter(|texels| *texels <= MOST_TEXELS);
    if texels.is_some_and(|texels| texels / MOST_TEXELS_PER_BYTE <= bytes) {
        return Ok(());
    }
    let found = format!("claims {width} x {height} texels in {bytes} bytes");
    let accepted = "at most 2^26 texels, and no more than its bytes can hold";
    Err(FileError::new(Place::Whole, found, accepted))
}

fn broken(error: impl core::fmt::Display) -> FileError {
    FileError::new(
        Place::Whole,
        error.to_string(),
        "a PNG or EXR image in one piece",
    )
}

fn from_png(bytes: &[u8]) -> Result<Gray> {
    let limits = png::Limits {
        bytes: 8 * MOST_TEXELS,
    };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    // Palettes and 1, 2 or 4 bits become 8 bits; 16 stay.
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    check_size(width, height, bytes.len())?;
    let size = reader
        .output_buffer_size()
        .ok_or_else(|| broken("too large"))?;
    let mut samples = vec![0; size];
    let frame = reader.next_frame(&mut samples).map_err(broken)?;
    let channels = frame.color_type.samples();
    let values = match frame.bit_depth {
        png::BitDepth::Sixteen => {
            let wide = |pair: &[u8]| f32::from(u16::from_be_bytes([pair[0], pair[1]])) / 65_535.0;
            samples
                .chunks_exact(2)
                .step_by(channels)
                .map(wide)
                .collect()
        }
        _ => samples
            .iter()
            .step_by(channels)
            .map(|&byte| f32::from(byte) / 255.0)
            .collect(),
    };
    Ok(Gray {
        values,
        width,
        height,
    })
}

fn from_exr(bytes: &[u8]) -> Result<Gray> {
    let about =
        exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(broken)?;
    for header in &about.headers {
        check_size(
            header.layer_size.width(),
            header.layer_size.height(),
            bytes.len(),
        )?;
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    let layer = image.layer_data;
    let channels = &layer.channel_data.list;
    let named = |name: &str| channels.iter().find(|channel| channel.name.eq(name));
    let channel = named("Y").or_else(|| named("R")).or(channels.first());
    let channel = channel.ok_or_else(|| broken("holds no channel"))?;
    let values: Vec<f32> = channel.sample_data.values_as_f32().collect();
    let (width, height) = (layer.size.width(), layer.size.height());
    if values.len() != width * height {
        return Err(broken("a channel with fewer samples than texels"));
    }
    Ok(Gray {
        values,
        width,
        height,
    })
}
