// One slice of the volume, drawn on a canvas with axes.

const INK = "#222";
const UNDECIDED = "#9b9b9b";
// Baseline of the vertical axis' label.
const LABEL = 13;

export function drawSlice(canvas, volume, classes, axis, layer) {
  const [across, up] = [0, 1, 2].filter((k) => k !== axis);
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth || 460, canvas.clientHeight || 460];
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, width, height);

  pen.font = "11px system-ui, sans-serif";
  const plot = fit(pen, volume.axes[across], volume.axes[up], width, height);
  pen.imageSmoothingEnabled = false;
  pen.drawImage(picture(volume, classes, axis, layer), plot.left, plot.top, plot.width, plot.height);
  frame(pen, volume.axes[across], volume.axes[up], plot);
}

// Beside the vertical axis' label and its numbers: equal scale for two lengths or two angles, else the whole room.
function fit(pen, x, y, width, height) {
  const numbers = Math.max(...ticks(y).map(([, text]) => pen.measureText(text).width));
  const left = Math.ceil(LABEL + 6 + numbers + 7);
  const room = { left, top: 12, width: width - left - 14, height: height - 54 };
  if (x.angle !== y.angle) return room;
  const [dx, dy] = [x.range[1] - x.range[0], y.range[1] - y.range[0]];
  const scale = Math.min(room.width / dx, room.height / dy);
  return { ...room, width: scale * dx, height: scale * dy };
}

function picture(volume, classes, axis, layer) {
  const [across, up] = [0, 1, 2].filter((k) => k !== axis);
  const { size } = volume;
  const stride = [1, size[0], size[0] * size[1]];
  const image = new ImageData(size[across], size[up]);
  for (const c of classes) {
    for (let j = 0; j < size[up]; j++) {
      for (let i = 0; i < size[across]; i++) {
        const label = c.labels[i * stride[across] + j * stride[up] + layer * stride[axis]];
        if (label === 0) continue;
        const at = 4 * (i + size[across] * (size[up] - 1 - j));
        if (label === 1 && image.data[at + 3]) continue;
        const colour = label === 1 ? UNDECIDED : c.aspects[label - 2].colour;
        image.data.set([1, 3, 5].map((p) => parseInt(colour.slice(p, p + 2), 16)), at);
        image.data[at + 3] = 255;
      }
    }
  }
  const buffer = document.createElement("canvas");
  [buffer.width, buffer.height] = [size[across], size[up]];
  buffer.getContext("2d").putImageData(image, 0, 0);
  return buffer;
}

function frame(pen, x, y, plot) {
  pen.strokeStyle = pen.fillStyle = INK;
  pen.lineWidth = 1;
  pen.strokeRect(plot.left, plot.top, plot.width, plot.height);
  pen.textAlign = "center";
  const bottom = plot.top + plot.height;
  for (const [value, text] of ticks(x)) {
    const px = plot.left + ((value - x.range[0]) / (x.range[1] - x.range[0])) * plot.width;
    line(pen, px, bottom, px, bottom + 4);
    pen.fillText(text, px, bottom + 16);
  }
  pen.fillText(x.label, plot.left + plot.width / 2, bottom + 32);
  pen.textAlign = "right";
  for (const [value, text] of ticks(y)) {
    const py = bottom - ((value - y.range[0]) / (y.range[1] - y.range[0])) * plot.height;
    line(pen, plot.left - 4, py, plot.left, py);
    pen.fillText(text, plot.left - 7, py + 4);
  }
  pen.save();
  pen.translate(LABEL, plot.top + plot.height / 2);
  pen.rotate(-Math.PI / 2);
  pen.textAlign = "center";
  pen.fillText(y.label, 0, 0);
  pen.restore();
}

function line(pen, x0, y0, x1, y1) {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

// About five round values: [[value, text], …].
export function ticks({ range: [lo, hi], angle }) {
  if (angle && hi - lo > 3) {
    const texts = ["−π", "−π/2", "0", "π/2", "π"];
    return texts.map((t, k) => [((k - 2) * Math.PI) / 2, t]).filter(([v]) => v > lo - 1e-6 && v < hi + 1e-6);
  }
  const rough = (hi - lo) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const first = Math.ceil(lo / step - 1e-6);
  const count = Math.floor(hi / step + 1e-6) - first + 1;
  return Array.from({ length: count }, (_, k) => (first + k) * step).map((v) => [
    v,
    (Math.abs(v) < step / 2 ? 0 : v).toFixed(digits).replace("-", "−"),
  ]);
}
