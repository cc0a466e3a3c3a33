// The 3-D view: machines, things, ground, scans, trajectories, what is pointed at.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Newest } from "../calls.js";
import { VIRIDIS, DIVERGING, datasetColour, isDark } from "../colours.js";
import { h, number, select, themeColour, toggle } from "../dom.js";
import { Cloud, coloursOf, pointsInWorld, rangeOf } from "../stage/cloud.js";
import { SceneBodies } from "../stage/scene_bodies.js";
import { Terrain, heightTimes, toWorld } from "../stage/terrain.js";
import { on, set, state, tell } from "../state.js";
import { lastNotAbove } from "../worker/table.js";

const NOON = { sky: 0xffffff, ground: 0x8a7a6a };
const TRAIL_STEPS = 400;
const KEPT_SCANS = 12;

/** Whether WebGL is drawn by the processor, which then has no time for smooth edges. */
function isSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2"), info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class View3d {
  constructor() {
    this.layers = { machines: true, ground: true, scans: true, paths: true, frames: false };
    this.ground_by = "plain";
    this.scans_shown = 1;
    this.follows = false;
    this.bodies = new Map();
    this.scans = new Map();
    this.rasters = new Map();
    this.canvas = h("canvas", { tabIndex: 0, "aria-label": "3-D view: drag to turn, right drag to move, wheel to come nearer" });
    this.key = h("div.key");
    this.note = h("div.note");
    this.element = h("section.panel.view3d", { "aria-label": "3-D view" }, this.#header(), h("div.stage", {}, this.canvas, this.key, this.note));
    this.#setUp();
    this.update = new Newest(() => this.#update());
    on("time", () => this.update.ask());
    on("stage", () => this.#restage());
    on("colour_by", () => this.#recolour());
    on("shown", () => this.update.ask());
    on("theme", () => this.#theme());
    on("point", () => this.#mark());
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement);
    this.canvas.addEventListener("pointermove", (event) => this.#point(event));
    this.canvas.addEventListener("pointerleave", () => state.point?.from === this && set("point", null));
  }

  #header() {
    const layer = (name, text, title) => toggle(text, title, this.layers[name], (is_on) => {
      this.layers[name] = is_on;
      this.update.ask();
    });
    return h("header", {}, h("h2", {}, "3-D"),
      h("label", {}, "points by", select("Colour of points", [["class", "class"], ["intensity", "intensity"], ["height", "height"],
        ["range", "range"], ["time", "time in scan"], ["ring", "ring"], ["instance", "instance"], ["dataset", "dataset"]],
      state.colour_by, (value) => set("colour_by", value))),
      h("label", {}, "scans", select("Scans shown", [["1", "1"], ["5", "5"], ["20", "20"]], "1", (value) => {
        this.scans_shown = Number(value);
        this.update.ask();
      })),
      h("label", {}, "ground by", this.ground_select = select("Colour of the ground", [["plain", "shade"], ["height", "height"],
        ["change", "change"]], "plain", (value) => {
        this.ground_by = value;
        this.shown_ground = null;
        this.update.ask();
      })),
      h("span.space"),
      layer("machines", "machines", "Show machines and things"), layer("ground", "ground", "Show the ground"),
      layer("scans", "scans", "Show scans"), layer("paths", "paths", "Show trajectories"), layer("frames", "axes", "Show axes of machines and sensors"),
      toggle("follow", "Let the view follow the first machine (F)", false, (is_on) => {
        this.follows = is_on;
        this.last_centre = null;
        this.update.ask();
      }));
  }

  #setUp() {
    this.is_software = isSoftware();
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: !this.is_software, preserveDrawingBuffer: true });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.1, 2000);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-9, -11, 7);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.set(1, 0, 1);
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(new THREE.HemisphereLight(NOON.sky, NOON.ground, 1.6));
    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(-6, -9, 14);
    this.scene.add(sun);
    this.terrain = new Terrain();
    this.terrain.object.visible = false;
    this.cloud = new Cloud();
    this.paths = new THREE.Group();
    this.frames = new THREE.Group();
    this.marker = new THREE.Mesh(new THREE.SphereGeometry(1, 16, 12), new THREE.MeshBasicMaterial({ color: 0xff3d7f, depthTest: false }));
    this.marker.renderOrder = 9;
    this.marker.visible = false;
    this.scene.add(this.terrain.object, this.cloud.object, this.paths, this.frames, this.marker);
    this.#theme();
  }

  #theme() {
    this.scene.background = new THREE.Color(themeColour("stage") || "#10141a");
    if (this.grid) this.scene.remove(this.grid);
    const [line, faint] = isDark() ? [0x3a4552, 0x252d37] : [0xb4bec9, 0xd6dde4];
    this.grid = new THREE.GridHelper(60, 60, line, faint);
    this.grid.rotateX(Math.PI / 2);
    this.scene.add(this.grid);
    this.#restage();
  }

  /** Bodies anew, when a scene has come or the theme has changed. */
  #restage() {
    for (const { object } of this.bodies.values()) this.scene.remove(object);
    this.bodies.clear();
    for (const dataset of state.datasets) {
      if (!dataset.stage) continue;
      const bodies = new SceneBodies(dataset.stage, dataset.letter === "A" ? null : datasetColour("B"));
      this.bodies.set(dataset, bodies);
      this.scene.add(bodies.object);
    }
    const failed = state.datasets.filter((dataset) => dataset.stage_error);
    this.note.textContent = failed.map((dataset) => `Machines of ${dataset.letter} are not drawn: ${dataset.stage_error}`).join("\n");
    this.paths_made = false;
    this.scans.clear();
    this.update?.ask();
  }

  #recolour() {
    for (const scan of this.scans.values()) scan.then((part) => part && this.#colour(part)).catch(() => {});
    this.range = null;
    this.update.ask();
  }

  async #update() {
    const t_s = state.t_s, begun = performance.now();
    await Promise.all([this.#placeMachines(t_s), this.#placeGround(t_s), this.#placeScans(t_s), this.#placePaths()]);
    this.#legend();
    this.#render();
    tell("drawn", { panel: "3-D", ms: performance.now() - begun, t_s });
  }

  async #placeMachines(t_s) {
    for (const [dataset, bodies] of this.bodies) {
      const now = await dataset.stateAt(t_s);
      bodies.object.visible = this.layers.machines;
      bodies.place(now, t_s);
      if (dataset === state.datasets[0]) await this.#placeFrames(dataset, now, t_s);
    }
    if (!this.follows || !state.datasets.length) return;
    const first = Object.values(await state.datasets[0].stateAt(t_s)).find((machine) => machine.has_pose);
    if (!first) return;
    const centre = new THREE.Vector3().setFromMatrixPosition(first.X_WB);
    if (this.last_centre) {
      const moved = centre.clone().sub(this.last_centre);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
    }
    this.last_centre = centre;
  }

  async #placeFrames(dataset, now, t_s) {
    this.frames.visible = this.layers.frames;
    if (!this.layers.frames) return;
    this.frames.clear();
    const add = (X, size) => {
      const axes = new THREE.AxesHelper(size);
      axes.material.depthTest = false;
      axes.applyMatrix4(X);
      this.frames.add(axes);
    };
    for (const machine of Object.values(now)) add(machine.X_WB, 1.2);
    for (const channel of dataset.channels) {
      const X_WS = channel.sheet?.X_PS && (await dataset.sensorPose(channel, t_s));
      if (X_WS) add(X_WS, 0.5);
    }
  }

  raster(dataset, name) {
    const key = `${dataset.source}/${name}`;
    if (!this.rasters.has(key)) {
      this.rasters.set(key, dataset.call("raster", { path: `truth/terrain/${name}` }).then((r) => toWorld(r, dataset.index.origin)));
    }
    return this.rasters.get(key);
  }

  async #placeGround(t_s) {
    const dataset = state.datasets[0], times = dataset ? heightTimes(dataset.index, state.from_s, state.to_s) : [];
    this.terrain.object.visible = this.layers.ground && times.length > 0;
    this.grid.visible = !this.terrain.object.visible;
    if (!this.terrain.object.visible) return;
    const [, name] = times[Math.max(0, lastNotAbove(times.map(([t]) => t), t_s + 1e-9))];
    const key = `${name} ${this.ground_by} ${isDark()}`;
    if (this.shown_ground === key) return;
    const other = state.datasets[1];
    const compared = this.ground_by !== "change" ? null : other && other.index.terrain.includes(name)
      ? await this.raster(other, name) : await this.raster(dataset, times[0][1]);
    this.terrain.show(await this.raster(dataset, name), this.ground_by, isDark() ? [104, 103, 102] : [205, 200, 194], compared);
    this.shown_ground = key;
  }

  async #part(dataset, channel, list, k) {
    const key = `${dataset.source}/${channel.path}/${k}`;
    if (this.scans.has(key)) return this.scans.get(key);
    while (this.scans.size >= KEPT_SCANS * Math.max(1, dataset.lidars.length)) this.scans.delete(this.scans.keys().next().value);
    const read = (async () => {
      const t_s = list.t_s[k];
      const scan = await dataset.call("scan", { path: `${channel.path}/scans/${list.names[k]}` });
      const longest_s = scan.time ? 1e-9 * scan.time.reduce((most, t) => Math.max(most, t), 0) : 0;
      const X_begin = await dataset.sensorPose(channel, t_s), X_end = await dataset.sensorPose(channel, t_s + longest_s);
      if (!X_begin || !X_end) return null;
      const part = { scan, dataset, channel, t_s, points_W: pointsInWorld(scan, X_begin, X_end) };
      this.#colour(part);
      return part;
    })();
    this.scans.set(key, read);
    return read;
  }

  #colour(part) {
    this.range = rangeOf(state.colour_by, part.scan, part.points_W);
    part.colours = coloursOf(state.colour_by, part.scan, part.points_W, this.range, part.dataset.index.classes, part.dataset.letter);
    part.range = this.range;
  }

  async #placeScans(t_s) {
    this.cloud.object.visible = this.layers.scans;
    const shown = state.datasets.length < 2 || state.shown === "both" || state.shown === "difference"
      ? state.datasets : state.datasets.filter((dataset) => dataset.letter === state.shown);
    const wanted = [];
    for (const dataset of shown) {
      for (const channel of dataset.lidars) {
        const list = await dataset.frames(channel), last = lastNotAbove(list.t_s, t_s + 1e-9);
        for (let k = Math.max(0, last - this.scans_shown + 1); k <= last; ++k) wanted.push(this.#part(dataset, channel, list, k));
      }
    }
    const parts = (await Promise.all(wanted.map((one) => one.catch(() => null)))).filter(Boolean);
    this.cloud.show(parts);
    this.range = parts.length ? parts.at(-1).range : null;
  }

  /** Trajectories, once. */
  async #placePaths() {
    this.paths.visible = this.layers.paths;
    if (this.paths_made) return;
    this.paths_made = true;
    this.paths.clear();
    for (const dataset of state.datasets) {
      for (const pose of dataset.channels.filter((channel) => channel.type === "pose" && /^truth\/[^/]+\/pose\.csv$/.test(channel.path))) {
        const series = await dataset.call("series", { path: pose.file, columns: ["x_m", "y_m", "z_m"], from_s: state.from_s,
          to_s: state.to_s, points: TRAIL_STEPS });
        if (!series || series.t_s.length < 2) continue;
        const points = Array.from(series.t_s, (_, k) => new THREE.Vector3(...series.values.map((v) => v[k])));
        const material = new THREE.LineBasicMaterial({ color: datasetColour(dataset.letter), depthTest: false, transparent: true, opacity: 0.9 });
        const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), material);
        line.renderOrder = 5;
        this.paths.add(line);
      }
    }
  }

  #legend() {
    const gradient = (scale) => `linear-gradient(90deg, ${scale.map((c) => `rgb(${c})`).join(",")})`;
    const bar = (name, unit, range, scale) => h("div.scale", {}, h("span", {}, name),
      h("i", { style: { background: gradient(scale) } }), h("span.num", {}, `${number(range[0], 3)} … ${number(range[1], 3)} ${unit}`));
    const rows = [];
    const units = { intensity: "", height: "m", range: "m", time: "s", ring: "" };
    if (this.layers.scans && this.range && this.cloud.parts.length) rows.push(bar(state.colour_by, units[state.colour_by] ?? "", this.range, VIRIDIS));
    if (this.layers.scans && state.colour_by === "class" && this.cloud.parts.length) rows.push(this.#classes());
    if (this.layers.ground && this.terrain.range && this.ground_by === "height") rows.push(bar("ground", "m", this.terrain.range, VIRIDIS));
    if (this.layers.ground && this.ground_by === "change") {
      rows.push(bar(state.datasets.length > 1 ? "A − B" : "since start", "m", [-0.5, 0.5], DIVERGING));
    }
    if (state.datasets.length > 1) {
      rows.push(h("div.classes", {}, state.datasets.map((d) => h("span", {}, h("i", { style: { background: datasetColour(d.letter) } }), `${d.letter} ${d.index.name}`))));
    }
    this.key.replaceChildren(...rows);
  }

  #classes() {
    const counts = new Map();
    for (const { scan, dataset } of this.cloud.parts) {
      for (const label of scan.label ?? []) {
        const one = dataset.index.classes[label];
        if (one) counts.set(one, (counts.get(one) ?? 0) + 1);
      }
    }
    const most = [...counts].sort((a, b) => b[1] - a[1]).slice(0, 8);
    return h("div.classes", {}, most.map(([one]) => h("span", {}, h("i", { style: { background: `rgb(${one.rgb})` } }), one.name.replaceAll("_", " "))));
  }

  #point(event) {
    if (event.buttons || !this.layers.scans) return;
    const box = this.canvas.getBoundingClientRect();
    const found = this.cloud.pick(this.camera, box.width, box.height, event.clientX - box.left, event.clientY - box.top);
    if (!found) {
      if (state.point?.from === this) set("point", null);
      return;
    }
    const { part: { scan, dataset }, index, p_W } = found;
    const words = [scan.label && dataset.className(scan.label[index]), scan.instance && dataset.instanceName(scan.instance[index]),
      scan.intensity && `intensity ${number(scan.intensity[index], 2)}`,
      `range ${number(Math.hypot(scan.x[index], scan.y[index], scan.z[index]), 4)} m`];
    set("point", { from: this, dataset, p_W, text: words.filter(Boolean).join(" · ") });
  }

  #mark() {
    this.marker.visible = state.point !== null && Number.isFinite(state.point.p_W[0]);
    if (this.marker.visible) {
      this.marker.position.set(...state.point.p_W);
      this.marker.scale.setScalar(0.008 * this.camera.position.distanceTo(this.marker.position));
    }
    this.draw();
  }

  /** Before the browser next paints, once whatever asks for it. */
  draw() {
    if (this.is_asked) return;
    this.is_asked = true;
    requestAnimationFrame(() => this.is_asked && this.#render());
  }

  #render() {
    this.is_asked = false;
    const box = this.canvas.parentElement.getBoundingClientRect();
    if (box.width < 1 || box.height < 1) return;
    const size = `${box.width} ${box.height} ${window.devicePixelRatio}`;
    if (this.size !== size) {
      this.size = size;
      this.renderer.setPixelRatio(this.is_software ? 1 : window.devicePixelRatio);
      this.renderer.setSize(box.width, box.height);
    }
    this.camera.aspect = box.width / box.height;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }

  get points() {
    return this.cloud.count ?? 0;
  }
}
