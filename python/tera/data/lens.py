"""Cameras' optics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_ANGULAR = ("kannala_brandt", "f_theta")


@dataclass(frozen=True)
class Lens:
    """A camera's lens, as OpenCV has it: Brown-Conrady's or the rational model, or a fisheye, `lens` being the law.

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
    lens: str = "brown_conrady"
    k4: float = 0
    k5: float = 0
    k6: float = 0
    field_of_view_deg: float = 180

    def __post_init__(self):
        if self.lens not in ("brown_conrady", "rational", *_ANGULAR):
            raise ValueError(f"lens '{self.lens}' is not known; need brown_conrady, rational, kannala_brandt or f_theta")

    @property
    def is_angular(self) -> bool:
        """Whether it follows the angle from the axis: then depth is the distance along the ray, not z."""
        return self.lens in _ANGULAR

    @property
    def K(self) -> np.ndarray:
        """3 x 3 camera matrix."""
        return np.array([[self.fx_px, 0, self.cx_px], [0, self.fy_px, self.cy_px], [0, 0, 1]], dtype=float)

    @property
    def distortion(self) -> np.ndarray:
        """The coefficients in OpenCV's order: k1, k2, p1, p2, k3 (k4, k5, k6), or of a fisheye k1 to k4."""
        if self.is_angular:
            return np.array([self.k1, self.k2, self.k3, self.k4], dtype=float)
        five = [self.k1, self.k2, self.p1, self.p2, self.k3]
        return np.array(five + ([self.k4, self.k5, self.k6] if self.lens == "rational" else []), dtype=float)

    def project(self, p_C_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pixels (u, v), N x 2, and depths, N, of N x 3 points in C. Points that the lens does not see have pixels NaN."""
        p = np.asarray(p_C_m, dtype=float)
        if self.is_angular:
            across = np.hypot(p[:, 0], p[:, 1])
            theta = np.arctan2(across, p[:, 2])
            theta = np.where(theta <= np.radians(self.field_of_view_deg) / 2, theta, np.nan)
            rho = self._radius(theta)[0]
            with np.errstate(divide="ignore", invalid="ignore"):
                scale = np.where(across > 0, rho / across, 0 * rho)
            depth = np.linalg.norm(p, axis=1)
            x, y = p[:, 0] * scale, p[:, 1] * scale
        else:
            depth = p[:, 2]
            with np.errstate(divide="ignore", invalid="ignore"):
                x, y = np.where(depth > 0, p[:, 0] / depth, np.nan), np.where(depth > 0, p[:, 1] / depth, np.nan)
            radial, tangent = self._radial(x, y), self._tangent(x, y)
            x, y = x * radial + tangent[0], y * radial + tangent[1]
        return np.column_stack([self.fx_px * x + self.cx_px, self.fy_px * y + self.cy_px]), depth

    def rays(self, pixels_px: np.ndarray) -> np.ndarray:
        """The points of depth 1 in C that N x 2 pixels see, N x 3: (x, y, 1), or of a fisheye unit vectors, NaN where it sees nothing."""
        u = np.asarray(pixels_px, dtype=float)
        distorted = np.column_stack([(u[:, 0] - self.cx_px) / self.fx_px, (u[:, 1] - self.cy_px) / self.fy_px])
        if self.is_angular:
            rho = np.linalg.norm(distorted, axis=1)
            theta = self._angle(rho)
            with np.errstate(divide="ignore", invalid="ignore"):
                side = np.where(rho[:, None] > 0, distorted / rho[:, None], 0)
            return np.column_stack([side * np.sin(theta)[:, None], np.cos(theta)])
        at = self._undistorted(distorted)
        return np.column_stack([at, np.ones(len(at))])

    def _distorted(self, at: np.ndarray) -> np.ndarray:
        x, y = at[:, 0], at[:, 1]
        return at * self._radial(x, y)[:, None] + np.column_stack(self._tangent(x, y))

    def _undistorted(self, distorted: np.ndarray) -> np.ndarray:
        """By Newton's method, each step no further than the picture is wide; NaN where it finds nothing."""
        step, at = 1e-6, distorted.copy()
        with np.errstate(all="ignore"):
            for _ in range(60):
                off = self._distorted(at) - distorted
                dx = (self._distorted(at + [step, 0]) - self._distorted(at - [step, 0])) / (2 * step)
                dy = (self._distorted(at + [0, step]) - self._distorted(at - [0, step])) / (2 * step)
                det = dx[:, 0] * dy[:, 1] - dx[:, 1] * dy[:, 0]
                move = np.column_stack([dy[:, 1] * off[:, 0] - dy[:, 0] * off[:, 1],
                                        dx[:, 0] * off[:, 1] - dx[:, 1] * off[:, 0]]) / det[:, None]
                length = np.linalg.norm(move, axis=1, keepdims=True)
                at = at - move * np.minimum(1, 0.3 * (1 + np.linalg.norm(at, axis=1, keepdims=True)) / length)
                if np.nanmax(length, initial=0) < 1e-12:
                    break
            found = np.linalg.norm(self._distorted(at) - distorted, axis=1) < 1e-8
        return np.where(found[:, None], at, np.nan)

    def points(self, depth_m: np.ndarray) -> np.ndarray:
        """Points in C of a depth picture, N x 3, those of pixels without a depth left out."""
        v, u = np.nonzero(depth_m > 0)
        return self.rays(np.column_stack([u, v])) * depth_m[v, u][:, None]

    def _radial(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        r2 = x * x + y * y
        return ((1 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3)))
                / (1 + r2 * (self.k4 + r2 * (self.k5 + r2 * self.k6))))

    def _tangent(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        r2 = x * x + y * y
        return (2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x), self.p1 * (r2 + 2 * y * y) + 2 * self.p2 * x * y)

    def _radius(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Focal lengths from the principal point at an angle, and the derivative."""
        k1, k2, k3, k4 = self.k1, self.k2, self.k3, self.k4
        if self.lens == "f_theta":
            return (t * (1 + t * (k1 + t * (k2 + t * (k3 + t * k4)))),
                    1 + t * (2 * k1 + t * (3 * k2 + t * (4 * k3 + t * 5 * k4))))
        t2 = t * t
        return (t * (1 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4)))),
                1 + t2 * (3 * k1 + t2 * (5 * k2 + t2 * (7 * k3 + t2 * 9 * k4))))

    def _angle(self, rho: np.ndarray) -> np.ndarray:
        """The angle within the field at which the radius is `rho`, by bisection; NaN beyond."""
        edge = np.radians(self.field_of_view_deg) / 2
        low, high = np.zeros_like(rho), np.full_like(rho, edge)
        for _ in range(60):
            middle = (low + high) / 2
            is_below = self._radius(middle)[0] < rho
            low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
        return np.where(rho <= self._radius(np.array(edge))[0], (low + high) / 2, np.nan)
