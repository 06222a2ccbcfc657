"use strict";
// Everything by the keyboard.
{
  const pictures = window.shuttertruth;
  const dialog = document.getElementById("keys");
  const actions = {
    1: () => pictures.setMode("slide"),
    2: () => pictures.setMode("blink"),
    3: () => pictures.setMode("onion"),
    4: () => pictures.setMode("side"),
    5: () => pictures.setMode("difference"),
    b: () => pictures.blink(),
    x: () => pictures.exchange(),
    a: () => pictures.next("left", 1),
    A: () => pictures.next("left", -1),
    m: () => pictures.next("right", 1),
    M: () => pictures.next("right", -1),
    e: () => pictures.nextExposure(),
    w: () => pictures.showWorst(),
    "[": () => pictures.slide(-2),
    "]": () => pictures.slide(2),
    "+": () => pictures.zoom(2),
    "=": () => pictures.zoom(2),
    "-": () => pictures.zoom(0.5),
    0: () => pictures.fit(),
  };
  document.addEventListener("keydown", (event) => {
    if (dialog.open || event.ctrlKey || event.altKey || event.metaKey || event.target.matches("input[type=search]")) return;
    if (event.key === "t") document.getElementById("theme").click();
    if (event.key === "?") dialog.showModal();
    const link = document.querySelector(`article.open a[data-key="${CSS.escape(event.key)}"]`);
    if (link) link.click();
    else if (pictures.isOpen() && actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  });
  for (const button of document.querySelectorAll("button.help")) button.addEventListener("click", () => dialog.showModal());
}
