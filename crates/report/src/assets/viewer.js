"use strict";
// Two pictures of the case that is open. They zoom and move together.
{
  // Largest magnification, and the one of a place that is shown.
  const MOST = 32;
  const NEAR = 6;
  // Time that either picture is seen while they blink, in milliseconds.
  const BLINK = 700;
  // Settings that an address need not name.
  const USUAL = [["left", "truth"], ["right", "output"], ["mode", "slide"], ["zoom", "1"], ["at", ""]];
  const pictures = window.shuttertruth;
  const { paint, painters, planes, motion, speedOf } = pictures;
  const viewer = document.getElementById("viewer");
  const [width, height, block] = ["width", "height", "block"].map((name) => Number(viewer.dataset[name]));
  const stack = viewer.querySelector(".stack");
  const panes = [...viewer.querySelectorAll(".pane")];
  const singles = [...viewer.querySelectorAll(".single")];
  const split = viewer.querySelector("[name=split]");
  const menus = { left: viewer.querySelector("[name=left]"), right: viewer.querySelector("[name=right]") };
  // What the menus were set to: it outlives a case that lacks the picture.
  const wanted = { left: "truth", right: "output" };

  // The part in view: `x` and `y` of the upper left corner in pixels of the picture.
  const view = { zoom: 1, x: 0, y: 0 };
  // The place of a broken bound, and the pixel whose numbers are read.
  let mark = null;
  let pixel = null;
  let open = null;
  let blinking = null;
  // Counts requests: what arrives late is not drawn over what came after.
  let asked = 0;

  const input = (name, value) => viewer.querySelector(`[name=${name}][value="${CSS.escape(value)}"]`);
  const chosen = (name) => viewer.querySelector(`[name=${name}]:checked`).value;
  const picked = () => ({ left: pictures.find(menus.left.value), right: pictures.find(menus.right.value) });
  const stops = () => Number(open.querySelector(".viewer_place").dataset.stops) + Number(chosen("exposure"));

  const fail = (error) => {
    viewer.querySelector(".hint").textContent = error.message;
  };

  const draw = async (mine, places) => {
    const canvases = [];
    for (const [place, [key, load, changes]] of Object.entries(places)) {
      const canvas = viewer.querySelector(`[data-place=${place}] canvas`);
      // What changes with every move of a slider is drawn only where it is seen.
      if (canvas.dataset.shows === key || (changes && !canvas.checkVisibility())) continue;
      canvases.push([canvas, key, await load()]);
      if (mine !== asked) return;
    }
    for (const [canvas, key, color] of canvases) {
      paint(canvas, color, width);
      canvas.dataset.shows = key;
    }
    viewer.dataset.drawn = mine;
  };

  // Lists the pictures that the case offers; falls back where it lacks the one that was wanted.
  const fillMenus = () => {
    for (const [side, menu] of Object.entries(menus)) {
      const groups = pictures.groups().map(([title, words]) => {
        const group = Object.assign(document.createElement("optgroup"), { label: title });
        group.append(...words.map((word) => new Option(pictures.find(word).title, word)));
        return group;
      });
      menu.replaceChildren(...groups);
      menu.value = wanted[side];
      if (menu.selectedIndex < 0) menu.value = "output";
    }
  };

  const show = () => {
    if (!open) return;
    const mode = chosen("mode");
    viewer.dataset.mode = mode;
    stack.hidden = mode === "side";
    for (const single of singles) single.hidden = mode !== "side";
    const { left, right } = picked();
    const at = stops();
    // A picture that this page computed has a version, and is drawn again with each.
    const key = ({ word, version = "" }) => `${word}${version}`;
    const drawing = (picture) => [`${open.id} ${key(picture)} ${at}`, () => pictures.painterOf(picture, at), "version" in picture];
    const isLight = left.painter === "radiance" && right.painter === "radiance";
    const differs = mode === "difference" && isLight;
    const below = differs
      ? [`${open.id} ${key(left)} ${key(right)} ${at}`, () => pictures.differenceOf(left, right, at)]
      : drawing(right);
    const swapped = "swapped" in viewer.dataset;
    const shown = differs ? "signed" : mode === "blink" && !swapped ? left.word : right.word;
    const minus = { title: `${right.title} minus ${left.title}`, hint: "brightness of the right picture minus the left one" };
    const over = mode === "blink" && swapped ? right : left;
    const named = { over, under: differs ? minus : right, left, right };
    for (const [place, { title, score = "" }] of Object.entries(named)) {
      viewer.querySelector(`[data-place=${place}] canvas`).setAttribute("aria-label", `${title}, ${open.dataset.title}`);
      const tag = viewer.querySelector(`[data-tag=${place}]`);
      tag.textContent = title;
      tag.dataset.score = score;
    }
    const { title, hint } = differs ? minus : pictures.find(shown);
    viewer.querySelector(".hint").textContent =
      mode === "difference" && !isLight ? "A difference needs two pictures of light." : `${title}: ${hint}.`;
    for (const legend of viewer.querySelectorAll("[data-legend]")) {
      legend.hidden = !legend.dataset.legend.split(" ").includes(shown);
    }
    asked += 1;
    viewer.dataset.asked = asked;
    draw(asked, { over: drawing(left), under: below, left: drawing(left), right: drawing(right) }).catch(fail);
    place();
    pictures.note();
  };

  const runBlink = () => {
    clearInterval(blinking);
    const runs = open && chosen("mode") === "blink" && !matchMedia("(prefers-reduced-motion: reduce)").matches;
    blinking = runs ? setInterval(swap, BLINK) : null;
  };

  const swap = () => {
    viewer.toggleAttribute("data-swapped");
    show();
  };

  // Starts to blink, stops, and once it stands changes the picture.
  const blink = () => {
    if (chosen("mode") !== "blink") return setMode("blink");
    if (blinking === null) return swap();
    clearInterval(blinking);
    blinking = null;
  };

  // Lays out pictures and marks.
  const place = () => {
    stack.style.setProperty("--split", `${split.value}%`);
    for (const pane of panes) {
      const scale = (pane.clientWidth / width) * view.zoom;
      for (const layer of pane.querySelectorAll(".layer")) {
        layer.style.transform = `scale(${scale}) translate(${-view.x}px, ${-view.y}px)`;
      }
      const box = (element, at, left, top, side) => {
        element.hidden = at === null;
        if (at === null) return;
        const style = { left: (left - view.x) * scale, top: (top - view.y) * scale, width: side * scale, height: side * scale };
        for (const [name, length] of Object.entries(style)) element.style[name] = `${length}px`;
      };
      box(pane.querySelector(".mark"), mark, mark?.x - block / 2, mark?.y - block / 2, block);
      box(pane.querySelector(".pixel"), pixel, pixel?.x, pixel?.y, 1);
      for (const line of pane.querySelectorAll(".line")) {
        line.style.strokeWidth = `${(line.matches(".shade") ? 3.5 : 1.5) / scale}px`;
      }
    }
    viewer.classList.toggle("zoomed", view.zoom > 1);
    viewer.querySelector(".zoom").textContent = `${Number(view.zoom.toPrecision(2))}×`;
  };

  // Zooms about the pixel `(x, y)`, which stays where it is.
  const zoom = (factor, x = view.x + width / view.zoom / 2, y = view.y + height / view.zoom / 2) => {
    const next = Math.min(MOST, Math.max(1, view.zoom * factor));
    const part = view.zoom / next;
    look(next, x - (x - view.x) * part, y - (y - view.y) * part);
  };

  const look = (zoomed, x, y) => {
    const within = (value, size) => Math.min(size - size / zoomed, Math.max(0, value));
    Object.assign(view, { zoom: zoomed, x: within(x, width), y: within(y, height) });
    place();
    pictures.note();
  };

  const lookAt = (zoomed, x, y) => look(zoomed, x - width / zoomed / 2, y - height / zoomed / 2);

  const fit = () => look(1, 0, 0);

  const showWorst = () => {
    const [x, y] = open.querySelector(".viewer_place").dataset.worst.split(",").map(Number);
    lookAt(NEAR, x + 0.5, y + 0.5);
    choose(x, y, true);
  };

  const locate = (pane, event) => {
    const box = pane.getBoundingClientRect();
    const scale = (box.width / width) * view.zoom;
    return [view.x + (event.clientX - box.left) / scale, view.y + (event.clientY - box.top) / scale];
  };

  const slide = (percent) => {
    split.value = Math.min(100, Math.max(0, percent));
    place();
  };

  const slideTo = (pane, event) => {
    const box = pane.getBoundingClientRect();
    slide((100 * (event.clientX - box.left)) / box.width);
  };

  // Reads a pixel; what the keys choose is followed and read aloud.
  const choose = (x, y, aloud) => {
    const within = (value, size) => Math.min(size - 1, Math.max(0, Math.floor(value)));
    pixel = { x: within(x, width), y: within(y, height) };
    if (aloud) {
      const follow = (at, start, size) => Math.min(at - size * 0.1, Math.max(start, at + 1 - size * 0.9));
      look(view.zoom, follow(pixel.x, view.x, width / view.zoom), follow(pixel.y, view.y, height / view.zoom));
    } else place();
    pictures.read(pixel, picked(), aloud);
  };

  const step = (columns, rows) => {
    if (pixel) choose(pixel.x + columns, pixel.y + rows, true);
    else choose(view.x + width / view.zoom / 2, view.y + height / view.zoom / 2, true);
  };

  for (const pane of panes) {
    let drag = null;
    pane.addEventListener("pointerdown", (event) => {
      const box = pane.getBoundingClientRect();
      const away = Math.abs(event.clientX - box.left - (box.width * split.value) / 100);
      const divides = viewer.dataset.mode === "slide" && (view.zoom === 1 || away < 16);
      drag = { divides, from: locate(pane, event) };
      pane.setPointerCapture(event.pointerId);
      if (divides) slideTo(pane, event);
      choose(...drag.from, false);
    });
    pane.addEventListener("pointermove", (event) => {
      const [x, y] = locate(pane, event);
      pictures.floatTip(event);
      if (!drag) choose(x, y, false);
      else if (drag.divides) slideTo(pane, event);
      else look(view.zoom, view.x + drag.from[0] - x, view.y + drag.from[1] - y);
    });
    const drop = () => (drag = null);
    pane.addEventListener("pointerup", drop);
    pane.addEventListener("pointercancel", drop);
    pane.addEventListener("pointerleave", () => pictures.floatTip(null));
    pane.addEventListener(
      "wheel",
      (event) => {
        // A whole picture lets the page scroll on.
        if (view.zoom === 1 && event.deltaY > 0) return;
        event.preventDefault();
        zoom(event.deltaY < 0 ? 1.25 : 0.8, ...locate(pane, event));
      },
      { passive: false },
    );
    pane.addEventListener("keydown", (event) => {
      const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      const way = ways[event.key];
      const far = event.shiftKey ? 10 : 1;
      if (event.key === "PageUp") zoom(2);
      else if (event.key === "PageDown") zoom(0.5);
      else if (way) step(far * way[0], far * way[1]);
      else return;
      event.preventDefault();
    });
  }

  const setMode = (mode) => {
    input("mode", mode).checked = true;
    viewer.removeAttribute("data-swapped");
    show();
    runBlink();
  };

  const setSide = (side, word) => {
    wanted[side] = word;
    menus[side].value = word;
    show();
  };

  const next = (side, step) => {
    const all = [...menus[side].options].map((option) => option.value);
    setSide(side, all[(all.indexOf(menus[side].value) + step + all.length) % all.length]);
  };

  const nextExposure = () => {
    const all = [...viewer.querySelectorAll("[name=exposure]")];
    all[(all.findIndex((one) => one.checked) + 1) % all.length].checked = true;
    show();
  };

  const exchange = () => {
    [wanted.left, wanted.right] = [menus.right.value, menus.left.value];
    [menus.left.value, menus.right.value] = [wanted.left, wanted.right];
    show();
  };

  // Truth, output and error around the worst place of a bound, the error as bright as it is there.
  const crop = async (figure) => {
    const { x, y, map } = figure.dataset;
    const canvases = [...figure.querySelectorAll("canvas")];
    const [columns, rows] = [canvases[0].width, canvases[0].height];
    const start = (middle, size, all) => Math.min(all - size, Math.max(0, middle - Math.floor(size / 2)));
    const [left, top] = [start(Number(x), columns, width), start(Number(y), rows, height)];
    const light = ["truth", "output"].map((word) => pictures.painterOf(pictures.find(word), stops()));
    const [truth, output, error] = await Promise.all([...light, planes([Number(map)])]);
    let most = Number.MIN_VALUE;
    for (let row = top; row < top + rows; row++) {
      for (let column = left; column < left + columns; column++) most = Math.max(most, error[0][row * width + column]);
    }
    [truth, output, painters.share(error, { most })].forEach((color, at) => paint(canvases[at], color, width, left, top));
  };

  const fillLegends = async () => {
    const canvas = viewer.querySelector(".wheel");
    const middle = (canvas.width - 1) / 2;
    const color = (at) => {
      const [x, y] = [(at % canvas.width) / middle - 1, Math.floor(at / canvas.width) / middle - 1];
      const speed = Math.hypot(x, y);
      // Strength grows evenly from the middle.
      return speed > 1 ? motion(0, 0, 1) : motion(x * speed, y * speed, 1);
    };
    paint(canvas, color, canvas.width);
    // Two pictures alone have neither motion nor depth.
    if (!pictures.own().velocity) return;
    const fastest = speedOf(await planes(pictures.own().velocity));
    viewer.querySelector(".fastest").textContent = fastest.toPrecision(3);
    const [depth] = await planes(pictures.own().depth);
    const [near, far] = pictures.reachOf(depth);
    viewer.querySelector(".nearest").textContent = near.toPrecision(3);
    viewer.querySelector(".farthest").textContent = far.toPrecision(3);
  };

  // Opens a case with the settings that an address names, the others as usual; an address without any keeps what there is. None
  // closes the viewer.
  const openCase = (section, settings = {}) => {
    open = section;
    viewer.hidden = !open;
    mark = null;
    if (!open) return runBlink();
    const home = open.querySelector(".viewer_place");
    pictures.openScene(Number(home.dataset.scene));
    pictures.openCase(open);
    if (Object.keys(settings).length > 0) {
      const { left, right, mode, zoom: zoomed, at } = { ...Object.fromEntries(USUAL), at: `${width / 2},${height / 2}`, ...settings };
      Object.assign(wanted, { left, right });
      (input("mode", mode) ?? input("mode", "slide")).checked = true;
      lookAt(Math.min(MOST, Math.max(1, Number(zoomed) || 1)), ...at.split(",").map(Number));
    }
    runBlink();
    fillMenus();
    for (const line of viewer.querySelectorAll(".line")) line.setAttribute("d", home.dataset.line);
    home.append(viewer);
    show();
    fillLegends().catch(fail);
    for (const figure of open.querySelectorAll(".crop")) crop(figure).catch(fail);
    if (pixel) pictures.read(pixel, picked(), false);
  };

  // Settings that an address names; those that are as usual are left out.
  const settings = () => {
    const { left, right } = picked();
    const middle = [view.x + width / view.zoom / 2, view.y + height / view.zoom / 2].map(Math.round);
    const now = {
      left: left.word,
      right: right.word,
      mode: chosen("mode"),
      zoom: String(Number(view.zoom.toPrecision(3))),
      at: view.zoom > 1 ? middle.join(",") : "",
    };
    return USUAL.map(([name, usual]) => [name, now[name], usual]).filter(([, value, usual]) => value !== usual);
  };

  for (const side of Object.keys(menus)) menus[side].addEventListener("change", () => setSide(side, menus[side].value));
  for (const one of viewer.querySelectorAll("[name=mode]")) one.addEventListener("change", () => setMode(one.value));
  for (const one of viewer.querySelectorAll("[name=exposure]")) one.addEventListener("change", show);
  split.addEventListener("input", place);
  const actions = { in: () => zoom(2), out: () => zoom(0.5), fit, worst: showWorst, exchange };
  for (const button of viewer.querySelectorAll("[data-do]")) button.addEventListener("click", actions[button.dataset.do]);
  document.addEventListener("click", (event) => {
    const button = event.target.closest("button.place");
    if (!button) return;
    mark = { x: Number(button.dataset.x), y: Number(button.dataset.y) };
    lookAt(NEAR, mark.x, mark.y);
    choose(mark.x, mark.y, true);
    viewer.scrollIntoView({ block: "start" });
  });
  new ResizeObserver(place).observe(viewer);

  Object.assign(pictures, {
    isOpen: () => open !== null,
    show: openCase,
    redraw: show,
    settings,
    setMode,
    next,
    nextExposure,
    exchange,
    blink,
    zoom,
    fit,
    showWorst,
    slide: (percent) => slide(Number(split.value) + percent),
  });
}
