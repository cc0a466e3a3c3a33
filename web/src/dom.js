/** An element: h("button.plain", { title, onclick }, "text", child ...). */
export function h(name, properties = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const element = document.createElement(tag || "div");
  if (classes.length) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(properties)) {
    if (key === "style") Object.assign(element.style, value);
    else if (key.startsWith("aria-") || key === "role" || key === "for" || key.startsWith("data-")) element.setAttribute(key, value);
    else element[key] = value;
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** A chooser: options are [value, text]. */
export function select(label, options, value, onchange) {
  return h("select", { title: label, "aria-label": label, onchange: (event) => onchange(event.target.value) },
    options.map(([key, text]) => h("option", { value: key, selected: key === value }, text)));
}

/** A button that is on or off. */
export function toggle(text, title, is_on, onchange) {
  const button = h("button.toggle", { title, type: "button", "aria-pressed": String(is_on) }, text);
  button.onclick = () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    onchange(on);
  };
  return button;
}

/** A canvas as large as its box, with its scale of pixels. */
export function fitCanvas(canvas) {
  const box = canvas.getBoundingClientRect(), scale = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(box.width * scale)), height = Math.max(1, Math.round(box.height * scale));
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const context = canvas.getContext("2d");
  context.setTransform(scale, 0, 0, scale, 0, 0);
  return { context, width: box.width, height: box.height };
}

/** The value of a CSS variable of the theme in force. */
export function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** A number with so many significant digits, without a tail of noughts. */
export function number(value, digits = 4) {
  if (!Number.isFinite(value)) return "–";
  if (Math.abs(value) >= 10 ** digits && Math.abs(value) < 1e5) return String(Math.round(value)).replace("-", "−");
  const text = Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-4) ? value.toExponential(digits - 1) : value.toPrecision(digits);
  return (text.includes(".") && !text.includes("e") ? text.replace(/\.?0+$/, "") : text).replace("-", "−");
}
