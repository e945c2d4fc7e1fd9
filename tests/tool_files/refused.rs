//! Broken, empty and lying files, each with the text it is answered with.

use crate::pyramid::*;
use striae::files::tool_from_bytes;

/// The message that the bytes are refused with.
pub(crate) fn refusal(name: &str, bytes: &[u8]) -> String {
    match tool_from_bytes(bytes, format_of(name), 1.0) {
        Ok(_) => panic!("{name} was taken: {}", String::from_utf8_lossy(bytes)),
        Err(error) => {
            assert_eq!(error.argument(), None, "{error}");
            error.to_string()
        }
    }
}

fn check_refusals(name: &str, cases: &[(Vec<u8>, &str)]) {
    for (bytes, expected) in cases {
        let message = refusal(name, bytes);
        assert!(
            message.contains(expected) && message.contains("accepted: "),
            "{name}: {message:?} lacks {expected:?}"
        );
    }
}

const VERTICES: &str = "v 0 0 0\nv 1 0 1\nv 0 1 1\n";

#[test]
fn bad_obj() {
    let with = |rest: &str| [VERTICES, rest].concat().into_bytes();
    check_refusals(
        "a.obj",
        &[
            (vec![], "holds no bytes"),
            (b"v 0 0 0\n".to_vec(), "holds no faces, and 1 vertices"),
            (
                b"f 1 2 3\n".to_vec(),
                "line 1: a face names the vertex 3, of 0",
            ),
            (
                b"v 0 nan 0\n".to_vec(),
                "line 1: \"nan\" is not a finite number",
            ),
            (
                b"v 0 0 0\nv 0 -inf 0".to_vec(),
                "line 2: \"-inf\" is not a finite",
            ),
            (
                b"v 0 1e999 0".to_vec(),
                "line 1: \"1e999\" is not a finite number",
            ),
            (b"v 1 2".to_vec(), "line 1: a vertex with 2 coordinates"),
            (
                b"v 1 2 3 0.5".to_vec(),
                "line 1: a vertex of weight \"0.5\"",
            ),
            (b"v 1 \xff 3".to_vec(), "is not a finite number"),
            (
                with("f 1 2 4\n"),
                "line 4: a face names the vertex 4, of 3; accepted: 1 to 3",
            ),
            (with("f 1 2 0\n"), "line 4: a face names the vertex 0"),
            (with("f 1 2 -4\n"), "line 4: a face names the vertex -4"),
            (
                with("f 1 2 -9223372036854775808\n"),
                "names the vertex -9223372036854775808",
            ),
            (
                with("f 1 2 9223372036854775807\n"),
                "names the vertex 9223372036854775807",
            ),
            (
                with("f 1 2 4294967296\n"),
                "line 4: a face names the vertex 4294967296",
            ),
            (
                with("f 1 2 99999999999999999999\n"),
                "is not a corner of a face",
            ),
            (with("f 1 2 x\n"), "line 4: \"x\" is not a corner"),
            (with("f 1 2 /3\n"), "line 4: \"/3\" is not a corner"),
            (with("f 1 2\n"), "line 4: a face with 2 corners"),
            (with("f\n"), "line 4: a face with 0 corners"),
            (with("f 1 2 \\"), "line 4: a face with 2 corners"),
            (
                b"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3".to_vec(),
                "size_mm is 0",
            ),
            (
                b"v 0 0 0\nv 9e6 0 0\nv 0 1 1\nf 1 2 3".to_vec(),
                "size_mm is 9000000",
            ),
            (
                b"v 0 0 0\nv 1e99 0 0\nv 0 1 1\nf 1 2 3".to_vec(),
                "positions[1] is",
            ),
            (
                ["# ", &"x".repeat(1 << 21)].concat().into_bytes(),
                "line 1: a line of 2097154 bytes",
            ),
        ],
    );
}

#[test]
pub(crate) fn bad_stl() {
    let binary = stl_binary(1.0, "");
    let text = stl_text(1.0);
    let claiming = |count: u32| {
        let mut bytes = binary.clone();
        bytes[80..84].copy_from_slice(&count.to_le_bytes());
        bytes
    };
    let with = |value: f32| {
        let mut bytes = binary.clone();
        bytes[96 + 50..100 + 50].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let all_equal = [&binary[..80], &1_u32.to_le_bytes(), &[0; 50]].concat();
    let text_with = |from: &str, to: &str| text.replacen(from, to, 1).into_bytes();
    check_refusals(
        "a.stl",
        &[
            (vec![], "holds no bytes"),
            (b"hello".to_vec(), "holds 5 bytes"),
            (
                claiming(u32::MAX),
                "byte 80: claims 4294967295 triangles, holds 6",
            ),
            (claiming(7), "byte 80: claims 7 triangles, holds 6"),
            (claiming(5), "byte 80: claims 5 triangles, holds 6"),
            ([&binary[..80], &[0; 4]].concat(), "holds no faces"),
            (with(f32::NAN), "byte 134: a coordinate is NaN"),
            (with(f32::NEG_INFINITY), "byte 134: a coordinate is -inf"),
            (all_equal, "size_mm is 0"),
            (b"solid\nendsolid\n".to_vec(), "holds no faces"),
            (b"solid".to_vec(), "line 1: the file ends within a solid"),
            (text_with("vertex", "vertx"), "line 4: \"vertx "),
            (
                text_with("vertex 3e0 -2e0 5e0", "vertex 3e0"),
                "line 4: a vertex with 1 coordinates",
            ),
            (
                text_with("5e0", "5e0 7"),
                "line 4: \"7\" after three coordinates",
            ),
            (
                text_with("endfacet", "facet"),
                "line 8: \"facet\" does not belong here",
            ),
            (
                text_with(" endloop", "vertex 0 0 0"),
                "line 7: \"vertex 0 0 0\" does not",
            ),
            (
                text_with("vertex 3e0", "vertex nan"),
                "line 4: \"nan\" is not a finite",
            ),
            (
                text_with("vertex 3e0", "vertex 1e400"),
                "line 4: \"1e400\" is not a finite",
            ),
        ],
    );
}

#[test]
pub(crate) fn bad_ply() {
    let text = ply_text(1.0);
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1).into_bytes()
    };
    let head = |lines: &str| format!("ply\nformat ascii 1.0\n{lines}end_header\n").into_bytes();
    let binary = |lines: &str, body: &[u8]| {
        let head = format!("ply\nformat binary_little_endian 1.0\n{lines}end_header\n");
        [head.as_bytes(), body].concat()
    };
    let xyz = "property float x\nproperty float y\nproperty float z\n";
    let list = "property list uint int vertex_indices\n";
    let one_face = format!("element face 1\n{list}");
    check_refusals(
        "a.ply",
        &[
            (vec![], "holds no bytes"),
            (b"plx\n".to_vec(), "line 1: begins with \"plx\""),
            (b"ply\nformat ascii 1.0\n".to_vec(), "a header without end"),
            (b"ply\nend_header\n".to_vec(), "in the header"),
            (
                with("float32 z", "quad z"),
                "line 8: \"property quad z\" in the header",
            ),
            (
                with("ascii", "morse"),
                "line 2: \"format morse 1.0\" in the header",
            ),
            (
                with("vertex 5", "vertex 99999999999999999999"),
                "line 4: \"element vertex 9",
            ),
            (head(""), "holds no faces, and 0 vertices"),
            (
                with("vertex 5", "vertex 5000"),
                "claims 5000 of element vertex, with",
            ),
            (
                with("face 5", "face 4000000000"),
                "claims 4000000000 of element face",
            ),
            (
                with("face 5", "face 6"),
                "line 28: the file ends in face 5 of the 6",
            ),
            (
                with("vertex 5", "vertex 6"),
                "line 22: \"17\" is not what the header says",
            ),
            (
                with("float x", "float a"),
                "an element vertex without x, y and z",
            ),
            (
                with("float x", "list int int x"),
                "an element vertex without x, y and z",
            ),
            (
                with("vertex_indices", "corners"),
                "an element face without a list of its",
            ),
            (with("red", "z"), "with the same name"),
            (with("marker", "vertex"), "with the same name"),
            (with("255 3 ", "255 nan "), "line 17: \"255 nan "),
            (with("255 3 ", "255 1e60 "), "line 17: a coordinate is inf"),
            (
                with("3 3 0 1 2", "3 3 0 1 5"),
                "the vertex 5, of 5; accepted: 0 to 4",
            ),
            (
                with("3 3 0 1 2", "3 3 0 1 -1"),
                "line 24: a face with a corner that is negative",
            ),
            (
                with("3 3 0 1 2", "3 2 0 1"),
                "line 24: a face with 2 corners",
            ),
            (
                with("3 3 0 1 2", "3 4000000000 0 1 2"),
                "line 24: \"3 4000000000 0 1 2",
            ),
            (
                head("element vertex 4\n"),
                "4 elements vertex without properties",
            ),
            (
                binary("element dot 9000000000000\n", b""),
                "without properties",
            ),
            (
                binary(
                    &format!("element vertex 18446744073709551615\n{xyz}"),
                    &[0; 120],
                ),
                "claims 18446744073709551615 of element vertex, with 120 bytes left",
            ),
            (
                binary(&one_face, &[0xff, 0xff, 0xff, 0xff, 1, 0, 0, 0]),
                "the file ends in face 0 of the 1 that it claims",
            ),
            (
                binary(&one_face.replace("uint", "char"), &[0xff, 0, 0, 0, 0]),
                "face 0 is not what the header says",
            ),
            (
                binary(
                    &one_face.replace("int v", "float v"),
                    &[1, 0, 0, 0, 0, 0, 0, 0],
                ),
                "a corner that is negative or not whole",
            ),
            (
                binary(
                    &format!("element vertex 1\n{xyz}"),
                    &f32::NAN.to_le_bytes().repeat(3),
                ),
                "byte 115: a coordinate is NaN",
            ),
        ],
    );
}
