// Slices and 3-D view of a robot with three coordinates. The page holds the volume in #volume (JSON) and the
// empty #explorer to fill.

import { decode, fullest } from "./volume.js";
import { drawSlice } from "./slices.js";
import { View } from "./scene.js";

function start() {
  const volume = JSON.parse(document.getElementById("volume").textContent);
  const root = document.getElementById("explorer");
  const [nx, ny, nz] = volume.size;
  const labelled = (c) => (c.labels ??= decode(c.data, nx * ny * nz));
  const modes = [...new Set(volume.classes.map((c) => c.mode))];

  const mode = select("Working mode", modes.map((m, k) => [m, `Mf${volume.numbers[k]} (${m.replaceAll("-", "−")})`]));
  const sign = select("det A", [["both", "both signs"], ["+", "> 0"], ["-", "< 0"]]);
  const axis = select("Slice across", volume.axes.map((a, k) => [k, a.label.split(" ")[0]]));
  axis.input.value = "2";
  mode.input.value = (volume.classes.find((c) => c.aspects.length > 0) ?? volume.classes[0]).mode;
  const slider = element("input", { type: "range", min: 0, step: 1, "aria-label": "Position of the slice" });
  const where = element("output", {});
  const canvas = element("canvas", { class: "slice", role: "img", "aria-label": "Slice of the W-aspects" });
  const holder = element("div", { class: "scene" });
  const toggles = element("div", { class: "toggles" });
  const bar = element("div", { class: "controls" }, mode.label, sign.label, axis.label, element("label", {}, "Position ", slider, " ", where));
  root.append(bar, element("div", { class: "panes" }, canvas, holder), toggles);

  let view = null;
  try {
    view = new View(holder, volume);
  } catch {
    holder.textContent = "This browser offers no WebGL: only the slices are shown.";
  }
  const hidden = new Set();
  const current = () => {
    const fits = (c) => c.mode === mode.input.value && (sign.input.value === "both" || c.det_a === sign.input.value);
    const classes = volume.classes.filter(fits);
    classes.forEach(labelled);
    return classes;
  };

  function surfaces() {
    const ids = current().flatMap((c) => c.aspects.map((a) => a.id));
    view?.show(current(), new Set(ids.filter((id) => !hidden.has(id))));
  }
  function slice() {
    const k = Number(axis.input.value);
    slider.max = volume.size[k] - 1;
    const [lo, hi] = volume.axes[k].range;
    const value = lo + ((hi - lo) * (Number(slider.value) + 0.5)) / volume.size[k];
    where.textContent = `${volume.axes[k].label.split(" ")[0]} = ${value.toFixed(3).replace("-", "−")}`;
    drawSlice(canvas, volume, current(), k, Number(slider.value));
    view?.cut(k, value);
  }
  function list() {
    toggles.replaceChildren(
      ...current().flatMap((c) =>
        c.aspects.map((a) => {
          const box = element("input", { type: "checkbox" });
          box.checked = !hidden.has(a.id);
          box.addEventListener("change", () => {
            hidden[box.checked ? "delete" : "add"](a.id);
            surfaces();
          });
          const swatch = element("span", { class: "swatch", style: `background:${a.colour}` });
          return element("label", {}, box, swatch, `${a.id} (det A ${c.det_a === "+" ? "> 0" : "< 0"})`);
        }),
      ),
      element("span", {}, element("span", { class: "swatch", style: "background:#9b9b9b" }), "undecided (slices only)"),
    );
  }
  const all = () => (list(), slice(), surfaces());
  // Where there is most to be seen.
  function place() {
    const k = Number(axis.input.value);
    slider.max = volume.size[k] - 1;
    slider.value = fullest(current().map(labelled), volume.size, k);
  }
  mode.input.addEventListener("change", () => (place(), all()));
  sign.input.addEventListener("change", all);
  axis.input.addEventListener("change", () => (place(), slice()));
  slider.addEventListener("input", slice);
  place();
  new ResizeObserver(slice).observe(canvas);
  all();
}

function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

function select(name, options) {
  const input = element("select", {}, ...options.map(([value, text]) => element("option", { value }, text)));
  return { input, label: element("label", {}, `${name} `, input) };
}

start();
