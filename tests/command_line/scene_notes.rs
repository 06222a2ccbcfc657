//! What `list` says of a scene's files.

use tests::text::{assert_contains, squeeze};

use crate::sandbox::{Sandbox, split, stderr};

#[test]
fn list_names_surfaces_of_different_materials_in_one_place() {
    let sandbox = Sandbox::new();
    let list = || stderr(&sandbox.shuttertruth(&split("list plate")));
    assert_eq!(list(), "");
    // A second plate of another color in the place of the first.
    sandbox.edit(
        "scenes/plate/plate.obj",
        "f 1 3 4\n",
        "f 1 3 4\nusemtl ink\nf 1 2 3\n",
    );
    sandbox.edit(
        "scenes/plate/plate.mtl",
        "newmtl paint",
        "newmtl ink\nKd 1 1 1\nnewmtl paint",
    );
    let parts = [
        "plate: \"plate\" (material",
        "(material ink)",
        "have surfaces in one place, seen at (",
        "cut one of them, or move it by a millimetre",
    ];
    assert_contains(&squeeze(&list()), &parts);
}
