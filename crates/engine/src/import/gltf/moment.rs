//! Times: frames of the scene and seconds of the file.

use super::animation::Animation;

/// Frames between the two keys of a jump.
pub const JUMP: f64 = 1e-3;

/// Times closer than this are one, in frames.
const SAME: f64 = 1e-4;

/// A time, as frames relative to the instant and as seconds of the animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    pub frame: f64,
    pub seconds: f64,
}

/// The part of an animation that a scene shows.
#[derive(Clone, Copy, Debug)]
pub struct Clip {
    /// Seconds of the animation at the instant.
    pub instant: f64,
    /// Frames per second.
    pub rate: f64,
    /// Frames that a sequence has.
    pub frames: u32,
    /// Frames that keys cover, relative to the instant.
    pub span: [f64; 2],
}

/// A time at which keys are put.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    pub moment: Moment,
    /// True if values jump between the mark before and this one.
    pub is_jump: bool,
    /// True if a frame is drawn at this time, so that velocities must be right.
    pub is_drawn: bool,
}

impl Clip {
    pub fn moment(&self, frame: f64) -> Moment {
        Moment {
            frame,
            seconds: self.instant + frame / self.rate,
        }
    }

    fn frame(&self, seconds: f64) -> f64 {
        (seconds - self.instant) * self.rate
    }

    /// Lists whole frames, and the keys of the animation between the ends of the span.
    pub fn marks(&self, animation: &Animation) -> Vec<Mark> {
        let [start, end] = self.span;
        let drawn = 0.0..f64::from(self.frames);
        let count = (end - start) as u32;
        let whole = (0..=count)
            .map(|frame| start + f64::from(frame))
            .map(|frame| Mark {
                moment: self.moment(frame),
                is_jump: false,
                is_drawn: drawn.contains(&frame),
            });
        let mut marks: Vec<Mark> = whole.collect();
        for channel in &animation.channels {
            for (key, time) in channel.times.iter().enumerate() {
                let seconds = f64::from(*time);
                let frame = self.frame(seconds);
                if frame > start + SAME && frame < end - SAME {
                    let is_jump = channel.is_step() && key > 0;
                    let mark = |frame: f64, seconds: f64, is_jump: bool| Mark {
                        moment: Moment { frame, seconds },
                        is_jump,
                        is_drawn: false,
                    };
                    if is_jump && frame - JUMP > start {
                        marks.push(mark(frame - JUMP, seconds - JUMP / self.rate, false));
                    }
                    marks.push(mark(frame, seconds, is_jump));
                }
            }
        }
        marks.sort_by(|a, b| a.moment.frame.total_cmp(&b.moment.frame));
        marks.dedup_by(|after, before| {
            let is_same = after.moment.frame - before.moment.frame < SAME;
            if is_same {
                // Whole frames stay whole; the later time in seconds is after the jump.
                if before.moment.frame.fract() != 0.0 {
                    before.moment.frame = after.moment.frame;
                }
                before.moment.seconds = before.moment.seconds.max(after.moment.seconds);
                before.is_jump |= after.is_jump;
                before.is_drawn |= after.is_drawn;
            }
            is_same
        });
        marks
    }
}
