// The timeline: play, scrub, what is where. Findings of a diagnosis lie above the axis, frames below it.

import { fitCanvas, h, select, themeColour } from "../dom.js";
import { on, set, setTime, setWindow, state } from "../state.js";

const FINDING_ROW = 7, EDGE = 10;

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
    for (const event of ["time", "window", "theme", "playing", "findings"]) on(event, () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.#listen();
  }

  #listen() {
    const at = (event) => {
      const box = this.canvas.getBoundingClientRect(), [from, to] = state.window;
      return from + ((event.clientX - box.left - EDGE) / (box.width - 2 * EDGE)) * (to - from);
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.pause();
      setTime(at(event));
    });
    this.canvas.addEventListener("pointermove", (event) => event.buttons && setTime(at(event)));
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
    return EDGE + ((t_s - from) / (to - from)) * (width - 2 * EDGE);
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
        if (x < EDGE || x > width - EDGE || x - last < 1.5) continue;
        last = x;
        c.fillRect(x, height - 20 - 4 * row, 1, 3);
      }
    });
  }

  #drawFindings(c, width) {
    this.bars = [];
    this.findings.forEach((finding, row) => {
      c.fillStyle = finding.colour;
      for (const [from, to] of finding.intervals_s) {
        const x = Math.max(EDGE, this.xOf(from, width)), end = Math.min(width - EDGE, this.xOf(to, width));
        if (end < x) continue;
        const y = 2 + FINDING_ROW * (row % 5);
        c.globalAlpha = finding.is_chosen ? 1 : 0.6;
        c.fillRect(x, y, Math.max(2, end - x), FINDING_ROW - 2);
        this.bars.push({ finding, from, to, x, width: end - x });
      }
      c.globalAlpha = 1;
    });
  }
}
