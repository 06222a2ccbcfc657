"use strict";
// Asks the questions of a session, keeps the answers, and saves them to a file.
{
  const data = JSON.parse(document.getElementById("data").textContent);
  const { study } = data;
  const texts = Object.fromEntries(data.questions);
  const at = (id) => document.getElementById(id);
  const clips = makeClips(data);
  const place = `shuttertruth ${data.id}`;
  // No answer counts before this time: a key that is pressed twice answers one question.
  const LOCK_MILLISECONDS = 250;
  let session = null;
  let pairs = [];
  let shown = 0;
  let zoom = 0;
  let asked = 0;
  let isAsking = false;

  const keep = () => {
    try {
      if (session) localStorage.setItem(place, JSON.stringify(session));
      else localStorage.removeItem(place);
      at("kept").textContent = "The answers are kept in this browser: closing or reloading the page does not lose them.";
    } catch {
      at("kept").textContent = "This browser keeps nothing for this page: save the answers before you close or reload it.";
    }
  };
  const recall = () => {
    try {
      const kept = JSON.parse(localStorage.getItem(place));
      return kept && texts[kept.question] && Number.isSafeInteger(kept.seed) && Array.isArray(kept.answers) ? kept : null;
    } catch {
      return null;
    }
  };
  const drawSeed = () => {
    const [high, low] = crypto.getRandomValues(new Uint32Array(2));
    return (high & 0x1fffff) * 2 ** 32 + low;
  };

  const open = (id, focused) => {
    for (const section of ["start", "asking", "end"]) at(section).hidden = section !== id;
    document.body.classList.toggle("asking", id === "asking");
    at(focused)?.focus();
  };
  const fit = () => {
    if (!isAsking) return;
    const found = clips.fit(session.question === "truth");
    zoom = found.zoom;
    at("misfit").hidden = zoom > 0;
    at("misfit").textContent =
      `This window is too small: the pictures need ${found.needed.join(" x ")} pixels of the display, and have ` +
      `${found.room.join(" x ")}. Make the window larger.`;
  };

  const ask = async () => {
    const index = session.answers.length;
    if (index >= pairs.length) return finish();
    const token = ++asked;
    shown = 0;
    document.body.dataset.ready = "false";
    document.body.dataset.asked = index;
    at("progress").textContent = `question ${index + 1} of ${pairs.length}`;
    try {
      await clips.show(pairs[index], pairs[index + 1], session.question === "truth");
    } catch (error) {
      at("progress").textContent = "A picture beside this page cannot be loaded: copy the whole folder, and open the page again.";
      return;
    }
    if (token !== asked || !isAsking) return clips.blank();
    shown = performance.now();
    setTimeout(() => {
      if (token === asked) document.body.dataset.ready = "true";
    }, LOCK_MILLISECONDS);
  };
  const answer = (choice) => {
    const elapsed = performance.now() - shown;
    if (!isAsking || !shown || zoom === 0 || elapsed < LOCK_MILLISECONDS) return;
    const pair = namePair(study, pairs[session.answers.length]);
    session.answers.push({ ...pair, choice, milliseconds: Math.round(elapsed), zoom });
    keep();
    ask();
  };
  const goOn = () => {
    pairs = drawSession(study, session.question, session.seed);
    isAsking = true;
    at("words").textContent = texts[session.question];
    open("asking", "words");
    at("truth").hidden = session.question !== "truth";
    fit();
    ask();
  };
  const finish = () => {
    isAsking = false;
    asked++;
    clips.blank();
    pairs = drawSession(study, session.question, session.seed);
    const count = session.answers.length;
    const isDone = count >= pairs.length;
    at("verdict").textContent = isDone ? "Thank you" : "Stopped";
    at("given").textContent = `“${texts[session.question]}” ${count} of ${pairs.length} questions are answered.`;
    at("resume").hidden = isDone;
    at("save").disabled = count === 0;
    keep();
    open("end", "verdict");
  };
  const begin = () => {
    const question = document.querySelector("input[name=question]:checked").value;
    session = { question, seed: drawSeed(), answers: [] };
    keep();
    goOn();
  };
  const save = () => {
    const file = {
      format: 1,
      program: data.program,
      study,
      question: session.question,
      seed: session.seed,
      display: { device_pixel_ratio: devicePixelRatio, viewport: [innerWidth, innerHeight] },
      answers: session.answers,
    };
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([JSON.stringify(file, null, 1)], { type: "application/json" }));
    link.download = `answers_${session.seed}.json`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  };
  const forget = () => {
    if (!confirm("Delete the answers in this browser? A saved file stays.")) return;
    session = null;
    keep();
    open("start", "begin");
  };

  const actions = {
    ArrowLeft: () => answer("left"),
    ArrowRight: () => answer("right"),
    ArrowDown: () => answer("neither"),
    r: () => clips.play(),
    R: () => clips.play(),
    Escape: finish,
  };
  addEventListener("keydown", (event) => {
    if (!isAsking || event.ctrlKey || event.altKey || event.metaKey || !actions[event.key]) return;
    if (!event.repeat) actions[event.key]();
    event.preventDefault();
  });
  for (const button of document.querySelectorAll("button[data-choice]")) {
    button.addEventListener("click", () => answer(button.dataset.choice));
  }
  at("replay").addEventListener("click", () => clips.play());
  at("stop").addEventListener("click", finish);
  at("begin").addEventListener("click", begin);
  at("resume").addEventListener("click", goOn);
  at("save").addEventListener("click", save);
  at("fresh").addEventListener("click", forget);
  addEventListener("resize", fit);

  session = recall();
  if (session) finish();
}
