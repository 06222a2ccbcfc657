//! Pictures that are small as files and huge when decoded.

use std::fs;
use std::io::Write as _;

use super::{assert_render_refused, with_sky, with_texture};
use crate::sandbox::Sandbox;

/// Makes a black grey PNG of one bit per pixel, which takes a few kilobytes at any size.
fn black_png(width: u32, height: u32) -> Vec<u8> {
    let mut idat = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    let row = vec![0; 1 + width.div_ceil(8) as usize];
    for _ in 0..height {
        idat.write_all(&row).unwrap();
    }
    let mut ihdr = [width.to_be_bytes(), height.to_be_bytes()].concat();
    ihdr.extend([1, 0, 0, 0, 0]);
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in [
        (b"IHDR", ihdr),
        (b"IDAT", idat.finish().unwrap()),
        (b"IEND", Vec::new()),
    ] {
        let mut crc = flate2::Crc::new();
        crc.update(kind);
        crc.update(&data);
        png.extend((data.len() as u32).to_be_bytes());
        png.extend(kind);
        png.extend(&data);
        png.extend(crc.sum().to_be_bytes());
    }
    png
}

/// Makes the header of an uncompressed EXR file without its pixels. Its parameters are `channels` and the corners of
/// both windows.
fn exr_header(channels: &[String], data_window: [i32; 4], display_window: [i32; 4]) -> Vec<u8> {
    let mut list = Vec::new();
    for channel in channels {
        list.extend(channel.as_bytes());
        list.push(0);
        // 32-bit floats, linear, one sample for every pixel.
        for number in [2, 0, 1, 1] {
            list.extend(i32::to_le_bytes(number));
        }
    }
    list.push(0);
    let window = |corners: [i32; 4]| corners.map(i32::to_le_bytes).concat();
    let mut file = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    for (name, kind, value) in [
        ("channels", "chlist", list),
        ("compression", "compression", vec![0]),
        ("dataWindow", "box2i", window(data_window)),
        ("displayWindow", "box2i", window(display_window)),
        ("lineOrder", "lineOrder", vec![0]),
        ("pixelAspectRatio", "float", 1f32.to_le_bytes().to_vec()),
        ("screenWindowCenter", "v2f", vec![0; 8]),
        ("screenWindowWidth", "float", 1f32.to_le_bytes().to_vec()),
    ] {
        file.extend([name.as_bytes(), b"\0", kind.as_bytes(), b"\0"].concat());
        file.extend((value.len() as u32).to_le_bytes());
        file.extend(value);
    }
    file.push(0);
    file
}

#[test]
fn a_small_png_that_decodes_to_a_huge_picture_is_refused() {
    let sandbox = Sandbox::new();
    with_texture(&sandbox, "black.png");
    let png = black_png(16_384, 8_192);
    assert!(png.len() < 50_000, "{} bytes", png.len());
    fs::write(sandbox.path("scenes/plate/black.png"), png).unwrap();
    let found = "is 16384 x 8192, 134217728 texels; allowed: 1 to 67108864; scale it down";
    assert_render_refused(&sandbox, &["plate.mtl:3: texture", "black.png", found]);
}

#[test]
fn small_environments_that_decode_to_huge_pictures_are_refused() {
    let rgb = ["B", "G", "R"].map(str::to_owned);
    let mut many: Vec<String> = (0..4_000).map(|channel| format!("A{channel:04}")).collect();
    many.extend(rgb.clone());
    let whole = |width: i32, height: i32| [0, 0, width - 1, height - 1];
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 60000\n".to_vec();
    for (name, file, found) in [
        ("sky.hdr", hdr, "is 60000 x 30000, 1800000000 texels"),
        (
            "sky.exr",
            exr_header(&rgb, whole(60_000, 30_000), whole(60_000, 30_000)),
            "is 60000 x 30000, 1800000000 texels",
        ),
        (
            "sky.exr",
            exr_header(&rgb, whole(60_000, 30_000), whole(4, 2)),
            "holds 5400000000 values in all its channels and layers",
        ),
        (
            "sky.exr",
            exr_header(&many, whole(512, 256), whole(512, 256)),
            "holds 524681216 values in all its channels and layers",
        ),
    ] {
        let sandbox = Sandbox::new();
        with_sky(&sandbox, name);
        fs::write(sandbox.path("scenes/plate").join(name), file).unwrap();
        assert_render_refused(&sandbox, &["scene.toml:12: the background's image", found]);
    }
}
