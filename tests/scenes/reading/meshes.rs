//! Meshes, groups and key shapes from OBJ files.

use glam::{Vec2, Vec3};
use scene::{Scene, load_scene};

use crate::{Folder, MTL, OBJ};

#[test]
fn a_group_is_a_mesh_of_its_own_and_faces_keep_their_materials() {
    let scene = Folder::new().load().unwrap();
    let [whole, left] = [0, 1].map(|object| &scene.meshes[scene.objects[object].mesh]);
    assert_eq!((whole.triangles.len(), left.triangles.len()), (5, 3));
    assert_eq!(whole.slots, [0, 0, 1, 1, 0]);
    assert_eq!(left.slots, [0, 0, 1]);
    for (at, due) in [(0, ["paint", "glow"]), (1, ["glow", "paint"])] {
        let materials = scene.objects[at].materials.iter();
        let names = materials.map(|index| &scene.materials[*index].name);
        assert!(names.eq(&due));
    }
    // Normals have unit length.
    assert_eq!(whole.normals, vec![Vec3::Z; whole.positions.len()]);
    assert_eq!(whole.texcoords[1], Vec2::new(1.0, 0.0));
    assert_eq!(whole.positions[whole.triangles[0][1] as usize], Vec3::X);
}

#[test]
fn objects_of_one_mesh_share_it() {
    let folder = Folder::new();
    folder.edit("scene.toml", "group = \"left\"\n", "");
    let scene = folder.load().unwrap();
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!((scene.objects[0].mesh, scene.objects[1].mesh), (0, 0));
}

#[test]
fn other_spellings_of_a_mesh_load_the_same() {
    let plain = Folder::new().load().unwrap();
    let spaced = |text: &str| {
        text.replace("paint", "old  red paint")
            .replace("mesh.mtl", "my mesh.mtl")
    };
    let folder = Folder::new();
    folder.write("my mesh.mtl", spaced(MTL).replace('\n', "\r\n"));
    let written_otherwise = [
        ("f 1/1/1 2/2/1 3/3/1", "f -6/-3/-1 -5/-2/-1 -4/-1/-1"),
        ("usemtl old", "  usemtl \t old"),
        ("v 1 1 0", "v 2 2 0 2"),
        ("v 0 1 0", "v 0 1 0 0.5 0.5 0.5"),
        ("g left", "l 1 2 3\n\n# faces on the left\n o left"),
        ("\n", "\r\n"),
    ];
    let replace = |text: String, (from, to): (&str, &str)| text.replace(from, to);
    folder.write(
        "mesh.obj",
        written_otherwise.into_iter().fold(spaced(OBJ), replace),
    );
    let renamed = "material.\"old  red paint\"";
    folder.edit("scene.toml", "material.paint", renamed);
    let other = folder.load().unwrap_or_else(|error| panic!("{error}"));
    assert_equal_meshes(&plain, &other);
    assert!(other.materials.iter().any(|m| m.name == "old  red paint"));
}

#[test]
fn faces_without_normals_are_flat_beside_smooth_ones() {
    let folder = Folder::new();
    let without = "usemtl paint\nf 1/1/1 4/2/1 6/3/1";
    folder.edit("mesh.obj", without, "usemtl paint\nf 1/1 6/3 4/2");
    let scene = folder.load().unwrap();
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    let last = mesh.triangles.last().unwrap();
    // Clockwise seen from +Z.
    let normals = last.map(|corner| mesh.normals[corner as usize]);
    assert_eq!(normals, [Vec3::NEG_Z; 3]);
    assert_eq!(mesh.texcoords[last[1] as usize], Vec2::ONE);
}

/// Returns the square with its corner (1, 1) elsewhere, and other indices for the same normals.
fn bent_obj() -> String {
    OBJ.replace("v 1 1 0", "v 3 5 0")
        .replace("vn 0 0 2", "vn 0 0 2\nvn 0 0 3")
        .replace("3/3/1 4/2/1", "3/3/2 4/2/1")
}

const SHAPES: &str =
    "shapes = [{ time = -1, mesh = \"mesh.obj\" }, { time = 1, mesh = \"bent.obj\" }]";

/// Makes a scene with a second shape for the mesh that this key follows.
fn deforming(bent: String, key: &str) -> Folder {
    let folder = Folder::new();
    folder.write("bent.obj", bent);
    let mesh = format!("mesh = \"mesh.obj\"\n{key}");
    folder.edit("scene.toml", &mesh, &format!("{SHAPES}\n{key}"));
    folder
}

#[test]
fn key_shapes_are_one_mesh_that_deforms() {
    let scene = deforming(bent_obj(), "keys").load().unwrap();
    let mesh = &scene.meshes[scene.objects[0].mesh];
    let times: Vec<f64> = mesh.shapes.iter().map(|shape| shape.time).collect();
    assert_eq!(times, [-1.0, 1.0]);
    assert_eq!(mesh.positions, mesh.shapes[0].positions);
    assert_eq!(mesh.triangles.len(), 5);
    for triangle in &mesh.triangles {
        for vertex in triangle.map(|vertex| vertex as usize) {
            let [from, to] = [0, 1].map(|shape| mesh.shapes[shape].positions[vertex]);
            let corner = Vec3::new(1.0, 1.0, 0.0);
            let bent = Vec3::new(3.0, 5.0, 0.0);
            assert_eq!(to, if from == corner { bent } else { from });
        }
    }
    for shape in &mesh.shapes {
        assert_eq!(shape.normals, vec![Vec3::Z; mesh.positions.len()]);
    }
    assert_eq!(mesh.texcoords.len(), mesh.positions.len());
    // Another object shows a group of the first file unchanged.
    assert!(scene.meshes[scene.objects[1].mesh].shapes.is_empty());
}

#[test]
fn a_group_of_key_shapes_deforms_and_a_variant_may_choose_them() {
    let folder = deforming(bent_obj(), "group");
    let table = "[variant.fast.object.body]";
    folder.edit("scene.toml", table, &format!("{table}\n{SHAPES}"));
    let fast = load_scene(&folder.path, Some("fast")).unwrap();
    let [body, part] = [0, 1].map(|object| &fast.meshes[fast.objects[object].mesh]);
    assert_eq!((body.shapes.len(), part.shapes.len()), (2, 2));
    assert_eq!(part.triangles.len(), 3);
}

#[test]
fn faces_of_key_shapes_without_normals_are_flat_beside_smooth_ones() {
    let flat = |text: &str| {
        let smooth = "usemtl paint\nf 1/1/1 4/2/1 6/3/1";
        text.replace(smooth, "usemtl paint\nf 1/1 4/2 6/3")
    };
    let folder = deforming(flat(&bent_obj()), "keys");
    folder.write("mesh.obj", flat(OBJ));
    let scene = folder.load().unwrap();
    let mesh = &scene.meshes[0];
    let last = mesh.triangles.last().unwrap();
    for shape in &mesh.shapes {
        let normals = last.map(|vertex| shape.normals[vertex as usize]);
        assert_eq!(normals, [Vec3::ZERO; 3]);
        assert_eq!(shape.normals[0], Vec3::Z);
    }
}

/// Loads the scene with other text in its OBJ file, and compares all meshes with those of the plain
/// file.
fn assert_same_meshes(obj: &str) {
    let plain = Folder::new().load().unwrap();
    let folder = Folder::new();
    folder.write("mesh.obj", obj);
    let other = folder.load().unwrap_or_else(|error| panic!("{error}"));
    assert_equal_meshes(&plain, &other);
}

fn assert_equal_meshes(plain: &Scene, other: &Scene) {
    assert_eq!(plain.meshes.len(), other.meshes.len());
    for (plain, other) in plain.meshes.iter().zip(&other.meshes) {
        assert_eq!(plain.positions, other.positions);
        assert_eq!(plain.normals, other.normals);
        assert_eq!(plain.texcoords, other.texcoords);
        assert_eq!(plain.triangles, other.triangles);
        assert_eq!(plain.slots, other.slots);
    }
}

/// Replaces texts, each of which must be there.
fn replace_all(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

#[test]
fn a_byte_order_mark_changes_nothing() {
    assert_same_meshes(&format!("\u{feff}{OBJ}"));
    // Before a vertex it would shift all indices.
    let vertices = OBJ.replace("mtllib mesh.mtl\n", "") + "mtllib mesh.mtl\n";
    assert_same_meshes(&format!("\u{feff}{vertices}"));
    let folder = Folder::new();
    folder.write("mesh.mtl", format!("\u{feff}{MTL}"));
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    assert!(
        scene
            .materials
            .iter()
            .any(|material| material.name == "paint")
    );
}

#[test]
fn lines_continue_after_a_backslash_and_comments_follow_numbers() {
    assert_same_meshes(&replace_all(
        OBJ,
        &[
            (
                "f 1/1/1 2/2/1 3/3/1",
                "f 1/1/1 \\\n  2/2/1\\  \r\n3/3/1 # front",
            ),
            ("v 1 1 0", "v 1 \\\n1 0 # left of it"),
            ("vt 1 1", "vt 1 1 #"),
            ("vn 0 0 2", "# made on C:\\\nvn 0 0 2#up"),
        ],
    ));
    // Lines keep their numbers.
    let folder = Folder::new();
    let broken = [
        ("f 1/1/1 2/2/1", "f 1/1/1 \\\n2/2/1"),
        ("f 1/1/1 4/2/1 6/3/1 5", "f 1/1/1 4/2/1 6/3/1 9"),
    ];
    folder.write("mesh.obj", replace_all(OBJ, &broken));
    let error = folder.load().expect_err("it has no vertex 9");
    assert_eq!(
        (error.line, error.reason.contains("index 9")),
        (Some(19), true)
    );
}

#[test]
fn faces_may_come_before_what_they_refer_to() {
    let elements = ["v", "vt", "vn", "mtllib"];
    let is_element = |line: &&str| elements.contains(&line.split(' ').next().unwrap());
    let [first, last] = [false, true].map(|due| {
        let lines = OBJ.lines().filter(|line| is_element(line) == due);
        lines.collect::<Vec<&str>>().join("\n")
    });
    assert_same_meshes(&format!("{first}\n{last}\n"));
}

#[test]
fn a_file_of_all_colours_and_more_numbers_loads_the_same() {
    let changes = [
        ("v 1 1 0", "v 1 1 0 nan 2 0.5"),
        ("vt 1 1", "vt 1 1 0 0"),
        ("vn 0 0 2", "vn 0 0 2 0"),
    ];
    assert_same_meshes(&replace_all(OBJ, &changes));
}

/// Blender 4.4 writes `usemtl` without a name for a slot without a material.
#[test]
fn faces_of_an_empty_slot_have_no_material_and_all_others_keep_theirs() {
    let folder = Folder::new();
    folder.edit("mesh.obj", "usemtl glow\n", "usemtl \n");
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let whole = &scene.objects[0];
    let names = whole
        .materials
        .iter()
        .map(|index| scene.materials[*index].name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["paint", "default"]);
    assert_eq!(scene.meshes[whole.mesh].slots, [0, 0, 1, 1, 0]);
}

#[test]
fn faces_at_a_normal_without_length_are_flat() {
    let folder = Folder::new();
    folder.edit("mesh.obj", "vn 0 0 2\n", "vn 0 0 2\nvn 1 0 0\nvn 0 0 0\n");
    folder.edit("mesh.obj", "f 1/1/1 2/2/1 3/3/1", "f 1/1/2 2/2/3 3/3/2");
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let mesh = &scene.meshes[0];
    for (triangle, due) in mesh.triangles.iter().zip([Vec3::Z; 5]) {
        let normals = triangle.map(|corner| mesh.normals[corner as usize]);
        assert_eq!(normals, [due; 3]);
    }
}

#[test]
fn faces_of_one_group_may_have_different_kinds_of_indices() {
    let folder = Folder::new();
    folder.edit(
        "mesh.obj",
        "g left\nusemtl glow\nf 1/1/1 4/2/1 6/3/1 5/2/1",
        "g left\nusemtl glow\nf 1 6 4\nf 1/1/1 6/3/1 5/2/1",
    );
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.slots, [0, 0, 1, 1, 0]);
    // Clockwise seen from +Z: the face without normals is flat.
    assert_eq!(
        mesh.triangles[2].map(|corner| mesh.normals[corner as usize]),
        [Vec3::NEG_Z; 3]
    );
    assert_eq!(
        mesh.triangles[3].map(|corner| mesh.normals[corner as usize]),
        [Vec3::Z; 3]
    );
    assert_eq!(mesh.texcoords[mesh.triangles[3][1] as usize], Vec2::ONE);
    assert_eq!(scene.meshes[1].triangles.len(), 3);
}
