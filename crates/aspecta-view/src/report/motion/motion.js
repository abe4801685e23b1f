// Plays the frames of the page. All that is shown was computed before: a track is a list of whole numbers, its first value
// and the steps from frame to frame, and elements say which tracks move them.
const { frames, clock, tracks } = JSON.parse(document.getElementById("motion").textContent);
for (const track of tracks) for (let k = 1; k < track.length; k++) track[k] += track[k - 1];
const value = (track, k) => tracks[track][Math.min(k, tracks[track].length - 1)];
const pixels = (track, k) => value(track, k) / 100;
const numbers = (text) => text.split(" ").filter(Boolean).map(Number);
const all = (name) => [...document.querySelectorAll(`[data-${name}]`)];
const pairs = (list) => list.flatMap((x, k) => (k % 2 ? [] : [[x, list[k + 1]]]));

const shapes = all("points").map((group) => {
  const [element, points] = [group.firstElementChild, pairs(numbers(group.dataset.points))];
  const at = (k) => points.map(([x, y]) => `${pixels(x, k)} ${pixels(y, k)}`);
  if (element.tagName === "path") {
    const end = element.getAttribute("d").endsWith("Z") ? "Z" : "";
    return (k) => element.setAttribute("d", `M${at(k).join("L")}${end}`);
  }
  const [x, y] = element.tagName === "circle" ? ["cx", "cy"] : ["x", "y"];
  return (k) => {
    element.setAttribute(x, pixels(points[0][0], k));
    element.setAttribute(y, pixels(points[0][1], k));
  };
});
const trails = all("trail").map((group) => {
  const [[x, y], breaks] = [numbers(group.dataset.trail), new Set(numbers(group.dataset.breaks))];
  const parts = Array.from({ length: frames }, (_, k) => `${!k || breaks.has(k) ? "M" : "L"}${pixels(x, k)} ${pixels(y, k)}`);
  return (k) => group.firstElementChild.setAttribute("d", parts.slice(0, k + 1).join(""));
});
const cases = all("switch").map((element) => {
  const [track, own] = [Number(element.dataset.switch), Number(element.dataset.case)];
  return (k) => {
    const display = value(track, k) === own ? "" : "none";
    if (element.style.display !== display) element.style.display = display;
  };
});
const texts = all("number").map((element) => {
  const [track, decimals] = [Number(element.dataset.number), Number(element.dataset.decimals)];
  return (k) => (element.textContent = (value(track, k) / 10 ** decimals).toFixed(decimals).replace("-", "−"));
});

const [play, slider, speed, now] = ["#play", "#slider", "#speed", ".now"].map((name) => document.querySelector(name));
const last = frames - 1;
const seconds = (k) => value(clock, k) / 1000;
let frame = 0;
// Where the clock stands, and when it last moved; not playing if null.
let [time, moved] = [0, null];

function show(k) {
  frame = Math.max(0, Math.min(last, k));
  for (const draw of [...shapes, ...trails, ...cases, ...texts]) draw(frame);
  slider.value = frame;
  slider.setAttribute("aria-valuetext", now.textContent);
}

function tick(at) {
  if (moved === null) return;
  time += ((at - moved) / 1000) * Number(speed.value);
  moved = at;
  let next = frame;
  while (next < last && seconds(next + 1) <= time) next++;
  if (next !== frame) show(next);
  if (frame === last) pause();
  else requestAnimationFrame(tick);
}

function pause() {
  moved = null;
  play.textContent = "Play";
}

function start() {
  if (frame === last) show(0);
  [time, moved] = [seconds(frame), performance.now()];
  play.textContent = "Pause";
  requestAnimationFrame(tick);
}

function go(k) {
  pause();
  show(k);
}

play.addEventListener("click", () => (moved === null ? start() : pause()));
slider.addEventListener("input", () => go(Number(slider.value)));
document.addEventListener("keydown", (event) => {
  const own = ["SELECT", "BUTTON"].includes(event.target.tagName);
  if (event.ctrlKey || event.altKey || event.metaKey || event.target === speed) return;
  const step = event.shiftKey ? 10 : 1;
  const keys = { ArrowRight: frame + step, ArrowLeft: frame - step, Home: 0, End: last };
  if (event.key === " " && !own) play.click();
  else if (event.key in keys) go(keys[event.key]);
  else return;
  event.preventDefault();
});

// The address may name a frame to stop at: motion.html#120.
const wanted = parseInt(location.hash.slice(1), 10);
show(Number.isNaN(wanted) ? 0 : wanted);
if (Number.isNaN(wanted) && !matchMedia("(prefers-reduced-motion: reduce)").matches) start();
