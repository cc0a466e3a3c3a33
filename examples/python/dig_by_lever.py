"""Digs one bucket of soil by moving the levers, and says how much it holds.

    PYTHONPATH=build/release/python /usr/bin/python3 examples/python/dig_by_lever.py
"""

from pathlib import Path

import numpy as np

import tera

SCENARIO = Path(__file__).resolve().parents[2] / "config/scenarios/quickstart.yaml"

# Seconds, and the levers held for so long; all others rest.
STROKES = [
    (1.2, {"boom": -0.8, "arm": 0.4}),    # down, reaching out
    (1.8, {"arm": -0.7, "bucket": -0.1}),  # drag towards the machine
    (1.4, {"bucket": -0.9, "arm": -0.3}),  # curl
    (1.5, {"boom": 0.9, "bucket": -0.3}),  # lift
]


def main():
    step_s = 0.1
    with tera.make(SCENARIO, machine="excavator1", step_s=step_s,
                   reward=lambda observation, info: observation["shovel_load_kg"][0]) as env:
        names = [lever.name for lever in env.machine.levers]
        observation, info = env.reset(seed=1)
        for duration_s, positions in STROKES:
            action = np.array([positions.get(name, 0.0) for name in names])
            for _ in range(round(duration_s / step_s)):
                observation, reward, terminated, truncated, info = env.step(action)
            print(f"{info['time_s']:4.1f} s: {reward:6.1f} kg in the bucket")


if __name__ == "__main__":
    main()
