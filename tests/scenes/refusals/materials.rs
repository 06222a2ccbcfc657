//! Slips in MTL files.

use super::{Slip, check_slips, relative_message};
use crate::scene_folder::Folder;

#[test]
fn slips_in_materials_are_refused() {
    check_slips("mesh.mtl", MTL_SLIPS);
}

#[test]
fn slips_in_translucency_are_refused() {
    check_slips("scene.toml", TRANSLUCENCY_SLIPS);
    let folder = Folder::new();
    folder.edit("mesh.mtl", "newmtl glow", "Ni 9\nillum 4\nd 0\nnewmtl glow");
    assert!(folder.load().is_ok(), "nothing is blended");
    folder.edit(
        "scene.toml",
        "parent = \"body\"",
        "parent = \"body\"\nalpha = \"blended\"",
    );
    let error = folder.load().unwrap_err();
    assert_eq!(
        relative_message(&folder, &error),
        "scene.toml:26: material \"paint\" of mesh.obj is thin glass with an index of refraction of 9; allowed: 1 to 4"
    );
}

#[rustfmt::skip]
const TRANSLUCENCY_SLIPS: &[Slip] = &[
    ("unknown alpha", "parent = \"body\"", "alpha = \"blend\"",
        "scene.toml:28: unknown word `blend`; allowed: `cutout` or `blended`"),
    ("unknown buffers", "parent = \"body\"", "alpha = \"blended\"\nbuffers = \"both\"",
        "scene.toml:29: unknown word `both`; allowed: `behind` or `own`"),
    ("buffers of holes", "parent = \"body\"", "buffers = \"own\"",
        "scene.toml:28: buffers tells what velocity and depth are where an object is translucent; give it alpha = \"blended\""),
    ("filter of holes", "diffuse = [0.1, 0.2, 0.3]", "filter = [1, 1, 1]",
        "scene.toml:32: filter is about light that passes; give the object alpha = \"blended\""),
    ("glass of holes", "diffuse = [0.1, 0.2, 0.3]", "thin_glass = true",
        "scene.toml:32: thin_glass is about light that passes; give the object alpha = \"blended\""),
    ("filter above 1", "parent = \"body\"\nscale = 2\n\n[object.part.material.paint]\ndiffuse = [0.1, 0.2, 0.3]",
        "alpha = \"blended\"\n\n[object.part.material.paint]\nfilter = [2, 1, 1]",
        "scene.toml:31: filter is [2.0, 1.0, 1.0]; allowed: 0 to 1"),
    ("opaque glass", "parent = \"body\"\nscale = 2\n\n[object.part.material.paint]\ndiffuse = [0.1, 0.2, 0.3]",
        "alpha = \"blended\"\n\n[object.part.material.paint]\nthin_glass = true",
        "scene.toml:26: material \"paint\" of mesh.obj is thin glass with an opacity of 1, which lets nothing pass; give it less (0 is clean glass)"),
];

#[rustfmt::skip]
const MTL_SLIPS: &[Slip] = &[
    ("albedo above 1", "Kd 0.5 0.6 0.7", "Kd 0.5 1.6 0.7", 
        "mesh.mtl:2: Kd is [0.5, 1.6, 0.7]; allowed: 0 to 1"),
    ("negative albedo", "Kd 0.5 0.6 0.7", "Kd -0.5 0.6 0.7", 
        "mesh.mtl:2: Kd is [-0.5, 0.6, 0.7]; allowed: 0 to 1"),
    ("albedo of one number", "Kd 0.5 0.6 0.7", "Kd 0.5", 
        "mesh.mtl:2: Kd holds 1 numbers; allowed: 3"),
    ("NaN albedo", "Kd 0.5 0.6 0.7", "Kd 0.5 nan 0.7", 
        "mesh.mtl:2: Kd holds \"nan\"; allowed: finite numbers"),
    ("albedo from a spectrum", "Kd 0.5 0.6 0.7", "Kd spectral red.rfl", 
        "mesh.mtl:2: Kd holds \"spectral\"; allowed: finite numbers"),
    ("negative emission", "Ke 1 2 3", "Ke 1 2 -3", 
        "mesh.mtl:6: Ke is [1.0, 2.0, -3.0]; allowed: 0 to 1e12"),
    ("opacity above 1", "d 0.25", "d 25", 
        "mesh.mtl:7: d is 25; allowed: 0 to 1"),
    ("opacity with an option", "d 0.25", "d -halo 0.25", 
        "mesh.mtl:7: d holds \"-halo\"; allowed: finite numbers"),
    ("transparency", "d 0.25", "Tr 0.75", 
        "mesh.mtl:7: Tr is not read, since programs disagree about its meaning; write d (1 is opaque)"),
    ("transparency that is not what opacity leaves", "d 0.25", "Tr 0.5\nd 0.25",
        "mesh.mtl:7: Tr is 0.5 beside d 0.25; allowed: 1 - d, here 0.75; delete Tr"),
    ("filter above 1", "d 0.25", "Tf 1 1.5 1",
        "mesh.mtl:7: Tf is [1.0, 1.5, 1.0]; allowed: 0 to 1"),
    ("filter of one number", "d 0.25", "Tf 1",
        "mesh.mtl:7: Tf holds 1 numbers; allowed: 3"),
    ("texture missing", "map_Kd dots.png", "map_Kd gone.png", 
        "mesh.mtl:3: texture gone.png cannot be read: {gone}"),
    ("texture that is none", "map_Kd dots.png", "map_d mesh.obj", 
        "mesh.mtl:3: texture mesh.obj is neither a PNG nor a JPEG file"),
    ("texture without a name", "map_Kd dots.png", "map_Kd", 
        "mesh.mtl:3: map_Kd names no file; give it one"),
    ("texture with options", "map_Kd dots.png", "map_Kd -s 2 2 2 dots.png", 
        "mesh.mtl:3: map_Kd has options (\"-s 2 2 2 dots.png\"); allowed: a file name alone"),
    ("escape in a material", "newmtl glow", "newmtl gl\u{9b}ow", 
        "mesh.mtl:4: the name after newmtl holds the control character U+009B; allowed: one line of visible characters"),
    ("emission too bright", "Ke 1 2 3", "Ke 1 2 1e20", 
        "mesh.mtl:6: Ke holds \"1e20\"; allowed: numbers from -1e12 to 1e12"),
    ("material without a name", "newmtl glow", "newmtl", 
        "mesh.mtl:4: newmtl names no material; give it a name"),
    ("material twice", "newmtl glow", "newmtl paint", 
        "mesh.mtl:4: newmtl of material \"paint\" is given twice, first in mesh.mtl:1; delete one"),
    ("statement twice", "Ke 1 2 3", "Ke 1 2 3\nKe 1 2 3", 
        "mesh.mtl:7: Ke of material \"glow\" is given twice, first in mesh.mtl:6; delete one"),
    ("statement of no material", "newmtl paint", "Kd 1 1 1\nnewmtl paint", 
        "mesh.mtl:1: Kd stands before the first newmtl; move it below the newmtl of its material"),
];
