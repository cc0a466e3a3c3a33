// The list of channels: what there is, and which of it is plotted.

import { h } from "../dom.js";
import { on, state } from "../state.js";
import { groupsOf } from "./plots.js";

const KINDS = { pictures: "camera", scans: "lidar" };

function size(bytes) {
  return bytes > 1e9 ? `${(bytes / 1e9).toFixed(1)} GB` : bytes > 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${Math.ceil(bytes / 1e3)} kB`;
}

export class Channels {
  constructor(plots) {
    this.plots = plots;
    this.search = h("input", { type: "search", placeholder: "Filter channels (/)", "aria-label": "Filter channels", oninput: () => this.#filter() });
    this.list = h("div.tree");
    this.element = h("div.channels", {}, this.search, this.list);
    this.rows = [];
    on("plots", () => this.#refresh());
  }

  /** One section for each machine, truth after what was measured. */
  async fill() {
    const seen = new Set(), sections = new Map();
    for (const dataset of state.datasets) {
      for (const channel of dataset.channels) {
        if (seen.has(channel.path)) continue;
        seen.add(channel.path);
        const parts = channel.path.split("/"), section = parts[0] === "truth" ? `truth · ${parts[1]}` : parts[0];
        if (!sections.has(section)) sections.set(section, []);
        sections.get(section).push({ dataset, channel });
      }
    }
    const order = [...sections].sort(([a], [b]) => a.startsWith("truth") - b.startsWith("truth"));
    for (const [name, entries] of order) {
      const box = h("div.entries");
      this.list.append(h("details", { open: !name.startsWith("truth · ") || order.length < 6 }, h("summary", {}, name, h("span.hint", {}, ` ${entries.length}`)), box));
      for (const entry of entries) box.append(await this.#entry(entry));
    }
  }

  async #entry({ dataset, channel }) {
    const short = channel.path.replace(/^truth\/[^/]+\//, "").replace(/^[^/]+\//, "").replace(/\.csv$/, "");
    if (channel.form !== "rows") {
      const row = h("div.channel", { "data-path": channel.path }, h("span", {}, short), h("span.hint", {}, KINDS[channel.form]));
      this.rows.push({ row, channel });
      return row;
    }
    const { columns, is_empty, error } = await dataset.call("table", { path: channel.file });
    const groups = is_empty ? [] : groupsOf(columns, channel.path);
    const buttons = groups.map(([unit, of]) => {
      const button = h("button.unit", { type: "button", title: `${of.join(", ")}: plot or not`, onclick: () => this.plots.toggle(dataset, channel, unit, of) }, unit || (of.length === 1 ? of[0] : `${of.length} columns`));
      return { button, unit };
    });
    const row = h("div.channel", { "data-path": channel.path, title: size(channel.bytes) }, h("span", {}, short), h("span.units", {}, is_empty || !groups.length ? h("span.hint", {}, error ?? (is_empty ? "empty" : "no columns")) : buttons.map((one) => one.button)));
    this.rows.push({ row, channel, buttons });
    return row;
  }

  #refresh() {
    for (const { channel, buttons } of this.rows) {
      for (const { button, unit } of buttons ?? []) button.setAttribute("aria-pressed", String(this.plots.has(channel.path, unit)));
    }
  }

  #filter() {
    const wanted = this.search.value.toLowerCase();
    for (const { row, channel } of this.rows) row.hidden = !channel.path.toLowerCase().includes(wanted);
  }
}
