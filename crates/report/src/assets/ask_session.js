"use strict";
// Draws the pairs of a session from its seed, as `draw_session` in crates/suite/src/people/design.rs does; a test compares both.
// A clip is the number of its filter, or one of these.
const TRUTH = -1;
const SHARP = -2;

// SplitMix64 (Steele, Lea and Flood 2014).
function makeRandom(seed) {
  let state = BigInt(seed);
  const wrap = (value) => BigInt.asUintN(64, value);
  const bits = () => {
    state = wrap(state + 0x9e3779b97f4a7c15n);
    let value = state;
    value = wrap((value ^ (value >> 30n)) * 0xbf58476d1ce4e5b9n);
    value = wrap((value ^ (value >> 27n)) * 0x94d049bb133111ebn);
    return value ^ (value >> 31n);
  };
  return (count) => Number((bits() * BigInt(count)) >> 64n);
}

function drawSession(study, question, seed) {
  const below = makeRandom(seed);
  const shuffle = (list) => {
    for (let last = list.length - 1; last >= 1; last--) {
      const other = below(last + 1);
      [list[last], list[other]] = [list[other], list[last]];
    }
    return list;
  };
  const order = (count) => shuffle([...Array(count).keys()]);
  const counts = study.shutters.map((shutter) => shutter.filters.length);
  const circles = counts.map((count) => study.scenes.map(() => order(count)));
  const roundSize = (count, distance) => (2 * distance === count ? distance : count);

  const drawRounds = () => {
    const rounds = [];
    let pairs = 0;
    for (let distance = 1; distance <= Math.floor(Math.max(...counts) / 2); distance++) {
      for (const scene of order(study.scenes.length)) {
        for (const [shutter, count] of counts.entries()) {
          if (2 * distance > count) continue;
          pairs += roundSize(count, distance);
          if (pairs > study.most_pairs) return rounds;
          rounds.push({ distance, scene, shutter });
        }
      }
    }
    return rounds;
  };
  const pairs = [];
  for (const { distance, scene, shutter } of drawRounds()) {
    const circle = circles[shutter][scene];
    for (let place = 0; place < roundSize(circle.length, distance); place++) {
      pairs.push({ shutter, scene, left: circle[place], right: circle[(place + distance) % circle.length] });
    }
  }
  const drawCheck = (index) => {
    const shutter = below(study.shutters.length);
    const telling = study.shutters[shutter].telling_scenes;
    if (question === "truth" && index % 2 === 0) {
      return { shutter, scene: telling[below(telling.length)], left: TRUTH, right: SHARP };
    }
    const scene = below(study.scenes.length);
    const clip = below(counts[shutter]);
    return { shutter, scene, left: clip, right: clip };
  };
  const checks = Math.max(Math.ceil(pairs.length / 8), 2);
  for (let index = 0; index < checks; index++) pairs.push(drawCheck(index));
  shuffle(pairs);
  for (const pair of pairs) {
    if (below(2) === 1) [pair.left, pair.right] = [pair.right, pair.left];
  }
  return pairs;
}

// Names of what a pair shows, as the file of answers has them.
function namePair(study, pair) {
  const shutter = study.shutters[pair.shutter];
  const name = (clip) => (clip === TRUTH ? "[truth]" : clip === SHARP ? "[sharp frame]" : shutter.filters[clip]);
  return {
    scene: study.scenes[pair.scene],
    alignment: shutter.alignment,
    left: name(pair.left),
    right: name(pair.right),
  };
}
