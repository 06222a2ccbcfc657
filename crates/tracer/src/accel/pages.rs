//! Long slices in large memory pages.

use std::ops::Deref;

use bytemuck::Pod;
use memmap2::MmapMut;

/// Bytes of a large page. Slices of half as many and more get such pages.
const LARGE: usize = 1 << 21;

/// A slice that rays read here and there. Over many small pages a processor loses sight of where in memory they lie, and has to
/// look that up before nearly every read; Linux gives large ones where they are asked for.
pub(crate) enum Pages<T> {
    /// Short, or on a system without large pages.
    Heap(Vec<T>),
    /// As bytes.
    Large {
        memory: MmapMut,
        /// Where the slice begins: at a large page's beginning.
        start: usize,
        bytes: usize,
    },
}

impl<T: Pod> Pages<T> {
    pub fn of(items: Vec<T>) -> Self {
        let bytes = size_of_val(items.as_slice());
        if bytes < LARGE / 2 {
            return Pages::Heap(items);
        }
        let Some(mut memory) = large_pages(bytes.next_multiple_of(LARGE) + LARGE) else {
            return Pages::Heap(items);
        };
        let start = memory.as_ptr().align_offset(LARGE);
        memory[start..start + bytes].copy_from_slice(bytemuck::cast_slice(&items));
        Pages::Large {
            memory,
            start,
            bytes,
        }
    }
}

impl<T: Pod> Deref for Pages<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match self {
            Pages::Heap(items) => items,
            Pages::Large {
                memory,
                start,
                bytes,
            } => bytemuck::cast_slice(&memory[*start..start + bytes]),
        }
    }
}

/// So many bytes in large pages where they begin at one; none where the system has none.
#[cfg(target_os = "linux")]
fn large_pages(bytes: usize) -> Option<MmapMut> {
    let memory = MmapMut::map_anon(bytes).ok()?;
    memory.advise(memmap2::Advice::HugePage).ok()?;
    Some(memory)
}

/// So many bytes in large pages; none where the system has none.
#[cfg(not(target_os = "linux"))]
fn large_pages(_: usize) -> Option<MmapMut> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slice_of_any_length_reads_back() {
        for length in [0, 1, 1000, LARGE / 8 - 1, LARGE / 8, 3 * LARGE / 4 + 5] {
            let items: Vec<u32> = (0..length as u32)
                .map(|index| index ^ 0x5555_5555)
                .collect();
            assert_eq!(*Pages::of(items.clone()), *items);
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_long_slice_begins_at_a_large_page() {
        let pages = Pages::of(vec![7_u32; LARGE]);
        if matches!(pages, Pages::Large { .. }) {
            assert_eq!(pages.as_ptr().align_offset(LARGE), 0);
        }
    }
}
