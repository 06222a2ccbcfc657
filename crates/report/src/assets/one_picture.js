"use strict";
// A page of one picture and its reference: they are open from the start.
{
  const pictures = window.shuttertruth;
  const section = document.querySelector("article.case");
  pictures.note = () => {};
  document.documentElement.classList.add("scripted");
  section.classList.add("open");
  pictures.show(section);
}
