//! Tuning: known answers for every decision.

mod deciding;
mod searching;
