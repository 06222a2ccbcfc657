//! Bench of filters: the work behind its tables.

use std::cell::Cell;

use filters::{Blur, BufferCopy, Filter, FilterError, Gpu, Input, LoadedBlur, Settings};
use tracer::Watch;

use super::costs::{case_cost, growth, pass_costs, total_seconds};
use super::panels::Panels;
use super::turns::{Times, Turns};
use super::{
    BASELINE, BENCH_FORMAT, Bench, CaseCost, CopyCost, EXPOSURE, REACHES, ReachCost, ReachPoint,
    SPEED, Spread,
};
use crate::filter_choice::FilterChoice;
use crate::{Error, PROGRAM};

/// Everything that a bench is told to do.
pub struct BenchPlan {
    /// Filters to time, beside [`BASELINE`].
    pub filters: Vec<FilterChoice>,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Runs of each filter.
    pub rounds: u32,
    /// True if values in pixels stay as the presets have them.
    pub as_written: bool,
}

impl BenchPlan {
    /// Counts the runs of filters: in every round each of them once among the others, and once at each reach.
    pub fn count_runs(&self) -> u64 {
        u64::from(self.rounds + 1) * self.filters.len() as u64 * (1 + REACHES.len() as u64)
    }
}

/// Times every filter. Those of one table take turns, one run each per round, so that whatever else the machine does
/// affects all of them alike.
pub fn bench(mut plan: BenchPlan, gpu: &Gpu, watch: Watch) -> Result<Bench, Error> {
    if !plan.filters.iter().any(|choice| choice.name() == BASELINE) {
        let (filter, preset) = (BASELINE.split_once(':')).expect("the baseline has a preset");
        let choice = FilterChoice::new(Filter::builtin(filter)?, preset)?;
        plan.filters.insert(0, choice);
    }
    let (width, as_written) = (plan.width, plan.as_written);
    plan.filters = (plan.filters.into_iter())
        .map(|choice| choice.as_written(as_written).scaled_to(width))
        .collect();
    let turns = Turns {
        rounds: plan.rounds,
        watch,
        done: Cell::new(0),
        total: plan.count_runs(),
    };
    let (copy, cases) = time_presets(&plan, gpu, &turns)?;
    let reaches = plan
        .filters
        .iter()
        .map(|choice| time_reaches(&plan, gpu, choice, &turns))
        .collect::<Result<_, _>>()?;
    Ok(Bench {
        format: BENCH_FORMAT,
        program: PROGRAM.to_owned(),
        adapter: gpu.adapter.clone(),
        clock: gpu.clock,
        width: plan.width,
        height: plan.height,
        rounds: plan.rounds,
        exposure: EXPOSURE,
        speed: SPEED,
        copy,
        cases,
        reaches,
    })
}

/// Times every filter preset on the frame of [`SPEED`], and the memory copy beside them.
fn time_presets(
    plan: &BenchPlan,
    gpu: &Gpu,
    turns: &Turns,
) -> Result<(CopyCost, Vec<CaseCost>), Error> {
    let panels = Panels::new(plan.width, plan.height, SPEED as f32);
    let mut blurs = Vec::new();
    for choice in &plan.filters {
        blurs.push(compile(plan, gpu, choice, &choice.settings)?);
    }
    let mut loaded = Vec::new();
    for blur in &mut blurs {
        loaded.push(load(blur, &panels)?);
    }
    let buffers = BufferCopy::new(gpu)?;
    let (runs, copies) = turns.take(&loaded, || buffers.time())?;
    let seconds = Spread::of(copies);
    let copy = CopyCost {
        bytes: buffers.bytes,
        seconds,
        bytes_per_second: buffers.bytes as f64 / seconds.median,
    };
    let index = plan
        .filters
        .iter()
        .position(|choice| choice.name() == BASELINE);
    let baseline: Vec<f64> = runs[index.expect("the baseline takes part")]
        .iter()
        .map(|run| total_seconds(run))
        .collect();
    let costs = plan.filters.iter().zip(&runs);
    let costs =
        costs.map(|(choice, runs)| case_cost(choice, runs, &baseline, pixel_count(plan), &copy));
    let costs = costs.collect();
    Ok((copy, costs))
}

/// Times one filter at every reach, in turns.
fn time_reaches(
    plan: &BenchPlan,
    gpu: &Gpu,
    choice: &FilterChoice,
    turns: &Turns,
) -> Result<ReachCost, Error> {
    // A range that ends before a reach leaves a gap in the table.
    let settings = REACHES.map(|pixels| choice.settings.with_reach(&choice.filter, pixels).ok());
    let (mut blurs, mut speeds) = (Vec::new(), Vec::new());
    for (settings, pixels) in settings.iter().zip(REACHES) {
        if let Some(settings) = settings {
            blurs.push(compile(plan, gpu, choice, settings)?);
            speeds.push(pixels as f32);
        }
    }
    let mut loaded = Vec::new();
    for (blur, speed) in blurs.iter_mut().zip(speeds) {
        loaded.push(load(blur, &Panels::new(plan.width, plan.height, speed))?);
    }
    let (runs, _) = turns.take(&loaded, || Ok(()))?;
    let gaps = (REACHES.len() - loaded.len()) as u64;
    turns.advance(gaps * u64::from(turns.rounds + 1))?;
    let mut runs = runs.into_iter();
    let runs = settings
        .each_ref()
        .map(|settings| settings.as_ref().and_then(|_| runs.next()));
    let parameter = choice.filter.reach_by.as_ref().map(|by| &by.parameter);
    let point = |index: usize| {
        let runs: Option<&Vec<Times>> = runs[index].as_ref();
        ReachPoint {
            pixels: REACHES[index],
            seconds: runs.map(|runs| Spread::of(runs.iter().map(|run| total_seconds(run)))),
            value: (settings[index].as_ref().zip(parameter))
                .map(|(settings, name)| settings.values[name].clone()),
            passes: runs.map_or(Vec::new(), |runs| pass_costs(runs, pixel_count(plan))),
        }
    };
    Ok(ReachCost {
        filter: choice.filter.name.clone(),
        preset: choice.preset.clone(),
        parameter: parameter.cloned(),
        points: (0..REACHES.len()).map(point).collect(),
        growth: growth(&runs),
    })
}

fn pixel_count(plan: &BenchPlan) -> f64 {
    f64::from(plan.width) * f64::from(plan.height)
}

fn compile<'g>(
    plan: &BenchPlan,
    gpu: &'g Gpu,
    choice: &FilterChoice,
    settings: &Settings,
) -> Result<Blur<'g>, FilterError> {
    Blur::new(gpu, &choice.filter, settings, plan.width, plan.height)
}

fn load<'b, 'g>(
    blur: &'b mut Blur<'g>,
    panels: &Panels,
) -> Result<LoadedBlur<'b, 'g>, FilterError> {
    blur.load(&Input {
        color: &[&panels.color],
        velocity: &panels.velocity,
        depth: &panels.depth,
        reprojection: Some(panels.reprojection),
        camera: Some(panels.camera),
        exposure: EXPOSURE,
        frames_per_second: None,
        frame_index: 0,
    })
}
