//! Changes of PNG files: chunks with right checksums and wrong content.

use flate2::Crc;

use super::Format;
use super::bytes;

/// First bytes of PNG files.
pub const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Chunks: each piece is a type and a content.
pub static FORMAT: Format = Format {
    header: SIGNATURE.len(),
    cut: |mut rest, _| {
        let mut chunks = Vec::new();
        while let Some((length, named)) = rest.split_first_chunk() {
            let length = u32::from_be_bytes(*length) as usize;
            let Some(chunk) = named.get(..length.saturating_add(4)) else {
                break;
            };
            chunks.push(chunk.to_vec());
            rest = named.get(length + 8..).unwrap_or_default();
        }
        chunks
    },
    write: |file, chunk| {
        let mut crc = Crc::new();
        crc.update(chunk);
        file.extend((chunk.len().saturating_sub(4) as u32).to_be_bytes());
        file.extend(chunk);
        file.extend(crc.sum().to_be_bytes());
    },
    edit: |chunks, _, random| {
        // The depth, kind of colour or interlacing.
        if random.u8(..3) == 0 && chunks[0].starts_with(b"IHDR") && chunks[0].len() > 16 {
            let field = random.choice([12, 13, 16]).expect("a list");
            chunks[0][field] = random.choice([0, 1, 2, 3, 4, 6, 8, 16]).expect("a list");
            return;
        }
        let at = random.usize(..chunks.len());
        let name = chunks[at].len().min(4);
        let mut content = chunks[at].split_off(name);
        bytes::edit(&mut content, random);
        chunks[at].extend(content);
    },
    moves: 4,
};
