// Colours of label pictures. Scales are perceptually even and safe for colour-blind eyes: viridis (van der Walt and Smith 2015)
// sampled at eleven places, and a blue-orange one that is white at zero.

export const VIRIDIS = [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140], [34, 168, 132],
  [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37]];
export const DIVERGING = [[5, 48, 97], [33, 102, 172], [67, 147, 195], [146, 197, 222], [209, 229, 240], [247, 247, 247],
  [253, 219, 180], [244, 165, 90], [214, 112, 30], [179, 82, 6], [127, 59, 8]];

/** The colour of a scale at s in [0, 1], each channel 0 to 255. */
export function scaleColour(scale, s, out = [0, 0, 0]) {
  const x = Math.min(1, Math.max(0, s)) * (scale.length - 1), i = Math.min(scale.length - 2, Math.floor(x)), f = x - i;
  for (let c = 0; c < 3; ++c) out[c] = scale[i][c] + f * (scale[i + 1][c] - scale[i][c]);
  return out;
}

/** Different numbers, different colours, by steps of the golden angle of hue at two lightnesses. */
export function numberColour(n, out = [0, 0, 0]) {
  if (n === 0) return out.fill(0);
  const hue = ((n * 137.508) % 360) / 60, light = n % 2 ? 0.62 : 0.45, chroma = (1 - Math.abs(2 * light - 1)) * 0.75;
  const x = chroma * (1 - Math.abs((hue % 2) - 1)), low = light - chroma / 2;
  const rgb = [[chroma, x, 0], [x, chroma, 0], [0, chroma, x], [0, x, chroma], [x, 0, chroma], [chroma, 0, x]][Math.floor(hue) % 6];
  for (let c = 0; c < 3; ++c) out[c] = 255 * (rgb[c] + low);
  return out;
}

const NEAREST_MM = 500, FURTHEST_MM = 30000;

const OPAQUE = 0xff000000;

/** RGBA of each pixel; `colourOf(values, at, rgb)` sets its colour, and is false where it has none. Of pictures of one number each number is asked for once. */
function paint({ width, height, samples, values }, colourOf) {
  const rgba = new Uint32Array(width * height), rgb = [0, 0, 0];
  const packed = (at) => {
    if (!colourOf(values, at, rgb)) return 0;
    const [r, g, b] = rgb.map(Math.round);
    return (OPAQUE | (b << 16) | (g << 8) | r) >>> 0;
  };
  if (samples > 1) {
    for (let k = 0; k < rgba.length; ++k) rgba[k] = packed(samples * k);
  } else {
    const known = new Float64Array(1 << (8 * values.BYTES_PER_ELEMENT)).fill(-1);
    for (let k = 0; k < rgba.length; ++k) {
      const value = values[k];
      if (known[value] < 0) known[value] = packed(k);
      rgba[k] = known[value];
    }
  }
  return new Uint8ClampedArray(rgba.buffer);
}

function flowColour(values, at, rgb) {
  if (!values[at + 2] && !values[at]) return false;
  const u = (values[at] - 32768) / 64, v = (values[at + 1] - 32768) / 64;
  const strength = Math.min(1, Math.hypot(u, v) / 16), angle = Math.atan2(v, u);
  for (let c = 0; c < 3; ++c) rgb[c] = 255 * (1 - strength * (0.5 - 0.5 * Math.cos(angle - (2 * Math.PI * c) / 3)));
  return true;
}

/** RGBA of a label picture; what means nothing is transparent. */
export function paintLabel(kind, picture, classes) {
  const set = (rgb, colour) => (([rgb[0], rgb[1], rgb[2]] = colour), true);
  switch (kind) {
    case "semantic":
      return paint(picture, (v, k, rgb) => set(rgb, classes[v[k]]?.rgb ?? [255, 255, 255]));
    case "panoptic":
      return paint(picture, (v, k, rgb) => {
        const instance = v[k + 1] + 256 * v[k + 2];
        return instance > 0 ? (numberColour(instance, rgb), true) : set(rgb, classes[v[k]]?.rgb ?? [255, 255, 255]);
      });
    case "instance":
    case "ground_soil":
    case "soil_in_flight":
      return paint(picture, (v, k, rgb) => v[k] > 0 && (numberColour(v[k], rgb), true));
    case "depth":
    case "distance":
      return paint(picture, (v, k, rgb) => {
        const s = Math.log(v[k] / NEAREST_MM) / Math.log(FURTHEST_MM / NEAREST_MM);
        return v[k] > 0 && (scaleColour(VIRIDIS, 1 - s, rgb), true);
      });
    case "ground_age":
      return paint(picture, (v, k, rgb) => v[k] > 0 && (scaleColour(VIRIDIS, v[k] === 65535 ? 0 : 1 - v[k] / 600, rgb), true));
    case "dust_optical_depth":
      return paint(picture, (v, k, rgb) => v[k] > 0 && (scaleColour(VIRIDIS, 1 - Math.exp(-v[k] / 1000), rgb), true));
    case "lens_soiling":
      return paint(picture, (v, k, rgb) => (scaleColour(VIRIDIS, v[k] / 255, rgb), true));
    case "ground_change":
      return paint(picture, (v, k, rgb) => v[k] > 0 && (scaleColour(DIVERGING, 0.5 + (v[k] - 32768) / 1000, rgb), true));
    case "flow_to_previous":
    case "flow_to_this":
      return paint(picture, flowColour);
    default: {  // three components around a middle, or 8-bit colours
      const shift = picture.values instanceof Uint16Array ? 256 : 1;
      return paint(picture, (v, k, rgb) => {
        for (let c = 0; c < 3; ++c) rgb[c] = v[k + c] / shift;
        return v[k] + v[k + 1] + v[k + 2] > 0;
      });
    }
  }
}
