#!/usr/bin/env python3
"""Makes a small dataset with all labels, before a digging machine and behind a lens, and has check_labels.py judge it.

    judge_labels.py TERA
"""

import subprocess
import sys
import tempfile
from pathlib import Path

LABELS = ("[semantic,instance,normal,distance,flow_to_previous,flow_to_this,scene_flow_to_previous,ground_soil,ground_state,"
          "ground_change,ground_age,panoptic,soil_in_flight]")
FRONT, LEFT = "machines[0].rig.sensors[6]", "machines[0].rig.sensors[7]"


def main():
    with tempfile.TemporaryDirectory() as scratch:
        dataset = Path(scratch) / "run"
        settings = ["record.poses_hz=200", "machines[1].rig.sensors[0].rate_hz=1"]
        for camera in (FRONT, LEFT):
            settings += [f"{camera}.width_px=160", f"{camera}.height_px=120", f"{camera}.rate_hz=5", f"{camera}.labels={LABELS}"]
        command = [sys.argv[1], "generate", "config/scenarios/quickstart.yaml", "--out", str(dataset), "--duration", "3.5"]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        judge = Path(__file__).with_name("check_labels.py")
        return subprocess.run([sys.executable, "-B", str(judge), str(dataset)]).returncode


if __name__ == "__main__":
    sys.exit(main())
