"use strict";
// The pictures of the case that is open. All of them zoom and move together.
{
  // Largest magnification.
  const MOST = 32;
  // Side of the blocks that the worst place is looked for in, in pixels.
  const BLOCK = Number(document.getElementById("viewer").dataset.block);
  const pictures = JSON.parse(document.getElementById("pictures").textContent);
  const viewer = document.getElementById("viewer");
  const [width, height, band] = ["width", "height", "band"].map((name) => Number(viewer.dataset[name]));
  const stack = viewer.querySelector(".stack");
  const panes = [...viewer.querySelectorAll(".pane")];
  const singles = [...viewer.querySelectorAll(".single")];
  const split = viewer.querySelector("[name=split]");
  const readout = viewer.querySelector(".readout");
  const maps = ["flip", "label_tv", "bleed", "velocity"];

  // What is in view: `x` and `y` of the upper left corner in pixels of the picture.
  const view = { zoom: 1, x: 0, y: 0 };
  let mark = null;
  let open = null;
  let layers = {};

  const input = (name, value) => viewer.querySelector(`[name=${name}][value=${value}]`);
  const chosen = (name) => viewer.querySelector(`[name=${name}]:checked`);
  const titled = (word) => input("under", word).parentElement.textContent.trim();

  // Which picture lies where.
  const placed = () => {
    const under = chosen("under").value;
    return {
      over: chosen("over").value,
      under,
      instant: "instant",
      truth: "truth",
      output: "output",
      map: maps.includes(under) ? under : "flip",
    };
  };

  const fill = () => {
    if (!open) return;
    const way = chosen("way").value;
    viewer.dataset.way = way;
    stack.hidden = way === "side";
    for (const single of singles) single.hidden = way !== "side";
    const places = placed();
    for (const [place, word] of Object.entries(places)) {
      const image = viewer.querySelector(`[data-place=${place}] img`);
      const tag = viewer.querySelector(`[data-tag=${place}]`);
      image.src = pictures[layers[word]];
      image.alt = `${titled(word)}, ${open.dataset.title}`;
      image.classList.toggle("banded", "banded" in input("under", word).dataset);
      tag.textContent = titled(word);
    }
    const swapped = "swapped" in viewer.dataset;
    if (way === "blink") {
      viewer.querySelector("[data-tag=over]").textContent = titled(swapped ? places.under : places.over);
    }
    const shown = way === "blink" && !swapped ? places.over : places.under;
    const hint = input("under", way === "side" ? places.map : shown).dataset.hint;
    viewer.querySelector(".hint").textContent = `${titled(way === "side" ? places.map : shown)}: ${hint}.`;
    draw();
  };

  const draw = () => {
    stack.style.setProperty("--split", `${split.value}%`);
    for (const pane of panes) {
      const scale = (pane.clientWidth / width) * view.zoom;
      for (const layer of pane.querySelectorAll(".layer")) {
        layer.style.transform = `scale(${scale}) translate(${-view.x}px, ${-view.y}px)`;
      }
      const frame = pane.querySelector(".mark");
      frame.hidden = mark === null;
      if (mark) {
        const side = `${BLOCK * scale}px`;
        const left = `${(mark.x - BLOCK / 2 - view.x) * scale}px`;
        const top = `${(mark.y - BLOCK / 2 - view.y) * scale}px`;
        Object.assign(frame.style, { left, top, width: side, height: side });
      }
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
    draw();
  };

  const move = (columns, rows) => look(view.zoom, view.x + columns / view.zoom, view.y + rows / view.zoom);

  const pixel = (pane, event) => {
    const box = pane.getBoundingClientRect();
    const scale = (box.width / width) * view.zoom;
    return [view.x + (event.clientX - box.left) / scale, view.y + (event.clientY - box.top) / scale];
  };

  const slide = (pane, event) => {
    const box = pane.getBoundingClientRect();
    const part = (event.clientX - box.left) / box.width;
    split.value = 100 * Math.min(1, Math.max(0, part));
    draw();
  };

  for (const pane of panes) {
    let drag = null;
    pane.addEventListener("pointerdown", (event) => {
      const box = pane.getBoundingClientRect();
      const away = Math.abs(event.clientX - box.left - (box.width * split.value) / 100);
      const divides = viewer.dataset.way === "slide" && (view.zoom === 1 || away < 16);
      drag = { divides, from: pixel(pane, event) };
      pane.setPointerCapture(event.pointerId);
      if (divides) slide(pane, event);
    });
    pane.addEventListener("pointermove", (event) => {
      const [x, y] = pixel(pane, event);
      readout.textContent = `x ${Math.floor(x)}, y ${Math.floor(y)}`;
      if (!drag) return;
      if (drag.divides) slide(pane, event);
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
        zoom(event.deltaY < 0 ? 1.25 : 0.8, ...pixel(pane, event));
      },
      { passive: false },
    );
    pane.addEventListener("keydown", (event) => {
      const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      const way = ways[event.key];
      if (event.key === "PageUp") zoom(2);
      else if (event.key === "PageDown") zoom(0.5);
      else if (way && view.zoom > 1) move((way[0] * width) / 10, (way[1] * height) / 10);
      else if (way && way[0] && pane === stack) {
        split.value = Number(split.value) + 2 * way[0];
        draw();
      } else return;
      event.preventDefault();
    });
  }

  const swap = () => {
    if (chosen("way").value !== "blink") input("way", "blink").checked = true;
    viewer.toggleAttribute("data-swapped");
    fill();
  };

  const next = (name, step) => {
    const all = [...viewer.querySelectorAll(`[name=${name}]`)];
    const now = all.indexOf(chosen(name));
    all[(now + step + all.length) % all.length].checked = true;
    fill();
  };

  const route = () => {
    // While the page loads, no element is the target yet.
    const named = document.getElementById(location.hash.slice(1));
    open = named?.matches("article.case") ? named : null;
    viewer.hidden = !open;
    document.title = open ? `${open.dataset.title} - Shuttertruth` : "Shuttertruth report";
    mark = null;
    if (!open) return;
    const place = open.querySelector(".viewer_place");
    layers = Object.fromEntries(place.dataset.layers.split(" ").map((pair) => pair.split(":")));
    place.append(viewer);
    for (const image of open.querySelectorAll("[data-picture]")) image.src = pictures[image.dataset.picture];
    fill();
  };

  viewer.addEventListener("change", fill);
  split.addEventListener("input", draw);
  viewer.querySelector("[data-zoom=in]").addEventListener("click", () => zoom(2));
  viewer.querySelector("[data-zoom=out]").addEventListener("click", () => zoom(0.5));
  viewer.querySelector("[data-zoom=fit]").addEventListener("click", () => look(1, 0, 0));
  for (const button of document.querySelectorAll("button.place")) {
    button.addEventListener("click", () => {
      mark = { x: Number(button.dataset.x), y: Number(button.dataset.y) };
      look(5, mark.x - width / 10, mark.y - height / 10);
      viewer.scrollIntoView({ block: "start" });
    });
  }
  new ResizeObserver(draw).observe(viewer);
  window.addEventListener("hashchange", () => {
    route();
    if (open) open.querySelector("h2").focus({ preventScroll: true });
    window.scrollTo(0, 0);
  });
  route();

  // What keys do while a case is open.
  window.shuttertruth = {
    isOpen: () => open !== null,
    case: () => open,
    way: (word) => {
      input("way", word).checked = true;
      fill();
    },
    swap,
    next,
    zoom,
    fit: () => look(1, 0, 0),
  };
}
