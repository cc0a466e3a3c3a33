"""What a reset costs, and how fast `tera serve` steps a scenario.

    PYTHONPATH=build/release/python python3 bench/serve_speed.py config/scenarios/quickstart.yaml

Resets are shown by wall time and by the time of the server's threads together, which other programs disturb less.
"""

import os
import sys
import time
from pathlib import Path

import numpy as np

import tera

RESETS = 8
STEP_S = 0.1


def seconds_of(call, times):
    start = time.perf_counter()
    for _ in range(times):
        call()
    return (time.perf_counter() - start) / times


def thread_s(process):
    """Time of all threads of a process, s."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def show_reset(name, server, reset):
    reset(0)  # what is made once
    before_s = thread_s(server._process.pid)
    numbers = iter(range(1, RESETS + 1))
    wall_s = seconds_of(lambda: reset(next(numbers)), RESETS)
    own_s = (thread_s(server._process.pid) - before_s) / RESETS
    print(f"reset, {name:36} {1e3 * wall_s:6.0f} ms, {1e3 * own_s:6.0f} ms of threads")


def show_resets(server):
    with tera.Session(server.address) as session:
        show_reset("the same yard", server, lambda k: session.reset(seed=1))
        show_reset("another yard", server, lambda k: session.reset(seed=100 + k))
        camera = next(((m.name, s.name) for m in session.description.machines for s in m.sensors if s.HasField("camera")), None)
        if camera:
            observe = tera.messages.Observe(sensors=[tera.messages.SensorSelection(machine=camera[0], sensor=camera[1])])
            show_reset("another yard, a picture", server, lambda k: session.reset(seed=200 + k, observe=observe))
        waited_s = []
        for k in range(RESETS):
            session.reset(seed=300 + k, next_seed=301 + k)
            session.step(duration_s=5)
            waited_s.append(seconds_of(lambda: session.reset(seed=301 + k), 1))
        print(f"reset, {'another yard, prepared during 5 s':36} {1e3 * np.mean(waited_s):6.0f} ms")


def show_steps(server):
    with tera.Session(server.address) as session:
        machine = next(m for m in session.description.machines if m.levers)
        still = tera.messages.LeverPositions(position=[0.0] * len(machine.levers))
        actions = [tera.messages.Action(machine=machine.name, levers=still)]
        session.reset(seed=1)
        for physics_steps, times in ((1, 1000), (50, 20), (500, 2)):
            each_s = seconds_of(lambda: session.step(actions, physics_steps=physics_steps), times)
            print(f"{physics_steps:4} physics steps a request: {1 / each_s:7.1f} requests/s, "
                  f"{physics_steps / each_s:7.0f} physics steps/s")
        describe_s = seconds_of(lambda: session.ask(describe=tera.messages.Describe()), 1000)
        print(f"a request that simulates nothing: {1e6 * describe_s:.0f} us")


def show_environments(server):
    for cameras in ([], None):
        for count in (1, 2, 4, 8):
            with tera.VectorEnv(server.address, count, step_s=STEP_S, prepare=False) as envs:
                if cameras is None:
                    cameras = [s.name for s in envs.machine.sensors if s.HasField("camera")][:1]
            with tera.VectorEnv(server.address, count, step_s=STEP_S, sensors=cameras, prepare=False) as envs:
                envs.reset(seed=1)
                still = np.zeros(envs.action_space.shape)
                envs.step(still)
                each_s = seconds_of(lambda: envs.step(still), 8)
                what = f"steps of {STEP_S} s" + (f" with a picture of {cameras[0]}" if cameras else "")
                print(f"{count} environments: {count / each_s:7.1f} {what} a second")


def main():
    with tera.Server(sys.argv[1]) as server:
        show_resets(server)
        show_steps(server)
        show_environments(server)


if __name__ == "__main__":
    main()
