"""What `tera diagnose` says."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Diagnosis:
    """A diagnosis.json. `raw` holds all of it; docs/reference/diagnose.md says what its keys mean."""

    verdict: list[str]
    findings: list[dict]
    channels: list[dict]
    raw: dict

    def named(self, target: str | None = None) -> list[dict]:
        """Findings that name a mechanism, of one target where it is given, the first the largest."""
        named = [finding for finding in self.findings if finding.get("mechanism")]
        return [finding for finding in named if target is None or finding.get("target") == target]


def diagnosis(path: str | Path) -> Diagnosis:
    """Reads a diagnosis, of a folder that `tera diagnose` wrote or of the file itself."""
    file = Path(path)
    file = file / "diagnosis.json" if file.is_dir() else file
    with file.open(encoding="utf-8") as text:
        raw = json.load(text)
    if "findings" not in raw or "verdict" not in raw:
        raise ValueError(f"{file} has no findings and verdict; need a diagnosis.json of tera diagnose")
    return Diagnosis(raw["verdict"], raw["findings"], raw.get("channels", []), raw)
