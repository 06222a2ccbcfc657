//! The limits of scenes. `docs/limits.md` lists these numbers and those of renders; a test compares
//! the two.
//!
//! Each is far above the needs of scenes, and low enough to bound memory and time. A file beyond a
//! limit is refused before memory is allocated for it.

/// Widest and highest picture, in pixels.
pub const LARGEST_SIDE: u32 = 16_384;

/// Most pixels of a picture: 8192 x 8192.
pub const MAX_PIXELS: u64 = 67_108_864;

/// Largest scene.toml, in bytes.
pub const LARGEST_SCENE_FILE: u64 = 16_777_216;

/// Largest OBJ file, in bytes.
pub const LARGEST_MESH_FILE: u64 = 2_147_483_648;

/// Largest MTL file, in bytes.
pub const LARGEST_MATERIAL_FILE: u64 = 16_777_216;

/// Largest file of a texture or an environment, in bytes.
pub const LARGEST_IMAGE_FILE: u64 = 536_870_912;

/// Most texels of a texture: 8192 x 8192. One takes 16 bytes.
pub const MAX_TEXELS: u64 = 67_108_864;

/// Most texels of all textures of a scene together: two of 8192 x 8192.
pub const MAX_TEXELS_TOGETHER: u64 = 134_217_728;

/// Most texels of an environment: 8192 x 4096. One takes 44 bytes, because it is sampled as a light
/// too.
pub const MAX_ENVIRONMENT_TEXELS: u64 = 33_554_432;

/// Most values of all channels and layers of an EXR file that holds an environment.
pub const MAX_ENVIRONMENT_VALUES: u64 = 134_217_728;

/// Most vertices, texture coordinates or normals of an OBJ file.
pub const MAX_VERTICES: usize = 32_000_000;

/// Most triangles of a scene's meshes together; a mesh that several objects show counts once.
pub const MAX_TRIANGLES: usize = 32_000_000;

/// Most corners of a face.
pub const MAX_CORNERS: usize = 4_096;

/// Most triangles that emit, counted once for each object that shows them.
pub const MAX_EMISSIVE_TRIANGLES: usize = 8_000_000;

/// Most materials of an MTL file.
pub const MAX_MATERIALS: usize = 65_536;

/// Most objects of a scene.
pub const MAX_OBJECTS: usize = 16_384;

/// Most parents above an object, the parents' parents counted too.
pub const MAX_PARENTS: usize = 256;

/// Most variants of a scene.
pub const MAX_VARIANTS: usize = 4_096;

/// Most keys of a motion, and most key shapes of a mesh.
pub const MAX_KEYS: usize = 16_384;

/// Greatest magnitude of a number in a scene's files: metres, watts, degrees and frames alike.
pub const LARGEST_NUMBER: f64 = 1e12;

/// Greatest distance of anything in a scene file from the world's origin, in metres, summed up over
/// sizes and motions.
pub const FARTHEST: f64 = 1e12;

/// Largest angle of an object since a key, in degrees, its parents' angles added: 64-bit numbers
/// place it to 1e-5 radians.
pub const LARGEST_ANGLE: f64 = 4e12;

/// Smallest factor by which all scales together, those of parents included, may shrink an object.
pub const SMALLEST_SCALE: f64 = 1e-12;

/// Least time between two keys, in frames.
pub const CLOSEST_KEYS: f64 = 1e-6;

/// Slowest frame rate that a scene may be filmed at, in frames per second.
pub const SLOWEST_RATE: f64 = 1.0;

/// Fastest frame rate, in frames per second.
pub const FASTEST_RATE: f64 = 1000.0;

/// Fewest exposures of a shutter in time that fill a second: 1 s is its longest time.
pub const SLOWEST_SHUTTER: f64 = 1.0;

/// Most exposures that fill a second: 1/100000 s is the shortest time.
pub const FASTEST_SHUTTER: f64 = 100_000.0;

/// Narrowest vertical field of view, in degrees.
pub const NARROWEST_VIEW: f64 = 0.001;

/// Nearest focus of a lens, in metres.
pub const NEAREST_FOCUS: f64 = 1e-6;

/// Largest diameter of a lens, as a part of the distance of its focus.
pub const WIDEST_LENS: f64 = 1.0;

/// Smallest angular radius of a sun that is not a point, in degrees.
pub const SMALLEST_SUN: f64 = 0.001;

/// Brightest radiance.
pub const BRIGHTEST: f32 = 1e12;
