//! Inputs that are large, or claim to be. They are made when needed.

use std::fmt::Write as _;
use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::mutation::push_chunk;

const VERTICES: &str = "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\n";

/// Makes the same face 10,000 times: no split of a tree separates them.
pub fn identical_faces() -> Vec<u8> {
    (VERTICES.to_owned() + &"f 1 2 3\n".repeat(10_000)).into_bytes()
}

/// Makes the same glowing face 6,000 times, each a light.
pub fn identical_lights() -> Vec<u8> {
    let text = VERTICES.replace("paint", "glow");
    (text + &"f 1 2 3\n".repeat(6_000)).into_bytes()
}

/// Makes 200,000 triangles in one place, each with vertices of its own.
pub fn coincident_triangles() -> Vec<u8> {
    let mut text = VERTICES.to_owned();
    for triangle in 1..=200_000 {
        let first = 3 * triangle + 1;
        let _ = writeln!(
            text,
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf {first} {} {}",
            first + 1,
            first + 2
        );
    }
    text.into_bytes()
}

/// Makes 20,000 faces whose corners lie on one line.
pub fn faces_without_area() -> Vec<u8> {
    (VERTICES.to_owned() + "v 2 0 0\nf 1 2 3\n" + &"f 1 2 4\n".repeat(20_000)).into_bytes()
}

/// Makes a face of 40,000 corners on a circle.
pub fn face_of_many_corners() -> Vec<u8> {
    let mut text = String::from("mtllib mesh.mtl\nusemtl paint\n");
    let mut face = String::from("f");
    for corner in 0..40_000 {
        let (y, x) = (f64::from(corner) / 40_000.0 * std::f64::consts::TAU).sin_cos();
        let _ = writeln!(text, "v {x} {y} 0");
        let _ = write!(face, " {}", corner + 1);
    }
    (text + &face + "\n").into_bytes()
}

/// Makes one line of 10 MB.
pub fn line_without_end() -> Vec<u8> {
    ("v ".to_owned() + &"0".repeat(10_000_000)).into_bytes()
}

const SCENE: &str = "exposes = \"x\"\nfamily = \"limits\"\nexposure = 0.5\nsize = [16, 16]\ncamera = { position = [0, 0, 5], \
                     look_at = [0, 0, 0], vertical_fov = 40 }\nbackground = { constant = [0, 0, 0] }\n";

/// Makes 10,000 objects at one pose.
pub fn objects_at_one_pose() -> Vec<u8> {
    objects(10_000, |_| String::new())
}

/// Makes 3,000 objects, each the parent of the next.
pub fn chain_of_parents() -> Vec<u8> {
    objects(3_000, |index| match index {
        0 => String::new(),
        _ => format!("parent = \"o{}\"\n", index - 1),
    })
}

/// Makes 2,000 variants.
pub fn many_variants() -> Vec<u8> {
    let mut text = objects(1, |_| String::new());
    for index in 0..2_000 {
        let _ = writeln!(text, "[variant.v{index}]\nexposure = 0.25");
    }
    text
}

/// Makes an object that moves by 100,000 keys.
pub fn many_keys() -> Vec<u8> {
    objects(1, |_| {
        let keys: Vec<String> = (0..100_000)
            .map(|key| format!("{{ time = {key} }}"))
            .collect();
        format!("keys = [{}]\n", keys.join(", "))
    })
}

fn objects(count: usize, more: impl Fn(usize) -> String) -> Vec<u8> {
    let mut text = SCENE.to_owned();
    for index in 0..count {
        let _ = write!(
            text,
            "[object.o{index}]\nmesh = \"mesh.obj\"\n{}",
            more(index)
        );
    }
    text.into_bytes()
}

/// Nests tables in TOML.
pub fn deep_toml() -> Vec<u8> {
    let depth = 100_000;
    format!("exposes = {}1{}", "[".repeat(depth), "]".repeat(depth)).into_bytes()
}

/// Makes a table whose name has 50,000 parts.
pub fn long_key() -> Vec<u8> {
    format!("a{} = 1", ".a".repeat(50_000)).into_bytes()
}

/// Nests lists in JSON.
pub fn deep_json() -> Vec<u8> {
    let depth = 100_000;
    format!("{}{}", "[".repeat(depth), "]".repeat(depth)).into_bytes()
}

/// Makes a sum of 20,000 terms, which is a tree of that depth.
pub fn long_sum() -> Vec<u8> {
    kernel(&format!("let x = 1.0{};", " + 1.0".repeat(20_000)))
}

/// Nests 20,000 brackets.
pub fn deep_brackets() -> Vec<u8> {
    kernel(&format!(
        "let x = {}1.0{};",
        "(".repeat(20_000),
        ")".repeat(20_000)
    ))
}

/// Nests 20,000 blocks.
pub fn deep_blocks() -> Vec<u8> {
    kernel(&("{".repeat(20_000) + &"}".repeat(20_000)))
}

/// Makes 5,000 conditions in a row.
pub fn long_condition() -> Vec<u8> {
    kernel(&format!(
        "if pixel.x > 0 {{}} {}",
        "else if pixel.x > 1 {} ".repeat(5_000)
    ))
}

/// Makes 20,000 signs before a number.
pub fn many_signs() -> Vec<u8> {
    kernel(&format!("let x = {}1.0;", "- ".repeat(20_000)))
}

/// Nests types.
pub fn deep_type() -> Vec<u8> {
    kernel(&format!(
        "var x: {}f32{};",
        "array<".repeat(20_000),
        ", 1>".repeat(20_000)
    ))
}

fn kernel(body: &str) -> Vec<u8> {
    format!(
        "@group(0) @binding(1) var color: texture_2d<f32>;\n\
         @group(0) @binding(2) var output: texture_storage_2d<rgba32float, write>;\n\
         @compute @workgroup_size(8, 8)\nfn copy(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         let pixel = vec2<i32>(id.xy);\n{body}\n\
         if inside(pixel) {{ textureStore(output, pixel, textureLoad(color, pixel, 0)); }}\n}}\n"
    )
    .into_bytes()
}

/// Makes a PNG of 20,000 by 20,000 pixels of one bit, in about 50 KB.
pub fn png_bomb() -> Vec<u8> {
    let side = 20_000;
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::fast());
    let row = vec![0; 1 + side / 8];
    for _ in 0..side {
        packed.write_all(&row).unwrap();
    }
    png(side as u32, 1, &packed.finish().unwrap())
}

/// Makes a PNG that claims 60,000 by 60,000 pixels of 64 bits, and ends.
pub fn png_that_boasts() -> Vec<u8> {
    png(60_000, 16, &[])
}

/// Makes a PNG with a text that unpacks to 1 GB.
pub fn png_with_packed_text() -> Vec<u8> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::fast());
    let megabyte = vec![b'a'; 1 << 20];
    for _ in 0..200 {
        packed.write_all(&megabyte).unwrap();
    }
    let text = [b"key\0\0".as_slice(), &packed.finish().unwrap()].concat();
    let mut file = png(1, 8, &[]);
    push_chunk(&mut file, *b"zTXt", &text);
    file
}

/// Makes a square of grey or, at 16 bits, of colour with alpha.
fn png(side: u32, depth: u8, packed: &[u8]) -> Vec<u8> {
    let kind = match depth {
        16 => 6,
        _ => 0,
    };
    let sides = side.to_be_bytes();
    let header = [sides.as_slice(), &sides, &[depth, kind, 0, 0, 0]].concat();
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    push_chunk(&mut file, *b"IHDR", &header);
    push_chunk(&mut file, *b"IDAT", packed);
    push_chunk(&mut file, *b"IEND", &[]);
    file
}

/// Makes a sky of 200,000 by 100,000 pixels that ends after its header.
pub fn hdr_that_boasts() -> Vec<u8> {
    b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 200000\n\x02\x02\x80\x00".to_vec()
}

/// Makes a sky of 32,766 by 16,383 pixels in run lengths: 127 pixels in two bytes.
pub fn hdr_bomb() -> Vec<u8> {
    let (width, height) = (32_766_usize, 16_383_usize);
    let mut row = vec![2, 2, (width >> 8) as u8, width as u8];
    for _ in 0..4 {
        let mut left = width;
        while left > 0 {
            let run = left.min(127);
            row.extend([128 + run as u8, 128]);
            left -= run;
        }
    }
    let mut file =
        format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    // The file claims 2 GB of pixels and holds a hundredth of them.
    for _ in 0..height / 100 {
        file.extend(&row);
    }
    file
}

/// Makes an OpenEXR file whose window has 2^31 pixels on either side.
pub fn exr_that_boasts() -> Vec<u8> {
    let window = |x: i32, y: i32| {
        let mut bytes = [0_i32, 0].map(i32::to_le_bytes).concat();
        bytes.extend([x, y].map(i32::to_le_bytes).concat());
        bytes
    };
    let channel = |name: &str| {
        let mut bytes = name.as_bytes().to_vec();
        bytes.push(0);
        bytes.extend([2_i32, 0, 1, 1].map(i32::to_le_bytes).concat());
        bytes
    };
    let mut channels = ["B", "G", "R"].map(channel).concat();
    channels.push(0);
    let attributes: [(&str, &str, Vec<u8>); 8] = [
        ("channels", "chlist", channels),
        ("compression", "compression", vec![0]),
        ("dataWindow", "box2i", window(2_000_000, 2_000_000)),
        ("displayWindow", "box2i", window(2_000_000, 2_000_000)),
        ("lineOrder", "lineOrder", vec![0]),
        ("pixelAspectRatio", "float", 1_f32.to_le_bytes().to_vec()),
        ("screenWindowCenter", "v2f", vec![0; 8]),
        ("screenWindowWidth", "float", 1_f32.to_le_bytes().to_vec()),
    ];
    let mut file = vec![0x76, 0x2F, 0x31, 0x01, 2, 0, 0, 0];
    for (name, kind, value) in attributes {
        file.extend(format!("{name}\0{kind}\0").into_bytes());
        file.extend((value.len() as u32).to_le_bytes());
        file.extend(value);
    }
    file.push(0);
    file.extend([0; 64]);
    file
}
