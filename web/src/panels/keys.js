// All of the page by keyboard.

import { h } from "../dom.js";
import { set, setTime, setWindow, state } from "../state.js";

const KEYS = [["Space", "play or pause"], ["← →", "a hundredth of what the plots show back or on; with Shift a tenth"], [", .", "a frame back or on"],
  ["Home End", "to the beginning or the end"], ["+ − 0", "zoom in, out, all"], ["[ ]", "finding before or after"], ["O", "more overlay on pictures"],
  ["B", "boxes of objects"], ["C", "next colour of points"], ["S", "which dataset's pictures, of two"], ["D", "difference of two datasets"],
  ["F", "view follows the machine"], ["T", "dark or light"], ["/", "filter channels"], ["?", "these keys"]];
const COLOURS = ["class", "intensity", "height", "range", "time", "ring", "instance", "dataset"];
const SHOWN = ["A", "B", "both", "difference"];

export function helpDialog() {
  const dialog = h("dialog.help", { "aria-label": "Keys" }, h("h2", {}, "Keys"),
    h("table", {}, KEYS.map(([key, what]) => h("tr", {}, h("th", {}, key), h("td", {}, what)))),
    h("p.hint", {}, "3-D: drag turns, right drag moves, wheel comes nearer. Point at a picture or a scan to see the place in both."),
    h("form", { method: "dialog" }, h("button", {}, "Close")));
  return dialog;
}

function next(list, value) {
  return list[(list.indexOf(value) + 1) % list.length];
}

export function listenToKeys({ timeline, plots, view, cameras, findings, help, theme, channels }) {
  const zoom = (factor) => {
    const [from, to] = state.window, half = 0.5 * (to - from) * factor;
    setWindow(state.t_s - half, state.t_s + half);
  };
  const step = (share) => {
    timeline.pause();
    setTime(state.t_s + share * (state.window[1] - state.window[0]));
  };
  const press = (panel, title) => [...panel.element.querySelectorAll("header .toggle")].find((button) => button.title.startsWith(title))?.click();
  const actions = {
    " ": () => timeline.toggle(), ",": () => timeline.step(-1), ".": () => timeline.step(1), "+": () => zoom(0.5), "=": () => zoom(0.5), "-": () => zoom(2),
    0: () => setWindow(state.from_s, state.to_s), "[": () => findings?.step(-1), "]": () => findings?.step(1), "?": () => help.showModal(),
    Home: () => setTime(state.from_s), End: () => setTime(state.to_s),
    o: () => {
      state.opacity = state.opacity >= 1 ? 0 : Math.min(1, state.opacity + 0.25);
      cameras.opacity.value = state.opacity;
      set("opacity", state.opacity, "overlay");
    },
    b: () => press(cameras, "Boxes"), f: () => press(view, "Let the view follow"), d: () => press(plots, "Draw the difference"),
    c: () => {
      const colour = next(COLOURS, state.colour_by);
      view.element.querySelector("select").value = colour;
      set("colour_by", colour);
    },
    s: () => {
      const chooser = cameras.header.querySelector("select[aria-label^='Which']");
      if (!chooser) return;
      chooser.value = next(SHOWN, state.shown);
      set("shown", chooser.value);
    },
    t: () => theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"),
    "/": () => channels.search.focus(),
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) || help.open) return;
    if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
      step((event.key === "ArrowLeft" ? -1 : 1) * (event.shiftKey ? 0.1 : 0.01));
    } else {
      const action = actions[event.key] ?? actions[event.key.toLowerCase()];
      if (!action || (event.key === " " && event.target.tagName === "BUTTON")) return;
      action();
    }
    event.preventDefault();
  });
}
