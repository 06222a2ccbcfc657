"use strict";
// Pictures of the case that is open: its own, those of other filters on the scene, and its error maps.
{
  const { painters, planes, speedOf } = window.shuttertruth;
  const layers = JSON.parse(document.getElementById("layers").textContent);
  // By the scene's number, its cases.
  const cases = new Map();
  for (const section of document.querySelectorAll("article.case")) {
    const { scene } = section.querySelector(".viewer_place").dataset;
    cases.set(scene, [...(cases.get(scene) ?? []), section]);
  }
  let open = null;
  let own = {};

  // `truth:3,4,5 flip:9` as an object.
  const planesOf = (section) =>
    Object.fromEntries(
      section.querySelector(".viewer_place").dataset.layers.split(" ").map((pair) => {
        const [word, numbers] = pair.split(":");
        return [word, numbers.split(",").map(Number)];
      }),
    );

  const openCase = (section) => {
    open = section;
    own = planesOf(section);
  };

  const siblings = () => cases.get(open.querySelector(".viewer_place").dataset.scene);

  // Title and hint of a truth that an engine drew.
  const truthWords = () => JSON.parse(open.querySelector(".viewer_place").dataset.truth ?? "{}");

  // A picture by its word: `truth`, `flip`, or a filter, `bevy:high`. None if the case has none of that name.
  const find = (word) => {
    const layer = layers[word];
    const of = (section) => ({ title: section.dataset.filter, score: section.dataset.score });
    if (word === "truth") return own[word] && { ...layer, ...truthWords(), word, planes: own[word] };
    const live = window.shuttertruth.live?.find(word);
    if (layer) return own[word] && { ...layer, word, planes: own[word], ...(word === "output" ? of(open) : {}), ...live };
    const other = siblings().find((section) => section.dataset.name === word);
    return other && { ...layers.output, word, planes: planesOf(other).output, ...of(other) };
  };

  // Groups of a menu: titles, each with the words of its pictures.
  const groups = () => {
    const light = ["truth", "traced_truth", "instant", "output", "live"].filter((word) => own[word]);
    const others = siblings().filter((section) => section !== open);
    const names = (isReference) =>
      others.filter((section) => "reference" in section.dataset === isReference).map((section) => section.dataset.name);
    return [
      ["This case", light],
      ["Other filters", names(false)],
      ["References", names(true)],
      ["Maps of this case", Object.keys(layers).filter((word) => own[word] && !light.includes(word))],
    ].filter(([, words]) => words.length > 0);
  };

  // A function from a pixel's index to the colour of a picture.
  const painterOf = async (picture, stops) => {
    const motions = picture.painter === "motion" ? await planes(own.velocity) : null;
    return painters[picture.painter](await planes(picture.planes), { stops, fastest: motions && speedOf(motions) });
  };

  // The same of the right picture less the left one; both show light.
  const differenceOf = async (left, right, stops) => painters.signed(await planes([...right.planes, ...left.planes]), { stops });

  Object.assign(window.shuttertruth, {
    layers,
    openCase,
    find,
    groups,
    painterOf,
    differenceOf,
    planesOf,
    own: () => own,
    section: () => open,
  });
}
