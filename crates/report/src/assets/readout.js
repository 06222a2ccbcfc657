"use strict";
// The numbers of one pixel, in all pictures of the case.
{
  const table = document.querySelector("#viewer .readout");
  const spoken = document.querySelector("#viewer .spoken");
  const { planes, FAR } = window.shuttertruth;
  const width = Number(document.getElementById("viewer").dataset.width);
  // Counts what was asked for: what arrives late is not shown over what came after.
  let asked = 0;

  // A half has three digits that count.
  const written = (value) => (Number.isFinite(value) ? String(Number(value.toPrecision(3))) : String(value));

  const numbers = (row, own, at) => {
    if (row.dataset.layer === "signed") return [0, 1, 2].map((c) => Math.fround(own[c][at] - own[c + 3][at]));
    return own.map((plane) => plane[at]);
  };

  const read = async (pixel, layers, aloud) => {
    asked += 1;
    const mine = asked;
    const at = pixel.y * width + pixel.x;
    const home = window.shuttertruth.case().querySelector(".viewer_place");
    const names = JSON.parse(home.dataset.names);
    const [ids] = await planes(layers.objects);
    const words = [];
    for (const row of table.querySelectorAll("[data-layer]")) {
      const own = layers[row.dataset.layer];
      row.hidden = !own;
      if (!own) continue;
      const values = numbers(row, await planes(own), at);
      if (mine !== asked) return;
      const text = values.map((value) => (row.dataset.layer === "depth" && value >= FAR ? "no surface" : written(value)));
      const cells = [...row.querySelectorAll("td")];
      cells.forEach((cell, index) => (cell.textContent = text[index] ?? ""));
      words.push(`${row.querySelector("th").textContent} ${text.join(" ")}`);
    }
    if (mine !== asked) return;
    const place = `x ${pixel.x}, y ${pixel.y}, ${names[ids[at]]}`;
    table.querySelector("caption span").textContent = place;
    table.dataset.pixel = `${pixel.x},${pixel.y}`;
    if (aloud) spoken.textContent = `${place}; ${words.slice(0, 4).join("; ")}`;
  };

  window.shuttertruth.read = (...words) => {
    read(...words).catch((error) => (table.querySelector("caption span").textContent = error.message));
  };
  window.shuttertruth.route();
}
