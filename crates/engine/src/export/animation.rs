//! Animation channels of nodes.

use glam::{DQuat, DVec3};
use gltf_json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Node};
use tracer::Shape;

use crate::export::buffer::Document;
use crate::export::motion::{CubicKey, Track, Tracks};
use crate::export::timeline::{FRAMES_PER_SECOND, Timeline};

/// The animation of a scene: channels and samplers.
#[derive(Debug, Default)]
pub struct Channels {
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

impl Channels {
    /// Poses a node at the start of the timeline, and adds a channel for each part of its pose that changes.
    pub fn add_motion(
        &mut self,
        document: &mut Document,
        node: Index<Node>,
        tracks: &Tracks,
        timeline: &Timeline,
    ) {
        let Tracks {
            translation,
            rotation,
            scale,
        } = tracks;
        let posed = &mut document.root.nodes[node.value()];
        posed.translation = Some(floats(first_of(translation)));
        posed.rotation = Some(gltf_json::scene::UnitQuaternion(turn(first_of(rotation))));
        posed.scale = Some(floats(first_of(scale)));
        self.add_track(
            document,
            node,
            Property::Translation,
            translation,
            floats,
            timeline,
        );
        self.add_track(document, node, Property::Rotation, rotation, turn, timeline);
        self.add_track(document, node, Property::Scale, scale, floats, timeline);
    }

    /// Adds the weights of a node's morph targets: between two shapes those of the two, and beyond the ends as between the nearest
    /// two, so that one weight is below 0 or above 1 there.
    pub fn add_shapes(
        &mut self,
        document: &mut Document,
        node: Index<Node>,
        shapes: &[Shape],
        timeline: &Timeline,
    ) {
        let times = timeline.cut(shapes.iter().map(|shape| shape.time));
        let weights: Vec<[f32; 1]> = (times.iter())
            .flat_map(|time| weigh_shapes(shapes, *time).into_iter().skip(1))
            .map(|weight| [weight as f32])
            .collect();
        let output = document.push_floats(&weights, None);
        let input = push_times(document, &times, timeline);
        self.add(
            node,
            Property::MorphTargetWeights,
            Interpolation::Linear,
            input,
            output,
        );
    }

    /// Adds the animation, if anything moves.
    pub fn finish(self, document: &mut Document) {
        if !self.channels.is_empty() {
            document.root.push(Animation {
                extensions: None,
                extras: None,
                channels: self.channels,
                name: Some("scene".to_owned()),
                samplers: self.samplers,
            });
        }
    }

    fn add_track<T: Copy, const N: usize>(
        &mut self,
        document: &mut Document,
        node: Index<Node>,
        property: Property,
        track: &Track<T>,
        value: fn(T) -> [f32; N],
        timeline: &Timeline,
    ) {
        let (times, values, interpolation): (Vec<f64>, Vec<[f32; N]>, Interpolation) = match track {
            Track::Still(_) => return,
            Track::Linear(keys) => {
                let (times, values): (Vec<f64>, Vec<T>) = keys.iter().copied().unzip();
                (
                    times,
                    values.into_iter().map(value).collect(),
                    Interpolation::Linear,
                )
            }
            Track::Cubic(keys) => {
                // Slopes are per second there.
                let slope =
                    |own: T| value(own).map(|part| (f64::from(part) * FRAMES_PER_SECOND) as f32);
                let triple = |key: &CubicKey<T>| {
                    [slope(key.slope_in), value(key.value), slope(key.slope_out)]
                };
                (
                    keys.iter().map(|key| key.time).collect(),
                    keys.iter().flat_map(triple).collect(),
                    Interpolation::CubicSpline,
                )
            }
        };
        let input = push_times(document, &times, timeline);
        let output = document.push_floats(&values, None);
        self.add(node, property, interpolation, input, output);
    }

    fn add(
        &mut self,
        node: Index<Node>,
        property: Property,
        interpolation: Interpolation,
        input: Index<Accessor>,
        output: Index<Accessor>,
    ) {
        let sampler = Index::push(
            &mut self.samplers,
            Sampler {
                extensions: None,
                extras: None,
                input,
                interpolation: Checked::Valid(interpolation),
                output,
            },
        );
        self.channels.push(Channel {
            sampler,
            target: Target {
                extensions: None,
                extras: None,
                node,
                path: Checked::Valid(property),
            },
            extensions: None,
            extras: None,
        });
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

fn push_times(document: &mut Document, times: &[f64], timeline: &Timeline) -> Index<Accessor> {
    let seconds: Vec<[f32; 1]> = (times.iter())
        .map(|time| [timeline.seconds(*time) as f32])
        .collect();
    document.push_limited(&seconds, None)
}

fn first_of<T: Copy>(track: &Track<T>) -> T {
    match track {
        Track::Still(value) => *value,
        Track::Linear(keys) => keys[0].1,
        Track::Cubic(keys) => keys[0].value,
    }
}

fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

fn turn(rotation: DQuat) -> [f32; 4] {
    rotation.as_quat().normalize().to_array()
}
