// Cameras' optics: from points in C (x right, y down, z forward) to pixels and back, by the laws of docs/reference/scenario.md.

const MOST_STEPS = 40;

export class Lens {
  constructor(model) {
    this.m = { k1: 0, k2: 0, k3: 0, k4: 0, k5: 0, k6: 0, p1: 0, p2: 0, ...model };
    this.is_angular = model.law === "kannala_brandt" || model.law === "f_theta";
  }

  #distorted(x, y) {
    const { k1, k2, k3, k4, k5, k6, p1, p2 } = this.m, r2 = x * x + y * y;
    const radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
    return [x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y];
  }

  #radius(t) {
    const { k1, k2, k3, k4, law } = this.m, s = law === "f_theta" ? t : t * t;
    return t * (1 + s * (k1 + s * (k2 + s * (k3 + s * k4))));
  }

  /** [u, v, depth] of a point in C, or null where the lens does not see it. */
  project([x, y, z]) {
    const { fx_px, fy_px, cx_px, cy_px } = this.m;
    let at, depth = z;
    if (this.is_angular) {
      const across = Math.hypot(x, y), scale = across > 0 ? this.#radius(Math.atan2(across, z)) / across : 0;
      at = [x * scale, y * scale];
      depth = Math.hypot(x, y, z);
    } else {
      if (z <= 0) return null;
      at = this.#distorted(x / z, y / z);
    }
    return [fx_px * at[0] + cx_px, fy_px * at[1] + cy_px, depth];
  }

  /** The point in C that a pixel shows at a depth as the depth picture has it. */
  point(u, v, depth) {
    const { fx_px, fy_px, cx_px, cy_px } = this.m;
    const dx = (u - cx_px) / fx_px, dy = (v - cy_px) / fy_px;
    if (this.is_angular) {
      const rho = Math.hypot(dx, dy);
      let low = 0, high = Math.PI;
      for (let k = 0; k < MOST_STEPS; ++k) {
        const middle = 0.5 * (low + high);
        if (this.#radius(middle) < rho) low = middle;
        else high = middle;
      }
      const s = rho > 0 ? Math.sin(low) / rho : 0;
      return [depth * dx * s, depth * dy * s, depth * Math.cos(low)];
    }
    let x = dx, y = dy;  // fixed-point steps, as OpenCV undistorts
    for (let k = 0; k < MOST_STEPS; ++k) {
      const [px, py] = this.#distorted(x, y);
      x += dx - px;
      y += dy - py;
    }
    return [depth * x, depth * y, depth];
  }
}
