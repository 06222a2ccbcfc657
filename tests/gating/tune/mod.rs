//! Tuning: known answers of everything that decides.

mod deciding;
mod searching;
mod sensitivity;
