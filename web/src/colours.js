// Colours that people with any colour vision can tell apart (Okabe and Ito 2008; viridis). Classes of a dataset have the colours of
// its overview; beside them there is always a name.

export { DIVERGING, VIRIDIS, numberColour, scaleColour } from "./worker/colour.js";

const ON_DARK = ["#56b4e9", "#e69f00", "#2ec4a0", "#f0e442", "#cc79a7", "#ff7f50", "#9aa7ff", "#b8c4d0"];
const ON_LIGHT = ["#0072b2", "#b86b00", "#00795a", "#8a7a00", "#a8447f", "#c2410c", "#4653c4", "#5d6b7a"];

export function isDark() {
  return document.documentElement.dataset.theme !== "light";
}

/** Of each of 256 values of sRGB (IEC 61966-2-1) the linear one, in which vertices have their colours. */
export const LINEAR = Uint8Array.from({ length: 256 }, (_, k) => {
  const s = k / 255;
  return Math.round(255 * (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4));
});

/** Of the k-th line of a plot. */
export function lineColour(k) {
  const colours = isDark() ? ON_DARK : ON_LIGHT;
  return colours[k % colours.length];
}

/** What a dataset is drawn in where it stands beside another. */
export function datasetColour(letter) {
  return letter === "A" ? lineColour(0) : lineColour(1);
}
