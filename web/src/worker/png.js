// PNGs of labels: a canvas would take away their 16 bits.

import { inflate } from "./inflate.js";

const SAMPLES = { 0: 1, 2: 3 };

function unfilter(raw, width, height, pixel_bytes) {
  const stride = width * pixel_bytes, out = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)], from = y * (stride + 1) + 1, to = y * stride, up = to - stride;
    for (let i = 0; i < stride; ++i) {
      const left = i >= pixel_bytes ? out[to + i - pixel_bytes] : 0;
      const above = y > 0 ? out[up + i] : 0;
      let guess = 0;
      if (filter === 1) guess = left;
      else if (filter === 2) guess = above;
      else if (filter === 3) guess = (left + above) >> 1;
      else if (filter === 4) {
        const corner = i >= pixel_bytes && y > 0 ? out[up + i - pixel_bytes] : 0;
        const p = left + above - corner, a = Math.abs(p - left), b = Math.abs(p - above), c = Math.abs(p - corner);
        guess = a <= b && a <= c ? left : b <= c ? above : corner;
      }
      out[to + i] = raw[from + i] + guess;
    }
  }
  return out;
}

/** { width, height, samples, values }: grey or RGB, of 8 or 16 bits. */
export async function readPng(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < 33 || view.getUint32(0) !== 0x89504e47) throw new Error("is no PNG");
  const width = view.getUint32(16), height = view.getUint32(20), bits = bytes[24], samples = SAMPLES[bytes[25]];
  if (!samples || (bits !== 8 && bits !== 16)) throw new Error("is a PNG of another form than labels have");
  const parts = [];
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at), kind = view.getUint32(at + 4);
    if (kind === 0x49444154) parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const packed = new Uint8Array(parts.reduce((sum, p) => sum + p.length, 0));
  parts.reduce((at, p) => (packed.set(p, at), at + p.length), 0);
  const raw = unfilter(await inflate(packed), width, height, (samples * bits) / 8);
  if (bits === 8) return { width, height, samples, values: raw };
  const values = new Uint16Array(width * height * samples);
  for (let k = 0; k < values.length; ++k) values[k] = (raw[2 * k] << 8) | raw[2 * k + 1];
  return { width, height, samples, values };
}
