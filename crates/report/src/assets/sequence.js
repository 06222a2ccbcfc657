"use strict";
// Plays the pictures of a sequence in step.
{
  const sequences = JSON.parse(document.getElementById("sequences").textContent);
  const choice = document.getElementById("sequence");
  const play = document.getElementById("play");
  const readout = document.getElementById("readout");
  const rates = [...document.querySelectorAll("input[name=rate]")];
  const names = ["instant", "truth", "output", "error", "change"];
  const shown = Object.fromEntries(names.map((name) => [name, document.getElementById(`picture_${name}`)]));
  const address = (path) => path.split("/").map(encodeURIComponent).join("/");
  let frame = 0;
  let began = null;
  let first = 0;
  let loaded = [];
  const frames = () => sequences[choice.value].frames;
  const rate = () => Number(rates.find((own) => own.checked).value);

  // Pictures are loaded before they are played, so that none is late.
  const load = () => {
    loaded = frames().map((own) => Object.fromEntries(names.map((name) => {
      const picture = new Image();
      if (own[name]) picture.src = address(own[name]);
      return [name, picture];
    })));
    show(Math.min(frame, frames().length - 1));
  };
  const show = (next) => {
    frame = (next + frames().length) % frames().length;
    const own = frames()[frame];
    for (const name of names) {
      shown[name].hidden = !own[name];
      if (own[name]) shown[name].src = loaded[frame][name].src;
    }
    const number = (value) => (value === null ? "none" : value.toFixed(1));
    readout.textContent = `frame ${frame} of ${frames().length - 1}; error ${number(own.mse)}, flicker along the motion ${number(own.flicker)}`;
    document.body.dataset.frame = frame;
  };
  const stop = () => {
    began = null;
    play.textContent = "Play";
  };
  const tick = (now) => {
    if (began === null) return;
    const next = (first + Math.floor((now - began) * rate() / 1000)) % frames().length;
    if (next !== frame) show(next);
    requestAnimationFrame(tick);
  };
  const start = () => {
    first = frame;
    began = performance.now();
    play.textContent = "Stop";
    requestAnimationFrame(tick);
  };
  const toggle = () => (began === null ? start() : stop());
  const step = (by) => {
    stop();
    show(frame + by);
  };
  const choose = (by) => {
    choice.value = (Number(choice.value) + by + sequences.length) % sequences.length;
    load();
  };
  const setRate = (index) => {
    if (!rates[index]) return;
    rates[index].checked = true;
    if (began !== null) start();
  };
  const actions = {
    " ": toggle,
    ",": () => step(-1),
    ".": () => step(1),
    "[": () => choose(-1),
    "]": () => choose(1),
    1: () => setRate(0),
    2: () => setRate(1),
    3: () => setRate(2),
    4: () => setRate(3),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !actions[event.key]) return;
    if (event.key === " " && event.target.matches("button, select")) return;
    actions[event.key]();
    event.preventDefault();
  });
  play.addEventListener("click", toggle);
  document.getElementById("back").addEventListener("click", () => step(-1));
  document.getElementById("on").addEventListener("click", () => step(1));
  choice.addEventListener("change", load);
  for (const own of rates) own.addEventListener("change", () => began !== null && start());
  const follow = () => {
    const index = Number(location.hash.slice(1));
    if (sequences[index]) choice.value = index;
    load();
  };
  addEventListener("hashchange", follow);
  follow();
}
