//! Times filters in turn, round after round.

use std::cell::Cell;

use filters::{Blur, BufferCopy, Filter, FilterError, Gpu, Input, Loaded, PassTime, Settings};
use tracer::{Progress, TraceError, Watch};

use super::panels::Panels;
use super::{
    BENCH_FORMAT, Bench, CaseCost, CopyCost, EXPOSURE, GROWTH_FROM, PassCost, REACHES, ReachCost,
    ReachPoint, SPEED, Spread,
};
use crate::run::filter_choice::FilterChoice;
use crate::{Error, PROGRAM};

/// Filter and preset that times are divided by.
pub const BASELINE: &str = "jump_flood:paper";

/// What a bench is asked to do.
pub struct BenchPlan {
    /// What is timed, beside [`BASELINE`].
    pub filters: Vec<FilterChoice>,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// How often each filter runs.
    pub rounds: u32,
    /// Whether values in pixels stay as the presets have them.
    pub as_written: bool,
}

impl BenchPlan {
    /// Counts the runs of filters: in every round each of them once among the others, and once at each reach.
    pub fn count_runs(&self) -> u64 {
        u64::from(self.rounds + 1) * self.filters.len() as u64 * (1 + REACHES.len() as u64)
    }
}

/// Every dispatch of one run of a filter.
type Times = Vec<PassTime>;

/// Times every filter. Those of one table take turns, one run each per round, so that whatever else the machine does
/// falls on all of them alike; a round before the first is not counted.
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
    let (copy, cases) = cases(&plan, gpu, &turns)?;
    let reaches = plan
        .filters
        .iter()
        .map(|choice| reach(&plan, gpu, choice, &turns))
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

/// Rounds, and the runs of filters that are done.
struct Turns<'a> {
    rounds: u32,
    watch: Watch<'a>,
    done: Cell<u64>,
    total: u64,
}

impl Turns<'_> {
    /// One run of each blur, then `beside`, in every round: per blur, its runs.
    fn take<T>(
        &self,
        blurs: &[Loaded],
        beside: impl Fn() -> Result<T, FilterError>,
    ) -> Result<(Vec<Vec<Times>>, Vec<T>), Error> {
        let mut runs = vec![Vec::new(); blurs.len()];
        let mut besides = Vec::new();
        for round in 0..=self.rounds {
            let counts = round > 0;
            for (blur, runs) in blurs.iter().zip(&mut runs) {
                let times = blur.time()?;
                runs.extend(counts.then_some(times));
                self.advance(1)?;
            }
            besides.extend(Some(beside()?).filter(|_| counts));
        }
        Ok((runs, besides))
    }

    /// Shows that some runs are done, or left out.
    fn advance(&self, runs: u64) -> Result<(), Error> {
        self.done.set(self.done.get() + runs);
        let progress = Progress {
            done: self.done.get(),
            total: self.total,
        };
        match (self.watch)(progress).is_break() {
            true => Err(TraceError::Cancelled.into()),
            false => Ok(()),
        }
    }
}

fn cases(plan: &BenchPlan, gpu: &Gpu, turns: &Turns) -> Result<(CopyCost, Vec<CaseCost>), Error> {
    let panels = Panels::new(plan.width, plan.height, SPEED as f32);
    let mut blurs = Vec::new();
    for choice in &plan.filters {
        blurs.push(blur(plan, gpu, choice, &choice.settings)?);
    }
    let mut loaded = Vec::new();
    for blur in &mut blurs {
        loaded.push(load(blur, &panels)?);
    }
    let buffers = BufferCopy::new(gpu)?;
    let (runs, copies) = turns.take(&loaded, || buffers.time())?;
    let copy = copy_cost(buffers.bytes, copies);
    let index = plan
        .filters
        .iter()
        .position(|choice| choice.name() == BASELINE);
    let baseline: Vec<f64> = runs[index.expect("the baseline takes part")]
        .iter()
        .map(total)
        .collect();
    let costs = plan.filters.iter().zip(&runs);
    let costs = costs.map(|(choice, runs)| case_cost(choice, runs, &baseline, pixels(plan), &copy));
    let costs = costs.collect();
    Ok((copy, costs))
}

fn copy_cost(bytes: u64, seconds: Vec<f64>) -> CopyCost {
    let seconds = Spread::of(seconds);
    CopyCost {
        bytes,
        seconds,
        bytes_per_second: bytes as f64 / seconds.median,
    }
}

fn case_cost(
    choice: &FilterChoice,
    runs: &[Times],
    baseline: &[f64],
    pixels: f64,
    copy: &CopyCost,
) -> CaseCost {
    let seconds = Spread::of(runs.iter().map(total));
    let bytes: u64 = runs[0].iter().map(|pass| pass.bytes).sum();
    let bytes_per_second = bytes as f64 / seconds.median;
    CaseCost {
        filter: choice.filter.name.clone(),
        preset: choice.preset.clone(),
        parameters: choice.settings.values.clone(),
        reference_width: choice.settings.reference_width,
        seconds,
        ratio: Spread::of(
            runs.iter()
                .zip(baseline)
                .map(|(run, base)| total(run) / base),
        ),
        bytes_per_pixel: bytes as f64 / pixels,
        bytes_per_second,
        part_of_copy: bytes_per_second / copy.bytes_per_second,
        passes: pass_costs(runs, pixels),
    }
}

/// The iterations of a pass follow one another.
fn pass_costs(runs: &[Times], pixels: f64) -> Vec<PassCost> {
    let mut start = 0;
    let passes = runs[0].chunk_by(|a, b| a.entry == b.entry);
    passes
        .map(|iterations| {
            let range = start..start + iterations.len();
            start = range.end;
            let bytes: u64 = iterations.iter().map(|pass| pass.bytes).sum();
            PassCost {
                entry: iterations[0].entry.clone(),
                iterations: iterations.len(),
                seconds: Spread::of(runs.iter().map(|run| seconds(&run[range.clone()]))),
                bytes_per_pixel: bytes as f64 / pixels,
            }
        })
        .collect()
}

/// Times one filter at every reach, in turns.
fn reach(
    plan: &BenchPlan,
    gpu: &Gpu,
    choice: &FilterChoice,
    turns: &Turns,
) -> Result<ReachCost, Error> {
    // A range that ends before a reach leaves a gap in the table.
    let settings = REACHES.map(|pixels| choice.settings.reaching(&choice.filter, pixels).ok());
    let (mut blurs, mut speeds) = (Vec::new(), Vec::new());
    for (settings, pixels) in settings.iter().zip(REACHES) {
        if let Some(settings) = settings {
            blurs.push(blur(plan, gpu, choice, settings)?);
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
            seconds: runs.map(|runs| Spread::of(runs.iter().map(total))),
            value: (settings[index].as_ref().zip(parameter))
                .map(|(settings, name)| settings.values[name].clone()),
            passes: runs.map_or(Vec::new(), |runs| pass_costs(runs, pixels(plan))),
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

/// Of the longest reach over [`GROWTH_FROM`], round by round.
fn growth(runs: &[Option<Vec<Times>>; REACHES.len()]) -> Option<Spread> {
    let from = REACHES.iter().position(|pixels| *pixels == GROWTH_FROM);
    let from = runs[from.expect("growth starts at one of the reaches")].as_ref()?;
    let to = runs.last().and_then(Option::as_ref)?;
    Some(Spread::of(
        to.iter()
            .zip(from)
            .map(|(to, from)| total(to) / total(from)),
    ))
}

fn pixels(plan: &BenchPlan) -> f64 {
    f64::from(plan.width) * f64::from(plan.height)
}

fn blur<'g>(
    plan: &BenchPlan,
    gpu: &'g Gpu,
    choice: &FilterChoice,
    settings: &Settings,
) -> Result<Blur<'g>, FilterError> {
    Blur::new(gpu, &choice.filter, settings, plan.width, plan.height)
}

fn load<'b, 'g>(blur: &'b mut Blur<'g>, panels: &Panels) -> Result<Loaded<'b, 'g>, FilterError> {
    blur.load(&Input {
        color: &[&panels.color],
        velocity: &panels.velocity,
        depth: &panels.depth,
        reprojection: Some(panels.reprojection),
        exposure: EXPOSURE,
        frame_index: 0,
    })
}

fn seconds(passes: &[PassTime]) -> f64 {
    passes.iter().map(|pass| pass.seconds).sum()
}

fn total(run: &Times) -> f64 {
    seconds(run)
}
