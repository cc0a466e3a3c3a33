// Trajectories from above, on the shaded ground; receivers' fixes, places of findings, the pointed-at point.

import { Newest } from "../calls.js";
import { DIVERGING, datasetColour, isDark, scaleColour } from "../colours.js";
import { fitCanvas, h, number, themeColour } from "../dom.js";
import { heightTimes, toWorld } from "../stage/terrain.js";
import { on, state } from "../state.js";
import { axisStep } from "./timeline.js";

const STEPS = 800;

export class SiteMap {
  constructor() {
    this.canvas = h("canvas", { tabIndex: 0, "aria-label": "Map: drag to move, wheel to zoom, double click for all" });
    this.element = h("section.panel.map", { "aria-label": "Map" }, h("header", {}, h("h2", {}, "Map"), this.text = h("span.hint")), h("div.stage", {}, this.canvas));
    this.lines = [];
    this.now = [];
    this.places = [];
    this.view = null;
    this.update = new Newest(() => this.#update());
    on("time", () => this.update.ask());
    for (const event of ["theme", "point", "findings"]) on(event, () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement);
    this.#listen();
  }

  #listen() {
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const box = this.canvas.getBoundingClientRect(), [x, y] = this.#place(event.clientX - box.left, event.clientY - box.top, box);
      const factor = Math.exp(0.002 * event.deltaY);
      this.view = { x: x + (this.view.x - x) * factor, y: y + (this.view.y - y) * factor, span: this.view.span * factor };
      this.draw();
    }, { passive: false });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons || !this.view) return;
      const box = this.canvas.getBoundingClientRect(), scale = this.view.span / Math.min(box.width, box.height);
      this.view.x -= event.movementX * scale;
      this.view.y += event.movementY * scale;
      this.draw();
    });
    this.canvas.addEventListener("dblclick", () => {
      this.view = null;
      this.draw();
    });
  }

  /** Lines that do not change with time, then where machines are. */
  async fill() {
    for (const dataset of state.datasets) {
      for (const channel of dataset.channels) {
        const is_pose = channel.type === "pose" && /^truth\/[^/]+\/pose\.csv$/.test(channel.path), is_gnss = channel.type === "gnss";
        if (!is_pose && !is_gnss) continue;
        const columns = is_pose ? ["x_m", "y_m"] : ["east_m", "north_m", "fix"];
        const series = await dataset.call("series", { path: channel.file, columns, from_s: state.from_s, to_s: state.to_s, points: STEPS });
        if (!series || series.t_s.length === 0) continue;
        let points = Array.from(series.t_s, (_, k) => [series.values[0][k], series.values[1][k]]);
        if (is_gnss) points = points.filter((_, k) => series.values[2][k] > 0);
        this.lines.push({ dataset, channel, is_gnss, points });
      }
    }
    await this.#shade();
    this.update.ask();
  }

  async #shade() {
    const dataset = state.datasets[0], times = dataset ? heightTimes(dataset.index, state.from_s, state.to_s) : [];
    if (!times.length) return;
    const raster = toWorld(await dataset.call("raster", { path: `truth/terrain/${times[0][1]}` }), dataset.index.origin);
    const canvas = new OffscreenCanvas(raster.nx, raster.ny), c = canvas.getContext("2d"), image = c.createImageData(raster.nx, raster.ny);
    for (let j = 0; j < raster.ny; ++j) {
      for (let i = 0; i < raster.nx; ++i) {
        const at = (a, b) => raster.values[Math.min(raster.ny - 1, Math.max(0, j + b)) * raster.nx + Math.min(raster.nx - 1, Math.max(0, i + a))];
        const slope_x = (at(1, 0) - at(-1, 0)) / (2 * raster.cell_m), slope_y = (at(0, 1) - at(0, -1)) / (2 * raster.cell_m);
        const light = Math.max(0, (0.5 * slope_x - 0.5 * slope_y + 0.7) / Math.hypot(slope_x, slope_y, 1)) / 0.99;
        const k = 4 * ((raster.ny - 1 - j) * raster.nx + i);
        image.data.set([170 * light, 156 * light, 140 * light, 255], k);
      }
    }
    c.putImageData(image, 0, 0);
    this.ground = { canvas, raster };
  }

  async addGround(raster) {
    const canvas = new OffscreenCanvas(raster.nx, raster.ny), c = canvas.getContext("2d"), image = c.createImageData(raster.nx, raster.ny), rgb = [0, 0, 0];
    raster.values.forEach((value, k) => {
      if (!Number.isFinite(value)) return;
      scaleColour(DIVERGING, 0.5 + value / 0.6, rgb);
      image.data.set([...rgb, 235], 4 * ((raster.ny - 1 - Math.floor(k / raster.nx)) * raster.nx + (k % raster.nx)));
    });
    c.putImageData(image, 0, 0);
    this.difference = { canvas, raster };
    this.draw();
  }

  async #update() {
    this.now = [];
    for (const dataset of state.datasets) {
      for (const [name, machine] of Object.entries(await dataset.stateAt(state.t_s))) {
        if (!machine.has_pose) continue;
        const e = machine.X_WB.elements;
        this.now.push({ name, dataset, x: e[12], y: e[13], yaw: Math.atan2(e[1], e[0]) });
      }
    }
    this.draw();
  }

  #all() {
    const points = [...this.lines.flatMap((line) => line.points), ...this.now.map((m) => [m.x, m.y])];
    const xs = points.map((p) => p[0]), ys = points.map((p) => p[1]);
    if (!points.length) return { x: 0, y: 0, span: 20 };
    const [west, east, south, north] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    return { x: 0.5 * (west + east), y: 0.5 * (south + north), span: Math.max(12, 1.25 * Math.max(east - west, north - south)) };
  }

  #place(u, v, { width, height }) {
    const scale = this.view.span / Math.min(width, height);
    return [this.view.x + (u - width / 2) * scale, this.view.y - (v - height / 2) * scale];
  }

  draw() {
    const { context: c, width, height } = fitCanvas(this.canvas);
    this.view ??= this.#all();
    const scale = Math.min(width, height) / this.view.span;
    const u = (x) => width / 2 + (x - this.view.x) * scale, v = (y) => height / 2 - (y - this.view.y) * scale;
    c.fillStyle = themeColour("stage");
    c.fillRect(0, 0, width, height);
    c.imageSmoothingEnabled = true;
    for (const image of [this.ground, this.difference]) {
      if (!image) continue;
      const r = image.raster;
      c.globalAlpha = image === this.ground ? (isDark() ? 0.45 : 0.8) : 1;
      c.drawImage(image.canvas, u(r.west_m), v(r.south_m + r.ny * r.cell_m), r.nx * r.cell_m * scale, r.ny * r.cell_m * scale);
      c.globalAlpha = 1;
    }
    this.#drawLines(c, u, v);
    this.#drawPlaces(c, u, v, scale);
    this.#drawMachines(c, u, v);
    this.#drawScale(c, width, height, scale);
  }

  #drawLines(c, u, v) {
    for (const { dataset, is_gnss, points } of this.lines) {
      c.strokeStyle = c.fillStyle = datasetColour(dataset.letter);
      if (is_gnss) {
        c.globalAlpha = 0.35;
        for (const [x, y] of points) c.fillRect(u(x) - 1, v(y) - 1, 2, 2);
        c.globalAlpha = 1;
        continue;
      }
      c.lineWidth = 2;
      c.setLineDash(dataset.letter === "B" ? [6, 4] : []);
      c.beginPath();
      points.forEach(([x, y], k) => (k ? c.lineTo(u(x), v(y)) : c.moveTo(u(x), v(y))));
      c.stroke();
      c.setLineDash([]);
    }
  }

  #drawPlaces(c, u, v, scale) {
    for (const { place, colour, is_chosen, title } of this.places) {
      c.strokeStyle = c.fillStyle = colour;
      c.lineWidth = is_chosen ? 3 : 1.5;
      c.strokeRect(u(place.low_m[0]), v(place.high_m[1]), (place.high_m[0] - place.low_m[0]) * scale, (place.high_m[1] - place.low_m[1]) * scale);
      c.font = "11px system-ui, sans-serif";
      c.fillText(title, u(place.low_m[0]), v(place.high_m[1]) - 4);
    }
    const p = state.point?.p_W;
    if (p && Number.isFinite(p[0])) {
      c.fillStyle = "#ff3d7f";
      c.beginPath();
      c.arc(u(p[0]), v(p[1]), 4, 0, 2 * Math.PI);
      c.fill();
    }
  }

  #drawMachines(c, u, v) {
    c.font = "11px system-ui, sans-serif";
    for (const { name, dataset, x, y, yaw } of this.now) {
      c.save();
      c.translate(u(x), v(y));
      c.rotate(-yaw);
      c.fillStyle = datasetColour(dataset.letter);
      c.strokeStyle = themeColour("panel");
      c.lineWidth = 1.5;
      c.beginPath();
      c.moveTo(10, 0);
      c.lineTo(-7, 6);
      c.lineTo(-4, 0);
      c.lineTo(-7, -6);
      c.closePath();
      c.fill();
      c.stroke();
      c.restore();
      if (dataset.letter === "B") continue;
      c.fillStyle = themeColour("text");
      c.fillText(name, u(x) + 10, v(y) - 8);
    }
    this.text.textContent = "";
  }

  #drawScale(c, width, height, scale) {
    const length = axisStep(60 / scale);
    c.fillStyle = c.strokeStyle = themeColour("text");
    c.fillRect(10, height - 12, length * scale, 2);
    c.font = "11px system-ui, sans-serif";
    c.fillText(`${number(length, 3)} m`, 10, height - 17);
    c.fillText("N", width - 18, 14);
    c.beginPath();
    c.moveTo(width - 14, 18);
    c.lineTo(width - 18, 30);
    c.lineTo(width - 10, 30);
    c.fill();
  }
}
