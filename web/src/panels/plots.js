// Plots of channels over time, one for each channel and unit, their cursors in step. Two datasets lie over each other, or their
// difference is drawn.

import uPlot from "uplot";
import { Newest } from "../calls.js";
import { lineColour } from "../colours.js";
import { nameAndUnit } from "../dataset.js";
import { h, number, themeColour, toggle } from "../dom.js";
import { on, set, setTime, setWindow, state, tell } from "../state.js";

const REFINED_BLOCKS = 2;
const PLOT_HEIGHT = 128;

/** The columns of a table by unit: [[unit, [column ...]]]. */
export function groupsOf(columns, path) {
  const groups = new Map();
  for (const column of columns) {
    const [, unit] = nameAndUnit(column, path);
    if (!groups.has(unit)) groups.set(unit, []);
    groups.get(unit).push(column);
  }
  return [...groups];
}

export class Plots {
  constructor() {
    this.plots = [];
    this.difference = false;
    this.list = h("div.plots");
    this.header = h("header", {}, h("h2", {}, "Plots"), this.hint = h("span.hint", {}, "drag: zoom · double click: all · click: go there"), h("span.space"));
    this.element = h("section.panel.plotpanel", { "aria-label": "Plots" }, this.header, this.list);
    this.values = new Newest(() => this.#values());
    on("time", () => this.#cursors());
    on("hover", () => this.#cursors());
    on("window", () => this.plots.forEach((plot) => plot.load.ask()));
    on("theme", () => this.plots.forEach((plot) => this.#remake(plot)));
    on("findings", () => this.plots.forEach((plot) => plot.chart?.redraw(false)));
    this.findings = [];
    on("finding", (finding) => this.showChannel(finding.channel));
    new ResizeObserver(() => this.plots.forEach((plot) => this.#resize(plot))).observe(this.list);
  }

  offerDifference() {
    this.header.append(toggle("A − B", "Draw the difference of the two datasets (D)", false, (is_on) => this.setDifference(is_on)));
  }

  setDifference(is_on) {
    this.difference = is_on;
    this.plots.forEach((plot) => {
      plot.chart?.destroy();
      plot.chart = null;
      plot.load.ask();
    });
  }

  has(path, unit) {
    return this.plots.some((plot) => plot.path === path && plot.unit === unit);
  }

  /** Adds or removes the plot of a channel's columns of one unit. */
  toggle(owner, channel, unit, columns) {
    const found = this.plots.findIndex((plot) => plot.path === channel.path && plot.unit === unit && plot.owner === owner);
    if (found >= 0) this.#close(this.plots[found]);
    else this.add(owner, channel, unit, columns);
    tell("plots");
  }

  /** `owner` is a dataset, or a diagnosis whose series it is. */
  add(owner, channel, unit, columns) {
    const others = state.datasets.filter((dataset) => dataset !== owner && dataset.by_path.has(channel.path) && state.datasets.includes(owner));
    const plot = { owner, path: channel.path, file: channel.file, unit, columns, hidden: new Set(), of: [owner, ...others] };
    plot.legend = h("div.legend");
    plot.box = h("div.chart");
    plot.status = h("span.hint");
    const [machine, ...rest] = channel.path.replace(/^truth\//, "").replace(/\.csv$/, "").split("/");
    const truth = channel.path.startsWith("truth/") ? "truth · " : "";
    plot.element = h("article.plot", { "data-path": channel.path }, h("div.title", {}, h("b", {}, rest.join("/") || machine),
      h("span.hint", {}, `${truth}${rest.length ? machine : ""}${unit ? `  [${unit}]` : ""}`), plot.status, plot.legend,
      h("button.close", { title: "Close this plot", "aria-label": "Close this plot", onclick: () => (this.#close(plot), tell("plots")) }, "×")), plot.box);
    plot.load = new Newest(() => this.#load(plot));
    this.plots.push(plot);
    this.list.append(plot.element);
    plot.load.ask();
    return plot;
  }

  /** Shows the channel that a finding is seen in: "excavator1/encoders/arm_radps". */
  showChannel(name) {
    const at = name.lastIndexOf("/"), path = name.slice(0, at), column = name.slice(at + 1), dataset = state.datasets[0];
    let plot = this.plots.find((one) => one.path === path && one.columns.includes(column));
    const channel = dataset?.by_path.get(path) ?? dataset?.by_path.get(`${path}.csv`);
    if (!plot && channel?.form === "rows") {
      const [, unit] = nameAndUnit(column, channel.path);
      plot = this.add(dataset, channel, unit, [column]);
      this.list.prepend(plot.element);
      tell("plots");
    }
    plot?.element.scrollIntoView({ block: "nearest" });
  }

  #close(plot) {
    plot.chart?.destroy();
    plot.element.remove();
    this.plots.splice(this.plots.indexOf(plot), 1);
  }

  async #load(plot) {
    const [from_s, to_s] = state.window, points = Math.max(200, Math.round(plot.box.clientWidth || 600));
    const ask = { columns: plot.columns, from_s, to_s, points };
    let data, lines;
    if (this.difference && plot.of.length > 1) {
      const d = await plot.owner.calls.call("difference", { a: { source: plot.of[0].source, path: plot.file },
        b: { source: plot.of[1].source, path: plot.file }, ...ask });
      if (!d) return;
      data = [d.t_s, ...d.values];
      plot.rms = d.rms;
      lines = plot.columns.map((column, k) => ({ column, k, letter: "A − B" }));
    } else {
      const all = (await Promise.all(plot.of.map((owner) => owner.call("series", { path: plot.file, ...ask })))).filter(Boolean);
      data = all.length === 1 ? [all[0].t_s, ...all[0].values] : uPlot.join(all.map((s) => [s.t_s, ...s.values]));
      lines = all.flatMap((_, i) => plot.columns.map((column, k) => ({ column, k, letter: plot.of.length > 1 ? plot.of[i].letter : "", dashed: i > 0 })));
      plot.status.textContent = all.every((s) => s.complete) ? "" : `reading ${Math.round(100 * all[0].share_read)} %`;
      if (!all.every((s) => s.complete)) this.#refine(plot);
    }
    if (plot.chart && plot.chart.series.length !== lines.length + 1) {
      plot.chart.destroy();
      plot.chart = null;
    }
    plot.data = data;
    plot.lines = lines;
    if (!plot.chart) this.#make(plot);
    else plot.chart.setData(data, false);
    plot.chart.setScale("x", { min: from_s, max: to_s });
    this.values.ask();
    tell("drawn", { panel: "plot", path: plot.path });
  }

  /** Goes on reading a long table while there is nothing else to do, until its overview is of all rows. */
  async #refine(plot) {
    if (plot.is_refining) return;
    plot.is_refining = true;
    for (const owner of plot.of) {
      for (let more = true; more && this.plots.includes(plot);) {
        const answer = await owner.call("refine", { path: plot.file, blocks: REFINED_BLOCKS });
        more = answer.more;
        plot.status.textContent = more ? `reading ${Math.round(100 * answer.share)} %` : "";
        do await new Promise((resolve) => setTimeout(resolve, 10));
        while (owner.calls.is_asked);
      }
    }
    plot.is_refining = false;
    plot.load.ask();
  }

  #make(plot) {
    const axis = { stroke: themeColour("muted"), grid: { stroke: themeColour("line"), width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    plot.chart = new uPlot({
      width: Math.max(50, plot.box.clientWidth), height: PLOT_HEIGHT, pxAlign: false,
      legend: { show: false },
      cursor: { y: false, drag: { x: true, y: false, setScale: false }, sync: { key: "tera" }, points: { size: 5 } },
      scales: { x: { time: false } },
      axes: [{ ...axis, size: 22, values: (_, ticks) => ticks.map((t) => `${Number(t.toPrecision(8))}`) },
        { ...axis, size: 52, values: (_, ticks) => ticks.map((v) => number(v, 3)) }],
      series: [{}, ...plot.lines.map((line, i) => ({ stroke: lineColour(line.k), width: 1.3, dash: line.dashed ? [5, 4] : [], spanGaps: true,
        points: { show: false }, show: !plot.hidden.has(i) }))],
      hooks: {
        setSelect: [(chart) => {
          if (chart.select.width < 4) return;
          setWindow(chart.posToVal(chart.select.left, "x"), chart.posToVal(chart.select.left + chart.select.width, "x"));
          chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        }],
        setCursor: [(chart) => {
          if (chart.root !== plot.pointed) return;
          const hover = chart.cursor.left >= 0 ? chart.posToVal(chart.cursor.left, "x") : null;
          if (hover !== state.hover_s) set("hover_s", hover, "hover");
        }],
        drawClear: [(chart) => this.#shade(chart)],
        draw: [(chart) => this.#line(chart)],
      },
    }, plot.data, plot.box);
    const over = plot.chart.over;
    over.addEventListener("pointerenter", () => (plot.pointed = plot.chart.root));
    over.addEventListener("pointerleave", () => {
      plot.pointed = null;
      set("hover_s", null, "hover");
    });
    let down = 0;
    over.addEventListener("pointerdown", (event) => (down = event.clientX));
    over.addEventListener("click", (event) => Math.abs(event.clientX - down) < 4 && setTime(plot.chart.posToVal(event.offsetX, "x")));
    over.addEventListener("dblclick", () => setWindow(state.from_s, state.to_s));
    this.#resize(plot);
  }

  #remake(plot) {
    if (!plot.chart) return;
    plot.chart.destroy();
    plot.chart = null;
    if (plot.data) {
      this.#make(plot);
      plot.chart.setScale("x", { min: state.window[0], max: state.window[1] });
      this.values.ask();
    }
  }

  #resize(plot) {
    const width = plot.box.clientWidth;
    if (plot.chart && width > 50 && plot.chart.width !== width) plot.chart.setSize({ width, height: PLOT_HEIGHT });
  }

  /** Intervals of the finding that is chosen, behind the lines. */
  #shade(chart) {
    const c = chart.ctx, chosen = this.findings.find((finding) => finding.is_chosen);
    if (!chosen) return;
    c.save();
    c.globalAlpha = 0.16;
    c.fillStyle = chosen.colour;
    for (const [from, to] of chosen.intervals_s) {
      const x = Math.max(chart.bbox.left, chart.valToPos(from, "x", true));
      const end = Math.min(chart.bbox.left + chart.bbox.width, chart.valToPos(to, "x", true));
      if (end > x) c.fillRect(x, chart.bbox.top, Math.max(2, end - x), chart.bbox.height);
    }
    c.restore();
  }

  #line(chart) {
    const x = chart.valToPos(state.t_s, "x", true);
    if (!(x >= chart.bbox.left && x <= chart.bbox.left + chart.bbox.width)) return;
    chart.ctx.fillStyle = themeColour("cursor");
    chart.ctx.fillRect(x - 0.75, chart.bbox.top, 1.5, chart.bbox.height);
  }

  #cursors() {
    if (!this.is_asked) {
      this.is_asked = true;
      requestAnimationFrame(() => {
        this.is_asked = false;
        this.plots.forEach((plot) => plot.chart?.redraw(false));
      });
    }
    this.values.ask();
  }

  /** The row in force under the cursor, of each plot, as the dataset has it. */
  async #values() {
    const t_s = state.hover_s ?? state.t_s;
    for (const owner of new Set(this.plots.flatMap((plot) => plot.of))) {
      const plots = this.plots.filter((plot) => plot.of.includes(owner) && plot.lines);
      const rows = await owner.call("rows", { paths: plots.map((plot) => plot.file), t_s });
      plots.forEach((plot, i) => {
        plot.row ??= {};
        plot.row[owner.letter] = rows[i] && { ...rows[i].now, columns: rows[i].columns };
      });
    }
    for (const plot of this.plots) if (plot.lines) this.#legend(plot);
  }

  #legend(plot) {
    plot.legend.replaceChildren(...plot.lines.map((line, i) => {
      const of = (letter) => {
        const row = plot.row?.[letter];
        return row ? row.values[row.columns.indexOf(line.column)] : NaN;
      };
      const value = line.letter === "A − B" ? of("A") - of("B") : of(line.letter || plot.owner.letter);
      const entry = h("button.entry", { title: `${line.column}: show or hide`, "data-column": line.column, "data-letter": line.letter, "data-value": String(value),
        "aria-pressed": String(!plot.hidden.has(i)) },
      h("i", { style: { background: line.dashed ? `repeating-linear-gradient(90deg, ${lineColour(line.k)} 0 4px, transparent 4px 7px)` : lineColour(line.k) } }),
      `${plot.of.length > 1 && line.letter !== "A − B" ? `${line.letter} ` : ""}${nameAndUnit(line.column, plot.path)[0]} `,
      h("span.num", {}, number(value, 4)), line.letter === "A − B" && plot.rms ? h("span.hint", {}, ` rms ${number(plot.rms[line.k], 3)}`) : null);
      entry.onclick = () => {
        if (plot.hidden.has(i)) plot.hidden.delete(i);
        else plot.hidden.add(i);
        plot.chart.setSeries(i + 1, { show: !plot.hidden.has(i) });
        this.#legend(plot);
      };
      return entry;
    }));
  }
}
