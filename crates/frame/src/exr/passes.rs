//! Names of channels in other programs' files: a renderer's passes, and the outputs of Blender's
//! File Output node.

use std::path::Path;

use super::file::{ExrFile, Samples};
use super::reading::read_foreign_exr;
use crate::FileError;

/// A buffer of a frame, and its names in other programs' files.
struct Pass {
    /// This program's names of its channels.
    names: &'static [&'static str],
    /// Last part of its layer's name elsewhere.
    layers: &'static [&'static str],
    /// Its channels in such a layer: two spellings, the File Output node's last.
    channels: [&'static [&'static str]; 2],
}

const PASSES: [Pass; 5] = [
    Pass {
        names: &["R", "G", "B"],
        layers: &["Combined", "Image"],
        channels: [&["R", "G", "B"]; 2],
    },
    Pass {
        names: &["velocity.X", "velocity.Y"],
        layers: &["Vector"],
        channels: [&["X", "Y"]; 2],
    },
    Pass {
        names: &["velocity_next.X", "velocity_next.Y"],
        layers: &["Vector"],
        channels: [&["Z", "W"]; 2],
    },
    Pass {
        names: &["Z"],
        layers: &["Depth"],
        channels: [&["Z"], &["V"]],
    },
    Pass {
        names: &["object"],
        // Blender 5 renamed it.
        layers: &["IndexOB", "Object Index"],
        channels: [&["X"], &["V"]],
    },
];

/// Reads an OpenEXR file from any program. Blender's passes get this program's names of channels.
///
/// # Errors
/// The file cannot be read, its pixels are odd, or two layers have one buffer and differ in it.
pub fn read_passes(path: &Path) -> Result<ExrFile, FileError> {
    let mut file = read_foreign_exr(path)?;
    file.expect_plain_pixels()?;
    for pass in &PASSES {
        let names = pass.choose(&file)?;
        for (name, ours) in names.iter().zip(pass.names) {
            let mut channels = file.channels.iter_mut();
            if let Some(channel) = channels.find(|channel| channel.name == *name) {
                channel.name = (*ours).to_owned();
            }
        }
    }
    Ok(file)
}

impl Pass {
    /// Chooses the channels of the buffer; none if the file lacks it. Two layers with the same bits
    /// are one: Blender writes a view layer and the compositor's copy of it.
    fn choose(&self, file: &ExrFile) -> Result<Vec<String>, FileError> {
        let mut choices = self.find(file).into_iter();
        let first = choices.next().unwrap_or_default();
        match choices.find(|other| !are_equal(file, &first, other)) {
            None => Ok(first),
            Some(other) => Err(file.foreign(format!(
                "has the channels {} and {}, which differ; allowed: one of them, or equal ones; save only the layer that the \
                 picture is to show",
                first[0], other[0]
            ))),
        }
    }

    /// Finds all channels that may be the buffer, this program's names first.
    fn find(&self, file: &ExrFile) -> Vec<Vec<String>> {
        let in_layer = |layer: &str, channels: &[&str]| -> Vec<String> {
            channels
                .iter()
                .map(|channel| format!("{layer}{channel}"))
                .collect()
        };
        let mut choices = vec![in_layer("", self.names)];
        for channel in &file.channels {
            for channels in &self.channels {
                let layer = channel.name.strip_suffix(channels[0]).unwrap_or_default();
                let last = layer
                    .strip_suffix('.')
                    .and_then(|layer| layer.rsplit('.').next());
                if last.is_some_and(|last| self.layers.contains(&last)) {
                    choices.push(in_layer(layer, channels));
                }
            }
        }
        choices.dedup();
        choices.retain(|names| names.iter().all(|name| file.has_channel(name)));
        choices
    }
}

/// Returns whether two buffers have the same bits.
fn are_equal(file: &ExrFile, one: &[String], other: &[String]) -> bool {
    let samples = |name: &String| {
        let mut channels = file.channels.iter();
        channels
            .find(|channel| channel.name == *name)
            .map(|channel| &channel.samples)
    };
    one.iter()
        .zip(other)
        .all(|(one, other)| match (samples(one), samples(other)) {
            (Some(Samples::F32(one)), Some(Samples::F32(other))) => one
                .iter()
                .zip(other)
                .all(|(one, other)| one.to_bits() == other.to_bits()),
            (one, other) => one == other,
        })
}
