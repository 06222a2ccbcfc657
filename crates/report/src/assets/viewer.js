"use strict";
// The pictures of the case that is open. All of them zoom and move together.
{
  // Largest magnification.
  const MOST = 32;
  const { paint, painters, planes, motion, speedOf } = window.shuttertruth;
  const viewer = document.getElementById("viewer");
  const [width, height, block] = ["width", "height", "block"].map((name) => Number(viewer.dataset[name]));
  const stack = viewer.querySelector(".stack");
  const panes = [...viewer.querySelectorAll(".pane")];
  const singles = [...viewer.querySelectorAll(".single")];
  const split = viewer.querySelector("[name=split]");

  // What is in view: `x` and `y` of the upper left corner in pixels of the picture.
  const view = { zoom: 1, x: 0, y: 0 };
  // The place of a bound that is not kept, and the pixel whose numbers are read.
  let mark = null;
  let pixel = null;
  let open = null;
  let layers = {};
  let stops = 0;
  // Counts what was asked for: what arrives late is not drawn over what came after.
  let asked = 0;

  const input = (name, value) => viewer.querySelector(`[name=${name}][value="${value}"]`);
  const chosen = (name) => viewer.querySelector(`[name=${name}]:checked`);
  const titled = (word) => input("under", word).parentElement.textContent.trim();
  const isMap = (word) => input("under", word).dataset.painter !== "radiance";

  // Which picture lies where.
  const placed = () => {
    const under = chosen("under").value;
    return {
      over: chosen("over").value,
      under,
      instant: "instant",
      truth: "truth",
      output: "output",
      map: isMap(under) ? under : "flip",
    };
  };

  // A function from a pixel's index to the color of a layer.
  const painter = async (word) => {
    const own = await planes(layers[word]);
    const { painter } = input("under", word).dataset;
    const motions = painter === "motion" ? await planes(layers.velocity) : null;
    return painters[painter](own, { stops, fastest: motions && speedOf(motions) });
  };

  const failed = (error) => {
    viewer.querySelector(".hint").textContent = error.message;
  };

  const draw = async (mine, places) => {
    const words = [...new Set(Object.values(places))];
    const colors = Object.fromEntries(await Promise.all(words.map(async (word) => [word, await painter(word)])));
    if (mine !== asked) return;
    for (const [place, word] of Object.entries(places)) {
      const canvas = viewer.querySelector(`[data-place=${place}] canvas`);
      const key = `${open.id} ${word} ${stops}`;
      if (canvas.dataset.shows !== key) paint(canvas, colors[word], width);
      canvas.dataset.shows = key;
    }
    viewer.dataset.drawn = mine;
  };

  const fill = () => {
    if (!open) return;
    const way = chosen("way").value;
    viewer.dataset.way = way;
    stack.hidden = way === "side";
    for (const single of singles) single.hidden = way !== "side";
    stops = Number(open.querySelector(".viewer_place").dataset.stops) + Number(chosen("exposure").value);
    const places = placed();
    for (const [place, word] of Object.entries(places)) {
      const canvas = viewer.querySelector(`[data-place=${place}] canvas`);
      canvas.setAttribute("aria-label", `${titled(word)}, ${open.dataset.title}`);
      viewer.querySelector(`[data-tag=${place}]`).textContent = titled(word);
    }
    const swapped = "swapped" in viewer.dataset;
    if (way === "blink") {
      viewer.querySelector("[data-tag=over]").textContent = titled(swapped ? places.under : places.over);
    }
    const shown = way === "side" ? places.map : way === "blink" && !swapped ? places.over : places.under;
    viewer.querySelector(".hint").textContent = `${titled(shown)}: ${input("under", shown).dataset.hint}.`;
    for (const legend of viewer.querySelectorAll("[data-legend]")) {
      legend.hidden = !legend.dataset.legend.split(" ").includes(shown);
    }
    asked += 1;
    viewer.dataset.asked = asked;
    draw(asked, places).catch(failed);
    place();
  };

  // Where everything lies.
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
      pane.querySelector(".line").style.strokeWidth = `${1.5 / scale}px`;
    }
    viewer.classList.toggle("zoomed", view.zoom > 1);
  };

  // The pixel `(x, y)` stays where it is.
  const zoom = (factor, x = view.x + width / view.zoom / 2, y = view.y + height / view.zoom / 2) => {
    const next = Math.min(MOST, Math.max(1, view.zoom * factor));
    const part = view.zoom / next;
    look(next, x - (x - view.x) * part, y - (y - view.y) * part);
  };

  const look = (zoomed, x, y) => {
    const within = (value, size) => Math.min(size - size / zoomed, Math.max(0, value));
    Object.assign(view, { zoom: zoomed, x: within(x, width), y: within(y, height) });
    place();
  };

  const pointed = (pane, event) => {
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
    window.shuttertruth.read(pixel, layers, aloud);
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
      const divides = viewer.dataset.way === "slide" && (view.zoom === 1 || away < 16);
      drag = { divides, from: pointed(pane, event) };
      pane.setPointerCapture(event.pointerId);
      if (divides) slideTo(pane, event);
      choose(...drag.from, false);
    });
    pane.addEventListener("pointermove", (event) => {
      const [x, y] = pointed(pane, event);
      if (!drag) choose(x, y, false);
      else if (drag.divides) slideTo(pane, event);
      else look(view.zoom, view.x + drag.from[0] - x, view.y + drag.from[1] - y);
    });
    const drop = () => (drag = null);
    pane.addEventListener("pointerup", drop);
    pane.addEventListener("pointercancel", drop);
    pane.addEventListener(
      "wheel",
      (event) => {
        // The page scrolls, unless the picture was chosen.
        if (!event.ctrlKey && document.activeElement !== pane) return;
        event.preventDefault();
        zoom(event.deltaY < 0 ? 1.25 : 0.8, ...pointed(pane, event));
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

  const swap = () => {
    if (chosen("way").value !== "blink") input("way", "blink").checked = true;
    viewer.toggleAttribute("data-swapped");
    fill();
  };

  const next = (name, step) => {
    const all = [...viewer.querySelectorAll(`[name=${name}]:not(:disabled)`)];
    const now = all.indexOf(chosen(name));
    all[(now + step + all.length) % all.length].checked = true;
    fill();
  };

  // The worst place of a bound: truth, output and the error that was searched, the last as bright as it is there.
  const crop = async (figure) => {
    const { x, y, map } = figure.dataset;
    const canvases = [...figure.querySelectorAll("canvas")];
    const [columns, rows] = [canvases[0].width, canvases[0].height];
    const start = (middle, size, all) => Math.min(all - size, Math.max(0, middle - Math.floor(size / 2)));
    const [left, top] = [start(Number(x), columns, width), start(Number(y), rows, height)];
    const [truth, output, error] = await Promise.all([painter("truth"), painter("output"), planes([Number(map)])]);
    let most = Number.MIN_VALUE;
    for (let row = top; row < top + rows; row++) {
      for (let column = left; column < left + columns; column++) most = Math.max(most, error[0][row * width + column]);
    }
    [truth, output, painters.share(error, { most })].forEach((color, at) => paint(canvases[at], color, width, left, top));
  };

  const legend = async () => {
    const canvas = viewer.querySelector(".wheel");
    const middle = (canvas.width - 1) / 2;
    const color = (at) => {
      const [x, y] = [(at % canvas.width) / middle - 1, Math.floor(at / canvas.width) / middle - 1];
      const speed = Math.hypot(x, y);
      // Strength grows evenly from the middle.
      return speed > 1 ? motion(0, 0, 1) : motion(x * speed, y * speed, 1);
    };
    paint(canvas, color, canvas.width);
    const fastest = speedOf(await planes(layers.velocity));
    viewer.querySelector(".fastest").textContent = fastest.toPrecision(3);
    const [depth] = await planes(layers.depth);
    const [near, far] = window.shuttertruth.reachOf(depth);
    viewer.querySelector(".nearest").textContent = near.toPrecision(3);
    viewer.querySelector(".farthest").textContent = far.toPrecision(3);
  };

  const route = () => {
    // While the page loads, no element is the target yet.
    const named = document.getElementById(location.hash.slice(1));
    open = named?.matches("article.case") ? named : null;
    viewer.hidden = !open;
    document.title = open ? `${open.dataset.title} - Shuttertruth` : "Shuttertruth report";
    mark = null;
    if (!open) return;
    const home = open.querySelector(".viewer_place");
    window.shuttertruth.openScene(Number(home.dataset.scene));
    layers = Object.fromEntries(
      home.dataset.layers.split(" ").map((pair) => {
        const [word, numbers] = pair.split(":");
        return [word, numbers.split(",").map(Number)];
      }),
    );
    for (const choice of viewer.querySelectorAll("[name=under]")) {
      choice.disabled = !(choice.value in layers);
      choice.parentElement.hidden = choice.disabled;
      if (choice.disabled && choice.checked) input("under", "output").checked = true;
    }
    for (const line of viewer.querySelectorAll(".line")) line.setAttribute("d", home.dataset.line);
    home.append(viewer);
    fill();
    legend().catch(failed);
    for (const figure of open.querySelectorAll(".crop")) crop(figure).catch(failed);
    if (pixel) window.shuttertruth.read(pixel, layers, false);
  };

  viewer.addEventListener("change", fill);
  split.addEventListener("input", place);
  viewer.querySelector("[data-zoom=in]").addEventListener("click", () => zoom(2));
  viewer.querySelector("[data-zoom=out]").addEventListener("click", () => zoom(0.5));
  viewer.querySelector("[data-zoom=fit]").addEventListener("click", () => look(1, 0, 0));
  for (const button of document.querySelectorAll("button.place")) {
    button.addEventListener("click", () => {
      mark = { x: Number(button.dataset.x), y: Number(button.dataset.y) };
      look(5, mark.x - width / 10, mark.y - height / 10);
      choose(mark.x, mark.y, true);
      viewer.scrollIntoView({ block: "start" });
    });
  }
  new ResizeObserver(place).observe(viewer);
  window.addEventListener("hashchange", () => {
    route();
    if (open) open.querySelector("h2").focus({ preventScroll: true });
    window.scrollTo(0, 0);
  });

  // What keys do while a case is open.
  Object.assign(window.shuttertruth, {
    isOpen: () => open !== null,
    case: () => open,
    way: (word) => {
      input("way", word).checked = true;
      fill();
    },
    swap,
    next,
    zoom,
    slide: (percent) => slide(Number(split.value) + percent),
    fit: () => look(1, 0, 0),
    route,
  });
}
