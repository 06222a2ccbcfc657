//! Helps to choose the region of the headline score: prints FLIP of slight errors, of spills and of
//! doing nothing, over *moving* and *support*, on all shipped scenes or the named ones, as
//! Markdown. `cargo run -p shuttertruth --example regions -- 160x90 64`

use std::ops::ControlFlow;
use std::process::ExitCode;

use frame::{Alignment, Frame, Image, Picture, Raster, Truth};
use judge::make_wrong_pictures;
use measure::Error;
use metrics::scatter_oracle;
use metrics::{MeasureError, Reference};
use rayon::prelude::*;
use scene::{Scene, list_scenes, load_scene};
use tracer::{Progress, RenderSettings, trace_frame, trace_truth};

/// FLIP over *moving* and over *support*.
type Errors = [f64; 2];

/// The errors of a scene's pictures, by name.
struct Row {
    scene: String,
    errors: Vec<(String, Errors)>,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let parsed = match words.as_slice() {
        [size, samples, ..] => parse(size, samples),
        _ => None,
    };
    let Some(settings) = parsed else {
        eprintln!(
            "give a size and samples per pixel, such as 160x90 64, and scenes if not all are wanted"
        );
        return ExitCode::from(2);
    };
    match measure_scenes(&settings, words.get(2..).unwrap_or_default()) {
        Ok(rows) => {
            print_table(&rows);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn parse(size: &str, samples: &str) -> Option<RenderSettings> {
    let (width, height) = size.split_once('x')?;
    Some(RenderSettings {
        width: width.parse().ok()?,
        height: height.parse().ok()?,
        samples_per_pixel: samples.parse().ok()?,
        ..RenderSettings::default()
    })
}

fn measure_scenes(settings: &RenderSettings, names: &[String]) -> Result<Vec<Row>, Error> {
    let mut rows = Vec::new();
    for listing in list_scenes(std::path::Path::new("scenes"))? {
        if !(names.is_empty() || names.contains(&listing.name)) {
            continue;
        }
        let scene = load_scene(std::path::Path::new("scenes").join(&listing.name), None)?;
        let unwatched = |_: Progress| ControlFlow::Continue(());
        let frame = trace_frame(&scene, settings, &unwatched)?;
        // A centred shutter, so that the frame has no lag.
        let truth = trace_truth(&scene, settings, Alignment::Centred, &unwatched)?;
        if truth.support.moving.pixels.contains(&true) {
            rows.push(measure(&scene, &frame, &truth)?);
            eprintln!("{}", scene.id);
        }
    }
    Ok(rows)
}

fn measure(scene: &Scene, frame: &Frame, truth: &Truth) -> Result<Row, MeasureError> {
    let mean = truth.mean();
    let alike = |color: Image| Picture {
        color,
        coverage: mean.coverage.clone(),
    };
    let brighter = mean.color.map(|pixel| pixel.map(|part| 1.05 * part));
    let mut pictures = vec![
        ("truth x 1.05".to_owned(), alike(brighter)),
        (
            "truth, Gaussian 1 px".to_owned(),
            alike(soften(&mean.color, 1.0)),
        ),
        (
            "truth, halo of 4 px".to_owned(),
            alike(add_halo(&mean.color, truth)),
        ),
        (
            "oracle".to_owned(),
            scatter_oracle(frame, truth.shutter, &truth.shutter_profile),
        ),
    ];
    pictures.extend(make_wrong_pictures(frame, truth, None));
    let reference = Reference::new(frame, truth, None, &frame.display.into())?;
    let errors = (pictures.par_iter()).map(|(name, picture)| {
        let scores = reference.measure(picture)?.scores;
        let pools = [&scores.moving, &scores.support];
        let flips = pools.map(|pool| pool.flip.value().unwrap_or(f64::NAN));
        Ok((name.clone(), flips))
    });
    Ok(Row {
        scene: scene.id.to_string(),
        errors: errors.collect::<Result<_, MeasureError>>()?,
    })
}

/// Extends the support's colours by 4 pixels: a spill and nothing else.
fn add_halo(image: &Image, truth: &Truth) -> Image {
    const REACH: i64 = 4;
    let inside = |x: i64, y: i64| {
        let sizes = [image.width, image.height].map(i64::from);
        (0..sizes[0]).contains(&x)
            && (0..sizes[1]).contains(&y)
            && *truth.support.moving.at(x as u32, y as u32)
    };
    let mut offsets: Vec<(i64, i64)> = (-REACH..=REACH)
        .flat_map(|down| (-REACH..=REACH).map(move |right| (right, down)))
        .filter(|(right, down)| right * right + down * down <= REACH * REACH)
        .collect();
    offsets.sort_by_key(|(right, down)| right * right + down * down);
    Raster::from_fn(image.width, image.height, |x, y| {
        let near = |(right, down): &(i64, i64)| (i64::from(x) + right, i64::from(y) + down);
        let mut places = offsets.iter().map(near);
        let place = places.find(|(x, y)| inside(*x, *y));
        let (x, y) = place.map_or((x, y), |(x, y)| (x as u32, y as u32));
        *image.at(x, y)
    })
}

/// Blurs by a Gaussian with a standard deviation in pixels.
fn soften(image: &Image, deviation: f64) -> Image {
    let reach = (3.0 * deviation).ceil() as i64;
    let weights: Vec<f64> = (-reach..=reach)
        .map(|at| (-0.5 * (at as f64 / deviation).powi(2)).exp())
        .collect();
    let sum: f64 = weights.iter().sum();
    let along = |image: &Image, [right, down]: [i64; 2]| -> Image {
        let place =
            |at: u32, by: i64, size: u32| (i64::from(at) + by).clamp(0, i64::from(size) - 1) as u32;
        Raster::from_fn(image.width, image.height, |x, y| {
            let mut mean = [0.0; 3];
            for (weight, at) in weights.iter().zip(-reach..) {
                let (x, y) = (
                    place(x, at * right, image.width),
                    place(y, at * down, image.height),
                );
                let pixel = image.at(x, y);
                mean = [0, 1, 2].map(|c| mean[c] + weight / sum * f64::from(pixel[c]));
            }
            mean.map(|part| part as f32)
        })
    };
    along(&along(image, [1, 0]), [0, 1])
}

fn print_table(rows: &[Row]) {
    let names: Vec<&str> = (rows[0].errors.iter().map(|(name, _)| name.as_str())).collect();
    println!("| FLIP over moving / support | {} |", names.join(" | "));
    println!("|---|{}", "---|".repeat(names.len()));
    for row in rows {
        let cells = row.errors.iter();
        let cells: Vec<String> = cells
            .map(|(_, [moving, support])| format!("{moving:.3} / {support:.3}"))
            .collect();
        println!("| {} | {} |", row.scene, cells.join(" | "));
    }
    println!(
        "\nScenes, of {}, on which the first is no better than the second:\n",
        rows.len()
    );
    println!("| first | second | moving | support |\n|---|---|---|---|");
    let find = |row: &Row, wanted: &str| {
        let error = row.errors.iter().find(|(name, _)| name == wanted);
        error.expect("all scenes have all pictures").1
    };
    for second in ["oracle", "half_length", "no_blur"] {
        for first in names.iter().filter(|first| **first != second) {
            let [moving, support] = [0, 1].map(|pool| {
                let is_no_better = |row: &&Row| find(row, first)[pool] >= find(row, second)[pool];
                rows.iter().filter(is_no_better).count()
            });
            println!("| {first} | {second} | {moving} | {support} |");
        }
    }
}
