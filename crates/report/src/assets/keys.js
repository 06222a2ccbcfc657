"use strict";
// Everything by the keyboard.
{
  const pictures = window.shuttertruth;
  const ways = {
    1: () => pictures.way("slide"),
    2: () => pictures.way("blink"),
    3: () => pictures.way("onion"),
    4: () => pictures.way("side"),
    b: () => pictures.swap(),
    a: () => pictures.next("over", 1),
    m: () => pictures.next("under", 1),
    M: () => pictures.next("under", -1),
    e: () => pictures.next("exposure", 1),
    "[": () => pictures.slide(-2),
    "]": () => pictures.slide(2),
    "+": () => pictures.zoom(2),
    "=": () => pictures.zoom(2),
    "-": () => pictures.zoom(0.5),
    0: () => pictures.fit(),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "t") {
      document.getElementById("theme").click();
      return;
    }
    if (!pictures.isOpen()) return;
    const link = pictures.case().querySelector(`a[data-key="${CSS.escape(event.key)}"]`);
    if (link) link.click();
    else if (ways[event.key]) ways[event.key]();
    else return;
    event.preventDefault();
  });
}
