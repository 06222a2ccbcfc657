//! Model of a square plate, the object of the smallest scene.

/// plate.obj: one metre on each side.
pub const OBJ: &str = "\
mtllib plate.mtl
v -0.5 -0.5 0
v 0.5 -0.5 0
v 0.5 0.5 0
v -0.5 0.5 0
usemtl paint
f 1 2 3
f 1 3 4
";

/// plate.mtl: black, and glowing orange.
pub const MTL: &str = "newmtl paint\nKd 0 0 0\nKe 0.7 0.4 0.2\n";
