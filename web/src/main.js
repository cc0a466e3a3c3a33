// The page of `tera view`: reads the index, lays out the panels, and draws the first picture before anything else.

import { Calls } from "./calls.js";
import { Dataset } from "./dataset.js";
import { h } from "./dom.js";
import { Cameras } from "./panels/cameras.js";
import { Channels } from "./panels/channels.js";
import { Findings } from "./panels/findings.js";
import { listenToKeys, helpDialog } from "./panels/keys.js";
import { SiteMap } from "./panels/map.js";
import { Plots, groupsOf } from "./panels/plots.js";
import { Timeline } from "./panels/timeline.js";
import { View3d } from "./panels/view3d.js";
import { on, setTime, state, tell } from "./state.js";

const FIRST_PLOTS = 4;
const PLOTTED_FIRST = ["encoder", "imu", "gnss", "table"];
const LARGEST_FIRST = 64e6;  // bytes of a table that is plotted unasked

/** Index and packed files of an exported page, or what the server says. */
async function readIndex() {
  const head = document.getElementById("pack-head");
  if (!head) return { index: await (await fetch("index.json")).json(), pack: null };
  const { index, places } = JSON.parse(head.textContent);
  const text = document.getElementById("pack-bytes");
  const bytes = await (await fetch(`data:application/octet-stream;base64,${text.textContent.trim()}`)).arrayBuffer();
  text.remove();
  return { index, pack: { places, bytes } };
}

function theme(name) {
  document.documentElement.dataset.theme = name;
  try {
    localStorage.setItem("theme", name);
  } catch { /* a page of a file may have no storage */ }
  tell("theme");
}

function firstTheme() {
  let kept = null;
  try {
    kept = localStorage.getItem("theme");
  } catch { /* as above */ }
  return kept ?? (matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
}

function topBar(index, panels) {
  const readout = h("output.readout");
  on("point", () => {
    const p = state.point?.p_W;
    readout.textContent = state.point ? `${state.point.text}${p && Number.isFinite(p[0]) ? `   (${p.map((x) => x.toFixed(3)).join(", ")}) m` : ""}` : "";
  });
  const names = index.viewed.map((one, k) => h("span.name", { title: one.kind }, state.datasets.length > 1 && one.kind === "dataset" ? h("b", {}, `${state.datasets.find((d) => d.source === k).letter} `) : null,
    one.name, h("span.hint", {}, one.kind === "diagnosis" ? " diagnosis" : one.simulated ? " simulated" : " real")));
  return h("header.top", {}, h("h1", {}, "TERA"), names, index.excerpt ? h("span.hint.excerpt", {}, index.excerpt) : null,
    index.times ? h("span.hint.times", { title: index.times }, `times: ${index.times}`) : null, h("span.space"), readout,
    h("button", { title: "Dark or light (T)", "aria-label": "Dark or light", onclick: () => theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark") }, "◐"),
    h("button", { title: "Keys (?)", "aria-label": "Keys", onclick: () => panels.help.showModal() }, "?"));
}

/** At phone width one panel is shown at a time. */
function tabBar(root, tabs) {
  const bar = h("nav.tabs", { role: "tablist" }, tabs.map(([name, text]) => h("button", { role: "tab", type: "button", "data-tab": name, onclick: () => choose(name) }, text)));
  const choose = (name) => {
    root.dataset.tab = name;
    for (const button of bar.children) button.setAttribute("aria-selected", String(button.dataset.tab === name));
    tell("show_panel", name);
  };
  choose(tabs[0][0]);
  return bar;
}

function sidePanel(channels, findings) {
  const body = h("div.side-body");
  const show = (name) => {
    body.replaceChildren(...(name === "findings" ? findings.map((one) => one.element) : [channels.element]));
    for (const button of bar.children) button.setAttribute("aria-selected", String(button.dataset.side === name));
  };
  const bar = h("header", {}, findings.length ? h("button.tab", { "data-side": "findings", role: "tab", onclick: () => show("findings") }, "Findings") : null,
    h("button.tab", { "data-side": "channels", role: "tab", onclick: () => show("channels") }, "Channels"));
  show(findings.length ? "findings" : "channels");
  return h("aside.panel.side", { "aria-label": "Channels and findings" }, bar, body);
}

/** Drags of the borders between panels move the lines of the grid. */
function splitter(root, name, axis, low, high) {
  const element = h(`div.splitter.${name}`, { role: "separator", tabIndex: 0, "aria-label": `Border of ${name}` });
  element.addEventListener("pointerdown", (event) => element.setPointerCapture(event.pointerId));
  element.addEventListener("pointermove", (event) => {
    if (!event.buttons) return;
    const box = root.getBoundingClientRect();
    const share = axis === "x" ? (box.right - event.clientX) / box.width : (box.bottom - event.clientY) / box.height;
    root.style.setProperty(`--${name}`, `${(100 * Math.min(high, Math.max(low, share))).toFixed(2)}%`);
  });
  return element;
}

/** The spans of all that is viewed. */
async function findTimes() {
  let from = Infinity, to = -Infinity;
  for (const dataset of state.datasets) {
    const shift_s = 1e-9 * (dataset.index.shift_ns ?? 0);
    from = Math.min(from, shift_s);
    to = Math.max(to, dataset.index.duration_s + shift_s);
  }
  for (const diagnosis of state.diagnoses) {
    for (const [a, b] of diagnosis.findings.flatMap((finding) => finding.intervals_s)) {
      from = Math.min(from, a);
      to = Math.max(to, b);
    }
  }
  if (!(to > from)) [from, to] = [0, 1];
  state.from_s = from;
  state.to_s = to;
  state.window = [from, to];
  state.t_s = from;
}

/** A few plots to begin with: of each kind of channel the first, then more. */
async function firstPlots(plots) {
  const dataset = state.datasets[0];
  if (!dataset) return;
  const wanted = dataset.tables.filter((channel) => !channel.path.startsWith("truth/") && channel.type !== "pose" && channel.bytes < LARGEST_FIRST);
  const ranked = wanted.toSorted((a, b) => PLOTTED_FIRST.indexOf(a.type) - PLOTTED_FIRST.indexOf(b.type));
  const firsts = ranked.filter((channel, k) => ranked.findIndex((other) => other.type === channel.type) === k);
  let left = FIRST_PLOTS;
  for (const channel of [...firsts, ...dataset.tables.filter((c) => c.path.startsWith("truth/"))]) {
    if (left === 0) break;
    const { columns, is_empty } = await dataset.call("table", { path: channel.file });
    if (is_empty) continue;
    const groups = groupsOf(columns, channel.path);
    const [unit, of] = groups.find(([u]) => channel.type === "gnss" && u === "m") ?? groups[0] ?? [];
    if (!of) continue;
    plots.add(dataset, channel, unit, of);
    --left;
  }
  tell("plots");
}

async function stages(pack, index) {
  await Promise.all(state.datasets.map(async (dataset) => {
    if (!index.viewed[dataset.source].has_stage) return;
    if (pack) {
      const place = pack.places[`${dataset.source}/stage`], error = pack.places[`${dataset.source}/stage.error`];
      if (!place) dataset.stage_error = error ? new TextDecoder().decode(pack.bytes.slice(error[0], error[0] + error[1])) : "not part of this excerpt";
      else await dataset.loadStage(URL.createObjectURL(new Blob([pack.bytes.slice(place[0], place[0] + place[1])])));
    } else {
      await dataset.loadStage(`stage/${dataset.source}`);
    }
  }));
  tell("stage");
}

async function start() {
  const begun = performance.now();
  theme(firstTheme());
  const { index, pack } = await readIndex();
  const calls = new Calls();
  const list = index.viewed.map((one, k) => ({
    base: new URL(`data/${k}/`, location.href).href, prefix: `${k}/`, classes: one.classes ?? [], shift_ns: one.shift_ns ?? 0,
    sizes: Object.fromEntries([...(one.channels ?? []).map((c) => [c.file, c.bytes]), ...Object.entries(one.series ?? {})]),
  }));
  await calls.open({ list, pack });
  index.viewed.forEach((one, k) => {
    if (one.kind === "dataset") state.datasets.push(new Dataset(k, "AB"[state.datasets.length], one, calls));
    else state.diagnoses.push(Object.assign(new Findings(one.diagnosis, one), { source: k, calls }));
  });
  await findTimes();
  if (state.datasets.length > 1) state.shown = "both";

  const timeline = new Timeline(), plots = new Plots(), cameras = new Cameras(), view = new View3d(), map = new SiteMap(), channels = new Channels(plots);
  const findings = state.diagnoses.flatMap((diagnosis) => diagnosis.findings);
  timeline.findings = plots.findings = findings;
  state.datasets.forEach((dataset) => timeline.addEvents(dataset));
  const help = helpDialog();
  const root = h("main.grid");
  root.append(sidePanel(channels, state.diagnoses), view.element, cameras.element, plots.element, map.element,
    splitter(root, "right", "x", 0.15, 0.6), splitter(root, "lower", "y", 0.15, 0.75));
  if (!state.datasets.some((dataset) => dataset.cameras.length)) root.classList.add("no-cameras");
  if (!state.datasets.length) root.classList.add("no-datasets");
  const tabs = [["view3d", "3-D"], ["cameras", "Cameras"], ["plots", "Plots"], ["map", "Map"], ["side", state.diagnoses.length ? "Findings" : "Channels"]];
  document.body.append(topBar(index, { help }), root, tabBar(root, tabs), timeline.element, help);
  document.title = `${index.viewed.map((one) => one.name).join(" · ")} – TERA`;
  if (state.datasets.length > 1) plots.offerDifference();
  listenToKeys({ timeline, plots, view, cameras, findings: state.diagnoses[0], help, theme, channels });

  const app = { state, timeline, plots, cameras, view, map, calls, setTime, drawn: [], findings: state.diagnoses };
  window.tera = app;
  on("drawn", (what) => app.drawn.push({ ...what, at_ms: performance.now() - begun }) > 2000 && app.drawn.shift());

  cameras.fill();
  await Promise.all(cameras.cards.slice(0, 2).map((card) => card.update.ask()));
  app.first_picture_ms = performance.now();
  cameras.cards.forEach((card) => card.update.ask());
  view.update.ask();
  timeline.frames = await Promise.all(state.datasets.flatMap((dataset) => [...dataset.cameras, ...dataset.lidars].map(async (c) => (await dataset.frames(c)).t_s)));
  timeline.draw();
  await firstPlots(plots);
  await Promise.all([stages(pack, index), channels.fill(), map.fill()]);
  await diagnosisData(map, plots);
  app.is_ready = true;
  tell("ready");
}

/** Maps and series that a diagnosis brings. */
async function diagnosisData(map, plots) {
  for (const diagnosis of state.diagnoses) {
    map.places.push(...diagnosis.findings.filter((finding) => finding.place));
    for (const name of Object.keys(diagnosis.index.grounds)) await map.addGround(await diagnosis.calls.call("raster", { source: diagnosis.source, path: name }));
    const owner = { letter: "A", source: diagnosis.source, calls: diagnosis.calls, call: (method, args) => diagnosis.calls.call(method, { source: diagnosis.source, ...args }) };
    for (const name of Object.keys(diagnosis.index.series)) {
      const { columns, is_empty } = await owner.call("table", { path: name });
      if (is_empty) continue;
      for (const [unit, of] of groupsOf(columns, name)) plots.add(owner, { path: `why/${name}`, file: name }, unit, of);
    }
  }
  map.draw();
}

start().catch((error) => {
  document.body.append(h("p.fatal", { role: "alert" }, `This page cannot be shown: ${error.message}`));
  console.error(error);
});
