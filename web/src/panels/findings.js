// A diagnosis: what was found, where in time and in which regime, how large the error was before and after.

import uPlot from "uplot";
import { lineColour } from "../colours.js";
import { h, number, themeColour } from "../dom.js";
import { nameAndUnit } from "../dataset.js";
import { on, setTime, setWindow, tell } from "../state.js";

const words = (text) => (text ?? "").replaceAll("_", " ").replaceAll("/", " · ");

/** "0.121 ± 0.006 s" of each parameter. */
function parameterRows(parameters) {
  return Object.entries(parameters ?? {}).filter(([, one]) => one.determined !== false).map(([name, one]) => h("tr", {}, h("th", {}, words(nameAndUnit(name, "")[0])),
    h("td.num", {}, `${number(one.value, 3)}${one.sigma === null ? "" : ` ± ${number(one.sigma, 2)}`} ${one.unit === "1" ? "" : one.unit}`,
      one.instead_of !== undefined ? h("span.hint", {}, ` instead of ${number(one.instead_of, 3)}`) : null)));
}

function errorBars(held_out) {
  const { rmse_before: before, rmse_after: after, unit } = held_out, most = Math.max(before, after) || 1;
  const bar = (name, value, colour) => h("div.bar", {}, h("span", {}, name),
    h("i", {}, h("b", { style: { width: `${(100 * value) / most}%`, background: colour } })), h("span.num", {}, `${number(value, 2)} ${unit}`));
  return h("div.bars", {}, bar("before", before, lineColour(1)), bar("after", after, lineColour(0)));
}

function regimeText(regime) {
  if (!regime) return null;
  const range = regime.low === null ? "" : ` from ${number(regime.low, 3)} to ${number(regime.high, 3)}`;
  return h("p", {}, `${regime.error === "value" ? "The error" : "The error, as a share of the simulated value,"} depends on `,
    h("b", {}, words(regime.variable)), `${range}: ${regime.shape}`, regime.p === null ? "" : ` (p ${number(regime.p, 2)})`);
}

/** A regime's function with its band. */
function curveChart(curve, element) {
  const colour = lineColour(1), axis = { stroke: themeColour("muted"), grid: { stroke: themeColour("line"), width: 1 }, ticks: { show: false }, font: "10px system-ui, sans-serif" };
  return new uPlot({
    width: Math.max(120, element.clientWidth || 200), height: 130, legend: { show: false }, cursor: { show: false }, scales: { x: { time: false } },
    axes: [{ ...axis, size: 20 }, { ...axis, size: 44, values: (_, ticks) => ticks.map((v) => number(v, 2)) }],
    bands: [{ series: [3, 2], fill: `${colour}33` }],
    series: [{}, { stroke: colour, width: 1.6, points: { show: false } }, { stroke: "transparent", points: { show: false } }, { stroke: "transparent", points: { show: false } }],
  }, [curve.at, curve.mean, curve.low, curve.high], element);
}

export class Findings {
  constructor(diagnosis, index) {
    this.diagnosis = diagnosis;
    this.index = index;
    this.findings = diagnosis.findings.map((finding, k) => ({
      ...finding, is_unexplained: finding.mechanism === "unexplained", intervals_s: finding.intervals_s ?? [], is_chosen: false, rank: k,
      get colour() {
        return this.is_unexplained ? themeColour("faint") : lineColour(k + 2);
      },
      title: finding.mechanism === "unexplained" ? "unexplained" : words(finding.mechanism),
    }));
    on("theme", () => this.findings.forEach((finding) => (finding.mark.style.background = finding.colour)));
    this.element = h("div.findings", {}, this.#verdict(), this.findings.map((finding) => this.#card(finding)), this.#channels());
  }

  #verdict() {
    const verdict = this.diagnosis.verdict.map(words).join(", ");
    const whole = this.diagnosis.whole_simulation;
    return h("div.verdict", {}, h("b", {}, this.findings.length ? `${this.findings.length} finding${this.findings.length > 1 ? "s" : ""}` : "Nothing found"),
      h("span.hint", {}, ` verdict: ${verdict}`),
      whole?.path ? h("p", {}, `Way driven: recorded ${number(whole.path.recorded_m, 4)} m, simulated ${number(whole.path.before_m, 4)} m, with what was found ${number(whole.path.after_m, 4)} m.`) : null);
  }

  #card(finding) {
    const chips = finding.intervals_s.slice(0, 8).map(([from, to]) => h("button.chip", {
      title: "Show this interval", onclick: (event) => (event.stopPropagation(), this.choose(finding), setWindow(from - 0.3 * (to - from), to + 0.3 * (to - from)), setTime(from)),
    }, `${number(from, 4)}–${number(to, 4)} s`));
    const more = finding.intervals_s.length - chips.length;
    const chart = h("div.curve");
    const curve = finding.regime?.curve ?? null;
    finding.card = h("article.finding", { tabIndex: 0, onclick: () => this.choose(finding), onkeydown: (event) => event.key === "Enter" && this.choose(finding) },
      h("div.title", {}, finding.mark = h("i", { style: { background: finding.colour } }), h("b", {}, finding.title), h("span.hint", {}, words(finding.target ?? finding.channel))),
      finding.target && finding.channel !== finding.target ? h("p.hint", {}, `seen in ${words(nameAndUnit(finding.channel, "")[0])}`) : null,
      h("table", {}, parameterRows(finding.parameters)), errorBars(finding.held_out), regimeText(finding.regime),
      curve ? chart : null,
      finding.learned ? h("p", {}, `learned over ${words(finding.learned.variable)}: ${number(finding.learned.rmse_before, 2)} → ${number(finding.learned.rmse_after, 2)} ${finding.held_out.unit}`) : null,
      finding.class.length > 1 ? h("p", {}, `Not told apart from ${finding.class.filter((c) => c !== finding.mechanism).map(words).join(", ")}.`) : null,
      finding.evidence.p_confirmed !== null ? h("p.hint", {}, `chosen with p ${number(finding.evidence.p_chosen, 2)}, confirmed with p ${number(finding.evidence.p_confirmed, 2)}`) : null,
      chips.length ? h("div.chips", {}, chips, more > 0 ? h("span.hint", {}, `and ${more} more`) : null) : null);
    if (curve) {
      const draw = () => {
        finding.chart?.destroy();
        finding.chart = curveChart(curve, chart);
      };
      requestAnimationFrame(draw);
      on("theme", draw);
    }
    return finding.card;
  }

  #channels() {
    if (!this.diagnosis.channels?.length) return null;
    return h("details", {}, h("summary", {}, "Every channel"), h("table.channels", {}, h("tr", {}, ["channel", "noise", "before", "after", ""].map((t) => h("th", {}, t))),
      this.diagnosis.channels.map((line) => h("tr", {}, h("td", {}, words(nameAndUnit(line.channel, "")[0])), ...["noise", "before", "after"].map((key) => h("td.num", {}, number(line[key] ?? NaN, 2))),
        h("td.hint", {}, line.unit)))));
  }

  choose(finding) {
    for (const other of this.findings) {
      other.is_chosen = other === finding && !finding.is_chosen;
      other.card.classList.toggle("chosen", other.is_chosen);
    }
    tell("findings");
    if (finding.is_chosen) tell("finding", finding);
  }

  /** Goes to the next finding or the one before. */
  step(by) {
    if (!this.findings.length) return;
    const now = this.findings.findIndex((finding) => finding.is_chosen), next = this.findings[(now + by + this.findings.length) % this.findings.length];
    if (!next.is_chosen) this.choose(next);
    next.card.scrollIntoView({ block: "nearest" });
    if (next.intervals_s.length) setTime(next.intervals_s[0][0]);
  }
}
