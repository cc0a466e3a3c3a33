// The timeline: play, scrub, what is where. Events of datasets have a row for each kind at the top, then come findings of a diagnosis, then frames.

import { datasetColour, lineColour } from "../colours.js";
import { fitCanvas, h, number, select, themeColour } from "../dom.js";
import { on, set, setTime, setWindow, state } from "../state.js";

const FINDING_ROW = 7, EDGE = 10, EVENT_ROW = 11, EVENT_NAMES = 76, FREE_HEIGHT = 18;
const EVENT_KINDS = ["contact", "strike", "spill", "tip", "drop", "person_near"];

/** Steps of a readable axis over a span: 1, 2 or 5 times a power of ten, at least `least` apart. */
export function axisStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= least);
}

export class Timeline {
  constructor() {
    this.canvas = h("canvas", { tabIndex: 0, role: "slider", "aria-label": "Time; arrow keys step, drag to scrub, wheel to zoom" });
    this.play = h("button.play", { title: "Play or pause (space)", "aria-label": "Play", onclick: () => this.toggle() }, "▶");
    this.readout = h("output.time");
    this.element = h("footer.timeline", {}, this.play,
      h("button", { title: "A frame back (,)", "aria-label": "A frame back", onclick: () => this.step(-1) }, "◂"),
      h("button", { title: "A frame on (.)", "aria-label": "A frame on", onclick: () => this.step(1) }, "▸"),
      select("Speed", [["0.1", "0.1×"], ["0.25", "¼×"], ["1", "1×"], ["2", "2×"], ["5", "5×"], ["20", "20×"]], "1", (v) => set("speed", Number(v))),
      this.readout, this.canvas);
    this.findings = [];
    this.frames = [];
    this.events = [];
    this.event_rows = [];
    for (const event of ["time", "window", "theme", "playing", "findings"]) on(event, () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.#listen();
  }

  #listen() {
    const at = (event) => {
      const box = this.canvas.getBoundingClientRect(), [from, to] = state.window;
      return from + ((event.clientX - box.left - this.left) / (box.width - this.left - EDGE)) * (to - from);
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.pause();
      setTime(at(event));
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (event.buttons) return setTime(at(event));
      const box = this.canvas.getBoundingClientRect();
      this.canvas.title = this.eventsAt(event.clientX - box.left, event.clientY - box.top).map((one) => one.text).join("\n");
    });
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const t = at(event), [from, to] = state.window, factor = Math.exp(0.002 * event.deltaY);
      setWindow(t - (t - from) * factor, t + (to - t) * factor);
    }, { passive: false });
    this.canvas.addEventListener("dblclick", () => setWindow(state.from_s, state.to_s));
  }

  toggle() {
    if (state.is_playing) this.pause();
    else this.start();
  }

  start() {
    if (state.t_s >= state.to_s) setTime(state.from_s);
    set("is_playing", true, "playing");
    let last = performance.now();
    const go = (now) => {
      if (!state.is_playing) return;
      setTime(state.t_s + 1e-3 * (now - last) * state.speed);
      last = now;
      if (state.t_s >= state.to_s) this.pause();
      else requestAnimationFrame(go);
    };
    requestAnimationFrame(go);
  }

  pause() {
    if (state.is_playing) set("is_playing", false, "playing");
  }

  /** To the next frame of the first camera or lidar. */
  step(by) {
    this.pause();
    const times = this.frames[0];
    if (!times?.length) return setTime(state.t_s + 0.1 * by);
    const next = by > 0 ? times.find((t) => t > state.t_s + 1e-9) : times.findLast((t) => t < state.t_s - 1e-9);
    if (next !== undefined) setTime(next);
  }

  /** Where a time is drawn, in pixels from the left. */
  xOf(t_s, width) {
    const [from, to] = state.window;
    return this.left + ((t_s - from) / (to - from)) * (width - this.left - EDGE);
  }

  /** Where the axis begins: right of the names of events. */
  get left() {
    return this.events.length ? EVENT_NAMES : EDGE;
  }

  /** Events of a dataset, on the common axis of time. */
  addEvents(dataset) {
    const shift_s = 1e-9 * (dataset.index.shift_ns ?? 0);
    for (const event of dataset.index.events ?? []) {
      const from_s = event.from_s + shift_s, to_s = event.to_s + shift_s;
      const what = [[event.machine, event.part].filter(Boolean).join("/"), event.other].filter(Boolean).join(" – ");
      const text = `${event.kind.replace("_", " ")}: ${what}, ${number(event.value, 3)} ${event.unit}, ${from_s.toFixed(3)} to ${to_s.toFixed(3)} s`;
      this.events.push({ kind: event.kind, from_s, to_s, text, letter: dataset.letter });
    }
    this.event_rows = EVENT_KINDS.filter((kind) => this.events.some((event) => event.kind === kind));
    const needed = EVENT_ROW * this.event_rows.length - (this.findings.length ? 0 : FREE_HEIGHT);
    document.documentElement.style.setProperty("--events", `${Math.max(0, needed)}px`);
    this.draw();
  }

  /** Events drawn at a place of the canvas. */
  eventsAt(x, y) {
    const kind = this.event_rows[Math.floor(y / EVENT_ROW)], width = this.canvas.getBoundingClientRect().width;
    return this.events.filter((event) => event.kind === kind && x >= this.xOf(event.from_s, width) - 3 && x <= this.xOf(event.to_s, width) + 3);
  }

  draw() {
    const { context: c, width, height } = fitCanvas(this.canvas);
    this.play.textContent = state.is_playing ? "❚❚" : "▶";
    this.readout.textContent = `${state.t_s.toFixed(3)} s`;
    this.canvas.setAttribute("aria-valuenow", state.t_s.toFixed(3));
    c.clearRect(0, 0, width, height);
    this.#drawAxis(c, width, height);
    this.#drawFrames(c, width, height);
    this.#drawFindings(c, width);
    this.#drawEvents(c, width);
    const x = this.xOf(state.t_s, width);
    c.fillStyle = themeColour("cursor");
    c.fillRect(x - 0.75, 0, 1.5, height);
    c.beginPath();
    c.moveTo(x - 5, 0);
    c.lineTo(x + 5, 0);
    c.lineTo(x, 6);
    c.fill();
  }

  #drawAxis(c, width, height) {
    const [from, to] = state.window, step = axisStep(((to - from) * 70) / width);
    c.font = "11px system-ui, sans-serif";
    c.textAlign = "center";
    c.textBaseline = "alphabetic";
    for (let k = Math.ceil(from / step); k * step <= to; ++k) {
      const x = this.xOf(k * step, width);
      c.fillStyle = themeColour("line");
      c.fillRect(Math.round(x), 0, 1, height - 14);
      c.fillStyle = themeColour("muted");
      c.fillText(`${Number((k * step).toPrecision(9))} s`, x, height - 2);
    }
  }

  #drawFrames(c, width, height) {
    const rows = this.frames.slice(0, 4);
    rows.forEach((times, row) => {
      c.fillStyle = themeColour("faint");
      let last = -10;
      for (const t of times) {
        const x = this.xOf(t, width);
        if (x < this.left || x > width - EDGE || x - last < 1.5) continue;
        last = x;
        c.fillRect(x, height - 20 - 4 * row, 1, 3);
      }
    });
  }

  #drawEvents(c, width) {
    const two = state.datasets.length > 1;
    c.font = "10px system-ui, sans-serif";
    c.textAlign = "right";
    c.textBaseline = "middle";
    this.event_rows.forEach((kind, row) => {
      c.fillStyle = themeColour("muted");
      c.fillText(kind.replace("_", " "), EVENT_NAMES - 8, EVENT_ROW * (row + 0.5) + 0.5);
      c.fillStyle = themeColour("raised");
      c.fillRect(EVENT_NAMES, EVENT_ROW * row + 1, width - EVENT_NAMES - EDGE, EVENT_ROW - 2);
    });
    for (const event of this.events) {
      const from = Math.max(this.left, this.xOf(event.from_s, width)), to = Math.min(width - EDGE, this.xOf(event.to_s, width));
      if (to < from) continue;
      const row = this.event_rows.indexOf(event.kind), lower = two && event.letter === "B" ? 0.5 * EVENT_ROW : 0;
      c.fillStyle = two ? datasetColour(event.letter) : lineColour(EVENT_KINDS.indexOf(event.kind));
      c.fillRect(from, EVENT_ROW * row + 2 + lower, Math.max(3, to - from), two ? 0.5 * EVENT_ROW - 2 : EVENT_ROW - 4);
    }
  }

  #drawFindings(c, width) {
    this.bars = [];
    this.findings.forEach((finding, row) => {
      c.fillStyle = finding.colour;
      for (const [from, to] of finding.intervals_s) {
        const x = Math.max(this.left, this.xOf(from, width)), end = Math.min(width - EDGE, this.xOf(to, width));
        if (end < x) continue;
        const y = 2 + EVENT_ROW * this.event_rows.length + FINDING_ROW * (row % 5);
        c.globalAlpha = finding.is_chosen ? 1 : 0.6;
        c.fillRect(x, y, Math.max(2, end - x), FINDING_ROW - 2);
        this.bars.push({ finding, from, to, x, width: end - x });
      }
      c.globalAlpha = 1;
    });
  }
}
