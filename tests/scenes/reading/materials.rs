//! Materials and textures from MTL and picture files.

use glam::{Vec2, Vec3};
use scene::{Material, Scene, Translucency};

use crate::{Folder, OBJ, SCENE};

#[test]
fn a_material_can_change_for_one_object_only() {
    let scene = Folder::new().load().unwrap();
    let paint =
        |object: usize, slot: usize| &scene.materials[scene.objects[object].materials[slot]];
    assert_eq!(paint(0, 0).diffuse, Vec3::new(0.5, 0.6, 0.7));
    assert_eq!(paint(1, 1).diffuse, Vec3::new(0.1, 0.2, 0.3));
    // Everything else stays unchanged.
    assert_eq!(paint(1, 1).diffuse_texture, Some(0));
    let glow = paint(0, 1);
    assert_eq!(glow.emission, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(glow.opacity, 0.25);
}

#[test]
fn faces_without_a_material_are_grey() {
    let folder = Folder::new();
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    let text = SCENE.replace("group = \"left\"\n", "");
    folder.write(
        "scene.toml",
        text.replace("material.paint", "material.default"),
    );
    let scene = folder.load().unwrap();
    assert_eq!(scene.meshes[0].normals, []);
    assert_eq!(scene.materials[0].name, "default");
    assert_eq!(scene.materials[0].diffuse, Vec3::splat(0.5));
}

#[test]
fn texture_colours_are_decoded_and_opacities_are_not() {
    let folder = Folder::new();
    let color = "map_Kd dots.png";
    folder.edit("mesh.mtl", color, &format!("{color}\nmap_d dots.png"));
    let scene = folder.load().unwrap();
    let paint = scene.materials.iter().find(|m| m.name == "paint").unwrap();
    let color = &scene.textures[paint.diffuse_texture.unwrap()];
    let opacity = &scene.textures[paint.opacity_texture.unwrap()];
    assert_eq!((color.width, color.height), (2, 1));
    // 128 of 255 is 0.215861 in IEC 61966-2-1; 1e-6 is the rounding of 32-bit floats.
    assert!((color.texels[0][0] - 0.215_861).abs() < 1e-6);
    assert_eq!(color.texels[0][1..], [0.0, 1.0, 1.0]);
    assert_eq!(opacity.texels[0][3], 128.0 / 255.0);
    assert_eq!(opacity.texels[1][3], 1.0);
}

#[test]
fn a_jpeg_is_a_texture_too_and_a_name_from_windows_finds_it() {
    let folder = Folder::new();
    // One colour, so that the compression loses nothing: 128 of 255.
    let grey = image::GrayImage::from_pixel(16, 8, image::Luma([128]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    grey.write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
    std::fs::create_dir(folder.path.join("paints")).unwrap();
    folder.write("paints/grey.jpg", bytes.into_inner());
    folder.edit("mesh.mtl", "map_Kd dots.png", "map_Kd paints\\grey.jpg");
    let scene = folder.load().unwrap();
    let paint = scene.materials.iter().find(|m| m.name == "paint").unwrap();
    let color = &scene.textures[paint.diffuse_texture.unwrap()];
    assert_eq!((color.width, color.height), (16, 8));
    for texel in &color.texels {
        assert!((texel[0] - 0.215_861).abs() < 1e-6, "{texel:?}");
        assert_eq!(*texel, [texel[0], texel[0], texel[0], 1.0]);
    }
}

#[test]
fn a_textures_factor_is_one_unless_given() {
    let folder = Folder::new();
    let paint = "newmtl paint\nmap_Kd dots.png\nmap_Ke dots.png\nnewmtl glow\n";
    folder.write("mesh.mtl", paint);
    let scene = folder.load().unwrap();
    let material = |name| scene.materials.iter().find(|m| m.name == name).unwrap();
    assert_eq!(material("paint").diffuse, Vec3::ONE);
    assert_eq!(material("paint").emission, Vec3::ONE);
    assert_eq!(material("glow").diffuse, Vec3::splat(0.5));
    assert_eq!(material("glow").emission, Vec3::ZERO);
}

/// Loads the second object's materials `paint` and `glow`, its opacity blended, with more MTL
/// statements for `paint`.
fn load_blended(statements: &str, keys: &str) -> [Material; 2] {
    let folder = Folder::new();
    let paint = "newmtl paint\n";
    folder.edit("mesh.mtl", paint, &format!("{paint}{statements}\n"));
    let parent = "parent = \"body\"";
    let blended = format!("{parent}\nalpha = \"blended\"");
    folder.edit("scene.toml", parent, &blended);
    folder.edit("scene.toml", "diffuse = [0.1, 0.2, 0.3]", keys);
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let first = &scene.materials[scene.objects[0].materials[0]];
    assert_eq!(first.translucency, None, "the first object is cut out");
    let materials = scene.objects[1].materials.iter();
    let materials: Vec<&Material> = materials.map(|index| &scene.materials[*index]).collect();
    ["paint", "glow"].map(|name| {
        let material = materials.iter().find(|material| material.name == name);
        (*material.expect("it is there")).clone()
    })
}

#[test]
fn blended_opacity_lets_light_pass_and_other_objects_keep_their_holes() {
    let film = |filter: [f32; 3]| Translucency {
        filter: filter.into(),
        ..Translucency::CLEAR
    };
    let (clear, amber) = (Some(film([1.0; 3])), Some(film([0.5, 1.0, 0.25])));
    let glass = |index| {
        let glass = Some(index);
        amber.map(|amber| Translucency { glass, ..amber })
    };
    let (pane, clear_glass) = (
        "d 0\nTf 0.5 1 0.25\nillum 4",
        "opacity = 0\nthin_glass = true",
    );
    for (statements, keys, expected) in [
        // Opaque everywhere.
        ("", "", None),
        ("Tf 0.5 1 0.25", "", None),
        ("d 0.5", "", clear),
        ("d 0.25\nTr 0.75\nTf 0.5 1 0.25", "", amber),
        ("map_d dots.png", "", clear),
        (pane, "", glass(1.5)),
        ("d 0\nTf 0.5 1 0.25\nillum 4\nNi 1.3", "", glass(1.3)),
        // Other models have no effect.
        ("d 0\nTf 0.5 1 0.25\nillum 2\nNi 1.3", "", amber),
        // Glass of index 1 reflects nothing.
        ("d 0\nTf 0.5 1 0.25\nillum 4\nNi 1", "", amber),
        ("", "opacity = 0.5\nfilter = [0.5, 1, 0.25]", amber),
        ("Tf 0.5 1 0.25", clear_glass, glass(1.5)),
        (pane, "index_of_refraction = 1.8", glass(1.8)),
        (pane, "thin_glass = false", amber),
    ] {
        let [paint, glow] = load_blended(statements, keys);
        assert_eq!(paint.translucency, expected, "{statements} then {keys}");
        let glow = glow.translucency;
        assert_eq!(glow, Some(Translucency::CLEAR), "its d is 0.25");
    }
}

/// Loads the scene with other text in its files; returns it, and the index of the material `paint`.
fn load_paint(obj: [&str; 2], mtl: [&str; 2], prepare: impl Fn(&Folder)) -> (Scene, usize) {
    let folder = Folder::new();
    folder.edit("mesh.obj", obj[0], obj[1]);
    folder.edit("mesh.mtl", mtl[0], mtl[1]);
    prepare(&folder);
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let paint = scene
        .materials
        .iter()
        .position(|material| material.name == "paint");
    (scene, paint.expect("it is there"))
}

const OLD: [&str; 2] = ["mtllib mesh.mtl", "mtllib mesh.mtl"];
const SAME: [&str; 2] = ["newmtl paint", "newmtl paint"];

#[test]
fn options_of_a_texture_scale_and_move_it() {
    let texcoords = |options: &str| {
        let map = format!("map_Kd {options} dots.png");
        let (scene, paint) = load_paint(OLD, ["map_Kd dots.png", &map], |_| {});
        assert_eq!(scene.materials[paint].diffuse_texture, Some(0));
        let mesh = &scene.meshes[0];
        {
            let notes = scene
                .notes
                .into_iter()
                .filter(|note| note.contains("option"));
            let texcoord = mesh.texcoords[mesh.triangles[0][2] as usize];
            (texcoord, notes.collect::<Vec<String>>())
        }
    };
    for (options, due) in [
        ("-blendu off -texres 512", [1.0, 1.0]),
        ("-s 4 3 1", [4.0, 3.0]),
        ("-s 2", [2.0, 1.0]),
        ("-o 0.25 0.5 0 -s 2 2 2", [2.25, 2.5]),
        ("-clamp off -bm 1 -o -1 0", [0.0, 1.0]),
        ("-mm 0 1 -cc off -boost 0 -type sphere", [1.0, 1.0]),
    ] {
        let (texcoord, notes) = texcoords(options);
        assert_eq!((texcoord, notes), (Vec2::from(due), vec![]), "{options}");
    }
    for option in [
        "-clamp on",
        "-mm 0.1 2",
        "-cc on",
        "-boost 2",
        "-t 1 1 1",
        "-imfchan r",
    ] {
        let (texcoord, notes) = texcoords(option);
        let name = option.split(' ').next().unwrap();
        let due = format!("mesh.mtl:3: map_Kd's option {name} is not read");
        assert!(
            texcoord == Vec2::ONE && notes[0].ends_with(&due),
            "{notes:?}"
        );
    }
}

#[test]
fn several_libraries_are_read_from_one_statement_and_each_once() {
    let more = |folder: &Folder| {
        folder.write("my old.mtl", "newmtl old\n");
        folder.write("plain.MTL", "newmtl plain\n");
    };
    for names in [
        "my old.mtl plain.MTL mesh.mtl",
        ".\\mesh.mtl",
        "mesh.mtl mesh.mtl",
        "mesh.mtl\nmtllib mesh.mtl",
    ] {
        let statement = format!("mtllib {names}");
        load_paint(["mtllib mesh.mtl", &statement], SAME, more);
    }
    let folder = Folder::new();
    folder.edit("mesh.obj", "mtllib mesh.mtl", "mtllib mesh.mtl gone.mtl");
    let error = folder.load().expect_err("a library is missing");
    assert!(
        error.line == Some(1) && error.reason.contains("gone.mtl"),
        "{error}"
    );
}

#[test]
fn statements_of_materials_are_read_as_other_programs_read_them() {
    let read = |statement: &str| {
        let text = format!("newmtl paint\n{statement}");
        let (scene, paint) = load_paint(OLD, ["newmtl paint\nKd 0.5 0.6 0.7", &text], |_| {});
        scene.materials[paint].clone()
    };
    let plain = read("Kd 0.5 0.6 0.7");
    for statement in [
        "Kd 0.5 0.6 0.7 # blue",
        "\tKd\t0.5 \\\n0.6 0.7",
        "Kd 0.5 0.6 0.7 1",
        "Ka 1\nKs 2\nKd 0.5 0.6 0.7",
    ] {
        assert_eq!(read(statement), plain, "{statement}");
    }
    // A name may have backslashes and blanks, and may look like a comment.
    let name = "Set\\Paint\\old  #2";
    let folder = Folder::new();
    folder.write(
        "mesh.obj",
        OBJ.replace("usemtl paint", &format!("usemtl\t{name} ")),
    );
    folder.edit("mesh.mtl", "newmtl paint", &format!("newmtl {name}"));
    folder.edit(
        "scene.toml",
        "material.paint",
        &format!("material.'{name}'"),
    );
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.materials[0].name, name);
}

#[test]
fn a_translucent_material_is_noted_until_the_scene_says_what_its_opacity_means() {
    let notes = |opacity: &str, alpha: &str| {
        let folder = Folder::new();
        folder.edit("mesh.mtl", "d 0.25", opacity);
        let whole = "[object.body]\n";
        folder.edit("scene.toml", whole, &format!("{whole}{alpha}\n"));
        let left = "parent = \"body\"";
        folder.edit("scene.toml", left, &format!("{left}\n{alpha}"));
        folder
            .load()
            .unwrap_or_else(|error| panic!("{error}"))
            .notes
    };
    for (opacity, what) in [
        ("d 0.25", "a hole"),
        ("d 0.75", "opaque"),
        ("d 0\nillum 4", "a hole"),
    ] {
        let said = notes(opacity, "");
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].contains(what) && said[0].contains("alpha = \"blended\""),
            "{said:?}"
        );
        for alpha in ["blended", "cutout"] {
            assert_eq!(notes(opacity, &format!("alpha = \"{alpha}\"")), [""; 0]);
        }
    }
    for opacity in ["d 1", "d 0", "map_d dots.png"] {
        assert_eq!(notes(opacity, ""), [""; 0]);
    }
}
