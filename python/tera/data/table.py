"""Rows over time: inertial units, receivers, encoders, levers, truth."""

from __future__ import annotations

from pathlib import Path

import numpy as np


class Table:
    """A CSV file of a recording, read when first asked for.

    `table["wx_radps"]` is a column of N numbers; `table.values` holds all of them, N x C float64; `table.t_ns` are the
    stamps, N int64, strictly increasing.
    """

    def __init__(self, file: Path):
        self.file = Path(file)
        with self.file.open(encoding="utf-8") as lines:
            header = lines.readline().rstrip("\n").split(",")
        if header[:1] != ["t_ns"]:
            raise ValueError(f"{self.file}:1: found the columns {header}; need t_ns as the first")
        self.columns: tuple[str, ...] = tuple(header[1:])
        self._read: tuple[np.ndarray, np.ndarray] | None = None

    def _rows(self) -> tuple[np.ndarray, np.ndarray]:
        if self._read is None:
            with self.file.open(encoding="utf-8") as lines:
                rows = lines.read().splitlines()[1:]
            t_ns = np.array([row.partition(",")[0] for row in rows], dtype=np.int64)
            values = np.empty((len(rows), len(self.columns)))
            if values.size:
                values[:] = np.loadtxt(rows, delimiter=",", usecols=range(1, 1 + len(self.columns)), ndmin=2)
            self._read = t_ns, values
        return self._read

    @property
    def t_ns(self) -> np.ndarray:
        """Stamps, N int64."""
        return self._rows()[0]

    @property
    def t_s(self) -> np.ndarray:
        """Stamps in seconds, N float64."""
        return self.t_ns * 1e-9

    @property
    def values(self) -> np.ndarray:
        """All columns but the stamps, N x C float64, in the order of `columns`."""
        return self._rows()[1]

    def __getitem__(self, column: str) -> np.ndarray:
        """One column, N float64. Raises KeyError with the names that there are."""
        if column not in self.columns:
            raise KeyError(f"{self.file} has no column {column!r}; it has {', '.join(self.columns)}")
        return self.values[:, self.columns.index(column)]

    def __len__(self) -> int:
        return len(self.t_ns)

    def at(self, t_ns: int) -> dict[str, float]:
        """The last row that is not after a time. Raises ValueError before the first."""
        row = last_not_after(self.t_ns, t_ns, str(self.file))
        return dict(zip(self.columns, self.values[row]))


def last_not_after(stamps_ns: np.ndarray, t_ns: int, name: str) -> int:
    """Place of the last stamp that is not after a time."""
    place = int(np.searchsorted(stamps_ns, t_ns, side="right")) - 1
    if place < 0:
        first = f"begins at {stamps_ns[0]} ns" if len(stamps_ns) else "is empty"
        raise ValueError(f"{name} {first}; asked for {t_ns} ns")
    return place


def nearest(stamps_ns: np.ndarray, t_ns: int, name: str) -> int:
    """Place of the stamp that is nearest to a time; of two, the earlier."""
    if not len(stamps_ns):
        raise ValueError(f"{name} is empty; asked for {t_ns} ns")
    return int(np.argmin(np.abs(stamps_ns - t_ns)))
