//! From SVG to PNG, by resvg.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};
use std::sync::{Arc, LazyLock};

/// The only fonts there are: no plot depends on what a machine has installed.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(include_bytes!("font/NotoSans-Regular.ttf").to_vec());
    fonts.load_font_data(include_bytes!("font/NotoSans-Bold.ttf").to_vec());
    Arc::new(fonts)
});

/// The pixels of a plot's SVG as a PNG file's content.
pub(super) fn rasterised(svg: &str) -> Vec<u8> {
    let options = Options {
        fontdb: FONTS.clone(),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).expect("a plot's SVG is well formed");
    let size = tree.size().to_int_size();
    let mut pixels =
        Pixmap::new(size.width(), size.height()).expect("a plot's size lies in its range");
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    pixels.encode_png().expect("memory can be written to")
}
