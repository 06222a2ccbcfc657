//! Animation channels of nodes.

use scene::{Motion, Shape};
use serde_json::{Value, json};

use crate::export::document::{Document, widen};
use crate::export::motion::{Track, Tracks};
use crate::export::timeline::Timeline;

/// Most keys of all turns of an export together; one takes 20 bytes.
const MAX_TURN_KEYS: usize = 8_000_000;

/// Moving nodes, and their animation channels.
pub struct Channels<'a> {
    document: &'a mut Document,
    timeline: &'a Timeline,
    channels: Vec<Value>,
    samplers: Vec<Value>,
    /// Keys of all turns.
    turn_keys: usize,
}

impl<'a> Channels<'a> {
    /// Begins an animation in which nothing moves.
    pub fn new(document: &'a mut Document, timeline: &'a Timeline) -> Self {
        Self {
            document,
            timeline,
            channels: Vec::new(),
            samplers: Vec::new(),
            turn_keys: 0,
        }
    }

    /// Adds a node in its pose at the start of the timeline, and a channel for each part of its
    /// pose that changes; refuses turns that are too fast or need too many keys.
    pub fn push_node(&mut self, mut node: Value, motion: &Motion) -> Result<usize, String> {
        let Tracks {
            translation,
            rotation,
            scale,
        } = Tracks::of(motion, self.timeline)?;
        if !rotation.is_still {
            self.turn_keys += rotation.times.len();
        }
        if self.turn_keys > MAX_TURN_KEYS {
            return Err(format!(
                "needs {} keys for its turns and those before it; allowed: {MAX_TURN_KEYS}; export a scene or variant in which \
                 fewer objects turn, or more slowly",
                self.turn_keys
            ));
        }
        node["translation"] = json!(translation.first.map(widen));
        node["rotation"] = json!(rotation.first.map(widen));
        node["scale"] = json!(scale.first.map(widen));
        let node = self.document.push("nodes", node);
        self.add_track(node, "translation", &translation);
        self.add_track(node, "rotation", &rotation);
        self.add_track(node, "scale", &scale);
        Ok(node)
    }

    /// Adds the weights of a node's morph targets: interpolated between two shapes, and
    /// extrapolated beyond the ends, so that one weight there is below 0 or above 1.
    pub fn add_shapes(&mut self, node: usize, shapes: &[Shape]) {
        let times = self.timeline.cut(shapes.iter().map(|shape| shape.time));
        let weights: Vec<[f32; 1]> = (times.iter())
            .flat_map(|time| weigh_shapes(shapes, *time).into_iter().skip(1))
            .map(|weight| [weight as f32])
            .collect();
        let output = self.document.push_floats(&weights, None);
        self.add(node, "weights", "LINEAR", &times, output);
    }

    /// Adds the animation, if anything moves.
    pub fn finish(self) {
        if !self.channels.is_empty() {
            let animation = json!({
                "channels": self.channels,
                "name": "scene",
                "samplers": self.samplers,
            });
            self.document.push("animations", animation);
        }
    }

    fn add_track<const N: usize>(&mut self, node: usize, path: &str, track: &Track<N>) {
        if !track.is_still {
            let output = self.document.push_floats(&track.values, None);
            self.add(node, path, track.interpolation, &track.times, output);
        }
    }

    /// Adds a channel with its values in the accessor `output`.
    fn add(&mut self, node: usize, path: &str, interpolation: &str, times: &[f64], output: usize) {
        let seconds: Vec<[f32; 1]> = (times.iter())
            .map(|time| [self.timeline.seconds(*time) as f32])
            .collect();
        let input = self.document.push_limited(&seconds, None);
        self.channels.push(json!({
            "sampler": self.samplers.len(),
            "target": { "node": node, "path": path },
        }));
        self.samplers.push(json!({
            "input": input,
            "interpolation": interpolation,
            "output": output,
        }));
    }
}

/// Returns the weight of each shape at a time; they sum to 1.
fn weigh_shapes(shapes: &[Shape], time: f64) -> Vec<f64> {
    let after = shapes.partition_point(|shape| shape.time <= time);
    let after = after.clamp(1, shapes.len() - 1);
    let [from, to] = [after - 1, after].map(|at| shapes[at].time);
    let part = (time - from) / (to - from);
    let mut weights = vec![0.0; shapes.len()];
    weights[after - 1] = 1.0 - part;
    weights[after] = part;
    weights
}
