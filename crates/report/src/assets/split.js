"use strict";
// The first run's picture lies left of the divider, the second one's right of it.
for (const pair of document.querySelectorAll(".pair")) {
  const slider = pair.parentElement.querySelector("input");
  slider.addEventListener("input", () => pair.style.setProperty("--split", `${slider.value}%`));
}
