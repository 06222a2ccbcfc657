//! Samples per pixel by a noise.

use measure::{Error, RunPlan, estimate_render_seconds};
use scene::Scene;
use terminal::arguments::MeasureArgs;
use terminal::expected::print_expected_time;
use terminal::output::{count_text, print_note};
use terminal::refuse;

/// Noise of scenes that are not built in, whose noise nobody has measured.
const OWN_SCENES: f64 = 0.005;

/// Chooses the noise: the one asked for; without a number of samples, that of scenes that are not
/// built in. None leaves the samples as they are. Refuses a noise if nothing is rendered.
pub fn choose_noise(args: &MeasureArgs, scenes: &[Scene]) -> Result<Option<f64>, Error> {
    if scenes.is_empty() && args.noise.is_some() {
        refuse!(
            "--noise: engines drew all of these scenes, and none is rendered; leave the option out"
        );
    }
    let is_built_in = |scene: &Scene| {
        (catalogue::SCENES.unpack)(&format!("{}/scene.toml", scene.id.name)).is_some()
    };
    let has_own = !scenes.iter().all(is_built_in);
    let default = (has_own && args.scenes.samples_per_pixel.is_none()).then_some(OWN_SCENES);
    Ok(args.noise.or(default))
}

/// Gives a plan the samples per pixel that its noisiest scene needs, and prints them.
pub fn choose_samples(plan: &mut RunPlan) -> Result<(), Error> {
    let Some(noise) = plan.noise else {
        return Ok(());
    };
    let unknown = plan.count_unknown_samples(noise);
    let pilots = plan.pilots();
    let each: f64 = (pilots.iter())
        .map(|settings| estimate_render_seconds(settings, 1))
        .sum();
    let seconds = unknown as f64 * each;
    let scenes = count_text(unknown, "scene", "scenes");
    print_expected_time(seconds, &format!("to measure the noise of {scenes}"));
    let needed = plan.find_needed_samples(noise)?;
    let noisiest = needed.iter().zip(&plan.scenes);
    let Some((samples, scene)) = noisiest.max_by_key(|(samples, _)| **samples) else {
        return Ok(());
    };
    plan.render.samples_per_pixel = *samples;
    print_note(&format!(
        "{samples} samples per pixel bring the noise of {} to about {noise}; --samples-per-pixel or --noise choose others",
        scene.id
    ));
    Ok(())
}
