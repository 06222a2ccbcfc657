//! Changes of OpenEXR files: wrong content with right checksums.

use std::fs;

use fastrand::Rng;
use frame::{ExrFile, Samples, read_exr, write_exr};

use super::magnitude;
use super::text::{make_text, pick_number};
use crate::place::Place;

/// First bytes of OpenEXR files.
pub const MAGIC: &[u8] = b"\x76\x2F\x31\x01";

/// Changes channels, attributes or the size.
pub fn change(input: &mut Vec<u8>, place: &Place, random: &mut Rng) {
    let path = place.write("mutation.exr", &input);
    let Ok(mut file) = read_exr(&path) else {
        return;
    };
    let at = random.usize(..file.channels.len());
    match random.u8(..8) {
        0 if file.channels.len() > 1 => drop(file.channels.remove(at)),
        1 => {
            let start = random.choice(["", "coverage."]).expect("a list");
            let name = start.to_owned() + &make_plain_text(random);
            if file.channels.iter().all(|channel| channel.name != name) {
                file.channels[at].name = name;
            }
        }
        2 => {
            (file.width, file.height) = (random.u32(1..=20), random.u32(1..=20));
            let count = (file.width * file.height) as usize;
            for channel in &mut file.channels {
                match &mut channel.samples {
                    Samples::F32(values) => values.resize(count, 0.5),
                    Samples::U32(values) => values.resize(count, 0),
                }
            }
        }
        3 | 4 => change_samples(&mut file.channels[at].samples, random),
        _ => change_attribute(&mut file, random),
    }
    if write_exr(&path, &file).is_ok() {
        *input = fs::read(&path).unwrap();
    }
}

/// Makes a text that the format allows.
fn make_plain_text(random: &mut Rng) -> String {
    make_text(random).replace(|c: char| !c.is_ascii() || c == '\0', "")
}

/// Changes some samples of a channel, or its type.
fn change_samples(samples: &mut Samples, random: &mut Rng) {
    let number = pick_number(random);
    let mut count = |length| magnitude(length, random);
    match samples {
        Samples::F32(values) if count(8) == 8 => {
            *samples = Samples::U32(values.iter().map(|value| *value as u32).collect());
        }
        Samples::F32(values) => {
            let number = number.parse().expect("it is a list of numbers");
            let count = count(values.len());
            values[..count].fill(number);
        }
        Samples::U32(values) => {
            let number = number.parse().unwrap_or(u32::MAX);
            let count = count(values.len());
            values[..count].fill(number);
        }
    }
}

fn change_attribute(file: &mut ExrFile, random: &mut Rng) {
    let names: Vec<String> = file.attributes.keys().cloned().collect();
    let [Some(name), Some(other)] = [random.choice(&names), random.choice(&names)] else {
        return;
    };
    let other = file.attributes[other].clone();
    let old = file.attributes.remove(name).expect("it is a name of one");
    match random.u8(..5) {
        0 => {}
        1 => file.set(name, make_plain_text(random)),
        2 => file.set(name, format!("{old} {old}")),
        3 => file.set(name, other),
        _ => file.set(name, pick_number(random)),
    }
}
