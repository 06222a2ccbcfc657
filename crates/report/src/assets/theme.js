"use strict";
// Light, dark, or what the system says.
{
  const themes = ["system", "light", "dark"];
  const button = document.getElementById("theme");
  button.addEventListener("click", () => {
    const root = document.documentElement;
    const now = themes.indexOf(root.dataset.theme ?? "system");
    const next = themes[(now + 1) % themes.length];
    root.dataset.theme = next;
    button.textContent = `Theme: ${next}`;
  });
}
