"""Learns to fill the bucket by one pass through the ground, better than the scripted cycle does.

    PYTHONPATH=build/release/python /usr/bin/python3 examples/python/learn_to_dig.py --out out/dig

The policy is the rates of the levers in three phases (in, along, out) and how long each lasts: eleven numbers. They are
searched by the cross-entropy method (Rubinstein 1999; de Boer et al. 2005): each generation draws candidates from a
normal distribution, digs with each in yards of its own, and fits the distribution to the best. Yards differ by seed:
soil, relief and the arm's start are drawn (learn_to_dig.yaml). What was learnt is held against the scripted cycle in
yards that the search has not seen. The same seed gives the same policy.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np

import tera

SCENARIO = Path(__file__).with_name("learn_to_dig.yaml")
STEP_S = 0.1
PASS_S = 6.5       # of an episode
CYCLE_S = 16.0     # in which the scripted cycle has its bucket full
LIFT = {"boom": 0.9}

# Each number's name, where the search begins, and its spread. Times in seconds; levers from -1 to 1.
NUMBERS = [("in_s", 1.2, 0.4), ("in_boom", -0.8, 0.2), ("in_arm", 0.4, 0.3),
           ("along_s", 1.8, 0.5), ("along_boom", 0.0, 0.2), ("along_arm", -0.7, 0.2), ("along_bucket", -0.1, 0.3),
           ("out_s", 1.4, 0.4), ("out_boom", 0.1, 0.3), ("out_arm", -0.3, 0.3), ("out_bucket", -0.9, 0.2)]
START = np.array([number[1] for number in NUMBERS])
SPREAD = np.array([number[2] for number in NUMBERS])
LEAST_SPREAD = 0.05 * SPREAD
SMOOTHING = 0.7    # share of the new fit in the next distribution


def levers_at(policy, time_s, names):
    """The levers that a policy holds at a time: its three phases, then the lift, then rest."""
    p = dict(zip([number[0] for number in NUMBERS], policy))
    held = LIFT if time_s < PASS_S - 1 else {}
    for phase in ("out", "along", "in"):
        end_s = sum(max(p[f"{before}_s"], 0.1) for before in ("in", "along", "out")[:("in", "along", "out").index(phase) + 1])
        if time_s < end_s:
            held = {lever: p.get(f"{phase}_{lever}", 0.0) for lever in ("boom", "arm", "bucket")}
    return np.clip([held.get(name, 0.0) for name in names], -1, 1)


def dig(env, policies, seeds):
    """Soil in the bucket, m3, after each policy's pass in the yard of its seed; as many at once as `env` has room."""
    names = [lever.name for lever in env.machine.levers]
    filled_m3 = []
    for first in range(0, len(policies), env.num_envs):
        some, of_some = policies[first:first + env.num_envs], list(seeds[first:first + env.num_envs])
        missing = env.num_envs - len(some)
        some = np.vstack([some, np.repeat(some[-1:], missing, axis=0)])
        env.reset(seed=of_some + of_some[-1:] * missing)
        info = None
        for k in range(round(PASS_S / STEP_S)):
            _, _, _, _, info = env.step(np.array([levers_at(policy, k * STEP_S, names) for policy in some]))
        filled_m3 += list(info["truth"]["load_m3"][:env.num_envs - missing])
    return np.array(filled_m3)


def scripted(server, seeds):
    """The largest soil in the bucket during the scripted operator's first cycle in each yard, m3."""
    filled_m3 = []
    with tera.Session(server) as session:
        for seed in seeds:
            session.reset(seed=seed)
            loads = [session.step(duration_s=0.25).machines[0].shovel_load_m3[0] for _ in range(round(CYCLE_S / 0.25))]
            filled_m3.append(max(loads))
    return np.array(filled_m3)


def search(env, generations, candidates, yards, seed):
    """The policy found, and of each generation the mean of all, of its best, and of the distribution's middle."""
    random = np.random.default_rng(seed)
    middle, spread = START.copy(), SPREAD.copy()
    curve = []
    for generation in range(generations):
        drawn = middle + spread * random.standard_normal((candidates, len(middle)))
        drawn[0] = middle
        seeds = [int(s) for s in random.integers(2**31, size=yards)]
        filled_m3 = np.mean([dig(env, drawn, [yard] * candidates) for yard in seeds], axis=0)
        best = np.argsort(-filled_m3)[:max(2, candidates // 5)]
        middle = (1 - SMOOTHING) * middle + SMOOTHING * drawn[best].mean(axis=0)
        spread = np.maximum((1 - SMOOTHING) * spread + SMOOTHING * drawn[best].std(axis=0), LEAST_SPREAD)
        curve.append({"mean_m3": filled_m3.mean(), "best_m3": filled_m3[best].mean(), "middle_m3": filled_m3[0]})
        print(f"generation {generation + 1:2}: mean {filled_m3.mean():.4f}, best {filled_m3[best].mean():.4f}, "
              f"middle {filled_m3[0]:.4f} m3", flush=True)
    return middle, curve


def draw_curve(curve, scripted_m3, learnt_m3, file):
    """The learning curve as SVG."""
    width, height, left, bottom = 640, 360, 62, 44
    most = 1.15 * max([scripted_m3, learnt_m3] + [g["best_m3"] for g in curve])

    def x(k):
        return left + (width - left - 20) * k / max(len(curve) - 1, 1)

    def y(m3):
        return height - bottom - (height - bottom - 20) * m3 / most

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
             f'font-size="13"><rect width="{width}" height="{height}" fill="white"/>']
    for k in range(6):
        m3 = most * k / 5
        parts.append(f'<path d="M{left} {y(m3):.1f}H{width - 20}" stroke="#ddd"/>'
                     f'<text x="{left - 6}" y="{y(m3) + 4:.1f}" text-anchor="end">{m3:.3f}</text>')
    for k in range(0, len(curve), max(1, len(curve) // 10)):
        parts.append(f'<text x="{x(k):.1f}" y="{height - 24}" text-anchor="middle">{k + 1}</text>')
    parts.append(f'<text x="{width / 2}" y="{height - 6}" text-anchor="middle">generation</text>'
                 f'<text x="14" y="{height / 2}" transform="rotate(-90 14 {height / 2})" text-anchor="middle">'
                 'soil in the bucket, m³</text>')
    lines = [("best_m3", "#1b7", "best fifth"), ("middle_m3", "#06c", "middle of the distribution"),
             ("mean_m3", "#999", "mean of all")]
    for row, (key, colour, name) in enumerate(lines):
        points = " ".join(f"{x(k):.1f},{y(g[key]):.1f}" for k, g in enumerate(curve))
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>'
                     f'<text x="{width - 230}" y="{height - bottom - 60 + 17 * row}" fill="{colour}">{name}</text>')
    for m3, name in ((scripted_m3, "scripted cycle"), (learnt_m3, "learnt, other yards")):
        parts.append(f'<path d="M{left} {y(m3):.1f}H{width - 20}" stroke="black" stroke-dasharray="5 4"/>'
                     f'<text x="{left + 6}" y="{y(m3) - 5:.1f}">{name}</text>')
    file.write_text("".join(parts) + "</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("out/dig"), help="folder of policy.json and curve.svg")
    parser.add_argument("--generations", type=int, default=16)
    parser.add_argument("--candidates", type=int, default=24, help="of each generation")
    parser.add_argument("--yards", type=int, default=2, help="in which each candidate digs")
    parser.add_argument("--tests", type=int, default=16, help="yards of the comparison at the end")
    parser.add_argument("--environments", type=int, default=4, help="at once; changes no figure")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    start_s = time.monotonic()
    tests = range(10**6, 10**6 + options.tests)
    with tera.Server(SCENARIO) as server:
        with tera.VectorEnv(server.address, options.environments, step_s=STEP_S, prepare=False) as env:
            policy, curve = search(env, options.generations, options.candidates, options.yards, options.seed)
            first_m3 = dig(env, np.array([START] * options.tests), tests)
            learnt_m3 = dig(env, np.array([policy] * options.tests), tests)
        scripted_m3 = scripted(server.address, tests)
    options.out.mkdir(parents=True, exist_ok=True)
    draw_curve(curve, scripted_m3.mean(), learnt_m3.mean(), options.out / "curve.svg")
    better_m3 = learnt_m3 - scripted_m3
    report = {"policy": {number[0]: float(value) for number, value in zip(NUMBERS, policy)}, "curve": curve,
              "start_m3": first_m3.tolist(), "learnt_m3": learnt_m3.tolist(), "scripted_m3": scripted_m3.tolist()}
    (options.out / "policy.json").write_text(json.dumps(report, indent=1) + "\n")
    for name, m3 in (("scripted cycle", scripted_m3), ("start of the search", first_m3), ("learnt", learnt_m3)):
        print(f"{name:20} {m3.mean():.4f} m3, {m3.min():.4f} to {m3.max():.4f} in {options.tests} other yards")
    print(f"better than the scripted cycle by {better_m3.mean():.4f} m3 in the mean, in {np.mean(better_m3 > 0):.0%} "
          f"of the yards; {time.monotonic() - start_s:.0f} s")


if __name__ == "__main__":
    main()
