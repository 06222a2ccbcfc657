//! Animation channels of nodes.

use glam::{DQuat, DVec3};
use serde_json::{Value, json};
use tracer::{Motion, Shape};

use crate::export::document::{Document, widen};
use crate::export::motion::{Track, Tracks};
use crate::export::timeline::{FRAMES_PER_SECOND, Timeline};

/// Nodes that move, and the channels of their animation.
pub struct Channels<'a> {
    document: &'a mut Document,
    timeline: &'a Timeline,
    channels: Vec<Value>,
    samplers: Vec<Value>,
}

impl<'a> Channels<'a> {
    /// Begins an animation in which nothing moves.
    pub fn new(document: &'a mut Document, timeline: &'a Timeline) -> Self {
        Self {
            document,
            timeline,
            channels: Vec::new(),
            samplers: Vec::new(),
        }
    }

    /// Adds a node in its pose at the start of the timeline, and a channel for each part of its pose that changes.
    pub fn push_node(&mut self, mut node: Value, motion: &Motion) -> usize {
        let Tracks {
            translation,
            rotation,
            scale,
        } = Tracks::of(motion, self.timeline);
        node["translation"] = json!(floats(first_of(&translation)).map(widen));
        node["rotation"] = json!(turn(first_of(&rotation)).map(widen));
        node["scale"] = json!(floats(first_of(&scale)).map(widen));
        let node = self.document.push("nodes", node);
        self.add_track(node, "translation", &translation, floats);
        self.add_track(node, "rotation", &rotation, turn);
        self.add_track(node, "scale", &scale, floats);
        node
    }

    /// Adds the weights of a node's morph targets: between two shapes those of the two, and beyond the ends as between the nearest
    /// two, so that one weight is below 0 or above 1 there.
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

    fn add_track<T: Copy, const N: usize>(
        &mut self,
        node: usize,
        path: &str,
        track: &Track<T>,
        value: fn(T) -> [f32; N],
    ) {
        let (times, values, interpolation): (Vec<f64>, Vec<[f32; N]>, &str) = match track {
            Track::Still(_) => return,
            Track::Linear(keys) => {
                let (times, values) = keys.iter().map(|(time, own)| (*time, value(*own))).unzip();
                (times, values, "LINEAR")
            }
            Track::Cubic(keys) => {
                // Slopes are per second there.
                let slope =
                    |own: T| value(own).map(|part| (f64::from(part) * FRAMES_PER_SECOND) as f32);
                let times = keys.iter().map(|(time, _)| *time).collect();
                let triples = keys.iter().flat_map(|(_, [before, own, after])| {
                    [slope(*before), value(*own), slope(*after)]
                });
                (times, triples.collect(), "CUBICSPLINE")
            }
        };
        let output = self.document.push_floats(&values, None);
        self.add(node, path, interpolation, &times, output);
    }

    /// Adds a channel whose values are in the accessor `output`.
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

fn first_of<T: Copy>(track: &Track<T>) -> T {
    match track {
        Track::Still(value) => *value,
        Track::Linear(keys) => keys[0].1,
        Track::Cubic(keys) => keys[0].1[1],
    }
}

fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

fn turn(rotation: DQuat) -> [f32; 4] {
    rotation.as_quat().normalize().to_array()
}
