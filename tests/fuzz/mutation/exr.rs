//! Changes of OpenEXR files: wrong content with right checksums.

use std::fs;

use frame::{Channel, ExrFile, Samples, read_exr, write_exr};

use crate::place::Place;
use crate::random::Random;
use crate::tokens::{NUMBERS, TEXTS};

/// Changes channels, attributes or the size.
pub fn change(input: &mut Vec<u8>, place: &Place, random: &mut Random) {
    let path = place.write("mutation.exr", &input);
    let Ok(mut file) = read_exr(&path) else {
        return;
    };
    match random.below(8) {
        0 => drop(file.channels.remove(random.below(file.channels.len()))),
        1 => {
            let at = random.below(file.channels.len());
            let mut copy = file.channels[at].clone();
            copy.name = pick_name(&file, random);
            if file
                .channels
                .iter()
                .all(|channel| channel.name != copy.name)
            {
                file.channels[at] = copy;
            }
        }
        2 => change_size(&mut file, random),
        3 | 4 => change_values(&mut file, random),
        _ => change_attribute(&mut file, random),
    }
    if file.channels.is_empty() {
        return;
    }
    if write_exr(&path, &file).is_ok() {
        *input = fs::read(&path).unwrap();
    }
}

fn pick_name(file: &ExrFile, random: &mut Random) -> String {
    match random.once_in(3) {
        true => format!("coverage.{}", make_text(random)),
        false => {
            file.channels[random.below(file.channels.len())]
                .name
                .clone()
                + "x"
        }
    }
}

/// Makes a text that the format can hold.
fn make_text(random: &mut Random) -> String {
    let text = random.pick(&TEXTS);
    text.chars()
        .filter(|c| c.is_ascii() && *c != '\0')
        .collect()
}

/// Changes the size, with the right number of samples.
fn change_size(file: &mut ExrFile, random: &mut Random) {
    (file.width, file.height) = (1 + random.below(20) as u32, 1 + random.below(20) as u32);
    let count = (file.width * file.height) as usize;
    for Channel { samples, .. } in &mut file.channels {
        match samples {
            Samples::F32(values) => values.resize(count, 0.5),
            Samples::U32(values) => values.resize(count, 0),
        }
    }
}

/// Changes some samples of a channel, or its kind.
fn change_values(file: &mut ExrFile, random: &mut Random) {
    const FLOATS: [f32; 10] = [
        0.0,
        -0.0,
        -1.0,
        1e-45,
        1e38,
        f32::MAX,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        2.0,
    ];
    const INTEGERS: [u32; 5] = [0, 1, 2, 255, u32::MAX];
    let at = random.below(file.channels.len());
    let count = random.magnitude((file.width * file.height) as usize);
    let samples = &mut file.channels[at].samples;
    match samples {
        Samples::F32(values) if random.once_in(8) => {
            *samples = Samples::U32(values.iter().map(|value| *value as u32).collect());
        }
        Samples::F32(values) => values[..count].fill(*random.pick(&FLOATS)),
        Samples::U32(values) => values[..count].fill(*random.pick(&INTEGERS)),
    }
}

fn change_attribute(file: &mut ExrFile, random: &mut Random) {
    let names: Vec<String> = file.attributes.keys().cloned().collect();
    if names.is_empty() {
        return;
    }
    let name = random.pick(&names).clone();
    let old = file.attributes[&name].clone();
    let text = match random.below(5) {
        0 => {
            file.attributes.remove(&name);
            return;
        }
        1 => make_text(random),
        2 => format!("{old} {old}"),
        3 => file.attributes[random.pick(&names)].clone(),
        _ => (*random.pick(&NUMBERS)).to_owned(),
    };
    file.set(&name, text);
}
