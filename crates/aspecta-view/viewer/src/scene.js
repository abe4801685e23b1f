// The 3-D view: one smooth surface an aspect, the axes, and the plane of the current slice.

import {
  AmbientLight, BoxGeometry, BufferAttribute, BufferGeometry, CanvasTexture, Color, DirectionalLight, DoubleSide,
  EdgesGeometry, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera,
  PlaneGeometry, Scene, Sprite, SpriteMaterial, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { bounds } from "./volume.js";
import { surfaceNet } from "./nets.js";
import { ticks } from "./slices.js";

export class View {
  constructor(holder, volume) {
    this.volume = volume;
    this.holder = holder;
    this.meshes = new Map();
    this.scale = boxScale(volume.axes);
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    this.renderer.domElement.setAttribute("aria-label", "3-D view of the aspects; drag to turn, wheel to zoom");
    holder.append(this.renderer.domElement);
    this.scene = new Scene();
    this.scene.background = new Color("#ffffff");
    this.scene.add(new AmbientLight("#ffffff", 1.5));
    this.camera = new PerspectiveCamera(32, 1, 0.1, 50);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(2.2, -3.9, 2.1);
    const lamp = new DirectionalLight("#ffffff", 1.8);
    lamp.position.set(-1, -2, 3);
    this.camera.add(lamp);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.addAxes();
    this.addPlane();
    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
  }

  // The box has its centre at the origin and its longest length edge 1.5.
  place(axis, value) {
    const [lo, hi] = this.volume.axes[axis].range;
    return ((value - lo) / (hi - lo) - 0.5) * this.scale[axis];
  }

  addAxes() {
    const box = new EdgesGeometry(new BoxGeometry(...this.scale));
    this.scene.add(new LineSegments(box, new LineBasicMaterial({ color: "#888888" })));
    this.volume.axes.forEach((axis, k) => {
      const edge = this.scale.map((s) => -0.5 * s);
      if (k === 1) edge[0] = 0.5 * this.scale[0];
      const away = [[0, -0.1, -0.04], [0.1, 0, -0.04], [-0.1, -0.02, 0]][k];
      const put = (text, value, far, size) => {
        const at = edge.map((e, i) => e + far * away[i]);
        at[k] = this.place(k, value);
        this.scene.add(label(text, at, size));
      };
      for (const [value, text] of ticks(axis)) put(text, value, 1, 0.075);
      put(axis.label, 0.5 * (axis.range[0] + axis.range[1]), 2.6, 0.095);
    });
  }

  addPlane() {
    const material = new MeshBasicMaterial({ color: "#000000", transparent: true, opacity: 0.09, side: DoubleSide, depthWrite: false });
    this.plane = new Mesh(new PlaneGeometry(1, 1), material);
    this.scene.add(this.plane);
  }

  // Shows where the slice is.
  cut(axis, value) {
    const [across, up] = [0, 1, 2].filter((k) => k !== axis);
    this.plane.rotation.set(...[[Math.PI / 2, Math.PI / 2, 0], [Math.PI / 2, 0, 0], [0, 0, 0]][axis]);
    this.plane.scale.set(this.scale[across], this.scale[up], 1);
    this.plane.position.set(0, 0, 0).setComponent(axis, this.place(axis, value));
    this.draw();
  }

  // Shows exactly the surfaces of these classes' aspects whose ids are chosen.
  show(classes, chosen) {
    for (const mesh of this.meshes.values()) mesh.visible = false;
    for (const c of classes) {
      c.boxes ??= bounds(c.labels, this.volume.size);
      c.aspects.forEach((aspect, k) => {
        const box = c.boxes.get(k + 2);
        if (!box || !chosen.has(aspect.id)) return;
        if (!this.meshes.has(aspect.id)) this.meshes.set(aspect.id, this.surface(c.labels, k + 2, box, aspect.colour));
        this.meshes.get(aspect.id).visible = true;
      });
    }
    this.draw();
  }

  surface(labels, label, box, colour) {
    const { positions, index } = surfaceNet(labels, this.volume.size, label, box);
    for (let p = 0; p < positions.length; p++) {
      const axis = p % 3;
      positions[p] = (positions[p] / this.volume.size[axis] - 0.5) * this.scale[axis];
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setIndex(index);
    geometry.computeVertexNormals();
    const mesh = new Mesh(geometry, new MeshLambertMaterial({ color: colour, side: DoubleSide }));
    this.scene.add(mesh);
    return mesh;
  }

  resize() {
    const [width, height] = [this.holder.clientWidth, this.holder.clientHeight];
    if (!width || !height) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }
}

// Lengths at equal scale; an angle is as long as the longest length.
function boxScale(axes) {
  const span = (a) => a.range[1] - a.range[0];
  const longest = Math.max(...axes.map((a) => (a.angle ? 0 : span(a))));
  return axes.map((a) => 1.5 * (a.angle || longest === 0 ? 1 : span(a) / longest));
}

function label(text, at, size) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [256, 64];
  const pen = canvas.getContext("2d");
  pen.font = "40px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = "#222";
  pen.fillText(text, 128, 32);
  const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false, transparent: true }));
  sprite.scale.set(4 * size, size, 1);
  sprite.position.set(...at);
  return sprite;
}
