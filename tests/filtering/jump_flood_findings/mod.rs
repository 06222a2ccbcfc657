//! Claims suggested by the paper and the demo of the jump flood, each shown to be true or false.
//!
//! shaders/jump_flood/README.md lists the outcomes.

mod acceptance;
mod foreground;
mod map;
mod mover;
mod trail;
