"use strict";
// Clips on canvases, all in step, at a whole number of the display's pixels per pixel.
function makeClips(data) {
  const { study } = data;
  const stage = document.getElementById("stage");
  const canvases = [document.getElementById("left"), document.getElementById("right"), document.querySelector("#truth canvas")];
  const loaded = new Map();
  let showing = null;
  let began = 0;
  let drawn = null;

  for (const canvas of canvases) {
    canvas.width = study.width;
    canvas.height = study.height;
  }

  const number = (pair, clip) => {
    const first = pair.scene * data.clips_per_scene;
    return clip === SHARP ? first : first + data.truth_clips[pair.shutter] + (clip === TRUTH ? 0 : 1 + clip);
  };
  const numbers = (pair, withTruth) => [pair.left, pair.right, ...(withTruth ? [TRUTH] : [])].map((clip) => number(pair, clip));
  const loadPicture = async (clip, frame) => {
    const picture = new Image();
    picture.src = `pictures/${clip}_${frame}.png`;
    await picture.decode();
    return picture;
  };
  // Pictures are decoded before they are played, so that none is late.
  const load = (clip) => {
    if (!loaded.has(clip)) {
      const frames = [...Array(study.frames.count).keys()];
      loaded.set(clip, Promise.all(frames.map((frame) => loadPicture(clip, frame))));
    }
    return loaded.get(clip);
  };

  const draw = (now) => {
    if (!showing) return;
    const elapsed = Math.max(0, now - began) / 1000;
    const frame = Math.floor(elapsed * study.frames.per_second) % study.frames.count;
    if (frame !== drawn) {
      showing.forEach((clip, index) => canvases[index].getContext("2d").drawImage(clip[frame], 0, 0));
      drawn = frame;
      document.body.dataset.frame = frame;
    }
    requestAnimationFrame(draw);
  };
  const play = () => {
    began = performance.now();
    drawn = null;
  };
  const blank = () => {
    showing = null;
    for (const canvas of canvases) canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
  };

  return {
    // Shows a pair from its first frame on, and loads the next one meanwhile.
    async show(pair, next, withTruth) {
      blank();
      document.getElementById("truth").hidden = !withTruth;
      const wanted = numbers(pair, withTruth);
      const coming = next ? numbers(next, withTruth) : [];
      for (const clip of loaded.keys()) if (![...wanted, ...coming].includes(clip)) loaded.delete(clip);
      const clips = await Promise.all(wanted.map(load));
      for (const clip of coming) load(clip).catch(() => {});
      await new Promise(requestAnimationFrame);
      const isRunning = showing !== null;
      showing = clips;
      play();
      if (!isRunning) draw(began);
    },
    blank,
    play,
    // Sets the zoom that fits the window; returns it, or 0 where not even 1 does, with the room and what is needed.
    fit(withTruth) {
      const ratio = devicePixelRatio;
      const rows = withTruth ? 2 : 1;
      const section = document.getElementById("asking");
      const captions = rows * 30;
      const others = section.offsetHeight - stage.offsetHeight + captions + 24;
      const room = [(document.documentElement.clientWidth - 48) * ratio, (innerHeight - others) * ratio];
      const needed = [2 * study.width, rows * study.height];
      const zoom = Math.max(0, Math.floor(Math.min(room[0] / needed[0], room[1] / needed[1])));
      stage.hidden = zoom === 0;
      for (const canvas of canvases) {
        canvas.style.width = `${(study.width * zoom) / ratio}px`;
        canvas.style.height = `${(study.height * zoom) / ratio}px`;
      }
      return { zoom, room: room.map(Math.floor), needed };
    },
  };
}
