"""Cameras' optics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Lens:
    """A pinhole with Brown-Conrady distortion, as OpenCV has it (Brown 1971).

    C is the optical frame: x right, y down, z forward. Pixel (0, 0) is the centre of the upper left pixel.
    """

    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    k1: float = 0
    k2: float = 0
    p1: float = 0
    p2: float = 0
    k3: float = 0

    @property
    def K(self) -> np.ndarray:
        """3 x 3 camera matrix."""
        return np.array([[self.fx_px, 0, self.cx_px], [0, self.fy_px, self.cy_px], [0, 0, 1]], dtype=float)

    @property
    def distortion(self) -> np.ndarray:
        """k1, k2, p1, p2, k3, in OpenCV's order."""
        return np.array([self.k1, self.k2, self.p1, self.p2, self.k3], dtype=float)

    def project(self, p_C_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pixels (u, v), N x 2, and depths z, N, of N x 3 points in C. Points behind the camera have pixels NaN."""
        p = np.asarray(p_C_m, dtype=float)
        z = p[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            x, y = np.where(z > 0, p[:, 0] / z, np.nan), np.where(z > 0, p[:, 1] / z, np.nan)
        r2 = x * x + y * y
        radial = 1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
        u = self.fx_px * (x * radial + 2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x)) + self.cx_px
        v = self.fy_px * (y * radial + self.p1 * (r2 + 2 * y * y) + 2 * self.p2 * x * y) + self.cy_px
        return np.column_stack([u, v]), z

    def rays(self, pixels_px: np.ndarray) -> np.ndarray:
        """Directions (x, y, 1) in C of N x 2 pixels, N x 3, by fixed-point iteration on the distortion."""
        u = np.asarray(pixels_px, dtype=float)
        distorted = np.column_stack([(u[:, 0] - self.cx_px) / self.fx_px, (u[:, 1] - self.cy_px) / self.fy_px])
        at = distorted.copy()
        for _ in range(50):
            x, y = at[:, 0], at[:, 1]
            r2 = x * x + y * y
            radial = 1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3))
            tangent = np.column_stack([2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x),
                                       self.p1 * (r2 + 2 * y * y) + 2 * self.p2 * x * y])
            at = (distorted - tangent) / radial[:, None]
        return np.column_stack([at, np.ones(len(at))])

    def points(self, depth_m: np.ndarray) -> np.ndarray:
        """Points in C of a planar depth picture, N x 3, those of pixels without a depth left out."""
        v, u = np.nonzero(depth_m > 0)
        return self.rays(np.column_stack([u, v])) * depth_m[v, u][:, None]
