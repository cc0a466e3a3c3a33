"""What happened in a simulation: contacts, strikes, spills, tips, drops, people near machines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np


_UNITS = {"contact": "N", "strike": "N s", "spill": "kg", "tip": "rad", "drop": "m", "person_near": "m"}


class Event(NamedTuple):
    """A row of truth/events.csv (docs/reference/dataset.md#events)."""

    t_ns: int  #: its beginning
    end_ns: int
    kind: str
    machine: str
    part: str
    other: str
    value: float
    unit: str


class Events:
    """All events of a recording in order of their beginning: `len`, `[k]`, iteration, `.of("contact")`."""

    def __init__(self, file: Path):
        self.file = Path(file)
        header, *rows = self.file.read_text(encoding="utf-8").splitlines()
        if header != ",".join(Event._fields):
            raise ValueError(f"{self.file}:1: found the columns {header!r}; need {','.join(Event._fields)!r}")
        self._events = [self._event(line, row.split(",")) for line, row in enumerate(rows, 2)]

    def _event(self, line: int, fields: list[str]) -> Event:
        try:
            begin, end, kind, machine, part, other, value, unit = fields
            event = Event(int(begin), int(end), kind, machine, part, other, float(value), unit)
            if event.end_ns < event.t_ns:
                raise ValueError(f"ends at {end}, before it begins at {begin}; need a later end")
            if kind not in _UNITS:
                raise ValueError(f"unknown kind {kind!r}; need one of {', '.join(_UNITS)}")
            if not (math.isfinite(event.value) and event.value >= 0):
                raise ValueError(f"value {value}; need a number from 0")
            if unit != _UNITS[kind]:
                raise ValueError(f"unit {unit!r}; need {_UNITS[kind]!r} for {kind}")
            return event
        except ValueError as error:
            raise ValueError(f"{self.file}:{line}: {error}") from None

    @property
    def t_ns(self) -> np.ndarray:
        """Beginnings, N int64; several may be equal."""
        return np.array([event.t_ns for event in self._events], dtype=np.int64)

    def __len__(self) -> int:
        return len(self._events)

    def __getitem__(self, k: int) -> Event:
        return self._events[k]

    def __iter__(self) -> Iterator[Event]:
        return iter(self._events)

    def of(self, kind: str) -> list[Event]:
        """Events of a kind."""
        return [event for event in self._events if event.kind == kind]

    def at(self, t_ns: int) -> list[Event]:
        """Events that go on at a time."""
        return [event for event in self._events if event.t_ns <= t_ns <= event.end_ns]
