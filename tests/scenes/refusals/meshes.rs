//! Slips in OBJ files and key shapes.

use super::{Slip, check_slips, missing_file_text, relative_message};
use crate::scene_folder::{Folder, OBJ, SCENE};

#[test]
fn slips_in_meshes_are_refused() {
    check_slips("mesh.obj", OBJ_SLIPS);
}

#[test]
fn slips_in_key_shapes_are_refused() {
    for (what, from, to, message) in SHAPE_SLIPS {
        let folder = Folder::new();
        let shapes =
            "shapes = [\n{ time = 0, mesh = \"mesh.obj\" },\n{ time = 1, mesh = \"bent.obj\" },\n]";
        folder.edit(
            "scene.toml",
            "mesh = \"mesh.obj\"\nkeys",
            &format!("{shapes}\nkeys"),
        );
        folder.write("bent.obj", OBJ);
        let file = if SCENE.contains(from) || shapes.contains(from) {
            "scene.toml"
        } else {
            "bent.obj"
        };
        folder.edit(file, from, to);
        let error = folder.load().err();
        let error = error.unwrap_or_else(|| panic!("{what}: it loads, but must be refused"));
        let expected = message.replace("{gone}", &missing_file_text());
        assert_eq!(relative_message(&folder, &error), expected, "{what}");
    }
}

#[rustfmt::skip]
const OBJ_SLIPS: &[Slip] = &[
    ("NaN vertex", "v 1 1 0", "v 1 nan 0", 
        "mesh.obj:4: v holds \"nan\"; allowed: finite numbers"),
    ("infinite vertex", "v 1 1 0", "v 1 inf 0", 
        "mesh.obj:4: v holds \"inf\"; allowed: finite numbers"),
    ("vertex too large", "v 1 1 0", "v 1 1e39 0", 
        "mesh.obj:4: v holds \"1e39\"; allowed: numbers from -1e12 to 1e12"),
    ("vertex too far", "v 1 1 0", "v 1 1e30 0", 
        "mesh.obj:4: v holds \"1e30\"; allowed: numbers from -1e12 to 1e12"),
    ("vertex thrown far by its weight", "v 1 1 0", "v 1 1 0 1e-38", 
        "mesh.obj:4: v has the weight 1e-38, which puts it beyond 1e12; leave the weight out"),
    ("index beyond 64 bits", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 99999999999999999999/3/1", 
        "mesh.obj:14: f has the vertex index \"99999999999999999999\"; allowed: whole numbers"),
    ("huge index", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 1000000000/3/1", 
        "mesh.obj:14: f has the vertex index 1000000000; allowed: 1 to 6, or -6 to -1"),
    ("smallest index", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 -9223372036854775808/3/1", 
        "mesh.obj:14: f has the vertex index -9223372036854775808; allowed: 1 to 6, or -6 to -1"),
    ("escape in a group", "g left", "g le\u{1b}[31mft", 
        "mesh.obj:16: the name after g holds the control character U+001B; allowed: one line of visible characters"),
    ("carriage return in a name", "usemtl glow", "usemtl gl\row", 
        "mesh.obj:17: the name after usemtl holds the control character U+000D; allowed: one line of visible characters"),
    ("vertex with a word", "v 1 1 0", "v 1 one 0", 
        "mesh.obj:4: v holds \"one\"; allowed: finite numbers"),
    ("vertex cut short", "v 1 1 0", "v 1 1", 
        "mesh.obj:4: v holds 2 numbers; allowed: 3 or 4 or 6"),
    ("vertex of five", "v 1 1 0", "v 1 1 0 1 1", 
        "mesh.obj:4: v holds 5 numbers; allowed: 3 or 4 or 6"),
    ("vertex of no weight", "v 1 1 0", "v 1 1 0 0", 
        "mesh.obj:4: v has the weight 0, which puts it at infinity; leave the weight out"),
    ("NaN texture coordinate", "vt 1 1", "vt NaN 1", 
        "mesh.obj:10: vt holds \"NaN\"; allowed: finite numbers"),
    ("NaN normal", "vn 0 0 2", "vn 0 nan 2", 
        "mesh.obj:11: vn holds \"nan\"; allowed: finite numbers"),
    ("normal of no length", "vn 0 0 2", "vn 0 0 0", 
        "mesh.obj:11: vn has no length; give it a direction"),
    ("index beyond the last", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 7/3/1", 
        "mesh.obj:14: f has the vertex index 7; allowed: 1 to 6, or -6 to -1"),
    ("index before the first", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 -7/3/1", 
        "mesh.obj:14: f has the vertex index -7; allowed: 1 to 6, or -6 to -1"),
    ("index 0", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 0/3/1", 
        "mesh.obj:14: f has the vertex index 0; allowed: 1 to 6, or -6 to -1"),
    ("texture index beyond the last", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/4/1", 
        "mesh.obj:14: f has the texture coordinate index 4; allowed: 1 to 3, or -3 to -1"),
    ("texture index before the first", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/-4/1", 
        "mesh.obj:14: f has the texture coordinate index -4; allowed: 1 to 3, or -3 to -1"),
    ("texture index 0", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/0/1", 
        "mesh.obj:14: f has the texture coordinate index 0; allowed: 1 to 3, or -3 to -1"),
    ("normal index without normals", "vn 0 0 2\n", "", 
        "mesh.obj:13: f has the normal index 1, but no normal stands above it"),
    ("index with a word", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 c/3/1", 
        "mesh.obj:14: f has the vertex index \"c\"; allowed: whole numbers"),
    ("corner without a vertex", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 /3/1", 
        "mesh.obj:14: f has the corner \"/3/1\"; allowed: v, v/vt, v//vn or v/vt/vn"),
    ("corner of four", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/3/1/1", 
        "mesh.obj:14: f has the corner \"3/3/1/1\"; allowed: v, v/vt, v//vn or v/vt/vn"),
    ("two corners", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1", 
        "mesh.obj:14: f has 2 corners; allowed: 3 or more"),
    ("mixed corners", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2//1 3/3/1", 
        "mesh.obj:14: f has corners with different kinds of indices: \"1/1/1 2//1 3/3/1\"; write all as v, v/vt, v//vn or v/vt/vn"),
    ("mixed faces", "f 1/1/1 2/2/1 3/3/1", "f 1 2 3", 
        "mesh.obj:15: the face has other kinds of indices than the faces before it; give texture coordinates and normals to all faces of a group and material, or to none"),
    ("texture without coordinates", "usemtl paint\nf 1/1/1 4/2/1 6/3/1\n", "usemtl paint\nf 1 4 6\n", 
        "scene.toml:19: material \"paint\" has a texture, but some faces of mesh.obj that use it have no texture coordinates (vt); add them, or take the texture away"),
    ("unknown material", "usemtl glow", "usemtl glowing", 
        "mesh.obj:17: usemtl names material \"glowing\", which no mtllib above it defines; materials: glow, paint"),
    ("material library missing", "mtllib mesh.mtl", "mtllib gone.mtl", 
        "mesh.obj:1: material library gone.mtl cannot be read: {gone}"),
    ("no material library", "mtllib mesh.mtl\n", "", 
        "mesh.obj:12: usemtl names material \"paint\", which no mtllib above it defines; materials: none"),
];

#[rustfmt::skip]
const SHAPE_SLIPS: &[Slip] = &[
    ("one shape", "{ time = 1, mesh = \"bent.obj\" },\n", "", 
        "scene.toml:19: object \"body\" has 1 shapes; allowed: 2 to 16384, or a mesh in their place"),
    ("shapes out of order", "{ time = 1, mesh", "{ time = -1, mesh", 
        "scene.toml:21: object \"body\" has a shape at time -1 after one at 0; times must rise"),
    ("shapes at one time", "{ time = 1, mesh", "{ time = 0, mesh", 
        "scene.toml:21: object \"body\" has a shape at time 0 after one at 0; times must rise"),
    ("mesh and shapes", "shapes = [", "mesh = \"mesh.obj\"\nshapes = [", 
        "scene.toml:20: object \"body\" has both a mesh and shapes; give one or the other"),
    ("neither mesh nor shapes", "mesh = \"mesh.obj\"\ngroup = \"left\"\n", "", 
        "scene.toml:28: object \"part\" has no mesh; give it a mesh, or shapes if it deforms"),
    ("missing shape", "mesh = \"bent.obj\"", "mesh = \"gone.obj\"", 
        "scene.toml:21: mesh gone.obj cannot be read: {gone}"),
    ("fewer faces", "f 1/1/1 3/3/1 4/2/1\n", "", 
        "bent.obj: has 3 faces, mesh.obj has 4; key shapes must have the same faces in the same order"),
    ("another vertex", "f 1/1/1 3/3/1 4/2/1", "f 1/1/1 3/3/1 -1/2/1", 
        "bent.obj:15: the face has the vertices [1, 3, 6], in mesh.obj:15 it has [1, 3, 4]; key shapes must have the same faces in the same order"),
    ("another order", "f 1/1/1 3/3/1 4/2/1", "f 3/3/1 4/2/1 1/1/1", 
        "bent.obj:15: the face has the vertices [3, 4, 1], in mesh.obj:15 it has [1, 3, 4]; key shapes must have the same faces in the same order"),
    ("another material", "g left\nusemtl glow", "g left\nusemtl paint", 
        "bent.obj: has 3 triangles of group \"left\" with normals in material \"paint\" where mesh.obj has 2 triangles of group \"left\" with normals in material \"glow\"; key shapes must have the same groups, materials and kinds of faces"),
    ("another group", "g left", "g top", 
        "bent.obj: has 2 triangles of group \"top\" with normals in material \"glow\" where mesh.obj has 2 triangles of group \"left\" with normals in material \"glow\"; key shapes must have the same groups, materials and kinds of faces"),
    ("normals in one shape alone", "usemtl paint\nf 1/1/1 4/2/1 6/3/1", "usemtl paint\nf 1/1 4/2 6/3", 
        "bent.obj: has 1 triangles of group \"left\" without normals in material \"paint\" where mesh.obj has 1 triangles of group \"left\" with normals in material \"paint\"; key shapes must have the same groups, materials and kinds of faces"),
];
