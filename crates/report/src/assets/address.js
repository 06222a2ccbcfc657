"use strict";
// The address: `#railing/bevy:high&right=jimenez:hdrp&zoom=6&at=80,45` opens that case with these settings, and
// `#overview&metric=psnr_moving&search=bevy` the tables.
{
  const pictures = window.shuttertruth;
  let noted = null;

  // The section that is named, and the settings behind its name.
  const parse = () => {
    const [name, ...rest] = location.hash.slice(1).split("&");
    return [document.getElementById(decodeURIComponent(name)), Object.fromEntries(new URLSearchParams(rest.join("&")))];
  };

  // Parses the parts of a section that are text until somebody opens it.
  const parseParts = (section) => {
    for (const part of section.querySelectorAll("noscript")) part.outerHTML = part.textContent;
    for (const image of section.querySelectorAll("[data-thumbnail]")) image.src = pictures.thumbnails[image.dataset.thumbnail];
  };

  const named = () => {
    const [one, settings] = parse();
    return [one?.matches("article") ? one : null, settings];
  };

  const route = () => {
    const [section, settings] = named();
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

  window.addEventListener("hashchange", () => {
    const section = route();
    section?.querySelector("h2").focus({ preventScroll: true });
    window.scrollTo(0, 0);
  });
  document.documentElement.classList.add("scripted");
  route();
}
