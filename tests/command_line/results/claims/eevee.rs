//! The mean of samples that EEVEE is scored by.

use judge::Results;
use metrics::Metric;
use tests::root;

use super::Preset;
use crate::results::engines::list_engines;
use crate::results::page::main_results;

#[test]
fn eevee_is_scored_by_a_mean_of_its_samples_which_is_better_than_one() {
    let engines = list_engines();
    let eevee = engines.iter().find(|engine| engine.name.contains("EEVEE"));
    let eevee = eevee.unwrap();
    let mean = Preset::new(&eevee.shape);
    let [draws, one] = [&mean, &Preset::new("blender:eevee")].map(|preset| preset.number("draws"));
    assert_eq!(one, 1.0);
    let phrase = format!("the mean of {draws} of its 64 samples");
    assert!(mean.text().contains(&phrase), "{}", mean.text());
    assert!(eevee.name.ends_with("64 samples"), "{}", eevee.name);
    let results = Results::read_all(&root().join("results")).unwrap();
    let main = main_results(&results).unwrap();
    for scene in main.scenes() {
        let [mean, one] = [&*eevee.shape, "blender:eevee"].map(|name| {
            let mut scores = main.scores.iter();
            let score = scores.find(|score| score.scene == *scene && score.name == name);
            score.unwrap().score(Metric::FLIP).unwrap()
        });
        // One sample is certainly truer than the mean on no scene.
        assert!(mean < one + 0.001, "{scene}: {mean}, one sample {one}");
    }
}
