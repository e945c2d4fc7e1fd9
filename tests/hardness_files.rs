//! Hardness maps from PNG and EXR images.

use striae::files::{hardness_from_bytes, read_hardness};

const RANGE_HV: [f64; 2] = [100.0, 300.0];

/// A PNG of 16-bit gray, 3 x 2.
fn png_bytes() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let values = [0_u16, 65_535, 0, 32_768, 16_384, 0];
    let samples: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_be_bytes())
        .collect();
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&samples).unwrap();
    writer.finish().unwrap();
    bytes
}

/// The same numbers as an EXR, in its red channel.
fn exr_bytes() -> Vec<u8> {
    use exr::prelude::*;
    let values = [
        [0.0, 1.0, 0.0],
        [32_768.0 / 65_535.0, 16_384.0 / 65_535.0, 0.0_f32],
    ];
    let pixels = move |at: Vec2<usize>| (values[at.y()][at.x()], 7.0_f32, 9.0_f32);
    let image = Image::from_channels((3, 2), SpecificChannels::rgb(pixels));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

/// Texel centres of both kinds of file give their own values, the top row at v = 1.
#[test]
fn both_kinds_say_the_same() {
    for bytes in [png_bytes(), exr_bytes()] {
        let map = hardness_from_bytes(&bytes, RANGE_HV).unwrap();
        for (uv, hardness_hv) in [
            ([0.5, 0.75], 300.0),
            ([1.0 / 6.0, 0.25], 200.0),
            ([0.5, 0.25], 150.0),
        ] {
            let ours = map.at(uv);
            assert!(
                (ours - hardness_hv).abs() < 0.01,
                "{uv:?}: {ours} against {hardness_hv}"
            );
        }
    }
}

/// Truncated, foreign and missing files, and ranges out of bounds, are refused with a text; never a panic.
#[test]
fn bad_images_are_refused() {
    for bytes in [png_bytes(), exr_bytes()] {
        for length in 0..bytes.len() - 12 {
            assert!(
                hardness_from_bytes(&bytes[..length], RANGE_HV).is_err(),
                "cut at {length}"
            );
        }
    }
    let refused = |bytes: &[u8]| {
        hardness_from_bytes(bytes, RANGE_HV)
            .unwrap_err()
            .to_string()
    };
    assert!(refused(b"GIF89a").contains("a PNG or EXR image"), "foreign");
    let mut huge = png_bytes();
    huge[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    assert!(!refused(&huge).is_empty(), "huge");
    let nowhere = read_hardness("no/such.png".as_ref(), RANGE_HV)
        .unwrap_err()
        .to_string();
    assert!(nowhere.contains("such.png"), "{nowhere}");
    let range = hardness_from_bytes(&png_bytes(), [0.0, 300.0])
        .unwrap_err()
        .to_string();
    assert!(range.contains("range_hv[0] is 0"), "{range}");
}
