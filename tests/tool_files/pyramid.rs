//! One pyramid, written down in every format.

use striae::files::MeshFormat;

/// A square pyramid on its tip, its upper end closed: five vertices, four flanks, one square.
pub(crate) const FLANKS: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
pub(crate) const TOP: [u32; 4] = [4, 3, 2, 1];
pub(crate) const ANGLE_DEG: f64 = 136.0;
pub(crate) const HEIGHT_MM: f64 = 1.0;

/// The pyramid's vertices in units of `mm_per_unit`, off the origin.
pub(crate) fn vertices(mm_per_unit: f64) -> [[f64; 3]; 5] {
    let radius = HEIGHT_MM * (0.5 * ANGLE_DEG).to_radians().tan() / 45_f64.to_radians().cos();
    std::array::from_fn(|i| {
        let angle = (45.0 + 90.0 * (i as f64 - 1.0)).to_radians();
        let corner = [radius * angle.cos(), radius * angle.sin(), HEIGHT_MM];
        let at = if i == 0 { [0.0; 3] } else { corner };
        [at[0] + 3.0, at[1] - 2.0, at[2] + 5.0].map(|mm| mm / mm_per_unit)
    })
}

/// The pyramid as triangles only.
pub(crate) fn triangles() -> Vec<[u32; 3]> {
    let [a, b, c, d] = TOP;
    [FLANKS.as_slice(), &[[a, b, c], [a, c, d]]].concat()
}

/// The same, flanks as triangles and the upper end as a square.
pub(crate) fn faces() -> Vec<Vec<u32>> {
    let flanks = FLANKS.iter().map(|face| face.to_vec());
    flanks.chain([TOP.to_vec()]).collect()
}

pub(crate) fn single(value: f64) -> f32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "files hold single precision"
    )]
    let single = value as f32;
    single
}

pub(crate) fn obj(unit: f64, corner: impl Fn(u32) -> String) -> String {
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

pub(crate) fn stl_text(unit: f64) -> String {
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

pub(crate) fn stl_binary(unit: f64, head: &str) -> Vec<u8> {
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
pub(crate) const PLY_HEAD: &str = "comment by M\u{fc}ller\nelement vertex 5\nproperty uchar red\nproperty float x\n\
    property double y\nproperty float32 z\nproperty list uchar short tags\nelement marker 2\nproperty int id\n\
    element face 5\nproperty uchar kind\nproperty list uchar int vertex_indices\nproperty float quality\nend_header\n";

pub(crate) fn ply_text(unit: f64) -> String {
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

pub(crate) fn ply_binary(unit: f64, big: bool) -> Vec<u8> {
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
pub(crate) fn every_form(unit: f64) -> Vec<(&'static str, Vec<u8>)> {
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

pub(crate) fn format_of(name: &str) -> MeshFormat {
    match name.rsplit('.').next().unwrap().to_lowercase().as_str() {
        "obj" => MeshFormat::Obj,
        "stl" => MeshFormat::Stl,
        _ => MeshFormat::Ply,
    }
}
