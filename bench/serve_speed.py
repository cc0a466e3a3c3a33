"""How fast `tera serve` steps a scenario for a client that asks for no samples.

    PYTHONPATH=build/release/python python3 bench/serve_speed.py config/scenarios/quickstart.yaml
"""

import sys
import time

import tera


def seconds_of(call, times):
    start = time.perf_counter()
    for _ in range(times):
        call()
    return (time.perf_counter() - start) / times


def main():
    with tera.Server(sys.argv[1]) as server, tera.Session(server.address) as session:
        machine = next(m for m in session.description.machines if m.levers)
        still = tera.messages.LeverPositions(position=[0.0] * len(machine.levers))
        actions = [tera.messages.Action(machine=machine.name, levers=still)]
        print(f"reset {seconds_of(lambda: session.reset(seed=1), 2):.2f} s")
        for physics_steps, times in ((1, 1000), (50, 20), (500, 2)):
            each_s = seconds_of(lambda: session.step(actions, physics_steps=physics_steps), times)
            print(f"{physics_steps:4} physics steps a request: {1 / each_s:7.1f} requests/s, "
                  f"{physics_steps / each_s:7.0f} physics steps/s")
        describe_s = seconds_of(lambda: session.ask(describe=tera.messages.Describe()), 1000)
        print(f"a request that simulates nothing: {1e6 * describe_s:.0f} us")


if __name__ == "__main__":
    main()
