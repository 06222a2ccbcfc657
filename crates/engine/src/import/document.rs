//! Text of an imported scene's scene.toml.

use frame::Size;

use crate::import::framing::{self, SIZE, VERTICAL_FOV, VIEW};
use crate::import::model::{BLENDED, Model, Up};
use crate::import::plan::ImportPlan;
use crate::import::set::{STAND_HEIGHT, WALL_DISTANCE};

/// Writes the whole text. The world's origin is below the model's middle, on the stand's upper
/// face.
pub fn scene_toml(plan: &ImportPlan, model: &Model) -> String {
    let half_fov = (0.5 * VERTICAL_FOV).to_radians();
    let distance = framing::distance(model.radius());
    // Length of a pixel at the model's middle, in metres.
    let pixel = 2.0 * distance * half_fov.tan() / f64::from(SIZE.height);
    let file = plan.model.file_name().unwrap_or_default().to_string_lossy();
    let motions = &plan.motions;
    let exposes = format!("Imported from {file}: {}.", plan.sentence());
    let Size { width, height } = SIZE;
    format!(
        "# Made by `shuttertruth engine import`; yours to change.\n\
         exposes = {exposes}\nfamily = \"{family}\"\nexposure = {exposure}\nsize = [{width}, {height}]\n\n\
         [camera]\nvertical_fov = {VERTICAL_FOV}\n{path}\n\n\
         [background]\n\
         gradient = {{ ground = [0.25, 0.24, 0.22], horizon = [0.8, 0.85, 0.95], zenith = [0.3, 0.45, 0.8] }}\n\n\
         [sun]\ndirection = [-0.3, 0.9, 0.6]\nirradiance = [2.0, 1.9, 1.7]\n\n\
         {set}{stand}\n{object}",
        exposes = toml::Value::from(exposes),
        family = plan.family().name(),
        exposure = number(plan.exposure),
        path = camera_path(model.half_size().y, distance, motions.orbit),
        set = set_objects(model.radius()),
        stand = stand_motion(motions.spin, motions.slide.map(|speed| speed * pixel)),
        object = model_object(model),
    )
}

/// Writes the camera's position, and its path around the model at a speed in degrees per frame.
fn camera_path(middle: f64, distance: f64, orbit: Option<f64>) -> String {
    let view = |turn: f64| {
        let [x, y, z] = from_camera(VIEW[0] + turn, distance);
        [vector([x, y + middle, z]), vector([0.0, middle, 0.0])]
    };
    let Some(speed) = orbit else {
        let [position, target] = view(0.0);
        return format!("position = {position}\nlook_at = {target}");
    };
    // Points on the circle; cubic curves through them stay on it to a hundredth of a thousandth.
    let keys = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|time| {
        let [position, target] = view(speed * time);
        format!("    {{ time = {time:?}, position = {position}, look_at = {target} }},\n")
    });
    format!("interpolation = \"cubic\"\nkeys = [\n{}]", keys.concat())
}

/// Writes floor, wall and stand for a model of a given radius.
fn set_objects(radius: f64) -> String {
    let wall = from_camera(VIEW[0], -WALL_DISTANCE * radius);
    format!(
        "[object.floor]\nmesh = \"floor.obj\"\ntranslation = {}\nrotation = {{ axis = [1, 0, 0], degrees = -90 }}\n\n\
         [object.wall]\nmesh = \"wall.obj\"\ntranslation = {}\nrotation = {{ axis = [0, 1, 0], degrees = {} }}\n\n\
         [object.stand]\nmesh = \"stand.obj\"\n",
        vector([0.0, -STAND_HEIGHT * radius, 0.0]),
        vector([wall[0], 0.0, wall[2]]),
        number(VIEW[0]),
    )
}

/// Writes the model, with its lowest point on the middle of the stand.
fn model_object(model: &Model) -> String {
    let [low, high] = model.corners;
    let middle = 0.5 * (low + high);
    format!(
        "[object.model]\n{}parent = \"stand\"\ntranslation = {}\n{}{}",
        model.keys,
        vector([-middle.x, -low.y, -middle.z]),
        match model.up {
            Up::Y => "",
            Up::Z => "rotation = { axis = [1, 0, 0], degrees = -90 }\n",
        },
        if model.is_translucent { BLENDED } else { "" }
    )
}

/// Writes keys one frame before and after the instant, from degrees and metres per frame.
fn stand_motion(spin: Option<f64>, slide: Option<f64>) -> String {
    if spin.is_none() && slide.is_none() {
        return String::new();
    }
    let key = |time: f64| {
        let mut key = format!("    {{ time = {time:?}");
        if let Some(speed) = slide {
            let side = VIEW[0].to_radians();
            let moved = [side.cos(), 0.0, -side.sin()].map(|part| part * speed * time);
            key += &format!(", translation = {}", vector(moved));
        }
        if let Some(speed) = spin {
            // All digits: the angle counts, however many turns come before it.
            let degrees = speed * time + 0.0;
            key += &format!(", rotation = {{ axis = [0, 1, 0], degrees = {degrees:?} }}");
        }
        key + " },\n"
    };
    format!("keys = [\n{}{}]\n", key(-1.0), key(1.0))
}

/// Returns the point at a distance from the model's middle towards a camera that is `around`
/// degrees to the side.
fn from_camera(around: f64, distance: f64) -> [f64; 3] {
    let [around, above] = [around, VIEW[1]].map(f64::to_radians);
    [
        distance * around.sin() * above.cos(),
        distance * above.sin(),
        distance * around.cos() * above.cos(),
    ]
}

fn vector(parts: [f64; 3]) -> String {
    let [x, y, z] = parts.map(number);
    format!("[{x}, {y}, {z}]")
}

/// Writes a number with six significant digits.
fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}")
        .parse()
        .expect("what was written as a number");
    format!("{:?}", rounded + 0.0)
}
