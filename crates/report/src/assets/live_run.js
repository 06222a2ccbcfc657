"use strict";
// A filter on the reader's graphics card: its textures, pipelines and passes, as the program runs them.
{
  const pictures = window.shuttertruth;
  // Larger numbers, such as the depth of the background, become this one in 16 bits.
  const LARGEST_HALF = 65504;
  // Rows of a buffer that a texture is copied to begin at multiples of this many bytes.
  const ROW = 256;
  // Features that some filters need, and the clock.
  const FEATURES = ["timestamp-query", "float32-filterable", "rg11b10ufloat-renderable", "texture-formats-tier1"];
  // Limits that some filters reach.
  const LIMITS = [
    "maxStorageTexturesPerShaderStage",
    "maxComputeWorkgroupStorageSize",
    "maxComputeInvocationsPerWorkgroup",
    "maxBufferSize",
  ];
  // Numbers of a texel, and how one is kept, of the formats that frames and outputs have.
  const FORMATS = {
    rgba32float: [4, Float32Array],
    rg32float: [2, Float32Array],
    r32float: [1, Float32Array],
    rgba16float: [4, window.Float16Array],
    rg16float: [2, window.Float16Array],
    r16float: [1, window.Float16Array],
    rgba8unorm: [4, Uint8Array],
  };
  const FUNCTIONS = {
    "+": (a, b) => a + b,
    "-": (a, b) => (b === undefined ? -a : a - b),
    "*": (a, b) => a * b,
    "/": (a, b) => a / b,
    "^": (a, b) => a ** b,
    floor: Math.floor,
    ceil: Math.ceil,
    min: Math.min,
    max: Math.max,
  };

  const evaluate = (expression, value) => {
    if (typeof expression === "number") return expression;
    if (typeof expression === "string") return value(expression);
    const [name, ...parts] = expression;
    return FUNCTIONS[name](...parts.map((part) => evaluate(part, value)));
  };

  // Halves are rounded away from 0, as in the program.
  const round = (number) => Math.sign(number) * Math.round(Math.abs(number));

  const refuse = (reason) => {
    throw new Error(reason);
  };

  // Opens the graphics card. `lost` is called if it stops answering.
  const open = async (lost) => {
    const adapter = await navigator.gpu?.requestAdapter({ powerPreference: "high-performance" });
    if (!adapter) refuse("This browser has no WebGPU, so it cannot run the filter. Recent Chrome, Edge, Safari and Firefox have it.");
    const device = await adapter.requestDevice({
      requiredFeatures: FEATURES.filter((name) => adapter.features.has(name)),
      requiredLimits: Object.fromEntries(LIMITS.map((name) => [name, adapter.limits[name]])),
    });
    device.lost.then(({ reason }) => reason !== "destroyed" && lost());
    // Whoever waits for a scope gets the errors; the console needs none.
    device.addEventListener("uncapturederror", (event) => event.preventDefault());
    const { vendor, architecture, device: model, description, isFallbackAdapter } = adapter.info;
    const name = description || model || `${vendor} ${architecture}`.trim() || "unknown card";
    const isSoftware = isFallbackAdapter || /swiftshader|llvmpipe|basic render/i.test(`${architecture} ${name}`);
    return { device, name, kind: isSoftware ? "software" : "other" };
  };

  // Runs `work` after all earlier work; fails with what the card's driver says against it.
  const caught = (device, work) => {
    const done = last.then(() => catchErrors(device, work));
    last = done.catch(() => {});
    return done;
  };
  // Scopes are a stack: two works at once would get each other's errors.
  let last = Promise.resolve();

  const catchErrors = async (device, work) => {
    device.pushErrorScope("validation");
    device.pushErrorScope("out-of-memory");
    let made;
    try {
      made = await work();
    } finally {
      const errors = [await device.popErrorScope(), await device.popErrorScope()];
      const error = errors.find(Boolean);
      if (error) refuse(error.message);
    }
    return made;
  };

  const writesOf = (filter) => filter.passes.flatMap(({ bindings }) => bindings.filter(({ role }) => role === "write"));

  // Says why this browser cannot run a filter; nothing if it can.
  const findObstacle = (filter, device) => {
    const lacking = filter.features.find((name) => !device.features.has(name));
    if (lacking) return `The filter needs ${lacking}, a feature of WebGPU that this browser or graphics card does not have.`;
    const unknown = [...filter.inputs, { name: "output", format: filter.output }].find(({ format }) => !FORMATS[format]?.[1]);
    return unknown ? `The filter has ${unknown.name} in the format ${unknown.format}, which this page does not know.` : null;
  };

  const layoutEntry = (device, { binding, role, kind, filterable, format, storage, filter, mip }, visibility) => {
    const type = { uint: "uint", sint: "sint" }[kind] ?? (filterable ? "float" : "unfilterable-float");
    const interpolates = filter === "linear" || mip === "linear";
    const resource = {
      read: { texture: { sampleType: type } },
      write: { storageTexture: { access: "write-only", format } },
      block: { buffer: { type: storage ? "read-only-storage" : "uniform" } },
      sampler: { sampler: { type: interpolates ? "filtering" : "non-filtering" } },
    };
    return { binding, visibility, ...resource[role] };
  };

  const createSampler = (device, { filter, mip, wrap }) => {
    const address = { clamp: "clamp-to-edge", repeat: "repeat", mirror: "mirror-repeat" }[wrap];
    const filters = { magFilter: filter, minFilter: filter, mipmapFilter: mip };
    return device.createSampler({ addressModeU: address, addressModeV: address, ...filters });
  };

  // Format of a texture of the filter, by name.
  const formatOf = (filter, name) =>
    name === "output" ? filter.output : [...filter.inputs, ...filter.textures].find((own) => own.name === name).format;

  const compilePass = async (device, filter, pass, modules) => {
    const isFragment = pass.stage === "fragment";
    const own = { bindings: pass.bindings, visibility: isFragment ? GPUShaderStage.FRAGMENT : GPUShaderStage.COMPUTE };
    const vertex = isFragment ? [{ bindings: pass.vertex.bindings, visibility: GPUShaderStage.VERTEX }] : [];
    const stages = [own, ...vertex].map(({ bindings, visibility }) => {
      const entries = bindings.map((one) => layoutEntry(device, one, visibility));
      const samplers = new Map(bindings.filter(({ role }) => role === "sampler").map((one) => [one.binding, createSampler(device, one)]));
      return { bindings, samplers, layout: device.createBindGroupLayout({ entries }) };
    });
    const layout = device.createPipelineLayout({ bindGroupLayouts: stages.map((stage) => stage.layout) });
    const code = { module: modules[pass.module], entryPoint: pass.kernel };
    const pipeline = isFragment
      ? await device.createRenderPipelineAsync({
          layout,
          vertex: { module: modules[pass.vertex.module], entryPoint: pass.vertex.entry },
          fragment: { ...code, targets: pass.targets.map((name) => ({ format: formatOf(filter, name) })) },
        })
      : await device.createComputePipelineAsync({ layout, compute: code });
    return { pass, stages, pipeline };
  };

  // Compiles the passes; `texts` are the modules' own texts, without what the program appends. Returns `{passes}`, or `{errors}`, each
  // with the module, the line of its text (none if it is elsewhere) and what the compiler says.
  const compile = async (device, filter, texts) => {
    const modules = filter.modules.map(({ appended }, index) => device.createShaderModule({ code: `${texts[index]}\n${appended}` }));
    const said = await Promise.all(modules.map((module) => module.getCompilationInfo()));
    const errors = said.flatMap(({ messages }, module) => {
      const lines = texts[module].split("\n").length;
      const broken = messages.filter(({ type }) => type === "error");
      return broken.map(({ lineNum, message }) => ({ module, line: lineNum > 0 && lineNum <= lines ? lineNum : null, message }));
    });
    if (errors.length > 0) return { errors };
    try {
      return { passes: await caught(device, () => Promise.all(filter.passes.map((pass) => compilePass(device, filter, pass, modules)))) };
    } catch (error) {
      return { errors: [{ module: 0, line: null, message: error.message }] };
    }
  };

  // Numbers of an input in the filter's convention: one expression per component of `frame.value`.
  const convertAll = (floats, expressions, value) =>
    floats.map((number, at) => evaluate(expressions[at % expressions.length], (name) => (name === "frame.value" ? number : value(name))));

  // Numbers of an input as texels with `components` numbers each; missing ones are 0, and the fourth is 1.
  const texelsOf = (floats, pixels, components) => {
    const given = floats.length / pixels;
    if (given === components) return floats;
    const texels = new Float32Array(pixels * components);
    for (let pixel = 0; pixel < pixels; pixel++) {
      for (let part = 0; part < given; part++) texels[pixel * components + part] = floats[pixel * given + part];
      if (components === 4) texels[pixel * components + 3] = 1;
    }
    return texels;
  };

  const encode = (floats, array) => {
    if (array === Float32Array) return floats;
    if (array === Uint8Array) return Uint8Array.from(floats, (one) => Math.round(255 * Math.min(1, Math.max(0, one))));
    return array.from(floats, (one) => Math.min(LARGEST_HALF, Math.max(-LARGEST_HALF, one)));
  };

  // Plans a texture on pictures of a size: its own size, mip levels and copies.
  const plan = (texture, { filter, size, value }) => {
    const { name, format, divided_by: divisors, rounding, mips = 1 } = texture;
    const [width, height] = size.map((side, axis) => {
      const divisor = divisors ? evaluate(divisors[axis], value) : 1;
      if (!Number.isInteger(divisor) || divisor < 1) {
        refuse(`The size of texture ${name} is divided by ${divisor}; allowed: whole numbers from 1.`);
      }
      return rounding === "down" ? Math.max(1, Math.floor(side / divisor)) : Math.ceil(side / divisor);
    });
    // The last level has one texel.
    const levels = Math.min(mips, Math.floor(Math.log2(Math.max(width, height))) + 1);
    const copies = filter.passes.some(({ exchanged }) => exchanged.includes(name)) ? 2 : 1;
    return { name, format, width, height, levels, copies };
  };

  const usageOf = (filter, name) => {
    const isTarget = filter.passes.some(({ targets }) => targets.includes(name));
    const isStored = writesOf(filter).some(({ resource }) => resource === name);
    const { TEXTURE_BINDING, COPY_DST, COPY_SRC, RENDER_ATTACHMENT, STORAGE_BINDING } = GPUTextureUsage;
    return TEXTURE_BINDING | COPY_DST | COPY_SRC | (isTarget ? RENDER_ATTACHMENT : 0) | (isStored ? STORAGE_BINDING : 0);
  };

  // Makes the textures, by name: copies, of which the first is the one to read.
  const createTextures = (device, run) => {
    const { filter } = run;
    const all = [...filter.inputs, { name: "output", format: filter.output }, ...filter.textures];
    return new Map(all.map((texture) => {
      const { name, format, width, height, levels, copies } = plan(texture, run);
      const words = { label: name, size: [width, height], mipLevelCount: levels, format, usage: usageOf(filter, name) };
      return [name, Array.from({ length: copies }, () => device.createTexture(words))];
    }));
  };

  // Fills the textures of the frame. `texels` keeps what they are filled with, by name, for the next run.
  const upload = (device, { filter, scene, size: [width, height], textures, texels, value }) => {
    for (const { name, from, format, convert } of filter.inputs) {
      if (!scene.inputs[from]) refuse(`The filter reads ${from}, which this report does not have.`);
      const [components, array] = FORMATS[format];
      if (!texels.has(name)) {
        const floats = convert ? convertAll(scene.inputs[from], convert, value) : scene.inputs[from];
        texels.set(name, encode(texelsOf(floats, width * height, components), array));
      }
      const layout = { bytesPerRow: width * components * array.BYTES_PER_ELEMENT };
      device.queue.writeTexture({ texture: textures.get(name)[0] }, texels.get(name), layout, [width, height]);
    }
  };

  // A view of one mip level, or of all.
  const view = (texture, level) => texture.createView(level === null ? {} : { baseMipLevel: level, mipLevelCount: 1 });

  const fillBlock = (device, { bytes, storage, numbers }, value) => {
    const size = storage ? bytes : Math.ceil(bytes / 16) * 16;
    const data = new DataView(new ArrayBuffer(size));
    for (const [offset, kind, expression] of numbers) {
      const number = evaluate(expression, value);
      if (kind === "f32") data.setFloat32(offset, number, true);
      else data.setInt32(offset, round(number), true);
    }
    const usage = (storage ? GPUBufferUsage.STORAGE : GPUBufferUsage.UNIFORM) | GPUBufferUsage.COPY_DST;
    const buffer = device.createBuffer({ size, usage });
    device.queue.writeBuffer(buffer, 0, data.buffer);
    return buffer;
  };

  // Binds one run of a pass to its textures and numbers; none if it writes a level that a small texture does not have.
  const bind = (device, { textures }, { pass, stages, pipeline }, value) => {
    const levelOf = (expression) => round(evaluate(expression, value));
    const copy = (name, isWritten) => textures.get(name)[isWritten && pass.exchanged.includes(name) ? 1 : 0];
    const written = new Map(pass.targets.map((name) => [name, levelOf(pass.level ?? 0)]));
    for (const { role, resource, level } of pass.bindings) if (role === "write") written.set(resource, levelOf(level ?? 0));
    if ([...written].some(([name, level]) => level >= textures.get(name)[0].mipLevelCount)) return null;
    const resourceOf = (one, samplers) => {
      if (one.role === "sampler") return samplers.get(one.binding);
      if (one.role === "block") return { buffer: fillBlock(device, one, value) };
      const texture = copy(one.resource, one.role === "write");
      if (one.role === "write") return view(texture, written.get(one.resource));
      // A small texture has fewer levels: the pass gets its last.
      return view(texture, (one.level ?? null) === null ? null : Math.min(levelOf(one.level), texture.mipLevelCount - 1));
    };
    const groups = stages.map(({ bindings, samplers, layout }) => {
      const entries = bindings.map((one) => ({ binding: one.binding, resource: resourceOf(one, samplers) }));
      return device.createBindGroup({ layout, entries });
    });
    const over = pass.targets[0] ?? pass.over ?? "output";
    const side = (length) => Math.max(1, length >> (written.get(over) ?? 0));
    const sides = [textures.get(over)[0].width, textures.get(over)[0].height].map(side);
    const covers = pass.workgroup_per_texel || pass.stage === "fragment" ? [1, 1] : pass.workgroup;
    return {
      entry: pass.entry,
      isFragment: pass.stage === "fragment",
      pipeline,
      groups,
      workgroups: sides.map((length, axis) => Math.ceil(length / covers[axis])),
      attachments: pass.targets.map((name) => view(copy(name, true), written.get(name))),
      copies: pass.keeps_unwritten ? pass.exchanged.map((name) => [...textures.get(name)]) : [],
    };
  };

  const copyLevels = (encoder, from, to) => {
    for (let mipLevel = 0; mipLevel < from.mipLevelCount; mipLevel++) {
      const size = [from.width, from.height].map((side) => Math.max(1, side >> mipLevel));
      encoder.copyTextureToTexture({ texture: from, mipLevel }, { texture: to, mipLevel }, size);
    }
  };

  // Adds a dispatch to the commands of an encoder, with `timestampWrites` if they are there.
  const encodeDispatch = (encoder, one, timestampWrites) => {
    for (const [from, to] of one.copies) copyLevels(encoder, from, to);
    // A fragment that is discarded leaves what was there.
    const colorAttachments = one.attachments.map((attached) => ({ view: attached, loadOp: "load", storeOp: "store" }));
    const pass = one.isFragment
      ? encoder.beginRenderPass({ colorAttachments, timestampWrites })
      : encoder.beginComputePass({ timestampWrites });
    pass.setPipeline(one.pipeline);
    one.groups.forEach((group, at) => pass.setBindGroup(at, group));
    if (one.isFragment) pass.draw(3);
    else pass.dispatchWorkgroups(...one.workgroups);
    pass.end();
  };

  // Binds all runs of all passes, in order.
  const bindAll = (device, run, passes) => {
    const dispatches = [];
    for (const compiled of passes) {
      const { pass } = compiled;
      const iterations = evaluate(pass.repeat, run.value);
      for (let iteration = 0; iteration < iterations; iteration++) {
        const own = { iteration, iterations, "frame.iteration": iteration, "frame.iterations": iterations };
        const dispatch = bind(device, run, compiled, (name) => own[name] ?? run.value(name));
        if (!dispatch) continue;
        dispatches.push(dispatch);
        // The next pass reads what this one wrote.
        for (const name of pass.exchanged) run.textures.get(name).reverse();
      }
    }
    return dispatches;
  };

  // Prepares a run of compiled passes on a scene's frame: `numbers` are the values of parameters and of the frame, by name.
  const prepare = (device, { filter, scene, passes, texels, numbers }) => {
    const size = [scene.width, scene.height];
    const value = (name) => numbers[name] ?? refuse(`The report does not have the number ${name}.`);
    const run = { filter, scene, size, texels, value };
    run.textures = createTextures(device, run);
    upload(device, run);
    run.dispatches = bindAll(device, run, passes);
    return run;
  };

  const destroy = ({ textures }) => [...textures.values()].flat().forEach((texture) => texture.destroy());

  // Red, green and blue of the output, without the guard band.
  const readOutput = async (device, { filter, scene, textures }, encoder) => {
    const { x, y, width, height } = scene.crop;
    const [components, array] = FORMATS[filter.output];
    const row = Math.ceil((width * components * array.BYTES_PER_ELEMENT) / ROW) * ROW;
    const buffer = device.createBuffer({ size: row * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    encoder.copyTextureToBuffer({ texture: textures.get("output")[0], origin: [x, y] }, { buffer, bytesPerRow: row }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const numbers = new array(buffer.getMappedRange());
    const scale = (array === Uint8Array ? 1 / 255 : 1) / filter.output_scale;
    const planes = [0, 1, 2].map((part) => {
      const plane = new Float32Array(width * height);
      for (let at = 0; at < plane.length; at++) {
        const start = (Math.floor(at / width) * row) / array.BYTES_PER_ELEMENT + (at % width) * components;
        plane[at] = numbers[start + part] * scale;
      }
      return plane;
    });
    buffer.destroy();
    const broken = planes[0].findIndex((_, at) => !planes.every((plane) => Number.isFinite(plane[at])));
    if (broken >= 0) refuse(`Pixel ${broken % width}, ${Math.floor(broken / width)} is not a finite number.`);
    return planes;
  };

  // Runs the passes on a frame; returns red, green and blue of the output.
  const blur = (device, words) =>
    caught(device, async () => {
      const run = prepare(device, words);
      try {
        const encoder = device.createCommandEncoder();
        run.dispatches.forEach((one) => encodeDispatch(encoder, one));
        return await readOutput(device, run, encoder);
      } finally {
        destroy(run);
      }
    });

  pictures.card = { open, findObstacle, compile, blur, caught, prepare, destroy, encodeDispatch };
}
