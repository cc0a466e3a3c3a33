// Pictures of cameras: any label over colour, boxes of objects, and what a pixel under the pointer shows in the world.

import { Vector3 } from "three";
import { Newest } from "../calls.js";
import { numberColour } from "../colours.js";
import { h, number, select, toggle } from "../dom.js";
import { on, set, state, tell } from "../state.js";
import { lastNotAbove } from "../worker/table.js";

const KEPT_PICTURES = 12;  // of one camera; each takes some 2 to 5 MB

/** One camera of A, with that of B of the same path where there is one. */
class CameraCard {
  constructor(path, pair) {
    this.path = path;
    this.pair = pair;  // [[dataset, channel], ...]
    const kinds = pair[0][1].pictures;
    this.kind = kinds.includes("rgb") ? "rgb" : kinds[0];
    this.canvas = h("canvas", { tabIndex: 0, "aria-label": `Picture of ${path}` });
    this.caption = h("span.hint");
    this.element = h("article.camera", { "data-path": path }, h("div.title", {}, h("b", {}, path.split("/").at(-1)),
      h("span.hint", {}, path.split("/")[0]), h("span.space"), this.caption,
      kinds.length > 1 ? select("Picture", kinds.map((kind) => [kind, kind.replaceAll("_", " ")]), this.kind, (kind) => {
        this.kind = kind;
        this.update.ask();
      }) : null), this.canvas);
    this.kept = new Map();
    this.update = new Newest(() => this.#update());
    this.canvas.addEventListener("pointermove", (event) => this.#point(event));
    this.canvas.addEventListener("pointerleave", () => state.point?.from === this && set("point", null));
  }

  get has_overlay() {
    return state.opacity > 0 && this.kind === "rgb" && this.pair[0][1].pictures.includes(state.overlay);
  }

  #picture(dataset, channel, name, kind) {
    const path = `${channel.path}/${kind}/${name}`, key = `${dataset.source}/${path}`;
    if (!this.kept.has(key)) {
      while (this.kept.size >= KEPT_PICTURES) {
        const [oldest, picture] = this.kept.entries().next().value;
        this.kept.delete(oldest);
        picture.then((p) => p.bitmap.close()).catch(() => {});
      }
      this.kept.set(key, dataset.call("picture", { path, kind }));
    }
    return this.kept.get(key);
  }

  async #frame([dataset, channel]) {
    const list = await dataset.frames(channel), k = Math.max(0, lastNotAbove(list.t_s, state.t_s + 1e-9));
    if (k >= list.names.length) return null;
    const name = list.names[k];
    const [picture, overlay, boxes] = await Promise.all([this.#picture(dataset, channel, name, this.kind),
      this.has_overlay ? this.#picture(dataset, channel, name, state.overlay).catch(() => null) : null,
      state.boxes ? dataset.call("json", { path: `${channel.path}/boxes/${name.replace(/png$/, "json")}` }).catch(() => null) : null]);
    return { dataset, channel, t_s: list.t_s[k], name, picture, overlay, boxes };
  }

  async #update() {
    if (!this.element.isConnected || this.element.getBoundingClientRect().height === 0) return;
    const begun = performance.now();
    const pair = this.pair.length < 2 ? this.pair : state.shown === "B" ? [this.pair[1]] : state.shown === "A" ? [this.pair[0]] : this.pair;
    this.frames = (await Promise.all(pair.map((one) => this.#frame(one)))).filter(Boolean);
    this.draw();
    tell("drawn", { panel: this.path, ms: performance.now() - begun });
  }

  draw() {
    const frames = this.frames;
    if (!frames?.length) return;
    const { width, height } = frames[0].picture.bitmap, side_by_side = frames.length === 2 && state.shown === "both";
    this.canvas.width = side_by_side ? 2 * width : width;
    this.canvas.height = height;
    const c = this.canvas.getContext("2d");
    this.caption.textContent = `${frames[0].t_s.toFixed(3)} s`;
    if (frames.length === 2 && state.shown === "difference") {
      c.drawImage(frames[0].picture.bitmap, 0, 0);
      c.globalCompositeOperation = "difference";
      c.drawImage(frames[1].picture.bitmap, 0, 0);
      c.globalCompositeOperation = "source-over";
    } else {
      frames.forEach((frame, k) => this.#drawFrame(c, frame, k * width));
    }
    this.#mark(c, width);
  }

  #drawFrame(c, { picture, overlay, boxes, dataset }, x) {
    c.drawImage(picture.bitmap, x, 0);
    if (overlay) {
      c.globalAlpha = state.opacity;
      c.drawImage(overlay.bitmap, x, 0);
      c.globalAlpha = 1;
    }
    const size = Math.max(1, picture.bitmap.width / 480);
    for (const box of boxes?.boxes ?? []) {
      if (box.x_max_px === undefined) continue;
      if (box.parent && box.parent !== 0) continue;
      const rgb = `rgb(${dataset.index.classes.find((one) => one.name === box.class)?.rgb ?? numberColour(box.instance).map(Math.round)})`;
      c.lineWidth = 1.5 * size;
      c.strokeStyle = rgb;
      c.strokeRect(x + box.x_min_px, box.y_min_px, box.x_max_px - box.x_min_px + 1, box.y_max_px - box.y_min_px + 1);
      if (box.x_max_px - box.x_min_px < 24 * size) continue;
      c.font = `${11 * size}px system-ui, sans-serif`;
      const wide = c.measureText(box.name).width + 6 * size, top = Math.max(0, box.y_min_px - 14 * size);
      c.fillStyle = "rgba(10,13,17,.75)";
      c.fillRect(x + box.x_min_px, top, wide, 14 * size);
      c.fillStyle = "#fff";
      c.fillText(box.name, x + box.x_min_px + 3 * size, top + 10.5 * size);
    }
  }

  /** The point that is pointed at, where this camera would see it. */
  #mark(c, width) {
    if (!state.point) return;
    this.frames.forEach((frame, k) => {
      const pixel = frame.projected?.(state.point.p_W);
      if (!pixel || pixel[0] < 0 || pixel[1] < 0 || pixel[0] >= width || pixel[1] >= this.canvas.height) return;
      if (state.shown === "difference" && k > 0) return;
      const [u, v] = [pixel[0] + (state.shown === "both" ? k * width : 0), pixel[1]], size = Math.max(1, width / 480);
      c.strokeStyle = "#ff3d7f";
      c.lineWidth = 1.5 * size;
      c.beginPath();
      c.arc(u, v, 6 * size, 0, 2 * Math.PI);
      c.moveTo(u - 12 * size, v);
      c.lineTo(u - 3 * size, v);
      c.moveTo(u + 3 * size, v);
      c.lineTo(u + 12 * size, v);
      c.stroke();
    });
  }

  /** Prepares projection of the frames shown, then draws the mark. */
  async mark() {
    for (const frame of this.frames ?? []) {
      if (frame.projected !== undefined) continue;
      frame.projected = null;
      const lens = frame.dataset.lens(frame.channel), X_WC = lens && (await frame.dataset.opticalPose(frame.channel, frame.t_s));
      if (!X_WC) continue;
      frame.X_WC = X_WC;
      frame.lens = lens;
      const X_CW = X_WC.clone().invert();
      frame.projected = (p_W) => lens.project(new Vector3(...p_W).applyMatrix4(X_CW).toArray());
    }
    this.draw();
  }

  /** What the pixel under the pointer shows: its class, and by its depth its place in the world. */
  async #point(event) {
    const box = this.canvas.getBoundingClientRect();
    if (!this.frames?.length) return;
    const width = this.frames[0].picture.bitmap.width;
    const at = ((event.clientX - box.left) / box.width) * this.canvas.width, k = Math.min(this.frames.length - 1, Math.floor(at / width));
    const u = Math.floor(at - k * width), v = Math.floor(((event.clientY - box.top) / box.height) * this.canvas.height);
    this.pointer = new Newest(() => this.#look(this.frames[k], u, v));
    await this.pointer.ask();
  }

  async #look(frame, u, v) {
    const { dataset, channel, name } = frame;
    const value = async (kind) => {
      if (!channel.pictures.includes(kind)) return null;
      const picture = await this.#picture(dataset, channel, name, kind);
      return picture.values[v * picture.width + u];
    };
    const [label, instance, depth_mm] = await Promise.all([value("semantic"), value("instance"), value("depth")]);
    await this.mark();
    const words = [label !== null && dataset.className(label), instance && dataset.instanceName(instance), depth_mm && `${number(depth_mm / 1000, 4)} m`];
    const text = words.filter(Boolean).join(" · ");
    if (!depth_mm || !frame.X_WC) return set("point", text ? { from: this, dataset, p_W: [NaN, NaN, NaN], text, pixel: [u, v] } : null);
    const p_W = new Vector3(...frame.lens.point(u, v, depth_mm / 1000)).applyMatrix4(frame.X_WC).toArray();
    set("point", { from: this, dataset, p_W, text, pixel: [u, v] });
  }
}

export class Cameras {
  constructor() {
    this.cards = [];
    this.list = h("div.cards");
    const kinds = [["semantic", "classes"], ["instance", "instances"], ["depth", "depth"]];
    this.opacity = h("input", { type: "range", min: 0, max: 1, step: 0.05, value: state.opacity, title: "How opaque the overlay is (O)",
      "aria-label": "Opacity of the overlay", oninput: () => set("opacity", Number(this.opacity.value), "overlay") });
    this.header = h("header", {}, h("h2", {}, "Cameras"),
      select("Overlay", kinds, state.overlay, (kind) => {
        if (state.opacity === 0) this.opacity.value = state.opacity = 0.5;
        set("overlay", kind);
      }), this.opacity, toggle("boxes", "Boxes of objects (B)", state.boxes, (is_on) => set("boxes", is_on)), h("span.space"));
    this.element = h("section.panel.camerapanel", { "aria-label": "Cameras" }, this.header, this.list);
    for (const event of ["time", "overlay", "boxes", "shown", "show_panel"]) on(event, () => this.cards.forEach((card) => card.update.ask()));
    on("point", () => this.cards.forEach((card) => card.mark()));
    this.list.addEventListener("scroll", () => this.cards.forEach((card) => card.update.ask()));
  }

  /** A card for each camera of A, and for those that B alone has. */
  fill() {
    const paths = new Set(state.datasets.flatMap((dataset) => dataset.cameras.map((channel) => channel.path)));
    for (const path of paths) {
      const pair = state.datasets.map((dataset) => [dataset, dataset.by_path.get(path)]).filter(([, channel]) => channel?.pictures.length);
      if (!pair.length) continue;
      const card = new CameraCard(path, pair);
      this.cards.push(card);
      this.list.append(card.element);
    }
    if (state.datasets.length > 1) {
      this.header.append(select("Which dataset's pictures", [["A", "A"], ["B", "B"], ["both", "A | B"], ["difference", "|A − B|"]], state.shown, (shown) => set("shown", shown)));
    }
    if (!this.cards.length) this.list.append(h("p.empty", {}, "No camera in this recording."));
  }
}
