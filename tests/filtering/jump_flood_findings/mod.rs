//! What reading the jump flood's paper and demo suggested, shown true or false one by one; shaders/jump_flood/README.md
//! lists the outcomes.

mod acceptance;
mod foreground;
mod map;
mod mover;
mod trail;
