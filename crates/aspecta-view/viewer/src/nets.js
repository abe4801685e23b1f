// Surface nets (Gibson 1998) of the voxels with one label: a closed mesh, one vertex for each place where eight
// voxels meet that are not all alike, one quadrilateral for each face between a voxel inside and one outside.

const SMOOTHING = 10; // rounds of averaging, to take the stairs off

// Positions in voxel units: voxel (i, j, k) is the cube from there to (i + 1, j + 1, k + 1).
export function surfaceNet(labels, [nx, ny, nz], label, box) {
  const inside = (i, j, k) =>
    i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz && labels[i + nx * (j + ny * k)] === label;
  const [wide, deep] = [box.hi[0] - box.lo[0] + 2, box.hi[1] - box.lo[1] + 2];
  const ids = new Map();
  const positions = [];
  const vertex = (i, j, k) => {
    const key = i - box.lo[0] + wide * (j - box.lo[1] + deep * (k - box.lo[2]));
    let id = ids.get(key);
    if (id === undefined) {
      id = positions.length / 3;
      ids.set(key, id);
      positions.push(i, j, k);
    }
    return id;
  };
  const quads = [];
  // Corners of the face towards each of the six neighbours, counter-clockwise from outside.
  const faces = [
    [[1, 0, 0], [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]]],
    [[-1, 0, 0], [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]]],
    [[0, 1, 0], [[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]]],
    [[0, -1, 0], [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]],
    [[0, 0, 1], [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]],
    [[0, 0, -1], [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]]],
  ];
  for (let k = box.lo[2]; k <= box.hi[2]; k++) {
    for (let j = box.lo[1]; j <= box.hi[1]; j++) {
      for (let i = box.lo[0]; i <= box.hi[0]; i++) {
        if (!inside(i, j, k)) continue;
        for (const [n, corners] of faces) {
          if (inside(i + n[0], j + n[1], k + n[2])) continue;
          quads.push(corners.map((c) => vertex(i + c[0], j + c[1], k + c[2])));
        }
      }
    }
  }
  const index = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  return { positions: smooth(positions, quads), index };
}

function smooth(start, quads) {
  let positions = Float32Array.from(start);
  for (let round = 0; round < SMOOTHING; round++) {
    const sums = new Float32Array(positions.length);
    const counts = new Uint16Array(positions.length / 3);
    for (const quad of quads) {
      for (let e = 0; e < 4; e++) {
        const [a, b] = [quad[e], quad[(e + 1) % 4]];
        for (let axis = 0; axis < 3; axis++) sums[3 * a + axis] += positions[3 * b + axis];
        counts[a]++;
      }
    }
    positions = positions.map((x, p) => 0.5 * x + (0.5 * sums[p]) / counts[Math.floor(p / 3)]);
  }
  return positions;
}
