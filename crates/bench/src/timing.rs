//! Bench of filters: its measurements.

use std::cell::Cell;
use std::collections::BTreeMap;

use filters::{Blur, BufferCopy, Filter, FilterError, Gpu, Input, LoadedBlur, Settings};
use tracer::{Progress, TraceError, Watch};

use super::costs::{Times, case_cost, pass_costs, ratio, spread};
use super::panels::Panels;
use super::{
    BASELINE, BENCH_FORMAT, Bench, CaseCost, CopyCost, EXPOSURE, GROWTH_FROM, REACHES, ReachCost,
    ReachPoint, SPEED, Spread,
};
use measure::{Error, FilterChoice, PROGRAM};

/// All settings of a bench.
pub struct BenchPlan {
    /// Filters to time, in addition to [`BASELINE`].
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
    /// Counts the runs of filters: in every round, one of each filter among the others, and one at
    /// each reach.
    pub fn count_runs(&self) -> u64 {
        u64::from(self.rounds + 1) * self.filters.len() as u64 * (1 + REACHES.len() as u64)
    }
}

/// Times every filter. Filters of one table take turns, one run each per round, so that other load
/// on the machine affects them alike.
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
    let timer = Timer {
        plan: &plan,
        gpu,
        watch,
        panels: (REACHES.into_iter())
            .map(|speed| (speed, Panels::new(width, plan.height, speed as f32)))
            .collect(),
        done: Cell::new(0),
    };
    let (copy, cases) = timer.time_presets()?;
    let filters = plan.filters.iter();
    let reaches = filters.map(|choice| timer.time_reaches(choice));
    let reaches = reaches.collect::<Result<_, _>>()?;
    Ok(Bench {
        format: BENCH_FORMAT,
        program: PROGRAM.to_owned(),
        adapter: gpu.adapter.clone(),
        clock: gpu.clock,
        clock_step: None,
        width: plan.width,
        height: plan.height,
        rounds: plan.rounds,
        scene: None,
        exposure: Some(EXPOSURE),
        speed: Some(SPEED),
        copy: Some(copy),
        cases,
        reaches,
    })
}

/// A filter to time.
struct Timed<'a> {
    filter: &'a Filter,
    settings: &'a Settings,
    /// Speed in its frame, in pixels per frame.
    speed: u32,
}

/// The rounds of a bench, with progress over the filters' runs.
struct Timer<'a> {
    plan: &'a BenchPlan,
    gpu: &'a Gpu,
    watch: Watch<'a>,
    /// Frames by speed: every one of [`REACHES`], and so [`SPEED`].
    panels: BTreeMap<u32, Panels>,
    /// Finished runs, of all tables.
    done: Cell<u64>,
}

impl Timer<'_> {
    /// Times every filter preset at [`SPEED`], and the memory copy in the same rounds.
    fn time_presets(&self) -> Result<(CopyCost, Vec<CaseCost>), Error> {
        let filters = &self.plan.filters;
        let timed = filters.iter().map(|choice| Timed {
            filter: &choice.filter,
            settings: &choice.settings,
            speed: SPEED,
        });
        let buffers = BufferCopy::new(self.gpu)?;
        let (runs, copies) = self.time(&timed.collect::<Vec<_>>(), || buffers.time())?;
        let seconds = Spread::of(copies);
        let copy = CopyCost {
            bytes: buffers.bytes,
            seconds,
            bytes_per_second: buffers.bytes as f64 / seconds.median,
        };
        let baseline = filters.iter().position(|choice| choice.name() == BASELINE);
        let baseline = &runs[baseline.expect("the baseline takes part")];
        let costs = filters.iter().zip(&runs);
        let costs = costs
            .map(|(choice, runs)| case_cost(choice, runs, baseline, self.count_pixels(), &copy));
        let costs = costs.collect();
        Ok((copy, costs))
    }

    /// Times one filter at every reach, in turns.
    fn time_reaches(&self, choice: &FilterChoice) -> Result<ReachCost, Error> {
        // A range too short for a reach leaves a gap in the table.
        let settings = |pixels| choice.settings.with_reach(&choice.filter, pixels).ok();
        let settings: BTreeMap<u32, Settings> = (REACHES.into_iter())
            .filter_map(|pixels| Some((pixels, settings(pixels)?)))
            .collect();
        let timed = settings.iter().map(|(pixels, settings)| Timed {
            filter: &choice.filter,
            settings,
            speed: *pixels,
        });
        let (runs, _) = self.time(&timed.collect::<Vec<_>>(), || Ok(()))?;
        let gaps = (REACHES.len() - settings.len()) as u64;
        self.advance(gaps * u64::from(self.plan.rounds + 1))?;
        let runs: BTreeMap<u32, Vec<Times>> = settings.keys().copied().zip(runs).collect();
        let parameter = choice.filter.reach_by.as_ref().map(|by| &by.parameter);
        let point = |pixels: u32| {
            let runs = runs.get(&pixels);
            ReachPoint {
                pixels,
                seconds: runs.map(|runs| spread(runs)),
                value: (settings.get(&pixels).zip(parameter))
                    .map(|(settings, name)| settings.values[name].clone()),
                passes: runs.map_or(Vec::new(), |runs| pass_costs(runs, self.count_pixels())),
            }
        };
        let ends = (runs.get(&REACHES[REACHES.len() - 1])).zip(runs.get(&GROWTH_FROM));
        Ok(ReachCost {
            filter: choice.filter.name.clone(),
            preset: choice.preset.clone(),
            parameter: parameter.cloned(),
            points: REACHES.map(point).to_vec(),
            growth: ends.map(|(to, from)| ratio(to, from)),
        })
    }

    /// Runs each filter once, then `beside`, in every round; returns the runs of each filter.
    /// Discards a first round.
    fn time<T>(
        &self,
        filters: &[Timed],
        beside: impl Fn() -> Result<T, FilterError>,
    ) -> Result<(Vec<Vec<Times>>, Vec<T>), Error> {
        let (width, height) = (self.plan.width, self.plan.height);
        let mut blurs = Vec::new();
        for timed in filters {
            let blur = Blur::new(self.gpu, timed.filter, timed.settings, width, height)?;
            blurs.push(blur);
        }
        let mut loaded = Vec::new();
        for (blur, timed) in blurs.iter_mut().zip(filters) {
            loaded.push(load(blur, &self.panels[&timed.speed])?);
        }
        let mut runs = vec![Vec::new(); loaded.len()];
        let mut besides = Vec::new();
        for round in 0..=self.plan.rounds {
            let counts = round > 0;
            for (blur, runs) in loaded.iter().zip(&mut runs) {
                let times = blur.time()?;
                runs.extend(counts.then_some(times));
                self.advance(1)?;
            }
            besides.extend(Some(beside()?).filter(|_| counts));
        }
        Ok((runs, besides))
    }

    /// Reports finished or skipped runs.
    fn advance(&self, runs: u64) -> Result<(), Error> {
        self.done.set(self.done.get() + runs);
        let progress = Progress {
            done: self.done.get(),
            total: self.plan.count_runs(),
        };
        if (self.watch)(progress).is_break() {
            Err(TraceError::Cancelled.into())
        } else {
            Ok(())
        }
    }

    fn count_pixels(&self) -> f64 {
        f64::from(self.plan.width) * f64::from(self.plan.height)
    }
}

fn load<'b, 'g>(
    blur: &'b mut Blur<'g>,
    panels: &Panels,
) -> Result<LoadedBlur<'b, 'g>, FilterError> {
    blur.load(&Input {
        color: &[&panels.color],
        velocity: &panels.velocity,
        velocity_next: Some(&panels.velocity),
        velocity_z: Some(&panels.depth.map(|_| 0.0)),
        exclusion: Some(&panels.depth.map(|_| 0.0)),
        depth: &panels.depth,
        reprojection: Some(panels.reprojection),
        camera: Some(panels.camera),
        exposure: EXPOSURE,
        frames_per_second: None,
        frame_index: 0,
    })
}
