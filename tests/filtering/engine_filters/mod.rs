//! Claims from the sources of game engines' blurs, each shown to be true or false.

mod babylon;
mod bevy;
mod blender;
mod dagor;
mod hdrp;
mod hdrp_tiles;
mod jimenez;
mod kajiya;
mod kino;
mod o3de;
mod realism_effects;
mod wicked;
