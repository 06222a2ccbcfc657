"use strict";
// The address: `#railing/bevy:high&right=jimenez:hdrp&zoom=6&at=80,45` opens that case with these settings, and
// `#overview&metric=psnr_moving&search=bevy` the tables.
{
  const pictures = window.shuttertruth;
  let noted = null;
  // By the scene's number, the tables of its cases, where they lie beside the page.
  const tables = new Map();

  // The section that is named, and the settings behind its name.
  const parse = () => {
    const [name, ...rest] = location.hash.slice(1).split("&");
    return [document.getElementById(decodeURIComponent(name)), Object.fromEntries(new URLSearchParams(rest.join("&")))];
  };

  // Puts the tables of a case into their places, from the file beside the page that holds those of its scene.
  const loadTables = async (section) => {
    const { scene } = section.querySelector(".viewer_place").dataset;
    if (!tables.has(scene)) tables.set(scene, pictures.load(`tables_${scene}`));
    const [head, rest] = section.querySelectorAll(".part");
    try {
      const texts = (await tables.get(scene))[section.id];
      [head.outerHTML, rest.outerHTML] = texts ?? fail(`tables_${scene}.js is of another run: write the report again`);
    } catch (error) {
      head.replaceChildren(element("h2", section.dataset.title), element("p", error.message));
      head.className = rest.className = "";
      head.firstChild.tabIndex = -1;
    }
  };
  const fail = (reason) => {
    throw new Error(reason);
  };
  const element = (kind, text) => Object.assign(document.createElement(kind), { textContent: text });

  // Parses the parts of a section that are text until somebody opens it.
  const parseParts = (section) => {
    for (const part of section.querySelectorAll("noscript")) part.outerHTML = part.textContent;
    for (const image of section.querySelectorAll("[data-thumbnail]")) image.src = pictures.thumbnails[image.dataset.thumbnail];
  };

  const named = () => {
    const [one, settings] = parse();
    return [one?.matches("article") ? one : null, settings];
  };

  const route = async () => {
    const [section, settings] = named();
    if (section?.querySelector(".part")) {
      await loadTables(section);
      // Somebody went on meanwhile.
      if (section !== named()[0]) return null;
    }
    for (const one of document.querySelectorAll("article.open")) one.classList.remove("open");
    if (section) parseParts(section);
    section?.classList.add("open");
    document.title = section ? `${section.dataset.title} - Shuttertruth` : "Shuttertruth report";
    pictures.show(section?.matches(".case") ? section : null, settings);
    if (!section) {
      pictures.showTables(settings);
      pictures.note();
    }
    return section;
  };

  // Writes the settings into the address, a moment after the last change.
  pictures.note = () => {
    clearTimeout(noted);
    noted = setTimeout(() => {
      const section = document.querySelector("article.open");
      // The address may name another section that is about to open: a click, a moment after a change, is not lost.
      if (section !== named()[0] || (section && !pictures.isOpen())) return;
      const settings = section ? pictures.settings() : pictures.tableSettings();
      if (!section && !location.hash && settings.length === 0) return;
      const escaped = (value) => value.replace(/[%&+#\s]/g, encodeURIComponent);
      const words = [section?.id ?? "overview", ...settings.map(([name, value]) => `${name}=${escaped(value)}`)];
      const hash = `#${words.join("&")}`;
      if (location.hash !== hash) history.replaceState(null, "", hash);
    }, 200);
  };

  window.addEventListener("hashchange", async () => {
    const section = await route();
    section?.querySelector("h2").focus({ preventScroll: true });
    window.scrollTo(0, 0);
  });
  document.documentElement.classList.add("scripted");
  route();
}
