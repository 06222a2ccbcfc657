//! Reading of files that others wrote: regular files only, up to a given size.

use std::{
    fs::{File, Metadata},
    io::Read,
    path::Path,
};

use super::error::FileError;

/// Reads a regular file of at most `limit` bytes.
///
/// Symbolic links are followed. A directory, a FIFO, a socket or a device is refused before it is
/// opened, so that nothing blocks. A file that is larger than `limit` is refused before it is read.
/// A file that grows while it is read is refused too: no more than `limit + 1` bytes are ever held.
///
/// # Errors
/// Fails if the file cannot be read, is no regular file, or is larger than `limit`.
pub fn read_bounded(path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    let io = |source| FileError::io(path, "read", source);
    let (file, size) = open_regular(path, limit)?;
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0));
    file.take(limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(io)?;
    let read = bytes.len() as u64;
    if read > limit {
        return Err(too_large(path, read, limit));
    }
    Ok(bytes)
}

/// Opens a regular file of at most `limit` bytes; returns its size too. Anything else is refused
/// before it is opened, so that nothing blocks.
pub fn open_regular(path: &Path, limit: u64) -> Result<(File, u64), FileError> {
    let io = |source| FileError::io(path, "read", source);
    let metadata = std::fs::metadata(path).map_err(io)?;
    refuse_unfit(path, &metadata, limit)?;
    let file = File::open(path).map_err(io)?;
    // Another file may be at the path by now.
    let metadata = file.metadata().map_err(io)?;
    refuse_unfit(path, &metadata, limit)?;
    Ok((file, metadata.len()))
}

fn refuse_unfit(path: &Path, metadata: &Metadata, limit: u64) -> Result<(), FileError> {
    if !metadata.is_file() {
        return Err(FileError::foreign(
            path,
            format!(
                "is {}, where a regular file is expected; name a file",
                kind_of(metadata)
            ),
        ));
    }
    if metadata.len() > limit {
        return Err(too_large(path, metadata.len(), limit));
    }
    Ok(())
}

fn too_large(path: &Path, size: u64, limit: u64) -> FileError {
    FileError::foreign(
        path,
        format!("holds {size} bytes, and at most {limit} are read; use a smaller file"),
    )
}

/// Names the kind of a file that is not regular, with its article.
pub(crate) fn kind_of(metadata: &Metadata) -> &'static str {
    if metadata.is_dir() {
        return "a folder";
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = metadata.file_type();
        if kind.is_fifo() {
            return "a FIFO (named pipe)";
        }
        if kind.is_socket() {
            return "a socket";
        }
        if kind.is_char_device() || kind.is_block_device() {
            return "a device";
        }
    }
    "a special file"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_at_the_limit_is_read_and_one_byte_more_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("four");
        std::fs::write(&path, b"four").unwrap();
        assert_eq!(read_bounded(&path, 4).unwrap(), b"four");
        let refusal = read_bounded(&path, 3).unwrap_err().to_string();
        assert!(
            refusal.contains("holds 4 bytes, and at most 3 are read"),
            "{refusal}"
        );
    }
}
