"use strict";
// "Try it" of a case: the parameters and the shader of its filter, which runs on the reader's graphics card.
{
  const pictures = window.shuttertruth;
  const { card, bench, scores, folder, load, inflate, planes, put } = pictures;
  // Pictures that a panel adds to its case, with the numbers of their planes.
  const LAYERS = { live: [-1, -2, -3], live_flip: [-4] };
  // Differences from the stored scores up to these are those of graphics cards.
  const SAME = { flip: 0.0005, psnr: 0.05 };
  // Difference of radiance from the stored output that counts: its halves are off by half as much.
  const APART = 1e-3;
  // Time after the last key before the shader is compiled, in milliseconds.
  const PAUSE = 250;
  const STALE = "The shader has errors: the picture and the scores are those of the last one without.";
  // Narrower windows show one picture, in pixels.
  const NARROW = 700;
  // What files next to the page contain, by name.
  const loaded = new Map();
  // The panel that is open, if any, and the graphics card once it was used.
  let tried = null;
  let opened = null;

  const element = (kind, words = {}, ...children) => {
    const made = Object.assign(document.createElement(kind), words);
    made.append(...children);
    return made;
  };
  const button = (textContent, onclick) => element("button", { type: "button", textContent, onclick });

  const loadOnce = (name, prepare) => {
    if (!loaded.has(name)) loaded.set(name, load(name).then(prepare));
    loaded.get(name).catch(() => loaded.delete(name));
    return loaded.get(name);
  };

  const floatsOf = async (inputs) => {
    const read = async ([name, text]) => [name, new Float32Array((await inflate(text)).buffer)];
    return Object.fromEntries(await Promise.all(Object.entries(inputs).map(read)));
  };

  // Opens the graphics card, unless it is open.
  const openCard = () => {
    opened ??= card.open(() => {
      opened = null;
      say("The graphics card stopped answering: a pass may take too long. The next change starts it again.");
    });
    opened.catch(() => (opened = null));
    return opened;
  };

  const say = (words, mine = tried) => {
    if (mine) mine.said.textContent = words;
  };

  // Name by name the numbers that blocks may contain: a choice is its index.
  const numbersOf = ({ filter, values, data }) => {
    const number = ({ name, choices }) => (choices?.length > 0 ? choices.indexOf(values[name]) : values[name]);
    return { ...data.values, ...Object.fromEntries(filter.parameters.map((parameter) => [parameter.name, number(parameter)])) };
  };

  const wordsOf = (mine) => {
    const { filter, scene, passes, texels } = mine;
    return { filter, scene, passes, texels, numbers: numbersOf(mine) };
  };

  // Blurs the frame with the values and shaders of the panel, scores the result and shows it.
  const run = async (mine) => {
    const start = performance.now();
    const { device } = await openCard();
    if (mine.device !== device) await compile(mine, device);
    const output = await card.blur(device, wordsOf(mine));
    const { data, width, height, frame, truth, seen, region, scene, noise } = mine;
    const map = scores.mapFlip(seen, scores.see(output, width, height, scene.stops));
    if (mine !== tried) return;
    LAYERS.live.forEach((number, at) => put(number, output[at]));
    put(LAYERS.live_flip[0], map);
    const limit = data.stored.psnr_limit ?? Infinity;
    const psnr = scores.psnr(output, frame, truth, region, scene.stops, noise, limit);
    mine.found = { flip: scores.meanOver(region, map), psnr };
    mine.version += 1;
    fillScores(mine);
    say(mine.errors.length > 0 ? STALE : "");
    if (mine.version === 1) await showLive(mine, output);
    else pictures.redraw();
    if (mine !== tried) return;
    Object.assign(mine.place.dataset, { ...mine.found, milliseconds: (performance.now() - start).toFixed(1), version: mine.version });
  };

  // Runs the filter again, and once more if something changed meanwhile.
  const change = async (mine) => {
    mine.changed = true;
    if (mine.runs) return;
    mine.runs = true;
    while (mine.changed) {
      mine.changed = false;
      try {
        await run(mine);
      } catch (error) {
        say(error.message, mine);
      }
    }
    mine.runs = false;
  };

  // Compiles the shaders. Broken ones leave the passes and the picture as they are.
  const compile = async (mine, device) => {
    const { passes, errors = [] } = await card.compile(device, mine.filter, mine.texts);
    mine.errors = errors;
    if (mine.editor) fillErrors(mine);
    if (!passes) throw new Error(errors[0].message);
    Object.assign(mine, { passes, device });
  };

  const recompile = async (mine) => {
    try {
      await compile(mine, (await openCard()).device);
    } catch {
      return say(STALE, mine);
    }
    return change(mine);
  };

  // Adds the pictures to the case and shows them. Says if the stored output is another picture.
  const showLive = async (mine, output) => {
    const { section, home, layers } = mine;
    const stored = await planes(pictures.own().output);
    if (mine !== tried) return;
    const isApart = (one, other) => Math.abs(one - other) > APART * Math.max(1, Math.abs(other));
    const differs = (_, at) => output.some((plane, c) => isApart(plane[at], stored[c][at]));
    const share = output[0].filter(differs).length / output[0].length;
    if (share > 0.001) say(`On this graphics card ${(100 * share).toFixed(1)} % of the pixels differ from those of the stored run.`);
    home.dataset.layers = [layers, ...Object.entries(LAYERS).map(([word, numbers]) => `${word}:${numbers}`)].join(" ");
    const settings = Object.fromEntries(pictures.settings());
    pictures.show(section, { ...settings, left: "live", right: "live_flip", mode: innerWidth > NARROW ? "side" : "slide" });
  };

  const close = () => {
    if (!tried) return;
    const { section, home, place, layers, start } = tried;
    tried = null;
    home.dataset.layers = layers;
    section.classList.remove("trying");
    place.replaceChildren(start);
    for (const name of ["flip", "psnr", "milliseconds", "version"]) delete place.dataset[name];
  };

  const fillScores = ({ found, data: { stored }, table }) => {
    const rows = [["FLIP", "flip", 3, -1, ""], ["PSNR", "psnr", 2, 1, " dB"]].map(([title, name, digits, sign, unit]) => {
      const [now, before] = [found[name], stored[name]];
      const gain = sign * (now - before);
      const verdict = before === null || Math.abs(gain) <= SAME[name] ? "same" : gain > 0 ? "better" : "worse";
      const texts = [now, before].map((value) => (value === null ? "none" : `${value.toFixed(digits)}${unit}`));
      const cells = [...texts, verdict].map((textContent) => element("td", { textContent }));
      cells[2].className = verdict;
      return element("tr", {}, element("th", { scope: "row", textContent: title }), ...cells);
    });
    const titles = ["", "now", "stored run", ""].map((textContent) => element("th", { scope: "col", textContent }));
    table.replaceChildren(element("tr", {}, ...titles), ...rows);
  };

  // Sets parameters to values, and everything that shows them.
  const set = (mine, values) => {
    Object.assign(mine.values, values);
    for (const sync of mine.syncs) sync();
    for (const [one, preset] of mine.presets) {
      const isChosen = Object.entries(preset.values).every(([name, value]) => mine.values[name] === value);
      one.setAttribute("aria-pressed", isChosen);
    }
    change(mine);
  };

  const choiceOf = (mine, { name, choices }) => {
    const menu = element("select", { ariaLabel: name }, ...choices.map((choice) => new Option(choice)));
    menu.addEventListener("change", () => set(mine, { [name]: menu.value }));
    mine.syncs.push(() => (menu.value = mine.values[name]));
    return [menu];
  };

  // A slider and a field for a number.
  const numberOf = (mine, { name, kind, min, max, scale }) => {
    const isWhole = kind === "integer";
    const isLog = scale === "log" && min > 0;
    const steps = isWhole && !isLog ? max - min : 1000;
    const within = (value) => Math.min(max, Math.max(min, isWhole ? Math.round(value) : value));
    const partOf = (value) => (isLog ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min));
    const exactOf = (part) => (isLog ? min * (max / min) ** part : min + (max - min) * part);
    const valueOf = (part) => within(Number(exactOf(part).toPrecision(isWhole ? 12 : 3)));
    const slider = element("input", { type: "range", min: 0, max: steps, step: 1, ariaLabel: name });
    const field = element("input", { type: "number", min, max, step: "any", ariaLabel: `${name}, as a number` });
    slider.addEventListener("input", () => set(mine, { [name]: valueOf(slider.value / steps) }));
    field.addEventListener("change", () => set(mine, { [name]: field.value === "" ? mine.values[name] : within(Number(field.value)) }));
    mine.syncs.push(() => {
      const value = mine.values[name];
      field.value = Number(value.toPrecision(6));
      // A slider between two whole numbers stays where its reader put it.
      if (valueOf(slider.value / steps) !== value) slider.value = Math.round(steps * partOf(value));
      slider.ariaValueText = String(value);
    });
    return [slider, field];
  };

  const parameterRow = (mine, parameter) => {
    const { name, doc, min, max, scale, unit, choices } = parameter;
    const isChoice = choices?.length > 0;
    const range = isChoice ? "" : ` ${min} to ${max}${unit === "pixels" ? " pixels" : ""}${scale === "log" ? ", in equal ratios" : ""}.`;
    const controls = isChoice ? choiceOf(mine, parameter) : numberOf(mine, parameter);
    const title = element("div", { className: "title" }, element("code", { textContent: name }), ...controls);
    return element("div", { className: "parameter" }, title, element("p", { className: "note", textContent: `${doc}${range}` }));
  };

  const presetButtons = (mine) => {
    mine.presets = mine.filter.presets.map((preset) => {
      const one = button(preset.name, () => set(mine, preset.values));
      one.title = preset.doc;
      return [one, preset];
    });
    return element("div", { className: "presets" }, "Presets ", ...mine.presets.map(([one]) => one));
  };

  const copyPreset = async (mine) => {
    const preset = folder.presetOf(mine.filter, mine.values, nameOfScene(mine));
    try {
      await navigator.clipboard.writeText(preset);
      say("Copied. Paste it at the end of filter.toml.");
    } catch {
      say(`Copy this to the end of filter.toml:\n${preset}`);
    }
  };

  const nameOfScene = ({ section }) => section.dataset.title.split(" / ")[0];

  const saveFolder = (mine) => {
    const command = folder.save(mine.filter, mine.values, mine.texts, nameOfScene(mine));
    say(`Unpack it, and run: ${command}`);
  };

  // Numbers the lines of the shader, and lists what the compiler says about all.
  const fillErrors = (mine) => {
    const { errors, editor, module } = mine;
    const lines = editor.text.value.split("\n").map((_, at) => {
      const isBroken = errors.some((error) => error.module === module && error.line === at + 1);
      return element("span", { className: isBroken ? "broken" : "", textContent: `${at + 1}\n` });
    });
    editor.lines.replaceChildren(...lines);
    editor.errors.replaceChildren(...errors.map((error) => element("li", {}, goTo(mine, error), ` ${error.message}`)));
    editor.text.setAttribute("aria-invalid", errors.length > 0);
  };

  // A button that selects a line of the shader.
  const goTo = (mine, { line, module }) => {
    if (!line) return "In what is appended to the shader:";
    return button(`line ${line}`, () => {
      if (module !== mine.module) mine.edits(module);
      const { text } = mine.editor;
      const lines = text.value.split("\n");
      const start = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
      text.focus();
      text.setSelectionRange(start, start + lines[line - 1].length);
      text.scrollTop = ((line - 4) * text.scrollHeight) / lines.length;
    });
  };

  // An editor of the filter's modules. Foreign shaders are the WGSL that the program translated them to.
  const shaderEditor = (mine) => {
    const { filter } = mine;
    const own = [...filter.modules.keys()].filter((at) => filter.modules[at].file);
    const text = element("textarea", { spellcheck: false, wrap: "off", ariaLabel: "Shader" });
    const lines = element("pre", { ariaHidden: "true" });
    const menu = element("select", { ariaLabel: "File", hidden: own.length < 2 }, ...own.map((at) => new Option(filter.modules[at].file, at)));
    mine.editor = { text, lines, menu, errors: element("ul", { className: "errors", role: "alert" }) };
    mine.edits = (module) => {
      mine.module = module;
      menu.value = module;
      text.value = mine.texts[module];
      fillErrors(mine);
    };
    menu.addEventListener("change", () => mine.edits(Number(menu.value)));
    let waits = null;
    const edit = () => {
      mine.texts[mine.module] = text.value;
      fillErrors({ ...mine, errors: [] });
      clearTimeout(waits);
      waits = setTimeout(() => recompile(mine), PAUSE);
    };
    text.addEventListener("input", edit);
    text.addEventListener("scroll", () => (lines.scrollTop = text.scrollTop));
    mine.edits(own[0]);
    return element(
      "details",
      { className: "shader" },
      element("summary", { textContent: `Shader: ${own.map((at) => filter.modules[at].file).join(", ")}` }),
      menu,
      element("div", { className: "code" }, lines, text),
      mine.editor.errors,
      button("Reset the shader", () => {
        text.value = filter.modules[mine.module].wgsl;
        edit();
      }),
    );
  };

  // Times of the passes, and a bench.json of all presets.
  const timeTable = (mine) => {
    const said = element("p", { className: "note", role: "status" });
    const table = element("table");
    const name = element("input", { ariaLabel: "Graphics card" });
    const work = async (does) => {
      try {
        const opened = await openCard();
        name.value ||= opened.name;
        const canMeasure = opened.device.features.has("timestamp-query");
        said.textContent = canMeasure ? "Measuring .." : "This browser does not measure the time of a pass.";
        if (canMeasure) said.textContent = await does(opened);
      } catch (error) {
        said.textContent = error.message;
      }
    };
    const { width, height } = mine.scene;
    const measure = async ({ device, name: model }) => {
      const [{ seconds, passes, step }] = await bench.time(device, [wordsOf(mine)]);
      const rows = [...passes, { entry: "all passes", seconds }].map(({ entry, seconds: { median } }) => {
        const cell = element("td", { textContent: `${(1e3 * median).toFixed(3)} ms` });
        return element("tr", {}, element("th", { scope: "row", textContent: entry }), cell);
      });
      table.replaceChildren(...rows);
      const steps = step ? `This browser's clock has steps of ${(1e3 * step).toFixed(3)} ms, so short passes were repeated.` : "";
      return `Median of ${bench.TURNS} runs on ${model}, ${width}x${height}. ${steps}`;
    };
    const saveAll = async ({ device, kind }) => {
      const { filter, scene, data } = mine;
      const { passes } = await card.compile(device, filter, filter.modules.map(({ wgsl }) => wgsl));
      const words = (values) => ({ filter, scene, passes, texels: mine.texels, numbers: numbersOf({ filter, values, data }) });
      const adapter = { name: name.value.trim(), driver: navigator.userAgent, backend: "webgpu", kind };
      const about = { filter, adapter, program: data.program, scene: { name: nameOfScene(mine), width, height } };
      const text = await bench.measureAll(device, about, words, (sentence) => (said.textContent = sentence));
      folder.saveAs("bench.json", new Blob([text], { type: "application/json" }));
      return "Saved bench.json, with the stored shader and the card's name above.";
    };
    const buttons = [button("Measure", () => work(measure)), button("Download bench.json", () => work(saveAll))];
    openCard().then((opened) => (name.value ||= opened.name), () => {});
    buttons[1].title = "Times of every preset";
    const title = element("summary", { textContent: "Time per pass" });
    const row = element("div", { className: "presets" }, "Card ", name, ...buttons);
    return element("details", { className: "times" }, title, row, table, said);
  };

  const resetAll = (mine) => {
    const isEdited = mine.filter.modules.some(({ wgsl }, index) => wgsl !== mine.texts[index]);
    set(mine, mine.before);
    if (!isEdited) return;
    mine.texts = mine.filter.modules.map(({ wgsl }) => wgsl);
    mine.edits(mine.module);
    recompile(mine);
  };

  const fillPanel = (mine) => {
    mine.table = element("table", { className: "compared" });
    const reset = button("Reset", () => resetAll(mine));
    reset.title = "Values and shader of the stored run";
    const buttons = [reset, button("Copy as preset", () => copyPreset(mine)), button("Download filter", () => saveFolder(mine))];
    const head = element("div", { className: "head" }, element("h3", { textContent: "Try it" }), button("Close", leave));
    mine.place.replaceChildren(
      element("div", { className: "top" }, head, mine.table, mine.said),
      presetButtons(mine),
      element("div", { className: "parameters" }, ...mine.filter.parameters.map((parameter) => parameterRow(mine, parameter))),
      element("div", { className: "presets" }, ...buttons),
      shaderEditor(mine),
      timeTable(mine),
    );
    mine.section.classList.add("trying");
    mine.home.after(mine.place);
  };

  const leave = () => {
    const { section, start } = tried;
    close();
    pictures.show(section, { ...Object.fromEntries(pictures.settings()), left: "truth", right: "output", mode: "slide" });
    start.focus();
  };

  // Opens the panel of a case.
  const start = async (place) => {
    close();
    const section = place.closest("article");
    const data = JSON.parse(place.dataset.live);
    const home = section.querySelector(".viewer_place");
    const said = element("p", { className: "said note", role: "status", textContent: "Loading .." });
    const mine = { section, data, place, home, said, start: place.querySelector("button"), layers: home.dataset.layers };
    tried = Object.assign(mine, { values: {}, syncs: [], errors: [], texels: new Map(), version: 0 });
    place.replaceChildren(mine.start, mine.said);
    try {
      const { device } = await openCard();
      const filter = await loadOnce(`live_filter_${data.filter}`, (own) => own);
      const obstacle = card.findObstacle(filter, device);
      if (obstacle) throw new Error(obstacle);
      const scene = await loadOnce(`live_scene_${data.scene}`, async (own) => ({ ...own, inputs: await floatsOf(own.inputs) }));
      const { width, height } = scene.crop;
      const truth = await planes(scene.truth[data.alignment]);
      const frame = await planes(scene.frame);
      const [region, noise] = await planes([scene.moving[data.alignment], scene.noise[data.alignment]]);
      const seen = scores.see(truth, width, height, scene.stops);
      if (mine !== tried) return;
      const preset = filter.presets.find(({ name }) => name === data.preset)?.values;
      const defaults = Object.fromEntries(filter.parameters.map((parameter) => [parameter.name, parameter.default]));
      const before = { ...defaults, ...preset, ...data.parameters };
      const texts = filter.modules.map(({ wgsl }) => wgsl);
      Object.assign(mine, { filter, scene, width, height, frame, truth, region, noise, seen, texts, before });
      fillPanel(mine);
      set(mine, before);
    } catch (error) {
      say(error.message, mine);
    }
  };

  // What the viewer has to know about a picture of the open panel.
  const find = (word) => {
    if (!tried || !LAYERS[word]) return undefined;
    return { version: tried.version, ...(word === "live" ? { score: `FLIP ${tried.found.flip.toFixed(3)}` } : {}) };
  };

  document.addEventListener("click", (event) => {
    const place = event.target.closest(".live");
    if (place && event.target.matches(".live > button")) start(place);
  });
  // What is typed is no command to the page.
  document.addEventListener(
    "keydown",
    (event) => {
      if (event.target.matches?.(".live :is(input, textarea, select)")) event.stopImmediatePropagation();
    },
    { capture: true },
  );

  const show = pictures.show;
  pictures.show = (section, settings) => {
    const leaves = tried && section !== tried.section;
    if (leaves) close();
    show(section, leaves && section ? { left: "truth", right: "output", ...settings } : settings);
  };
  pictures.live = { find };

  for (const place of document.querySelectorAll("div.live")) place.hidden = false;
}
