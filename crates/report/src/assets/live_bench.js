"use strict";
// Times of a filter's passes by the card's clock, and the bench.json of all its presets.
{
  const pictures = window.shuttertruth;
  const { card } = pictures;
  const TURNS = 64;
  // Turns before those that count: a card that idled needs seconds to reach its clock.
  const WARM_UP = 32;
  // A pass is repeated until it takes this long, in nanoseconds: browsers round the clock to about 0.1 ms.
  const SPAN = 5e6;
  const MOST_REPETITIONS = 2048;
  // A clock with shorter steps is not rounded, in seconds.
  const EXACT = 1e-6;

  // Runs every dispatch `counts` times; returns its start and end by the clock, in nanoseconds.
  const readClock = async (device, { dispatches }, counts) => {
    const count = 2 * dispatches.length;
    const querySet = device.createQuerySet({ type: "timestamp", count });
    const make = (usage) => device.createBuffer({ size: 8 * count, usage });
    const resolved = make(GPUBufferUsage.QUERY_RESOLVE | GPUBufferUsage.COPY_SRC);
    const buffer = make(GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ);
    const encoder = device.createCommandEncoder();
    dispatches.forEach((one, index) => {
      for (let turn = 0; turn < counts[index]; turn++) {
        // What an earlier repetition left is what a copy would bring.
        const own = turn === 0 ? one : { ...one, copies: [] };
        const first = turn === 0 ? { beginningOfPassWriteIndex: 2 * index } : {};
        const last = turn === counts[index] - 1 ? { endOfPassWriteIndex: 2 * index + 1 } : {};
        const stamps = { ...first, ...last };
        card.encodeDispatch(encoder, own, Object.keys(stamps).length > 0 ? { querySet, ...stamps } : undefined);
      }
    });
    encoder.resolveQuerySet(querySet, 0, count, resolved, 0);
    encoder.copyBufferToBuffer(resolved, 0, buffer, 0, 8 * count);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const clock = [...new BigUint64Array(buffer.getMappedRange())];
    for (const made of [querySet, resolved, buffer]) made.destroy();
    return clock;
  };

  const spanOf = (clock, index) => Math.max(0, Number(clock[2 * index + 1] - clock[2 * index]));

  // How often each dispatch has to run to take SPAN.
  const findCounts = async (device, run) => {
    let counts = run.dispatches.map(() => 1);
    for (;;) {
      const clock = await readClock(device, run, counts);
      const more = counts.map((count, index) => {
        const span = spanOf(clock, index);
        const factor = span >= SPAN ? 1 : Math.min(16, 1.2 * (SPAN / Math.max(span, 1)));
        return Math.min(MOST_REPETITIONS, Math.ceil(count * factor));
      });
      if (more.every((count, index) => count === counts[index])) return counts;
      counts = more;
    }
  };

  // Median and quartiles, as the program's.
  const spreadOf = (values) => {
    const sorted = [...values].sort((a, b) => a - b);
    const count = sorted.length;
    const at = (part) => {
      const place = Math.min(count, Math.max(1, (count + 1 / 3) * part + 1 / 3));
      const below = Math.floor(place);
      return sorted[below - 1] + (place - below) * (sorted[Math.min(count, below + 1) - 1] - sorted[below - 1]);
    };
    return { median: at(0.5), lower_quartile: at(0.25), upper_quartile: at(0.75) };
  };

  const divisorOf = (a, b) => (b === 0n ? a : divisorOf(b, a % b));

  const stepOf = (nanoseconds) => {
    const step = Math.abs(Number(nanoseconds)) / 1e9;
    return step > EXACT ? step : null;
  };

  // Describes the turns of one run: `seconds` of all passes, `passes` with their own, and the steps of a rounded clock in seconds.
  const describe = ({ dispatches }, counts, turns) => {
    const step = turns.flat().reduce((all, one) => divisorOf(one - turns[0][0], all), 0n);
    const passes = [];
    dispatches.forEach(({ entry }, index) => {
      if (passes.at(-1)?.entry !== entry) passes.push({ entry, iterations: 0, turns: Array(TURNS).fill(0) });
      const own = passes.at(-1);
      own.iterations += 1;
      turns.forEach((clock, turn) => (own.turns[turn] += spanOf(clock, index) / counts[index] / 1e9));
    });
    const all = turns.map((_, turn) => passes.reduce((sum, own) => sum + own.turns[turn], 0));
    const described = passes.map(({ turns: own, ...pass }) => ({ ...pass, seconds: spreadOf(own) }));
    return { seconds: spreadOf(all), passes: described, step: stepOf(step) };
  };

  // Measures filters in turns, so that a change of the card's clock meets all of them.
  const time = (device, list, said = () => {}) =>
    card.caught(device, async () => {
      const runs = [];
      try {
        for (const words of list) runs.push(card.prepare(device, words));
        const counts = [];
        for (const run of runs) counts.push(await findCounts(device, run));
        const turns = runs.map(() => []);
        for (let turn = -WARM_UP; turn < TURNS; turn++) {
          said(turn < 0 ? "Warming up .." : `Measuring: ${turn + 1} of ${TURNS} turns ..`);
          for (const [at, run] of runs.entries()) {
            const clock = await readClock(device, run, counts[at]);
            if (turn >= 0) turns[at].push(clock);
          }
        }
        return runs.map((run, at) => describe(run, counts[at], turns[at]));
      } finally {
        runs.forEach(card.destroy);
      }
    });

  // Measures all presets; returns the text of a bench.json. `wordsOf` says what to run with a preset's values.
  const measureAll = async (device, { filter, adapter, scene, program }, wordsOf, said) => {
    const measured = await time(device, filter.presets.map(({ values }) => wordsOf(values)), said);
    const cases = filter.presets.map(({ name, values, reference_width }, at) => {
      const { seconds, passes } = measured[at];
      return { filter: filter.name, preset: name, parameters: values, reference_width, seconds, passes };
    });
    const { width, height } = scene;
    const clock = { clock: "timestamps", clock_step: Math.min(...measured.map(({ step }) => step)) || null };
    const bench = { format: 1, program, adapter, ...clock, width, height, rounds: TURNS, scene: scene.name, cases, reaches: [] };
    // Real numbers have a point.
    const reals = filter.parameters.filter(({ kind }) => kind === "real").map(({ name }) => name);
    const mark = (name, value) => (reals.includes(name) && Number.isInteger(value) ? `${value}.0 real` : value);
    return JSON.stringify(bench, mark).replace(/"(-?\d+\.0) real"/g, "$1");
  };

  pictures.bench = { time, measureAll, TURNS };
}
