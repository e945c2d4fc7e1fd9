//! Tools from files: the same pyramid in every format, and what is not a tool.

use peak_alloc::PeakAlloc;
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::fs;
use std::path::{Path, PathBuf};
use striae::brdf::Metal;
use striae::files::{MeshFormat, read_tool, tool_from_bytes};
use striae::formation::{CrossSection, Material, Orientation, Process, Tool};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// A square pyramid on its tip, its upper end closed: five vertices, four flanks, one square.
const FLANKS: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
const TOP: [u32; 4] = [4, 3, 2, 1];
const ANGLE_DEG: f64 = 136.0;
const HEIGHT_MM: f64 = 1.0;

/// The pyramid's vertices in units of `mm_per_unit`, off the origin.
fn vertices(mm_per_unit: f64) -> [[f64; 3]; 5] {
    let radius = HEIGHT_MM * (0.5 * ANGLE_DEG).to_radians().tan() / 45_f64.to_radians().cos();
    std::array::from_fn(|i| {
        let angle = (45.0 + 90.0 * (i as f64 - 1.0)).to_radians();
        let corner = [radius * angle.cos(), radius * angle.sin(), HEIGHT_MM];
        let at = if i == 0 { [0.0; 3] } else { corner };
        [at[0] + 3.0, at[1] - 2.0, at[2] + 5.0].map(|mm| mm / mm_per_unit)
    })
}

/// The pyramid as triangles only.
fn triangles() -> Vec<[u32; 3]> {
    let [a, b, c, d] = TOP;
    [FLANKS.as_slice(), &[[a, b, c], [a, c, d]]].concat()
}

/// The same, flanks as triangles and the upper end as a square.
fn faces() -> Vec<Vec<u32>> {
    let flanks = FLANKS.iter().map(|face| face.to_vec());
    flanks.chain([TOP.to_vec()]).collect()
}

fn single(value: f64) -> f32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "files hold single precision"
    )]
    let single = value as f32;
    single
}

fn obj(unit: f64, corner: impl Fn(u32) -> String) -> String {
    let mut text = "# a pyramid\nmtllib C:\\tools\\\no pyramid\n".to_owned();
    for [x, y, z] in vertices(unit) {
        text += &format!("v {x} {y} {z}\n");
    }
    text += "vt 0.5\nvn 0 0 1\ng faces\nusemtl\n";
    for face in faces() {
        let corners: Vec<String> = face.iter().map(|&i| corner(i)).collect();
        text += &format!("f {}\n", corners.join(" "));
    }
    text
}

fn stl_text(unit: f64) -> String {
    let vertices = vertices(unit);
    let facet = |triangle: &[u32; 3]| {
        let corner = |&i: &u32| {
            let [x, y, z] = vertices[i as usize];
            format!("vertex {x:e} {y:e} {z:e}\n")
        };
        let corners: String = triangle.iter().map(corner).collect();
        format!("facet normal nan nan nan\n outer loop\n{corners} endloop\nendfacet\n")
    };
    let triangles = triangles();
    let solid = |part: &[[u32; 3]]| part.iter().map(facet).collect::<String>();
    format!(
        "solid\n{}endsolid\nsolid upper end\n{}endsolid upper end\n",
        solid(&triangles[..4]),
        solid(&triangles[4..])
    )
}

fn stl_binary(unit: f64, head: &str) -> Vec<u8> {
    let mut bytes = head.as_bytes().to_vec();
    bytes.resize(80, b' ');
    let triangles = triangles();
    bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        for i in triangle {
            for value in vertices(unit)[i as usize] {
                bytes.extend(single(value).to_le_bytes());
            }
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// Extra properties before, between and after, and an element that is no mesh's.
const PLY_HEAD: &str = "comment by M\u{fc}ller\nelement vertex 5\nproperty uchar red\nproperty float x\n\
    property double y\nproperty float32 z\nproperty list uchar short tags\nelement marker 2\nproperty int id\n\
    element face 5\nproperty uchar kind\nproperty list uchar int vertex_indices\nproperty float quality\nend_header\n";

fn ply_text(unit: f64) -> String {
    let mut text = format!("ply\nformat ascii 1.0\n{PLY_HEAD}");
    for [x, y, z] in vertices(unit) {
        text += &format!("255 {x} {y} {z} 2 -1 1\n");
    }
    text += "17\n-18\n";
    for face in faces() {
        let corners: Vec<String> = face.iter().map(u32::to_string).collect();
        text += &format!("3 {} {} 0.5\n", face.len(), corners.join(" "));
    }
    text
}

fn ply_binary(unit: f64, big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!("ply\r\nformat binary_{order}_endian 1.0\r\n{PLY_HEAD}").into_bytes();
    let mut put = |mut number: Vec<u8>| {
        if big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for [x, y, z] in vertices(unit) {
        put(vec![255]);
        put(single(x).to_le_bytes().to_vec());
        put(y.to_le_bytes().to_vec());
        put(single(z).to_le_bytes().to_vec());
        put(vec![2]);
        put((-1_i16).to_le_bytes().to_vec());
        put(1_i16.to_le_bytes().to_vec());
    }
    put(17_i32.to_le_bytes().to_vec());
    put((-18_i32).to_le_bytes().to_vec());
    for face in faces() {
        put(vec![3]);
        put(vec![u8::try_from(face.len()).unwrap()]);
        face.iter().for_each(|i| put(i.to_le_bytes().to_vec()));
        put(0.5_f32.to_le_bytes().to_vec());
    }
    bytes
}

/// The pyramid in every form, under the name that its reader goes by.
fn every_form(unit: f64) -> Vec<(&'static str, Vec<u8>)> {
    let triple = |i: u32| format!("{}/1/1", i + 1);
    let from_the_end = |i: u32| format!("{}//-1", i64::from(i) - 5);
    vec![
        ("plain.obj", obj(unit, |i| (i + 1).to_string()).into_bytes()),
        (
            "triples.obj",
            obj(unit, triple).replace('\n', "\r\n").into_bytes(),
        ),
        ("from_the_end.OBJ", obj(unit, from_the_end).into_bytes()),
        (
            "joined.obj",
            obj(unit, |i| format!("\\\n{} \\\n", i + 1)).into_bytes(),
        ),
        ("text.stl", stl_text(unit).into_bytes()),
        ("capitals.stl", stl_text(unit).to_uppercase().into_bytes()),
        ("binary.STL", stl_binary(unit, "a pyramid")),
        ("solid.stl", stl_binary(unit, "solid pyramid")),
        ("text.ply", ply_text(unit).into_bytes()),
        ("little.ply", ply_binary(unit, false)),
        ("big.Ply", ply_binary(unit, true)),
    ]
}

fn format_of(name: &str) -> MeshFormat {
    match name.rsplit('.').next().unwrap().to_lowercase().as_str() {
        "obj" => MeshFormat::Obj,
        "stl" => MeshFormat::Stl,
        _ => MeshFormat::Ply,
    }
}

/// A folder of this test's own, gone at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("striae-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, bytes).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn section(tool: &Tool) -> striae::Result<CrossSection> {
    let process = Process {
        force_kgf: 2.0,
        orientation: Orientation {
            spin_deg: 20.0,
            tilt_deg: 8.0,
            azimuth_deg: 130.0,
        },
        ..Default::default()
    };
    CrossSection::form(tool, &process, &Material::metal(Metal::Titanium))
}

/// Depth, width and area of what a tool leaves.
fn measures(tool: &Tool) -> [f64; 3] {
    let section = section(tool).unwrap();
    [
        section.depth_mm(),
        section.groove_width_mm(),
        section.groove_area_mm2(),
    ]
}

/// In every format, unit and spelling the pyramid leaves what the built-in one leaves.
#[test]
fn one_pyramid_in_every_format() {
    let folder = Folder::new("formats");
    let truth = measures(&Tool::pyramid(4, ANGLE_DEG, HEIGHT_MM).unwrap());
    for mm_per_unit in [1.0, 25.4, 1000.0] {
        for (name, bytes) in every_form(mm_per_unit) {
            let path = folder.file(name, &bytes);
            let tool = read_tool(&path, mm_per_unit).unwrap_or_else(|error| panic!("{error}"));
            for (ours, truth) in measures(&tool).into_iter().zip(truth) {
                let off = (ours / truth - 1.0).abs();
                assert!(off < 2e-5, "{name}, {mm_per_unit}: {ours} against {truth}");
            }
        }
    }
}

/// A file in another unit is another tool.
#[test]
fn the_unit_counts() {
    let bytes = stl_binary(1.0, "");
    let [mm, inch] = [1.0, 25.4].map(|unit| tool_from_bytes(&bytes, MeshFormat::Stl, unit));
    assert_ne!(mm.unwrap(), inch.unwrap(), "the unit has no effect");
    let error = tool_from_bytes(&bytes, MeshFormat::Stl, 0.0).unwrap_err();
    assert_eq!(error.argument(), Some("mm_per_unit"));
    assert!(error.to_string().starts_with("mm_per_unit is 0"), "{error}");
}

/// The message that the bytes are refused with.
fn refusal(name: &str, bytes: &[u8]) -> String {
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
fn bad_stl() {
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
fn bad_ply() {
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

/// What a file claims costs no memory that it does not hold.
#[test]
fn claims_cost_nothing() {
    MEMORY.reset_peak_usage();
    bad_stl();
    bad_ply();
    let peak = MEMORY.peak_usage();
    // Other tests run at the same time; each of these claims would be gigabytes.
    assert!(peak < 64 << 20, "{peak} bytes");
}

/// A file that tells its end is refused wherever it is cut.
#[test]
fn cut_anywhere() {
    let joined = stl_text(1.0).replace("endsolid\nsolid upper end\n", "");
    let refuse_all = |name: &str, bytes: &[u8], sure: usize| {
        for end in 0..sure {
            refusal(name, &bytes[..end]);
        }
    };
    refuse_all(
        "joined.stl",
        joined.as_bytes(),
        joined.len() - "olid upper end\n".len(),
    );
    for (name, bytes) in every_form(1.0) {
        match name {
            "binary.STL" | "solid.stl" | "little.ply" | "big.Ply" => {
                refuse_all(name, &bytes, bytes.len());
            }
            // The last number may lose its last digits and stay a number.
            "text.ply" => refuse_all(name, &bytes, bytes.len() - ".5\n".len()),
            _ => {}
        }
    }
}

/// Noise, and files with a few wrong bytes: refused or taken, and what is taken can be used.
#[test]
fn noise() {
    let mut random = StdRng::seed_from_u64(3);
    let mut taken = 0;
    let mut attempt = |name: &str, bytes: &[u8]| {
        if let Ok(tool) = tool_from_bytes(bytes, format_of(name), 1.0) {
            taken += 1;
            let _ = section(&tool);
        }
    };
    for _ in 0..3000 {
        let mut bytes = vec![0; random.random_range(0..400)];
        random.fill(bytes.as_mut_slice());
        for (name, start) in [
            ("a.obj", ""),
            ("a.stl", ""),
            ("a.stl", "solid a\nfacet normal 0 0 0\n"),
            ("a.ply", "ply\nformat ascii 1.0\n"),
            (
                "a.ply",
                "ply\nformat binary_big_endian 1.0\nelement face 9\n",
            ),
        ] {
            attempt(name, &[start.as_bytes(), &bytes].concat());
        }
    }
    let forms = every_form(1.0);
    for _ in 0..1000 {
        for (name, bytes) in &forms {
            let mut bytes = bytes.clone();
            for _ in 0..random.random_range(1..6) {
                let at = random.random_range(0..bytes.len());
                match random.random_range(0..3) {
                    0 => bytes[at] = random.random(),
                    1 => drop(bytes.remove(at)),
                    _ => bytes.insert(at, b"0123456789-. \n/e"[random.random_range(0..16)]),
                }
            }
            attempt(name, &bytes);
        }
    }
    assert!(taken > 1000, "{taken}");
}

/// What the file system answers is said with the file's name.
#[test]
fn what_is_no_file() {
    let folder = Folder::new("no-file");
    let says = |path: &Path, expected: &str| {
        let message = read_tool(path, 1.0).unwrap_err().to_string();
        assert!(message.contains(expected), "{message:?} lacks {expected:?}");
    };
    says(
        &folder.0.join("none.stl"),
        "none.stl: is not there; accepted: ",
    );
    fs::create_dir(folder.0.join("folder.obj")).unwrap();
    says(
        &folder.0.join("folder.obj"),
        "folder.obj: is a folder; accepted: a file",
    );
    says(
        &folder.file("tool.3mf", b"PK"),
        "tool.3mf: a name that ends otherwise",
    );
    says(
        &folder.file("tool", b"PK"),
        "accepted: names that end in .obj, .stl or .ply",
    );
    says(&folder.file("empty.ply", b""), "empty.ply: holds no bytes");
    says(
        &folder.file("bad.obj", b"\nf 1"),
        "bad.obj: line 2: a face with 1 corners",
    );
    // A sparse file: it takes no room.
    let huge = folder.file("huge.stl", b"solid");
    let file = fs::OpenOptions::new().write(true).open(&huge).unwrap();
    file.set_len((1 << 30) + 1).unwrap();
    says(
        &huge,
        "huge.stl: holds 1073741825 bytes; accepted: at most 1073741824",
    );
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", folder.0.join("endless.stl")).unwrap();
        says(&folder.0.join("endless.stl"), "is a pipe or a device");
    }
}
