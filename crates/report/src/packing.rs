//! Numbers of a picture as few bytes: what is shared with another picture is said once, and of the rest what neighbours and
//! the other components do not tell.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::precision::Precision;

/// What a plane is kept against, as bits of numbers. All have as many.
#[derive(Clone, Copy, Default)]
pub struct Against<'a> {
    /// Another plane, with which it shares pixels.
    pub base: Option<&'a [u32]>,
    /// The component before: noise of light is in all of them.
    pub component: Option<&'a [u32]>,
}

/// The zlib stream of a plane's bits. It begins with one bit per pixel, the lowest of a byte first: whether the number is the
/// base's. Of the others follow the lowest bytes, then the next, up to the highest, of a residue: the number's difference to
/// the one before, less the same of the component, as integers of the number's width; 0, -1, 1, -2 .. are kept as 0, 1, 2, 3.
pub fn packed(own: &[u32], against: Against, precision: Precision) -> Vec<u8> {
    let shared = |at: usize| against.base.is_some_and(|base| base[at] == own[at]);
    let step =
        |bits: &[u32], at: usize| bits[at].wrapping_sub(at.checked_sub(1).map_or(0, |at| bits[at]));
    let residues: Vec<u32> = (0..own.len())
        .filter(|at| !shared(*at))
        .map(|at| {
            let expected = against.component.map_or(0, |bits| step(bits, at));
            folded(step(own, at).wrapping_sub(expected), precision)
        })
        .collect();
    let mut bytes = vec![0; own.len().div_ceil(8)];
    for at in (0..own.len()).filter(|at| shared(*at)) {
        bytes[at / 8] |= 1 << (at % 8);
    }
    for byte in 0..precision.width() {
        bytes.extend(residues.iter().map(|residue| (residue >> (8 * byte)) as u8));
    }
    deflated(&bytes)
}

/// A difference to a number of its size: the lowest bit is the sign.
fn folded(difference: u32, precision: Precision) -> u32 {
    let unused = 32 - 8 * precision.width();
    let signed = ((difference << unused) as i32) >> unused;
    ((signed << 1) ^ (signed >> 31)) as u32
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).expect("memory takes every byte");
    encoder.finish().expect("memory takes every byte")
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::ZlibDecoder;

    use super::*;

    /// As the page's script does it.
    fn unpacked(stream: &[u8], count: usize, against: Against, precision: Precision) -> Vec<u32> {
        let mut bytes = Vec::new();
        ZlibDecoder::new(stream).read_to_end(&mut bytes).unwrap();
        let (mask, rest) = bytes.split_at(count.div_ceil(8));
        let residues = rest.len() / precision.width();
        let all = u32::MAX >> (32 - 8 * precision.width());
        let mut own = vec![0_u32; count];
        let mut next = 0;
        for at in 0..count {
            if mask[at / 8] >> (at % 8) & 1 == 1 {
                own[at] = against.base.unwrap()[at];
                continue;
            }
            let folded: u32 = (0..precision.width())
                .map(|byte| u32::from(rest[byte * residues + next]) << (8 * byte))
                .sum();
            next += 1;
            let mut value = (folded >> 1) ^ (folded & 1).wrapping_neg();
            let before = |bits: &[u32]| at.checked_sub(1).map_or(0, |at| bits[at]);
            value = value.wrapping_add(before(&own));
            if let Some(component) = against.component {
                value = value
                    .wrapping_add(component[at])
                    .wrapping_sub(before(component));
            }
            own[at] = value & all;
        }
        assert_eq!(next, residues, "every residue belongs to a pixel");
        own
    }

    #[test]
    fn what_is_packed_comes_back_bit_for_bit() {
        // Numbers of every size and sign, half of them the base's.
        let number = |at: u32| (at.wrapping_mul(2_654_435_761) >> 7) as f32 / 1e3 - 1e4;
        for precision in [Precision::Float, Precision::Half] {
            let nature = super::super::precision::Nature::Number;
            let bits = |number: &dyn Fn(u32) -> f32| -> Vec<u32> {
                (0..1001)
                    .map(|at| precision.bits(number(at), nature))
                    .collect()
            };
            let base = bits(&number);
            let component = bits(&|at| number(at + 7));
            let own = bits(&|at| {
                if at % 5 < 3 {
                    number(at)
                } else {
                    -3.0 * number(at)
                }
            });
            for against in [
                Against::default(),
                Against {
                    base: Some(&base),
                    component: None,
                },
                Against {
                    base: None,
                    component: Some(&component),
                },
                Against {
                    base: Some(&base),
                    component: Some(&component),
                },
            ] {
                let stream = packed(&own, against, precision);
                assert!(
                    unpacked(&stream, own.len(), against, precision) == own,
                    "{precision:?}"
                );
            }
        }
    }

    #[test]
    fn what_is_shared_takes_hardly_any_room() {
        let mut state = 1_u32;
        let mut noise = || {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            state
        };
        let base: Vec<u32> = (0..10_000).map(|_| noise()).collect();
        let own: Vec<u32> = (base.iter().enumerate())
            .map(|(at, bits)| if at < 9_900 { *bits } else { !bits })
            .collect();
        let size = |base| {
            let against = Against {
                base,
                component: None,
            };
            packed(&own, against, Precision::Float).len()
        };
        // A hundred numbers, a mask of two runs, and what zlib adds.
        assert!(size(Some(&base)) < 600, "{}", size(Some(&base)));
        assert!(size(None) > 30_000, "{}", size(None));
    }
}
