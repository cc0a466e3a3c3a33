"""Poses over time."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tera.data.table import Table


def pose_matrix(xyz_m: np.ndarray, quaternion_wxyz: np.ndarray) -> np.ndarray:
    """4 x 4 poses from ... x 3 places and ... x 4 Hamilton quaternions, w first."""
    q = np.asarray(quaternion_wxyz, dtype=float)
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    X = np.zeros(q.shape[:-1] + (4, 4))
    X[..., 0, 0], X[..., 0, 1], X[..., 0, 2] = 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)
    X[..., 1, 0], X[..., 1, 1], X[..., 1, 2] = 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)
    X[..., 2, 0], X[..., 2, 1], X[..., 2, 2] = 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
    X[..., :3, 3] = xyz_m
    X[..., 3, 3] = 1
    return X


def inverse(X_AB: np.ndarray) -> np.ndarray:
    """X_BA, of ... x 4 x 4 poses."""
    X_BA = np.zeros_like(X_AB)
    R_BA = np.swapaxes(X_AB[..., :3, :3], -1, -2)
    X_BA[..., :3, :3] = R_BA
    X_BA[..., :3, 3] = -(R_BA @ X_AB[..., :3, 3:])[..., 0]
    X_BA[..., 3, 3] = 1
    return X_BA


def transformed(X_AB: np.ndarray, p_B: np.ndarray) -> np.ndarray:
    """N x 3 points of frame B in frame A."""
    return np.asarray(p_B) @ X_AB[:3, :3].T + X_AB[:3, 3]


class PoseTrack:
    """The pose of a frame B in W over time, from a file of a recording.

    Between two rows places go straight and turns along the shortest arc (slerp). Nothing is told outside the rows.
    """

    def __init__(self, file: Path):
        self.table = Table(file)

    def __len__(self) -> int:
        return len(self.table)

    @property
    def t_ns(self) -> np.ndarray:
        """Stamps, N int64."""
        return self.table.t_ns

    @property
    def X_WB(self) -> np.ndarray:
        """All rows, N x 4 x 4."""
        return pose_matrix(self.table.values[:, :3], self.table.values[:, 3:7])

    def at(self, t_ns: int | np.ndarray) -> np.ndarray:
        """X_WB at a time, 4 x 4, or at M times, M x 4 x 4. Raises ValueError outside the rows."""
        at_ns = np.atleast_1d(np.asarray(t_ns, dtype=np.int64))
        if not len(at_ns):
            return np.empty((0, 4, 4))
        stamps = self.t_ns
        if not len(stamps) or at_ns.min() < stamps[0] or at_ns.max() > stamps[-1]:
            extent = f"{stamps[0]} to {stamps[-1]} ns" if len(stamps) else "nothing"
            raise ValueError(f"{self.table.file} covers {extent}; asked for {at_ns.min()} to {at_ns.max()} ns")
        after = np.clip(np.searchsorted(stamps, at_ns, side="right"), 1, max(len(stamps) - 1, 1))
        before = after - 1
        after = np.minimum(after, len(stamps) - 1)
        span = np.maximum(stamps[after] - stamps[before], 1)
        share = ((at_ns - stamps[before]) / span)[:, None]
        values = self.table.values
        xyz_m = (1 - share) * values[before, :3] + share * values[after, :3]
        X = pose_matrix(xyz_m, slerp(values[before, 3:7], values[after, 3:7], share))
        return X if np.ndim(t_ns) else X[0]


def slerp(q0: np.ndarray, q1: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Unit quaternions, M x 4, a share (M x 1) of the way from q0 to q1. Source: Shoemake 1985."""
    cosine = np.sum(q0 * q1, axis=1, keepdims=True)
    q1 = np.where(cosine < 0, -q1, q1)
    angle = np.arccos(np.clip(np.abs(cosine), 0, 1))
    small = angle < 1e-6
    sine = np.where(small, 1, np.sin(angle))
    a = np.where(small, 1 - share, np.sin((1 - share) * angle) / sine)
    b = np.where(small, share, np.sin(share * angle) / sine)
    return a * q0 + b * q1
