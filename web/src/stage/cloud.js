// Scans as points in the world.

import * as THREE from "three";
import { LINEAR, VIRIDIS, lineColour, numberColour, scaleColour } from "../colours.js";

const MOST_POINTS = 2_000_000;

/** Where a scan's points are in W: each at the time of its own ray, the sensor going straight from X_begin to X_end. */
export function pointsInWorld(scan, X_begin, X_end) {
  const a = X_begin.elements, b = X_end.elements, n = scan.count, out = new Float32Array(3 * n);
  let longest = 1;
  if (scan.time) for (let k = 0; k < n; ++k) if (scan.time[k] > longest) longest = scan.time[k];
  for (let k = 0; k < n; ++k) {
    const x = scan.x[k], y = scan.y[k], z = scan.z[k], s = scan.time ? scan.time[k] / longest : 0;
    for (let i = 0; i < 3; ++i) {
      const p = a[i] * x + a[4 + i] * y + a[8 + i] * z + a[12 + i];
      const q = b[i] * x + b[4 + i] * y + b[8 + i] * z + b[12 + i];
      out[3 * k + i] = p + s * (q - p);
    }
  }
  return out;
}

/** Lowest and highest of what a cloud is coloured by, for its key; null where it has no scale. */
export function rangeOf(by, scan, points_W) {
  if (by === "class" || by === "instance" || by === "dataset") return null;
  const values = valuesOf(by, scan, points_W);
  if (!values) return null;
  const sorted = Float32Array.from(values).sort();
  const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
  return sorted.length ? [at(0.01), at(0.99)] : null;
}

function valuesOf(by, scan, points_W) {
  if (by === "height") return Float32Array.from({ length: scan.count }, (_, k) => points_W[3 * k + 2]);
  if (by === "range") return Float32Array.from({ length: scan.count }, (_, k) => Math.hypot(scan.x[k], scan.y[k], scan.z[k]));
  if (by === "time") return scan.time && Float32Array.from(scan.time, (t) => 1e-9 * t);
  return scan[by];
}

/** Colours of points, three bytes each. */
export function coloursOf(by, scan, points_W, range, classes, letter) {
  const colours = new Uint8Array(3 * scan.count), rgb = [0, 0, 0];
  const fixed = new THREE.Color(lineColour(letter === "A" ? 0 : 1)).convertLinearToSRGB();
  const values = range ? valuesOf(by, scan, points_W) : null;
  for (let k = 0; k < scan.count; ++k) {
    if (by === "class" && scan.label) {
      const of = classes[scan.label[k]]?.rgb ?? [255, 255, 255];
      for (let c = 0; c < 3; ++c) rgb[c] = of[c];
    } else if (by === "instance" && scan.instance) {
      if (scan.instance[k]) numberColour(scan.instance[k], rgb);
      else rgb.fill(120);
    } else if (values) {
      scaleColour(VIRIDIS, (values[k] - range[0]) / Math.max(1e-9, range[1] - range[0]), rgb);
    } else {
      rgb[0] = 255 * fixed.r;
      rgb[1] = 255 * fixed.g;
      rgb[2] = 255 * fixed.b;
    }
    for (let c = 0; c < 3; ++c) colours[3 * k + c] = LINEAR[Math.round(rgb[c])];
  }
  return colours;
}

/** Points of several scans as one object, its memory kept from one to the next. */
export class Cloud {
  constructor() {
    this.material = new THREE.PointsMaterial({ size: 2.5, sizeAttenuation: false, vertexColors: true });
    this.object = new THREE.Points(new THREE.BufferGeometry(), this.material);
    this.object.frustumCulled = false;
    this.capacity = 0;
    this.points_W = new Float32Array(0);
    this.parts = [];
  }

  /** Each part: { scan, points_W, colours, channel, dataset, t_s }. */
  show(parts) {
    const count = Math.min(MOST_POINTS, parts.reduce((sum, part) => sum + part.scan.count, 0));
    if (count > this.capacity) {
      this.capacity = Math.ceil(1.25 * count);
      this.object.geometry.dispose();
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * this.capacity), 3));
      geometry.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(3 * this.capacity), 3, true));
      this.object.geometry = geometry;
    }
    this.parts = parts;
    this.count = count;
    if (this.capacity === 0) return;
    const { position, color } = this.object.geometry.attributes;
    let at = 0;
    for (const part of parts) {
      const room = Math.min(part.scan.count, count - at);
      position.array.set(part.points_W.subarray(0, 3 * room), 3 * at);
      color.array.set(part.colours.subarray(0, 3 * room), 3 * at);
      at += room;
    }
    position.needsUpdate = true;
    color.needsUpdate = true;
    this.object.geometry.setDrawRange(0, count);
  }

  /** The point nearest to a ray within so many pixels, as { part, index, p_W }, or null. */
  pick(camera, width, height, x, y, within = 8) {
    const M = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    let best = null, least = within * within, nearest = Infinity;
    for (const part of this.parts) {
      const p = part.points_W;
      for (let k = 0; k < part.scan.count; ++k) {
        const X = p[3 * k], Y = p[3 * k + 1], Z = p[3 * k + 2];
        const w = M[3] * X + M[7] * Y + M[11] * Z + M[15];
        if (w <= 0) continue;
        const u = 0.5 * (1 + (M[0] * X + M[4] * Y + M[8] * Z + M[12]) / w) * width - x;
        const v = 0.5 * (1 - (M[1] * X + M[5] * Y + M[9] * Z + M[13]) / w) * height - y;
        const apart = u * u + v * v;
        if (apart > least || (apart > 0.5 * least && w > nearest)) continue;
        least = Math.max(apart, 1);
        nearest = w;
        best = { part, index: k, p_W: [X, Y, Z] };
      }
    }
    return best;
  }
}
