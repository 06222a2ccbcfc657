"use strict";
// The overview: one score at a time, rows that are searched for, settings in the address, and a look at the worst place of a case.
{
  const overview = document.getElementById("overview");
  const panels = [...document.querySelectorAll(".panel")];
  // The page holds every thumbnail once.
  const thumbnails = [...panels[0].querySelectorAll("th.scene img")].map((image) => image.src);
  // A table is text until it is first seen.
  const parse = (panel) => {
    const text = panel.querySelector("noscript");
    if (!text) return;
    text.outerHTML = text.textContent;
    panel.querySelectorAll("th.scene img").forEach((image, at) => (image.src = thumbnails[at]));
  };

  const tools = document.getElementById("tables");
  const tool = (name) => tools.querySelector(`[name=${name}]`);
  const show = () => {
    const metric = tools.querySelector("[name=metric]:checked").value;
    const words = tool("search").value.toLowerCase();
    const isHidden = (row) =>
      (row.classList.contains("reference") && !tool("references").checked) ||
      (tool("failing")?.checked && !("failing" in row.dataset)) ||
      !row.cells[0].textContent.toLowerCase().includes(words);
    for (const panel of panels) {
      panel.hidden = panel.dataset.metric !== metric;
      if (!panel.hidden) parse(panel);
      for (const group of panel.querySelectorAll("tbody:not(.group)")) {
        for (const row of group.rows) row.hidden = isHidden(row);
        const heading = group.previousElementSibling;
        if (heading.matches(".group")) heading.hidden = [...group.rows].every((row) => row.hidden);
      }
    }
    document.querySelector(".nothing").hidden = panels[0].querySelector("tbody:not(.group) tr:not([hidden])") !== null;
  };
  // Paper shows all tables.
  window.addEventListener("beforeprint", () => {
    panels.forEach(parse);
    show();
  });
  const pictures = window.shuttertruth;
  tools.addEventListener("input", () => {
    show();
    pictures.note();
  });

  // What an address names: the score, the words that are searched for, and what is ticked. An address without any keeps what there is.
  const boxes = ["failing", "references"];
  const usual = panels[0].dataset.metric;
  const showTables = (settings) => {
    if (Object.keys(settings).length > 0) {
      const metric = settings.metric ?? usual;
      const button = tools.querySelector(`[name=metric][value="${CSS.escape(metric)}"]`);
      (button ?? tool("metric")).checked = true;
      tool("search").value = settings.search ?? "";
      for (const name of boxes) if (tool(name)) tool(name).checked = name in settings;
    }
    show();
  };
  const tableSettings = () => {
    const metric = tools.querySelector("[name=metric]:checked").value;
    const ticked = boxes.filter((name) => tool(name)?.checked).map((name) => [name, "1"]);
    const all = [["metric", metric === usual ? "" : metric], ["search", tool("search").value], ...ticked];
    return all.filter(([, value]) => value);
  };
  Object.assign(pictures, { thumbnails, showTables, tableSettings });

  // Score, truth, output and error around the worst place of the case that is pointed at.
  const peek = document.querySelector(".peek");
  const width = Number(document.getElementById("viewer").dataset.width);
  const height = Number(document.getElementById("viewer").dataset.height);
  let asked = 0;
  const look = async (link) => {
    asked += 1;
    const mine = asked;
    const { scene, stops, worst } = document.getElementById(link.hash.slice(1)).querySelector(".viewer_place").dataset;
    pictures.openScene(Number(scene));
    pictures.openCase(document.getElementById(link.hash.slice(1)));
    peek.querySelector("p").textContent = link.textContent.replace(/^[✓✗?~]/, "");
    const canvases = [...peek.querySelectorAll("canvas")];
    const [x, y] = worst.split(",").map(Number);
    const start = (middle, size, all) => Math.max(0, Math.min(all - size, middle - size / 2));
    for (const canvas of canvases) Object.assign(canvas, { width: Math.min(48, width), height: Math.min(48, height) });
    const [left, top] = [start(x, canvases[0].width, width), start(y, canvases[0].height, height)];
    const colors = await Promise.all(
      ["truth", "output", "flip"].map((word) => pictures.painterOf(pictures.find(word), Number(stops))),
    );
    if (mine !== asked) return;
    colors.forEach((color, at) => pictures.paint(canvases[at], color, width, left, top));
    peek.hidden = false;
    const [own, box] = [link.getBoundingClientRect(), peek.getBoundingClientRect()];
    peek.style.left = `${Math.max(0, Math.min(own.left, innerWidth - box.width - 8))}px`;
    peek.style.top = `${own.bottom + box.height + 8 < innerHeight ? own.bottom + 4 : own.top - box.height - 4}px`;
  };
  const leave = () => {
    asked += 1;
    peek.hidden = true;
  };
  for (const kind of ["pointerover", "focusin"]) {
    overview.addEventListener(kind, (event) => {
      const link = event.target.closest("a.case");
      if (link && !link.contains(event.relatedTarget)) look(link).catch(leave);
    });
  }
  for (const kind of ["pointerout", "focusout", "click"]) {
    overview.addEventListener(kind, (event) => {
      const link = event.target.closest("a.case");
      if (link && !link.contains(event.relatedTarget)) leave();
    });
  }
}
