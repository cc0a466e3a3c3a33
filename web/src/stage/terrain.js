// The ground as a mesh, from the raster that is nearest before the time shown.

import * as THREE from "three";
import { DIVERGING, LINEAR, VIRIDIS, scaleColour } from "../colours.js";

const MOST_ACROSS = 260;
const SEMI_MAJOR_M = 6378137, E2 = 0.00669437999014;
const START = "height_start.tif", END = "height_end.tif";

/** Times of a dataset's height rasters: [[t_s, name]], the start and the end among them. */
export function heightTimes(index, from_s, to_s) {
  const times = [];
  for (const name of index.terrain) {
    if (name === START) times.push([from_s, name]);
    else if (name === END) times.push([to_s, name]);
    const stamp = name.match(/^height_(-?\d+)\.tif$/);
    if (stamp) times.push([1e-9 * Number(stamp[1]), name]);
  }
  return times.sort((a, b) => a[0] - b[0]);
}

/** Heights in W of a raster of heights above the ellipsoid: less the origin's, and the ellipsoid falls away from its plane. */
export function toWorld(raster, origin) {
  const s = Math.sin((origin.lat_deg * Math.PI) / 180), w = 1 - E2 * s * s;
  const across_m = SEMI_MAJOR_M / Math.sqrt(w), along_m = (SEMI_MAJOR_M * (1 - E2)) / (w * Math.sqrt(w));
  for (let j = 0; j < raster.ny; ++j) {
    const y = raster.south_m + (j + 0.5) * raster.cell_m;
    for (let i = 0; i < raster.nx; ++i) {
      const x = raster.west_m + (i + 0.5) * raster.cell_m;
      raster.values[j * raster.nx + i] -= origin.height_m + (x * x) / (2 * across_m) + (y * y) / (2 * along_m);
    }
  }
  return raster;
}

/** The value of the pixel that holds (x, y), or NaN. */
export function valueAt(raster, x, y) {
  const i = Math.floor((x - raster.west_m) / raster.cell_m), j = Math.floor((y - raster.south_m) / raster.cell_m);
  return i < 0 || j < 0 || i >= raster.nx || j >= raster.ny ? NaN : raster.values[j * raster.nx + i];
}

export class Terrain {
  constructor() {
    this.material = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide });
    this.object = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
  }

  /** `plain` is the ground's own colour; `compared` a raster of which the difference is shown, where `by` says so. `scale_m` of the difference's colours. */
  show(raster, by, plain, compared = null, scale_m = 0.5) {
    const n = Math.max(1, Math.ceil(Math.max(raster.nx, raster.ny) / MOST_ACROSS));
    const nx = Math.floor((raster.nx - 1) / n) + 1, ny = Math.floor((raster.ny - 1) / n) + 1;
    const positions = new Float32Array(3 * nx * ny), colours = new Uint8Array(3 * nx * ny), rgb = [0, 0, 0];
    let low = Infinity, high = -Infinity;
    for (let k = 0; k < raster.values.length; k += 97) {
      low = Math.min(low, raster.values[k]);
      high = Math.max(high, raster.values[k]);
    }
    for (let j = 0; j < ny; ++j) {
      for (let i = 0; i < nx; ++i) {
        const k = j * nx + i, x = raster.west_m + (i * n + 0.5) * raster.cell_m, y = raster.south_m + (j * n + 0.5) * raster.cell_m;
        const z = raster.values[j * n * raster.nx + i * n];
        positions.set([x, y, Number.isFinite(z) ? z : 0], 3 * k);
        if (by === "height") scaleColour(VIRIDIS, (z - low) / (high - low || 1), rgb);
        else if (by === "change" && compared) scaleColour(DIVERGING, 0.5 + (z - valueAt(compared, x, y)) / (2 * scale_m), rgb);
        else for (let c = 0; c < 3; ++c) rgb[c] = plain[c];
        for (let c = 0; c < 3; ++c) colours[3 * k + c] = LINEAR[Math.round(rgb[c])];
      }
    }
    const indices = new Uint32Array(6 * (nx - 1) * (ny - 1));
    let at = 0;
    for (let j = 0; j + 1 < ny; ++j) {
      for (let i = 0; i + 1 < nx; ++i) {
        const a = j * nx + i;
        indices.set([a, a + 1, a + nx + 1, a, a + nx + 1, a + nx], at);
        at += 6;
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3, true));
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    geometry.computeVertexNormals();
    this.object.geometry.dispose();
    this.object.geometry = geometry;
    this.range = [low, high];
  }
}
