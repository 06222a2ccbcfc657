//! Arguments for the frame rates of scenes.

use clap::Args;
use measure::Error;
use scene::{
    FrameRate,
    limits::{FASTEST_RATE, FASTEST_SHUTTER, SLOWEST_RATE, SLOWEST_SHUTTER},
};

use super::parse_number;
use crate::selection::{find_twin, split_scene};

/// Frame rates and shutter times to try on every scene.
#[derive(Clone, Debug, Args)]
pub struct FrameRateArgs {
    /// Frame rates to try on every scene in addition to its file's 60 frames per second, separated
    /// by commas: SCENE@144fps. Motion keeps its times in seconds; the shutter keeps its share of
    /// the frame.
    #[arg(long, value_delimiter = ',', value_name = "RATES", value_parser = parse_frame_rate)]
    pub frame_rate: Vec<f64>,
    /// Shutter times, such as 1/120, to try at each of these rates in addition to that share,
    /// separated by commas: SCENE@144fps_1-120s. They may be longer than a frame.
    #[arg(long, value_delimiter = ',', value_name = "TIMES", value_parser = parse_shutter_time)]
    pub shutter_time: Vec<f64>,
}

impl FrameRateArgs {
    /// Lists the frame rates, except the scene files' own: first with the shutter in frames, then
    /// with each shutter time.
    fn list(&self) -> Result<Vec<FrameRate>, Error> {
        if let Some(rate) = find_twin(&self.frame_rate) {
            refuse!("--frame-rate: {rate} is named twice; allowed: each once");
        }
        if let Some(count) = find_twin(&self.shutter_time) {
            refuse!("--shutter-time: 1/{count} is named twice; allowed: each once");
        }
        let written = [FrameRate::WRITTEN.per_second];
        let rates = match self.frame_rate.as_slice() {
            [] => &written[..],
            rates => rates,
        };
        let shutters = std::iter::once(None).chain(self.shutter_time.iter().copied().map(Some));
        let all = shutters.flat_map(|shutters_per_second| {
            rates.iter().map(move |&per_second| FrameRate {
                per_second,
                shutters_per_second,
            })
        });
        Ok(all.filter(|rate| *rate != FrameRate::WRITTEN).collect())
    }

    /// Adds each scene at each frame rate, after the scene itself. Without names, adds every scene.
    pub fn add_to(&self, names: Vec<String>) -> Result<Vec<String>, Error> {
        let rates = self.list()?;
        if rates.is_empty() {
            return Ok(names);
        }
        let names = if names.is_empty() {
            vec!["*".to_owned()]
        } else {
            names
        };
        let mut all = Vec::new();
        for name in names {
            let scene = name.trim_end_matches(['/', '\\']);
            if split_scene(scene).1.rate.is_some() {
                refuse!(
                    "--frame-rate: {name} has a frame rate of its own; allowed: scenes and variants without one"
                );
            }
            all.push(name.clone());
            all.extend((rates.iter()).map(|rate| format!("{scene}@{}", rate.word())));
        }
        Ok(all)
    }
}

fn parse_frame_rate(text: &str) -> Result<f64, String> {
    let is_allowed = |rate| (SLOWEST_RATE..=FASTEST_RATE).contains(&rate);
    parse_number(text, is_allowed, || {
        format!("frames per second from {SLOWEST_RATE} to {FASTEST_RATE}, such as 144")
    })
}

/// Parses a shutter time: `1/48` is 48, the number of such times in a second.
fn parse_shutter_time(text: &str) -> Result<f64, String> {
    let is_allowed = |count| (SLOWEST_SHUTTER..=FASTEST_SHUTTER).contains(&count);
    parse_number(
        text.strip_prefix("1/").unwrap_or_default(),
        is_allowed,
        || {
            format!(
                "parts of a second from 1/{SLOWEST_SHUTTER} to 1/{FASTEST_SHUTTER}, such as 1/48"
            )
        },
    )
}
