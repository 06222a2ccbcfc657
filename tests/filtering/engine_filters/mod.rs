//! What the blurs of game engines do and do not, measured: what was read in their sources, shown true or false.

mod bevy;
mod hdrp;
mod hdrp_tiles;
mod jimenez;
mod kajiya;
mod kino;
mod o3de;
mod wicked;
