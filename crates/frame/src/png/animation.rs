//! Animated PNG files, which browsers and pages of pull requests play.

use std::path::Path;

use crate::{FileError, Raster, Size, write_atomically};

/// Writes display values in [0, 1] as an animated PNG of 8 bits that plays for ever, at a number of
/// frames per second. All frames have the size of the first; there is at least one.
pub fn write_animated_png(
    path: &Path,
    frames: &[Raster<[f32; 3]>],
    per_second: f64,
) -> Result<(), FileError> {
    let first = frames.first().expect("an animation has a frame");
    assert!(
        frames.iter().all(|frame| frame.same_size(first)),
        "the frames of an animation have one size"
    );
    let bytes = encode(frames, first.size(), per_second)
        .map_err(|error| FileError::io(path, "encode", std::io::Error::other(error)))?;
    write_atomically(path, &bytes)
}

fn encode(
    frames: &[Raster<[f32; 3]>],
    Size { width, height }: Size,
    per_second: f64,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(frames.len() as u32, 0)?;
    let (numerator, denominator) = delay(per_second);
    encoder.set_frame_delay(numerator, denominator)?;
    let mut writer = encoder.write_header()?;
    for frame in frames {
        let values = frame.pixels.iter().flatten();
        let data: Vec<u8> = values.map(|value| (value * 255.0 + 0.5) as u8).collect();
        writer.write_image_data(&data)?;
    }
    writer.finish()?;
    Ok(bytes)
}

/// The time of a frame as a fraction of a second, of 16 bits each.
fn delay(per_second: f64) -> (u16, u16) {
    let most = f64::from(u16::MAX);
    // Slow sequences need a large numerator, fast ones a large denominator.
    let numerator = [1000.0, 100.0, 10.0, 1.0]
        .into_iter()
        .find(|numerator| numerator * per_second <= most);
    let numerator = numerator.unwrap_or(1.0);
    let denominator = (numerator * per_second).round().clamp(1.0, most);
    (numerator as u16, denominator as u16)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    #[test]
    fn an_animation_holds_its_frames_and_their_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sequence.png");
        let frames: Vec<_> = [0.0, 0.4, 1.0]
            .map(|value| Raster::filled(5, 3, [value; 3]))
            .into();
        write_animated_png(&path, &frames, 30.0).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let animation = reader.info().animation_control.unwrap();
        // 0 plays are plays without end.
        assert_eq!((animation.num_frames, animation.num_plays), (3, 0));
        for value in [0, 102, 255] {
            let mut pixels = vec![7; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            assert_eq!(pixels, vec![value; 45]);
            let control = reader.info().frame_control.unwrap();
            assert_eq!((control.delay_num, control.delay_den), (1000, 30_000));
        }
    }

    #[test]
    fn a_time_fits_16_bits() {
        for (per_second, expected) in [
            (60.0, (1000, 60_000)),
            (144.0, (100, 14_400)),
            (0.5, (1000, 500)),
        ] {
            assert_eq!(delay(per_second), expected);
        }
        assert_eq!(delay(1000.0), (10, 10_000));
    }
}
