"use strict";
// The numbers of one pixel: of the two pictures beside the pointer, of all pictures in the table.
{
  const pictures = window.shuttertruth;
  const { planes, FAR } = pictures;
  const viewer = document.getElementById("viewer");
  const table = viewer.querySelector(".readout");
  const spoken = viewer.querySelector(".spoken");
  const tip = viewer.querySelector(".tip");
  const width = Number(viewer.dataset.width);
  // Counts requests: what arrives late is not shown over what came after.
  let asked = 0;

  // A half has three digits that count.
  const write = (value) => (Number.isFinite(value) ? String(Number(value.toPrecision(3))) : String(value));

  const textsOf = async (painter, numbers, at) => {
    const own = (await planes(numbers)).map((plane) => plane[at]);
    const values = painter === "signed" ? [0, 1, 2].map((c) => own[c] - own[c + 3]) : own;
    return values.map((value) => (painter === "distance" && value >= FAR ? "no surface" : write(value)));
  };

  const read = async (pixel, { left, right }, aloud) => {
    asked += 1;
    const mine = asked;
    const at = pixel.y * width + pixel.x;
    const own = pictures.own();
    // Two pictures alone do not say which objects they show.
    const names = JSON.parse(pictures.section().querySelector(".viewer_place").dataset.names ?? "[]");
    const [ids] = own.objects ? await planes(own.objects) : [];
    const words = [];
    const cells = [];
    for (const row of table.querySelectorAll("[data-layer]")) {
      const word = row.dataset.layer;
      row.hidden = !own[word];
      if (!own[word]) continue;
      const texts = await textsOf(pictures.layers[word].painter, own[word], at);
      cells.push([row, texts]);
      words.push(`${row.querySelector("th").textContent} ${texts.join(" ")}`);
    }
    const sides = await Promise.all([left, right].map((picture) => textsOf(picture.painter, picture.planes, at)));
    const [flip] = await textsOf("share", own.flip, at);
    if (mine !== asked) return;
    for (const [row, texts] of cells) [...row.querySelectorAll("td")].forEach((cell, c) => (cell.textContent = texts[c] ?? ""));
    const place = `x ${pixel.x}, y ${pixel.y}${ids ? `, ${names[ids[at]]}` : ""}`;
    table.querySelector("caption span").textContent = place;
    table.dataset.pixel = `${pixel.x},${pixel.y}`;
    tip.textContent = [place, `${left.title}: ${sides[0].join(" ")}`, `${right.title}: ${sides[1].join(" ")}`, `FLIP: ${flip}`].join("\n");
    if (aloud) spoken.textContent = `${place}; ${words.slice(0, 4).join("; ")}`;
  };

  pictures.read = (...words) => {
    read(...words).catch((error) => (table.querySelector("caption span").textContent = error.message));
  };

  // Moves the numbers beside the pointer, to its other side where there is no room; none hides them.
  pictures.floatTip = (event) => {
    tip.hidden = event === null || event.pointerType === "touch";
    if (tip.hidden) return;
    const box = tip.getBoundingClientRect();
    const beside = (at, size, room) => (at + 18 + size < room ? at + 18 : at - 18 - size);
    tip.style.left = `${Math.max(0, beside(event.clientX, box.width, innerWidth))}px`;
    tip.style.top = `${Math.max(0, beside(event.clientY, box.height, innerHeight))}px`;
  };
}
