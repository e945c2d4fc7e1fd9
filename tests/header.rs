//! `include/striae.h` is what the source says. `STRIAE_BLESS=1` writes it anew.

use std::path::Path;

#[test]
fn header_is_fresh() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    // In the order of their use.
    let sources = [
        "status",
        "tool",
        "host_brdf",
        "brdf",
        "material",
        "cross_section",
        "plot",
        "hardness",
        "surface",
        "pattern",
        "generator",
        "svg",
        "relief_mesh",
        "files",
        "shading",
        "near",
        "hits",
        "sampling",
        "zones",
        "many",
        "baseline",
    ];
    let builder = sources
        .iter()
        .fold(cbindgen::Builder::new(), |builder, name| {
            builder.with_src(root.join(format!("src/capi/{name}.rs")))
        });
    let mut bytes = Vec::new();
    builder
        .with_config(config)
        .generate()
        .unwrap()
        .write(&mut bytes);
    let fresh = String::from_utf8(bytes).unwrap();
    let path = root.join("include/striae.h");
    if std::env::var_os("STRIAE_BLESS").is_some() {
        std::fs::write(&path, &fresh).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == fresh,
        "include/striae.h is stale: STRIAE_BLESS=1 cargo test --test header"
    );
}

/// The header's version macros are the crate's version.
#[test]
fn versions_agree() {
    use striae::capi::{STRIAE_VERSION_MAJOR, STRIAE_VERSION_MINOR, STRIAE_VERSION_PATCH};
    let macros = format!("{STRIAE_VERSION_MAJOR}.{STRIAE_VERSION_MINOR}.{STRIAE_VERSION_PATCH}");
    assert_eq!(macros, env!("CARGO_PKG_VERSION"));
}
