"use strict";
// The address: `#railing/bevy:high&right=jimenez:hdrp&zoom=6&at=80,45` opens that case with these settings.
{
  const pictures = window.shuttertruth;
  let noted = null;

  // The section that is open, and the settings behind its name.
  const parse = () => {
    const [name, ...rest] = decodeURIComponent(location.hash.slice(1)).split("&");
    return [document.getElementById(name), Object.fromEntries(new URLSearchParams(rest.join("&")))];
  };

  const route = () => {
    const [named, settings] = parse();
    const section = named?.matches("article") ? named : null;
    for (const one of document.querySelectorAll("article.open")) one.classList.remove("open");
    section?.classList.add("open");
    document.title = section ? `${section.dataset.title} - Shuttertruth` : "Shuttertruth report";
    pictures.show(section?.matches(".case") ? section : null, settings);
    return section;
  };

  // Writes the settings into the address, a moment after the last change.
  pictures.note = () => {
    clearTimeout(noted);
    noted = setTimeout(() => {
      if (!pictures.isOpen()) return;
      const words = [pictures.section().id, ...pictures.settings().map(([name, value]) => `${name}=${value}`)];
      const hash = `#${words.join("&")}`;
      if (decodeURIComponent(location.hash) !== hash) history.replaceState(null, "", hash);
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
