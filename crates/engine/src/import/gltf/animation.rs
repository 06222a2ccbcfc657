//! Animations: keys of nodes, and their values at a time.

use glam::{DQuat, DVec4};

use super::file::File;
use super::schema::{self, Gltf};

/// Part of a node that a channel moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Translation,
    Rotation,
    Scale,
    Weights,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Interpolation {
    Step,
    Linear,
    Cubic,
}

/// Keys of one part of one node.
#[derive(Debug)]
pub struct Channel {
    pub node: usize,
    pub part: Part,
    interpolation: Interpolation,
    /// Seconds, rising.
    pub times: Vec<f32>,
    /// Numbers of a value: 3, 4, or one per morph target.
    width: usize,
    /// One value per key; with cubic interpolation, slope before, value and slope after.
    values: Vec<f32>,
}

/// An animation.
#[derive(Debug, Default)]
pub struct Animation {
    pub name: String,
    pub channels: Vec<Channel>,
    /// Channels of what has no counterpart, such as colours.
    pub unread: usize,
}

impl Animation {
    /// Reads an animation. `target_count` returns how many morph targets a node has.
    pub fn read(
        file: &File,
        index: usize,
        target_count: impl Fn(usize) -> usize,
    ) -> Result<Self, String> {
        let entry = File::entry(&file.json.animations, "animations", index)?;
        let mut animation = Self {
            name: display_name(&file.json, index),
            ..Self::default()
        };
        for (at, channel) in entry.channels.iter().enumerate() {
            let place = format!("animations[{index}].channels[{at}]");
            let Some(node) = channel.target.node else {
                animation.unread += 1;
                continue;
            };
            File::entry(&file.json.nodes, "nodes", node)?;
            let (part, width) = match channel.target.path.as_str() {
                "translation" => (Part::Translation, 3),
                "rotation" => (Part::Rotation, 4),
                "scale" => (Part::Scale, 3),
                "weights" => (Part::Weights, target_count(node)),
                _ => {
                    animation.unread += 1;
                    continue;
                }
            };
            if width == 0 {
                continue;
            }
            let sampler = File::entry(&entry.samplers, "samplers", channel.sampler)?;
            let keys = Keys { node, part, width };
            let channel = Channel::read(file, sampler, keys);
            let channel = channel.map_err(|reason| format!("{place}: {reason}"))?;
            animation.channels.push(channel);
        }
        Ok(animation)
    }

    /// Adds the channels of another animation; refuses two that move one thing.
    pub fn join(mut self, other: Self) -> Result<Self, String> {
        let is_same = |a: &Channel, b: &Channel| a.node == b.node && a.part == b.part;
        for channel in &other.channels {
            if self.channels.iter().any(|mine| is_same(mine, channel)) {
                return Err(format!(
                    "animations \"{}\" and \"{}\" both move nodes[{}]; allowed: animations of different nodes",
                    self.name, other.name, channel.node
                ));
            }
        }
        if self.channels.is_empty() {
            self.name = other.name;
        } else {
            self.name += &format!(" + {}", other.name);
        }
        self.channels.extend(other.channels);
        self.unread += other.unread;
        Ok(self)
    }

    /// Returns the first and the last key's time, in seconds.
    pub fn range(&self) -> Option<[f64; 2]> {
        let ends = self.channels.iter().filter_map(|channel| {
            let [first, last] = [channel.times.first()?, channel.times.last()?];
            Some([*first, *last].map(f64::from))
        });
        ends.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }
}

/// Returns the name of an animation, or its number.
pub fn display_name(json: &Gltf, index: usize) -> String {
    match json.animations[index].name.as_str() {
        "" => index.to_string(),
        name => name.to_owned(),
    }
}

/// Meaning of a channel's values.
struct Keys {
    node: usize,
    part: Part,
    width: usize,
}

impl Channel {
    fn read(file: &File, sampler: &schema::Sampler, keys: Keys) -> Result<Self, String> {
        let Keys { node, part, width } = keys;
        let interpolation = match sampler.interpolation.as_deref() {
            None | Some("LINEAR") => Interpolation::Linear,
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::Cubic,
            Some(other) => {
                return Err(format!(
                    "the interpolation is {other:.20}; allowed: STEP, LINEAR and CUBICSPLINE"
                ));
            }
        };
        let times = file.flat_floats(sampler.input, 1, "times of keys")?;
        if times.is_empty() {
            return Err("has no keys; allowed: one or more".into());
        }
        if let Some(at) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(format!(
                "key {} is at {} s and the next at {} s; times must rise; export the file again",
                at,
                times[at],
                times[at + 1]
            ));
        }
        let element = if part == Part::Weights { 1 } else { width };
        let values = file.flat_floats(sampler.output, element, "values of keys")?;
        let factor = if interpolation == Interpolation::Cubic {
            3
        } else {
            1
        };
        let expected = times.len() * width * factor;
        if values.len() != expected {
            return Err(format!(
                "{} keys need {expected} numbers, and accessors[{}] has {}; export the file again",
                times.len(),
                sampler.output,
                values.len()
            ));
        }
        Ok(Self {
            node,
            part,
            interpolation,
            times,
            width,
            values,
        })
    }

    /// Returns true if values jump from key to key.
    pub fn is_step(&self) -> bool {
        self.interpolation == Interpolation::Step
    }

    /// Returns the value at a time in seconds. Before the first key and after the last it stands
    /// still, as glTF says.
    pub fn value(&self, seconds: f64) -> Vec<f64> {
        let after = (self.times).partition_point(|time| f64::from(*time) <= seconds);
        let last = self.times.len() - 1;
        if after == 0 || after > last {
            return self.key(after.min(last), 1);
        }
        let from = after - 1;
        let [start, end] = [from, after].map(|key| f64::from(self.times[key]));
        let (length, part) = (end - start, (seconds - start) / (end - start));
        match self.interpolation {
            Interpolation::Step => self.key(from, 1),
            Interpolation::Linear if self.part == Part::Rotation => {
                let [a, b] = [from, after].map(|key| quaternion(&self.key(key, 1)));
                DVec4::from(a.slerp(b, part)).to_array().to_vec()
            }
            Interpolation::Linear => {
                let pairs = self.key(from, 1).into_iter().zip(self.key(after, 1));
                pairs.map(|(a, b)| a + part * (b - a)).collect()
            }
            Interpolation::Cubic => {
                let [square, cube] = [part * part, part * part * part];
                let [v0, b0] = [1, 2].map(|which| self.key(from, which));
                let [a1, v1] = [0, 1].map(|which| self.key(after, which));
                let mix = |at: usize| {
                    (2.0 * cube - 3.0 * square + 1.0) * v0[at]
                        + length * (cube - 2.0 * square + part) * b0[at]
                        + (3.0 * square - 2.0 * cube) * v1[at]
                        + length * (cube - square) * a1[at]
                };
                (0..self.width).map(mix).collect()
            }
        }
    }

    /// Returns a key's value; `which` chooses 0, the slope before, 1, the value, or 2, the slope
    /// after, of which only cubic keys have the slopes.
    fn key(&self, key: usize, which: usize) -> Vec<f64> {
        let element = if self.interpolation == Interpolation::Cubic {
            3 * key + which
        } else {
            key
        };
        let start = element * self.width;
        let numbers = self.values[start..start + self.width].iter();
        numbers.map(|number| f64::from(*number)).collect()
    }
}

/// Makes a rotation of four numbers; of zeros, none.
pub fn quaternion(numbers: &[f64]) -> DQuat {
    let vector = DVec4::from_slice(numbers);
    match vector.try_normalize() {
        Some(unit) => DQuat::from_vec4(unit),
        None => DQuat::IDENTITY,
    }
}
