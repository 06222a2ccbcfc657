//! Changes of command lines, one word a line.

use super::Source;
use crate::random::Random;
use crate::tokens::TEXTS;

/// Inserts, removes or replaces a word, or continues as another command line does.
pub fn change(input: &mut Vec<u8>, source: &Source, random: &mut Random) {
    let text = String::from_utf8_lossy(input).into_owned();
    let mut words: Vec<String> = text.split('\n').map(str::to_owned).collect();
    let at = random.below(words.len());
    let token = |random: &mut Random| match random.once_in(5) {
        true => (*random.pick(&TEXTS)).replace('\n', " "),
        false => (*random.pick(source.tokens)).to_owned(),
    };
    match random.below(8) {
        0 => drop(words.remove(at)),
        1 => {
            let other = String::from_utf8_lossy(source.other).into_owned();
            let from = random.below(words.len());
            words.truncate(at + 1);
            words.extend(other.split('\n').skip(from).map(str::to_owned));
        }
        2 => words.swap(at, 0),
        3 | 4 => words.insert(at, token(random)),
        _ => words[at] = token(random),
    }
    *input = words.join("\n").into_bytes();
}
