//! Scene folders: manifests, models, textures.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::bench::{Bench, OBJ, SCENE, assert_done, assert_refused, stderr};

/// Loads the plate's scene in a process of its own, which renders as little as it can.
#[track_caller]
fn refused(bench: &Bench, parts: &[&str]) {
    assert_refused(&render(bench), 2, parts);
}

fn render(bench: &Bench) -> std::process::Output {
    let words = "render --quiet --scenes plate --size 16x16 --samples-per-pixel 16 --out out";
    bench.shuttertruth(&crate::bench::split(words))
}

fn with_texture(bench: &Bench, name: &str) {
    bench.write(
        "plate.mtl",
        &format!("newmtl paint\nKd 1 1 1\nmap_Kd {name}\n"),
    );
    bench.write("plate.obj", TEXTURED);
}

fn with_sky(bench: &Bench, name: &str) {
    let sky = format!("image = \"{name}\"");
    bench.write(
        "scene.toml",
        &SCENE.replace("constant = [0.2, 0.2, 0.2]", &sky),
    );
}

const TEXTURED: &str = "\
mtllib plate.mtl
v -0.5 -0.5 0
v 0.5 -0.5 0
v 0.5 0.5 0
vt 0 0
vt 1 0
vt 1 1
usemtl paint
f 1/1 2/2 3/3
";

/// A grey PNG of one bit per pixel, all black: a few kilobytes, whatever the size.
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

/// The header of an EXR file without compression, and nothing behind it: `channels` and the corners of both windows.
fn exr_header(channels: &[String], data_window: [i32; 4], display_window: [i32; 4]) -> Vec<u8> {
    let mut list = Vec::new();
    for channel in channels {
        list.extend(channel.as_bytes());
        list.push(0);
        // 32-bit floats, linear, a sample for every pixel.
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
fn a_small_png_that_is_huge_once_decoded_is_refused_from_its_header() {
    let bench = Bench::new();
    with_texture(&bench, "black.png");
    let png = black_png(16_384, 8_192);
    assert!(png.len() < 50_000, "{} bytes", png.len());
    fs::write(bench.path("scenes/plate/black.png"), png).unwrap();
    let found = "is 16384 x 8192, 134217728 texels; allowed: 1 to 67108864; scale it down";
    refused(&bench, &["plate.mtl:3: texture", "black.png", found]);
}

#[test]
fn environments_that_are_huge_once_decoded_are_refused_from_their_headers() {
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
        let bench = Bench::new();
        with_sky(&bench, name);
        fs::write(bench.path("scenes/plate").join(name), file).unwrap();
        refused(&bench, &["scene.toml:12: the background's image", found]);
    }
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_before_it_is_opened() {
    let fifo = |path: &Path| {
        let made = std::process::Command::new("mkfifo").arg(path).status();
        assert!(made.unwrap().success());
    };
    let zero = |path: &Path| std::os::unix::fs::symlink("/dev/zero", path).unwrap();
    let socket = |path: &Path| drop(std::os::unix::net::UnixListener::bind(path).unwrap());
    let folder = |path: &Path| fs::create_dir(path).unwrap();
    type Make<'a> = &'a dyn Fn(&Path);
    let kinds: [(Make, &str); 4] = [
        (&fifo, "it is a FIFO"),
        (&zero, "it is a device"),
        (&socket, "it is a socket"),
        (&folder, "it is a folder"),
    ];
    for (make, found) in kinds {
        for (file, place) in [
            ("scene.toml", "scene.toml: cannot be read"),
            ("plate.obj", "scene.toml:15: mesh"),
            ("plate.mtl", "plate.obj:1: material library"),
            ("paint.png", "plate.mtl:3: texture"),
            ("sky.exr", "scene.toml:12: the background's image"),
        ] {
            let bench = Bench::new();
            match file {
                "paint.png" => with_texture(&bench, file),
                "sky.exr" => with_sky(&bench, file),
                _ => fs::remove_file(bench.path("scenes/plate").join(file)).unwrap(),
            }
            make(&bench.path("scenes/plate").join(file));
            // In this process, since there are so many: a file that is opened after all hangs it.
            let error = tracer::load_scene(&bench.path("scenes/plate"), None).unwrap_err();
            let message = error.to_string();
            for part in [place, found, "where a regular file is expected"] {
                assert!(
                    message.contains(part),
                    "\"{part}\" is missing from: {message}"
                );
            }
        }
    }
}

#[test]
fn a_file_that_is_too_large_is_refused_before_it_is_read() {
    let bench = Bench::new();
    // A hole: no disk is taken.
    let file = fs::File::create(bench.path("scenes/plate/plate.obj")).unwrap();
    file.set_len(tracer::limits::LARGEST_MESH_FILE + 1).unwrap();
    let found = "holds 2147483649 bytes, and at most 2147483648 are read";
    refused(&bench, &["scene.toml:15: mesh", "plate.obj", found]);
}

#[test]
fn a_face_of_too_many_corners_is_refused() {
    let bench = Bench::new();
    let mut obj = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    for corner in 0..40_000 {
        write!(obj, " {}", 1 + corner % 3).unwrap();
    }
    bench.write("plate.obj", &obj);
    let found = "f has 40000 corners; allowed: 3 to 4096; cut the face into triangles";
    refused(&bench, &["plate.obj:4:", found]);
}

/// A scene of the plate and a text behind it.
fn with_more(bench: &Bench, more: impl FnOnce(&mut String)) {
    let mut scene = SCENE.to_owned();
    more(&mut scene);
    bench.write("scene.toml", &scene);
}

fn objects(scene: &mut String, count: usize, rest: impl Fn(usize) -> String) {
    for object in 0..count {
        let rest = rest(object);
        write!(scene, "[object.o{object}]\nmesh = \"plate.obj\"\n{rest}\n").unwrap();
    }
}

/// Each of these took minutes, or grew with the square or the cube of the number; now some 0.2 s. The limit is one for a
/// slow machine that does other things.
#[track_caller]
fn loads_soon<T>(load: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let loaded = load();
    let took = start.elapsed();
    assert!(took < Duration::from_secs(60), "{took:?}");
    loaded
}

#[test]
fn loading_takes_a_time_that_grows_with_the_scenes_size() {
    let bench = Bench::new();
    let load = || loads_soon(|| tracer::load_scene(&bench.path("scenes/plate"), None));

    // 16,000 objects in chains of 250.
    with_more(&bench, |scene| {
        objects(scene, 16_000, |object| match object % 250 {
            0 => String::new(),
            _ => format!("parent = \"o{}\"", object - 1),
        });
    });
    assert_eq!(load().unwrap().objects.len(), 16_001);

    // 4,000 variants, each of which changes an object that the others do not.
    with_more(&bench, |scene| {
        objects(scene, 4_000, |_| String::new());
        for variant in 0..4_000 {
            write!(scene, "[variant.v{variant}.object.o{variant}]\nscale = 2\n").unwrap();
        }
    });
    assert_eq!(load().unwrap().objects.len(), 4_001);
    let listings = loads_soon(|| tracer::list_scenes(&bench.path("scenes")).unwrap());
    assert_eq!(listings[0].variants.len(), 4_000);

    // 30,000 groups of as many materials, and 200 objects that show them all.
    let mut obj = OBJ.replace("usemtl paint\n", "");
    let mut mtl = String::new();
    for group in 0..30_000 {
        let corner = 5 + group;
        write!(
            obj,
            "v 0 0 {group}\ng g{group}\nusemtl m{group}\nf 1 2 {corner}\n"
        )
        .unwrap();
        write!(mtl, "newmtl m{group}\nKd 0 0 0\n").unwrap();
    }
    bench.write("plate.obj", &obj);
    bench.write("plate.mtl", &mtl);
    with_more(&bench, |scene| objects(scene, 200, |_| String::new()));
    assert_eq!(load().unwrap().meshes.len(), 1);
}

#[test]
fn a_chain_of_too_many_parents_is_refused_without_recursion() {
    let bench = Bench::new();
    with_more(&bench, |scene| {
        objects(scene, 10_000, |object| match object {
            0 => String::new(),
            _ => format!("parent = \"o{}\"", object - 1),
        });
    });
    let found = "object \"o257\" has 257 parents above it; allowed: 256; attach it to one nearer to the world";
    refused(&bench, &["scene.toml:791:", found]);

    // All in one circle.
    with_more(&bench, |scene| {
        objects(scene, 10_000, |object| {
            format!("parent = \"o{}\"", (object + 1) % 10_000)
        });
    });
    let found = "the parents of objects form a cycle: o0 -> o1 -> o2 -> o3 -> o4 -> o5 -> o6 -> o7 -> ... -> o9993";
    refused(&bench, &["scene.toml:22:", found]);
}

#[test]
fn too_many_of_anything_are_refused() {
    let bench = Bench::new();
    with_more(&bench, |scene| objects(scene, 16_384, |_| String::new()));
    let found = "the scene has 16385 objects; allowed: 16384";
    refused(&bench, &["scene.toml:", found]);

    with_more(&bench, |scene| {
        for variant in 0..4_097 {
            write!(scene, "[variant.v{variant}]\nexposure = 1\n").unwrap();
        }
    });
    let found = "the scene has 4097 variants; allowed: 4096; move some to a folder of their own";
    refused(&bench, &["scene.toml:", found]);

    let mut keys = String::new();
    for key in 0..16_385 {
        write!(keys, "{{ time = {key} }},").unwrap();
    }
    with_more(&bench, |scene| {
        objects(scene, 1, |_| format!("keys = [{keys}]"));
    });
    let found = "object \"o0\" has 16385 keys; allowed: 1 to 16384";
    refused(&bench, &["scene.toml:22:", found]);
}

#[test]
fn a_long_list_of_names_is_cut_in_messages() {
    let bench = Bench::new();
    with_more(&bench, |scene| {
        objects(scene, 5_000, |_| String::new());
        *scene += "[object.last]\nmesh = \"plate.obj\"\nparent = \"nobody\"\n";
    });
    let output = render(&bench);
    assert_refused(&output, 2, &["allowed: camera, plate, o0, o1", "4961 more"]);
    assert!(stderr(&output).len() < 1_000);
}

#[test]
fn a_text_that_nests_without_end_is_refused() {
    let bench = Bench::new();
    for text in [
        format!("a = {}", "[".repeat(200_000)),
        format!("a = {}", "{a=".repeat(200_000)),
        format!("[{}a]\n", "a.".repeat(200_000)),
        format!("{}a = 1\n", "a.".repeat(200_000)),
    ] {
        bench.write("scene.toml", &text);
        refused(
            &bench,
            &["scene.toml:", "nested too deeply; allowed: up to 80"],
        );
    }
}

#[test]
fn a_folder_whose_name_moves_the_cursor_is_refused() {
    let bench = Bench::new();
    bench.copy_scene("turn\u{1b}[31med", |scene| {
        scene.replace("exposure = 0.5", "exposure = 1")
    });
    let found = "the folder's name is the scene's, and it holds the control character U+001B";
    let output = bench.shuttertruth(&["list"]);
    assert_refused(&output, 2, &[found, "rename the folder"]);
}

#[test]
fn letters_of_other_languages_are_allowed() {
    let bench = Bench::new();
    bench.copy_scene("été_桜", |scene| {
        scene.replace("nothing: it serves", "Ничего: it serves")
    });
    let name = "scenes/été_桜";
    let scene = tracer::load_scene(&bench.path(name), None).unwrap();
    assert_eq!(scene.name, "été_桜");
}

#[cfg(unix)]
#[test]
fn a_scene_that_cannot_be_read_is_named_and_not_passed_over() {
    let message = |bench: &Bench| {
        let error = tracer::list_scenes(&bench.path("scenes")).unwrap_err();
        error.to_string()
    };
    let link = std::os::unix::fs::symlink::<&str, std::path::PathBuf>;

    // A folder that is gone.
    let bench = Bench::new();
    link("nowhere", bench.path("scenes/moved")).unwrap();
    let found = message(&bench);
    assert!(found.contains("scenes/moved: cannot be read"), "{found}");

    // A scene.toml that is gone, and one that is a folder.
    let bench = Bench::new();
    fs::create_dir(bench.path("scenes/half")).unwrap();
    assert_eq!(tracer::list_scenes(&bench.path("scenes")).unwrap().len(), 1);
    link("nowhere", bench.path("scenes/half/scene.toml")).unwrap();
    let found = message(&bench);
    assert!(found.contains("half/scene.toml: cannot be read"), "{found}");
    fs::remove_file(bench.path("scenes/half/scene.toml")).unwrap();
    fs::create_dir(bench.path("scenes/half/scene.toml")).unwrap();
    let found = message(&bench);
    assert!(found.contains("it is a folder"), "{found}");
}

#[test]
fn files_outside_of_the_scenes_folder_are_read() {
    let bench = Bench::new();
    fs::create_dir(bench.path("shared")).unwrap();
    for file in ["plate.obj", "plate.mtl"] {
        fs::rename(
            bench.path("scenes/plate").join(file),
            bench.path("shared").join(file),
        )
        .unwrap();
    }
    let elsewhere = toml::Value::from(bench.path("shared/plate.obj").to_string_lossy().as_ref());
    for mesh in [
        "\"../../shared/plate.obj\"".to_owned(),
        elsewhere.to_string(),
    ] {
        bench.write("scene.toml", &SCENE.replace("\"plate.obj\"", &mesh));
        assert_done(&render(&bench));
    }
}

#[test]
fn odd_models_are_refused_or_read_but_never_panic() {
    let odd = [
        "",
        "\0",
        "f",
        "f 1",
        "f 1 2 3",
        "v",
        "v 1 2",
        "v 1e999 0 0",
        "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2/ 3/",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1// 2// 3//",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1000000000 2 3",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no\ng\nf 3 2 1",
        "mtllib",
        "mtllib plate.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "mtllib ../plate/plate.mtl\nmtllib plate.mtl",
        "mtllib /",
        "usemtl",
        "usemtl paint",
        "\u{feff}v 0 0 0",
        "v\u{2028}0 0 0",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
        "l 1 2 3\np 1\nvp 1 2\ncurv 0 1 1 2\nend",
        "v 0 0 0 nan nan nan\nv 1 0 0\nv 0 1 0\nf 1 2 3",
    ];
    let long = [
        "v ".repeat(1_000_000),
        "f ".to_owned() + &"1/".repeat(1_000_000),
        "o ".to_owned() + &"x".repeat(1_000_000),
        "#".repeat(1_000_000),
        "1".repeat(1_000_000),
        "v ".to_owned() + &"1".repeat(1_000_000) + " 0 0",
    ];
    let bench = Bench::new();
    let scene = bench.path("scenes/plate");
    for text in odd.into_iter().chain(long.iter().map(String::as_str)) {
        for (file, good) in [("plate.obj", OBJ), ("plate.mtl", crate::bench::MTL)] {
            for text in [
                text.to_owned(),
                format!("{good}{text}\n"),
                format!("{text}\n{good}"),
            ] {
                bench.write(file, &text);
                if let Err(error) = tracer::load_scene(&scene, None) {
                    let length = error.to_string().len();
                    assert!(length < 1_000, "a message of {length} bytes");
                }
            }
            bench.write(file, good);
        }
    }
}

/// Rows of the table: a number, and the constant that holds it as `NAME` in `path`.
#[test]
fn the_page_of_limits_says_what_the_constants_say() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let read = |path: &str| fs::read_to_string(root.join(path)).unwrap();
    let page = read("docs/limits.md");
    let rows: Vec<Vec<&str>> = (page.lines())
        .filter(|line| line.starts_with("| ") && line.contains("` in `"))
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    for row in &rows {
        let written: f64 = row[2].replace(',', "").parse().unwrap();
        let place: Vec<&str> = row[4].split('`').collect();
        let (name, path) = (place[1], place[3]);
        let source = read(path);
        let declared = source
            .split_once(&format!("const {name}:"))
            .unwrap_or_else(|| panic!("{path} has no constant {name}"));
        let (_, value) = declared.1.split_once('=').unwrap();
        let (value, _) = value.split_once(';').unwrap();
        assert_eq!(written, number(value), "{name} in {path}");
    }
    let source = read("crates/tracer/src/limits.rs");
    for line in source.lines().filter(|line| line.starts_with("pub const")) {
        let name = line.split([' ', ':']).nth(2).unwrap();
        let named = rows.iter().any(|row| row[4].contains(&format!("`{name}`")));
        assert!(named, "docs/limits.md lacks {name}");
    }
}

/// A product of numbers as Rust writes them, or a shifted 1.
fn number(text: &str) -> f64 {
    let text = text.trim().replace('_', "");
    match text.split_once("<<") {
        Some((one, bits)) => number(one) * number(bits).exp2(),
        None => (text
            .split('*')
            .map(|factor| factor.trim().parse::<f64>().unwrap()))
        .product(),
    }
}
