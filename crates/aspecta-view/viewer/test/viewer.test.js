import assert from "node:assert/strict";
import { test } from "node:test";
import { surfaceNet } from "../src/nets.js";
import { ticks } from "../src/slices.js";
import { bounds, decode, fullest } from "../src/volume.js";

test("runs are decoded, long ones too", () => {
  const text = Buffer.from([0, 2, 3, 0xac, 0x02]).toString("base64");
  const labels = decode(text, 302);
  assert.deepEqual([...labels.slice(0, 3)], [0, 0, 3]);
  assert.equal(labels[301], 3);
});

test("a surface net is closed, faces outward and encloses about the volume", () => {
  const n = 20;
  const labels = new Uint16Array(n ** 3);
  let voxels = 0;
  for (let p = 0; p < n ** 3; p++) {
    const [i, j, k] = [p % n, Math.floor(p / n) % n, Math.floor(p / n / n)];
    if (Math.hypot(i - 9.5, j - 9.5, k - 9.5) < 8) voxels += labels[p] = 1;
  }
  const { positions, index } = surfaceNet(labels, [n, n, n], 1, bounds(labels, [n, n, n]).get(1));
  const edges = new Map();
  let volume = 0;
  for (let t = 0; t < index.length; t += 3) {
    const v = [0, 1, 2].map((e) => [...positions.slice(3 * index[t + e], 3 * index[t + e] + 3)]);
    const [a, b, c] = v;
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    for (let e = 0; e < 3; e++) {
      const [from, to] = [index[t + e], index[t + ((e + 1) % 3)]];
      edges.set(`${from},${to}`, (edges.get(`${from},${to}`) ?? 0) + 1);
    }
  }
  for (const key of edges.keys()) assert.ok(edges.has(key.split(",").reverse().join(",")));
  assert.ok(volume > 0.8 * voxels && volume < 1.02 * voxels, `${volume} of ${voxels}`);
});

test("ticks are round and within the range", () => {
  assert.deepEqual(ticks({ range: [-24, 26], angle: false }).map((t) => t[0]), [-20, -10, 0, 10, 20]);
  assert.equal(ticks({ range: [-3.1416, 3.1416], angle: true }).length, 5);
});

test("the slice that opens is the one in which aspects have most voxels", () => {
  const labels = new Uint16Array(2 * 3 * 4);
  labels[2 * 3 * 2] = 2; // one voxel at height 2
  labels.fill(1, 0, 6); // undecided ones count for nothing
  labels.fill(3, 2 * 3 * 3, 2 * 3 * 3 + 2); // two at height 3
  assert.equal(fullest([labels], [2, 3, 4], 2), 3);
  assert.equal(fullest([labels], [2, 3, 4], 0), 0);
  assert.equal(fullest([new Uint16Array(24)], [2, 3, 4], 1), 0);
});
