// What all panels share: the time, the window of time that plots show, what is pointed at, what is chosen.

const listeners = new Map();

export const state = {
  t_s: 0,
  from_s: 0,
  to_s: 1,
  window: [0, 1],       // of plots and timeline
  hover_s: null,        // time under the pointer in a plot
  is_playing: false,
  speed: 1,
  datasets: [],         // Dataset, at most two: A and B
  diagnoses: [],
  colour_by: "class",
  overlay: "semantic",
  opacity: 0,
  boxes: true,
  shown: "A",           // pictures: A, B, both, difference
  point: null,          // pointed at: { p_W, text, from }
};

export function on(event, listener) {
  if (!listeners.has(event)) listeners.set(event, []);
  listeners.get(event).push(listener);
}

export function tell(event, detail) {
  for (const listener of listeners.get(event) ?? []) listener(detail);
}

export function setTime(t_s) {
  const t = Math.min(state.to_s, Math.max(state.from_s, t_s));
  if (t === state.t_s) return;
  state.t_s = t;
  const [from, to] = state.window;
  if (t < from || t > to) setWindow(t - 0.5 * (to - from), t + 0.5 * (to - from));
  tell("time");
}

export function setWindow(from_s, to_s) {
  const shortest = Math.max(1e-3, 1e-6 * (state.to_s - state.from_s));
  const length = Math.min(state.to_s - state.from_s, Math.max(shortest, to_s - from_s));
  const from = Math.min(state.to_s - length, Math.max(state.from_s, from_s));
  state.window = [from, from + length];
  tell("window");
}

export function set(key, value, event = key) {
  state[key] = value;
  tell(event);
}
