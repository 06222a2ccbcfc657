//! Labels of pictures: a bar of small letters above each.

use frame::{Image, Raster};

/// The characters of the letters below, in order.
const SIGNS: &str = " .:-_0123456789abcdefghijklmnopqrstuvwxyzFILP";
/// Five columns of each sign as hexadecimal bytes; the lowest bit is the upper row.
const COLUMNS: &str = "\
000000000000606000000036360000080808080840404040403E5149453E00427F400042615149462141454B311814127F1027454545393C4A494930\
01710905033649494936064949291E20545454787F484444383844444420384444487F3854545418087E09010218A4A4A47C7F0804047800447D4000\
4080847D007F1028440000417F40007C041804787C080404783844444438FC2424241818242424FC7C080404084854545420043F4440203C4040207C\
1C2040201C3C4030403C44281028441CA0A0A07C4464544C447F0909090100417F41007F404040407F09090906";
/// Rows and columns of a letter, including the gap to the next.
const PITCH: [u32; 2] = [6, 10];
/// Picture width at which a dot of a letter is one pixel.
const DOT_WIDTH: u32 = 160;

/// Adds a bar with a text above a picture. Characters that presets and scores do not use leave a
/// gap.
pub fn label(picture: &Image, text: &str) -> Image {
    let dot = (picture.width / DOT_WIDTH).max(1);
    let bar = PITCH[1] * dot;
    Raster::from_fn(picture.width, picture.height + bar, |x, y| {
        if y < bar {
            [f32::from(u8::from(is_ink(text, x / dot, y / dot))); 3]
        } else {
            *picture.at(x, y - bar)
        }
    })
}

/// Returns whether a dot of a bar belongs to a letter.
fn is_ink(text: &str, x: u32, y: u32) -> bool {
    let sign = text.chars().nth((x / PITCH[0]) as usize);
    let index = sign.and_then(|sign| SIGNS.chars().position(|letter| letter == sign));
    let (Some(index), Some(row)) = (index, y.checked_sub(1)) else {
        return false;
    };
    let column = (x % PITCH[0]) as usize;
    let at = 10 * index + 2 * column;
    let bits = u8::from_str_radix(&COLUMNS[at..(at + 2).min(COLUMNS.len())], 16);
    column < 5 && row < 8 && bits.is_ok_and(|bits| (bits >> row) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_is_a_bar_of_letters_above_the_picture() {
        assert_eq!(COLUMNS.len(), 10 * SIGNS.len());
        let picture = Raster::filled(320, 4, [0.25; 3]);
        let labelled = label(&picture, "kino:L?");
        assert_eq!((labelled.width, labelled.height), (320, 24));
        assert_eq!(*labelled.at(319, 20), [0.25; 3]);
        // An L: a column of seven dots, and a row below; a dot is two pixels.
        let ink = |column: u32, row: u32| *labelled.at(2 * column + 1, 2 * row + 1) == [1.0; 3];
        let rows = (0..10).map(|row| (30..42).filter(|&column| ink(column, row)).count());
        assert_eq!(rows.collect::<Vec<_>>(), [0, 1, 1, 1, 1, 1, 1, 5, 0, 0]);
    }
}
