// A volume of labels, as report/volume.rs writes it: runs of (label, length), both LEB128, in base64.
// Label 0 is outside, 1 undecided, 2 + k the class's aspect k. The first coordinate varies fastest.

export function decode(text, count) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const labels = new Uint16Array(count);
  let at = 0;
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++];
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  for (let filled = 0; filled < count; ) {
    const label = number();
    const length = number();
    labels.fill(label, filled, filled + length);
    filled += length;
  }
  return labels;
}

// The index, across an axis, of the slice in which aspects have most voxels: of volumes of labels of one size.
export function fullest(volumes, size, axis) {
  const counts = new Uint32Array(size[axis]);
  const [nx, ny] = size;
  for (const labels of volumes) {
    labels.forEach((label, p) => {
      if (label > 1) counts[[p % nx, Math.floor(p / nx) % ny, Math.floor(p / (nx * ny))][axis]]++;
    });
  }
  return counts.indexOf(Math.max(...counts));
}

// The bounding boxes of all labels: Map from label to { lo: [i, j, k], hi: [i, j, k] } (inclusive).
export function bounds(labels, [nx, ny, nz]) {
  const boxes = new Map();
  for (let k = 0, p = 0; k < nz; k++) {
    for (let j = 0; j < ny; j++) {
      for (let i = 0; i < nx; i++, p++) {
        if (labels[p] === 0) continue;
        const box = boxes.get(labels[p]);
        if (!box) {
          boxes.set(labels[p], { lo: [i, j, k], hi: [i, j, k] });
          continue;
        }
        [i, j, k].forEach((v, axis) => {
          if (v < box.lo[axis]) box.lo[axis] = v;
          if (v > box.hi[axis]) box.hi[axis] = v;
        });
      }
    }
  }
  return boxes;
}
