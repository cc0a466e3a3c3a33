#!/usr/bin/env python3
"""Recordings of an excavator whose valves have many faults at once, and marks for what `tera diagnose` says of them.

    whole_valve.py --out FOLDER --seed 1 --cases 12          writes FOLDER/case_NN, as an owner has it, and FOLDER/truth_NN.json
    whole_valve.py --out FOLDER --run build/release/tera     imports and diagnoses one case at a time; goes on where it was stopped
    whole_valve.py --out FOLDER --mark                       prints a line a joint and the table of marks

The plant shares nothing with TERA but the data sheet below. A joint is a lever, dead time, a spool (dead band, end, slope and notch by
direction, kinks often rounded), a pump that boom and bucket share, an oil column, weight, a cylinder behind a linkage, relief pressure and
stops. An operator who sees the angles drives steps, ladders, waves and digging cycles. A joint has 1, 2, 4 or 5 to 8 causes (strong where the
rate changes by 6 % RMS without it), `gain23` (dead band and gain of 2.3) or `nothing`: rates within 3 %, dead time and lag within 15 ms.
"""

import argparse
import json
import math
import pathlib
import re
import subprocess
import time

import numpy as np

ROOT, NAMES = pathlib.Path(__file__).resolve().parents[2], ["slew", "boom", "arm", "bucket"]
FULL_RADPS = np.radians([(54, 54), (25.8, 30.8), (43.3, 42.7), (43.3, 64.3)])  # positive, negative
LIMITS_RAD = np.radians([(-1e9, 1e9), (-50, 72), (-155, -30), (-70, 50)])
SPAN_RAD = np.clip(LIMITS_RAD, -3, 3)
EFFORT_NM = [(3500, 3500), (32000, 21900), (35000, 35000), (25000, 25000)]  # relief pressure on piston and rod side
WEIGHT_NM, PUMP_M3PS, BOTH_M3PS = [1, 13000, 3200, 600], 9.6e-4, 1.56e-3  # largest moments; flow of the pump, and of boom and bucket at full rate
OIL_M3PRAD = {1: (1.33e-3, 0.91e-3), 3: (5.8e-4, 8.6e-4)}  # boom and bucket, by direction
STEP_S, SPOOL = 0.005, ["dead_band", "lever_saturation", "rate_gain"]
KINDS = {"nothing": (0, 1), "gain23": (2, 3), "1": (1, 2), "2": (2, 3), "4": (4, 5), "5-8": (5, 9)}  # numbers of causes, the last not included
rms = lambda x: float(np.sqrt(np.nanmean(np.square(x))))
arm_length = lambda ratio, angle_rad: ratio * np.sin(angle_rad) / np.sqrt(1 + ratio**2 - 2 * ratio * np.cos(angle_rad))  # pins at 1 and `ratio`
CAUSES = {  # mechanism: textbook terms, what also counts as right, the plant without it
    "dead_band": ("spool overlap", [], {"dead": (0, 0)}), "lever_saturation": ("spool at its end before the lever", [], {"end": (1, 1)}),
    "rate_gain": ("flow gain of the valve", [], {"gain": 1}), "asymmetric_gain": ("flow gain that differs by direction", [], {"ratio": 1}),
    "valve_curve": ("metering notch", [], {"exponent": 1, "notch": None}), "command_delay": ("dead time", [], {"dead_time_s": 0}),
    "actuator_lag": ("oil of first order, behind a spool of second order in some", [], {"lag_s": 0.01, "spool_s": 0}),
    "pressure_droop": ("flow that falls with load pressure", [], {"droop": 1}), "actuator_ring": ("oil spring", ["structural_flex"], {"spring": None}),
    "cylinder_lever": ("law of cosines", [], {"pins": None}), "flow_sharing": ("pump too small for two functions", ["power_limit"], {})}


def statics(q_rad):
    """Moments of weight in N m and inertias in kg m² about the axes of slew, boom, arm and bucket."""
    kg, kgm2, centre_m = np.array([290, 140, 124.9]), np.array([165, 36, 9]), np.array([1.15 + 0.25j, 0.6 + 0.05j, 0.32 + 0.2j])
    way = np.exp(1j * np.cumsum([q_rad[1], q_rad[2], q_rad[3] - math.pi / 4]))
    pin = np.array([0.8, 0.8 + 2.5 * way[0], 0.8 + 2.5 * way[0] + 1.545 * way[1]])
    at = pin + centre_m * way
    arm = np.triu(at - pin[:, None])
    inertia = np.sum(np.triu(kg * abs(arm) ** 2 + kgm2), axis=1).tolist()
    return [0.0, *(9.81 * arm.real @ kg).tolist()], [1110 + float(kg @ at.real**2 + kgm2.sum() / 2), *inertia]


def valve(p, side):
    """Opening of the spool at full lever, and rates in rad/s at 0, 0.001, ... 1 of the lever: gain times opening to the exponent, or near it a notch."""
    ramp, end, dead = lambda x: 0.5 * (x + np.sqrt(x * x + p["edge"] ** 2)), p["end"][side], p["dead"][side]  # kinks rounded over p["edge"]
    moved = np.maximum(0, end - ramp(end - np.linspace(0, 1, 1001))) if end < 1 else np.linspace(0, 1, 1001)
    x = ramp(moved - dead) - ramp(-dead) if dead > 0 else moved
    shape = np.interp(x / x[-1], *p["notch"]) if p["notch"] else (x / x[-1]) ** p["exponent"]
    return x[-1], [*(p["gain"] * p["ratio"] ** side * x[-1] ** p["exponent"] * shape * p["full_radps"][side]), 0.0]


def actuator(p):
    """One function of the machine: takes lever, share of flow, angle, weight and inertia; gives the rate that the spool asks for and the joint's."""
    table, late, pilot, oil, droop, rate, asked = [valve(p, side)[1] for side in (0, 1)], [0.0] * 100, 0.0, 0.0, 1.0, 0.0, 0.0
    (ring_radps, damping), swing, swing_rate, (up_nm, down_nm) = p["spring"] or (0, 0), 0.0, 0.0, EFFORT_NM[p["index"]]
    (steps, part), (ratio, zero_rad, way, mean_m) = divmod(p["dead_time_s"] / STEP_S, 1), p["pins"] or (0, 0, 0, 0)
    spool_part, oil_part = (1 - math.exp(-STEP_S / max(1e-6, lag_s)) for lag_s in (p["spool_s"] / 2, p["lag_s"]))
    while True:
        lever, share, q_rad, load_nm, inertia_kgm2 = yield asked, rate
        late = [lever] + late[:-1]
        u = late[int(steps)] * (1 - part) + late[int(steps) + 1] * part
        at = abs(u) * 1000
        low, high = table[u < 0][int(at) : int(at) + 2]
        pilot += spool_part * (math.copysign(low + at % 1 * (high - low), u) - pilot)
        asked += spool_part * (pilot - asked)
        oil += oil_part * (asked * share - oil)
        against = load_nm / WEIGHT_NM[p["index"]] * math.copysign(1, oil)
        aim = math.sqrt(1 - (1 - p["droop"] ** 2) * against) if p["orifice"] else 1 - (1 - p["droop"]) * against
        droop += STEP_S / 0.05 * (aim - droop)
        wanted = oil * droop * (mean_m / float(arm_length(ratio, zero_rad + way * q_rad)) if way else 1)
        swing_rate += STEP_S * (ring_radps**2 * (wanted - swing) - 2 * damping * ring_radps * swing_rate)
        swing += STEP_S * swing_rate
        push = ((swing if ring_radps else wanted) - rate) / STEP_S * inertia_kgm2
        rate += max(-down_nm - load_nm, min(up_nm - load_nm, push)) / inertia_kgm2 * STEP_S
        if (q_rad <= p["stops_rad"][0] and rate < 0) or (q_rad >= p["stops_rad"][1] and rate > 0):
            rate = swing = swing_rate = 0.0


def simulate(plants, pump_m3ps, count, levers_at, start_rad, known_rad=None):
    """Levers, angles and rates by step; over known angles, what the rates would be there."""
    actuators, q, rows, asked = [actuator(p) for p in plants], list(start_rad), np.zeros((3, count, 4)), [0.0] * 4
    list(map(next, actuators))
    for k in range(count):
        q = q if known_rad is None else list(known_rad[k])
        share = (1 + (sum(abs(asked[i]) * OIL_M3PRAD[i][asked[i] < 0] for i in OIL_M3PRAD) / pump_m3ps) ** 10) ** -0.1
        rows[:2, k] = levers_at(k, q), q
        for i, (a, load, inertia) in enumerate(zip(actuators, *statics(q))):
            asked[i], rows[2, k, i] = a.send((float(rows[0, k, i]), share if i in OIL_M3PRAD else 1, q[i], load, inertia))
            q[i] = min(max(q[i] + STEP_S * rows[2, k, i], plants[i]["stops_rad"][0]), plants[i]["stops_rad"][1])
    return rows


def operator(rng):
    """Takes angles and gives levers, step by step. Near a stop a lever is let go, unless the stop is to be reached."""
    q, levers, middle, hand_1ps, uniform = np.zeros(4), np.zeros(4), SPAN_RAD.mean(axis=1), rng.uniform(4, 10), rng.uniform
    away = lambda i, sure=0.85: (1 if q[i] < middle[i] else -1) * (1 if rng.random() < sure else -1)
    def hold(wish, seconds, into_stop=False):
        for _ in range(int(seconds / STEP_S)):
            near = {i: q[i] < SPAN_RAD[i][0] + 0.12 if u < 0 else q[i] > SPAN_RAD[i][1] - 0.12 for i, u in wish.items()}
            wanted = [0.0 if near.get(i) and not into_stop else wish.get(i, 0.0) for i in range(4)]
            levers[:] += np.clip(wanted - levers, -hand_1ps * STEP_S, hand_1ps * STEP_S)
            q[:] = yield levers
    for turn in range(100):
        for i in map(int, rng.permutation(4)):
            yield from hold({}, 1.5)
            if (turn + i) % 3 == 0:  # steps from rest, some from a stop
                yield from hold({i: 0.9 * away(i)}, 4.0 if i and rng.random() < 0.4 else 0.0, into_stop=True)
                for size in rng.permutation([0.2, 0.35, 0.5, 0.7, 0.85, 1.0]):
                    yield from hold({}, uniform(0.7, 1.4))
                    yield from hold({i: away(i) * min(1, size * uniform(0.8, 1.2))}, uniform(0.8, 2.2))
            elif (turn + i) % 3 == 1:  # a ladder, up and down
                way, rise, rung_s = away(i), uniform(0.08, 0.16), uniform(0.4, 0.8)
                for level in [*np.arange(rise, 1, rise), 1, *np.arange(1 - rise, 0, -rise)]:
                    way = way if SPAN_RAD[i][0] + 0.3 < q[i] < SPAN_RAD[i][1] - 0.3 else away(i, 1)
                    yield from hold({i: way * level}, rung_s)
            else:  # a wave that grows faster
                size, slow_hz, rise_hzps = uniform(0.4, 1), uniform(0.12, 0.4), uniform(0.02, 0.05)
                for t in np.arange(0, uniform(8, 12), STEP_S):
                    swing = size * math.sin(2 * math.pi * (slow_hz * t + rise_hzps * t * t)) + 0.3 * math.tanh(middle[i] - q[i])
                    yield from hold({i: min(1, max(-1, swing))}, STEP_S, into_stop=True)
            for ways in [{1: -1, 2: 1, 3: 1}, {2: -1, 3: -0.6}, {1: 1, 2: -0.8, 3: -1}, {0: 1, 1: 1, 3: -1}, {2: 1, 3: 1}, {0: -1, 1: -1, 3: 1}]:  # digging
                yield from hold({i: way * uniform(0.6, 1) for i, way in ways.items()}, uniform(0.8, 1.8), into_stop=rng.random() < 0.15)


def draw_valve(rng, p, has, even):
    """Dead band and end by direction, and where the gain is a cause, slopes of 1.1 to 3.7 that reach the data sheet's full rate."""
    (dead, end, whole), gains = (m in has for m in SPOOL), [9, 9]
    while max(gains) > 4.5:
        half, top = rng.uniform(-1, 1) * (0.02 if even else 0.06), rng.uniform(0.6, 0.95 if whole else 0.85)
        p["dead"] = tuple(np.clip(rng.uniform(0.05 if whole else 0.1, 0.45) + half * np.array([1, -1]), 0.05, 0.45)) if dead else (0, 0)
        p["end"] = (top, top if even else min(0.95, max(0.6, top + rng.uniform(-0.08, 0.08)))) if end else (1, 1)
        x = [float(valve(p, side)[0]) for side in (0, 1)]
        fits = min(x) > 0.27 and max(x) < (0.77 if dead and end else 0.9)
        gains = [1, 1] if not whole else [1 / travel ** p["exponent"] for travel in x] if fits else [9, 9]
    p["gain"], p["ratio"] = (sum(gains) / 2, 1) if even else (gains[0], gains[1] / gains[0])


def draw_joint(rng, index, kind, shared):
    """Plant of one joint and the mechanisms that stand for its causes."""
    rest = ["valve_curve", "command_delay", "actuator_lag", "actuator_ring"] + ["cylinder_lever"] * (index > 0) + ["pressure_droop"] * (index in (1, 2))
    some, uniform = lambda names, number: [str(m) for m in rng.choice(names, min(len(names), number), replace=False)], rng.uniform
    has, whole, number = ["flow_sharing"] if shared and index in OIL_M3PRAD else [], rng.random() < 0.7, int(rng.integers(*KINDS[kind]))
    if number > 3 and (whole or number > 4):
        has += SPOOL + some(rest, number - 3 - len(has))
    elif number == 2 and (whole or kind == "gain23"):
        has = [SPOOL[::2], SPOOL[1:], rest[1:3]][0 if kind == "gain23" else rng.integers(3)]
    else:
        has += some(rest + SPOOL, number - len(has))
    angle_rad, arm = np.zeros(1), np.ones(1)
    while angle_rad.min() < 0.15 or angle_rad.max() > math.pi - 0.15 or not 1.3 < arm.max() / arm.min() < 3:  # a stroke takes the data sheet's time
        ratio, zero_rad, way = uniform(0.15, 0.6), uniform(-6, 6), int(rng.choice([-1, 1]))
        angle_rad = zero_rad + way * np.linspace(*LIMITS_RAD[max(1, index)], 100)
        arm = arm_length(ratio, angle_rad)
    p = {"index": index, "dead": (0, 0), "end": (1, 1), "gain": 1, "ratio": 1, "exponent": 1, "notch": None, "orifice": bool(rng.integers(2)),
         "edge": float(uniform(0.01, 0.04) * (rng.random() < 0.7)), "full_radps": tuple(FULL_RADPS[index] * uniform(0.97, 1.03, 2)),
         "dead_time_s": uniform(0.08, 0.3) if "command_delay" in has else uniform(0, 0.015), "lag_s": uniform(0.005, 0.015), "spool_s": 0,
         "pins": (ratio, zero_rad, way, float(arm.mean())) if "cylinder_lever" in has else None, "droop": uniform(0.8, 0.9) if "pressure_droop" in has else 1,
         "spring": (uniform(10, 22), uniform(0.12, 0.35)) if "actuator_ring" in has else None,
         "stops_rad": tuple(LIMITS_RAD[index] + np.radians(uniform(0, 1, 2)) * [1, -1])}
    if "valve_curve" in has:
        p["exponent"], knee = uniform(1.3, 1.7 if "rate_gain" in has else 2.3), uniform(0.4, 0.6)
        p["notch"] = ([0, knee, 1], [0, knee ** p["exponent"], 1]) if rng.random() < 0.5 else None
    if "actuator_lag" in has:
        lag_s, part = math.exp(uniform(math.log(0.1), math.log(0.8))), rng.choice([0, 0.25])
        p["spool_s"], p["lag_s"] = part * lag_s, (1 - part) * lag_s
    if kind == "gain23":
        p["dead"], p["gain"] = tuple(uniform(0.3, 0.4) + uniform(-0.05, 0.05) * np.array([1, -1])), 2.3
    elif set(has) & set(SPOOL[:2]):
        draw_valve(rng, p, has, number < 3)
    elif "rate_gain" in has:
        p["gain"] = float(rng.choice([uniform(0.55, 0.8), uniform(1.25, 1.6)]))
    return p, has + ["asymmetric_gain"] * (abs(p["ratio"] - 1) > 0.08)


def numbers(p, pump_m3ps):
    """True numbers by MECHANISM.PARAMETER, with the range that counts as right: wider where the form is not the textbook's."""
    about, within = lambda x, less, more: (x, x * less, x * more), lambda x, less, more: (x, x - less, x + more)
    bent, width, apart, slow_s, spring = p["exponent"] - 1, sum(p["dead"]) / 2, 0.05 + abs(p["end"][0] - p["end"][1]) / 2, p["spool_s"], (p["spring"] or [0])[0]
    return {"dead_band.width": within(width, 0.03 + p["edge"], 0.03 + p["edge"] + 0.04 * (bent > 0)), "asymmetric_gain.ratio": about(p["ratio"], 0.88, 1.12),
            "dead_band.asymmetry": within((p["dead"][0] - p["dead"][1]) / max(1e-9, 2 * width), 0.15, 0.15),
            "lever_saturation.limit": within(sum(p["end"]) / 2, apart, apart), "valve_curve.exponent": within(1 + bent, bent / 2, 0.6 * bent),
            "rate_gain.gain": about(p["gain"], *((0.6, 1.45) if bent else (0.8, 1.2))), "command_delay.delay_s": within(p["dead_time_s"], 0.03, 0.03 + slow_s),
            "actuator_lag.time_s": about(p["lag_s"] + slow_s, 0.53 if slow_s else 0.7, 1.25), "actuator_ring.eta_radps": about(spring, 0.8, 1.2),
            "structural_flex.natural_radps": about(spring, 0.8, 1.2), "flow_sharing.capacity": about(pump_m3ps / PUMP_M3PS, 0.8, 1.25)}


def static_rmse(t_s, lever, rate, split):
    """RMSE behind `split` of the best map of 12 nodes a direction and the best single dead time, both fitted to what is before."""
    nodes, fits = np.concatenate([np.linspace(-1, 0, 12), np.linspace(1e-6, 1, 12)]), []
    for delay_s in np.arange(0, 0.8, 0.02):
        hats = np.array([np.interp(np.interp(t_s - delay_s, t_s, lever), nodes, row) for row in np.eye(24)]).T
        error = hats @ np.linalg.lstsq(hats[:split], rate[:split], rcond=None)[0] - rate
        fits.append((rms(error[:split]), rms(error[split:])))
    return min(fits)[1]


def write_owner(folder, duration_s, start_rad, columns):
    """Log, mapping and scenario, as an owner would have them. The owner's machine file knows of no ring."""
    folder.mkdir(parents=True, exist_ok=True)
    np.savetxt(folder / "log.csv", np.column_stack(list(columns.values())), "%.6f", ",", header=",".join(columns), comments="")
    field = lambda key, column, unit: (key, {"column": column, "unit": unit})
    joints = [dict([("name", n), field("angle", f"{n}_deg", "deg")] + [field("rate", f"{n}_degps", "deg/s")] * (f"{n}_degps" in columns)) for n in NAMES]
    mapping = {"name": folder.name, "machine": "excavator1", "file": "log.csv", "time": {"column": "t_s", "unit": "s"}, "zero": "start"}
    tables = [{"name": "commands", "columns": dict(field(n, f"{n}_percent", "%") for n in NAMES)}]
    (folder / "mapping.yaml").write_text(json.dumps({**mapping, "encoders": [{"name": "encoders", "joints": joints}], "tables": tables}, indent=1))
    text, start = (ROOT / "config/scenarios/identification.yaml").read_text(), ", ".join(f"{n}: {math.degrees(q):.1f}" for n, q in zip(NAMES, start_rad))
    for old, new in [("name: identification", f"name: {folder.name}"), (r"duration_s: \d+", f"duration_s: {duration_s:.0f}"), (r"\.\./", "tera:config/"),
                     (r"joints_deg: \{[^}]*\}", f"joints_deg: {{{start}, blade: 20}}"),
                     (r"csv: \S+ time_column: t_s", "csv: recording/excavator1/commands.csv, time_column: t_ns")]:
        text, found = re.subn(old, new, text)
        assert found, f"config/scenarios/identification.yaml has no {old}"
    (folder / "scenario.yaml").write_text(text + "\neffects:\n  excavator1:\n" + "".join(f"    {n}: {{actuator_ring: none}}\n" for n in NAMES))


def write_case(out, name, kind, rng):
    """One case: what an owner has in its folder, the truth elsewhere."""
    shared = rng.random() < {"1": 0.25, "4": 0.5, "5-8": 0.6}.get(kind, 0)
    kinds = ["nothing" if not shared and rng.random() < 0.15 else kind for _ in NAMES]
    plants, has = zip(*[draw_joint(rng, i, k, shared) for i, k in enumerate(kinds)])
    pump_m3ps, count, hands = rng.uniform(0.5, 0.75) * BOTH_M3PS if shared else 1e9, int(rng.integers(120, 241) / STEP_S), operator(rng)
    start_rad, changes = np.radians(np.round([0, 48, -85, -40] + rng.uniform(-8, 8, 4) * [0, 1, 1, 1], 1)), [{} for _ in NAMES]
    levers, angles, rates = simulate(plants, pump_m3ps, count, lambda k, q: hands.send(q if k else None), start_rad)
    for turn in range(max(map(len, has))):  # one cause of each joint left out at a time
        less = [(h + [None] * 9)[turn] for h in has]
        plain, pump = [{**p, **(CAUSES[m][2] if m else {})} for p, m in zip(plants, less)], 1e9 if "flow_sharing" in less else pump_m3ps
        other = simulate(plain, pump, count, lambda k, _: levers[k], start_rad, angles)[2]
        for i, m in enumerate(less):
            changes[i][m] = rms(other[:, i] - rates[:, i]) / rms(rates[:, i])
    angles_only = bool(rng.random() < 0.4)
    log_hz, quantum_deg = (int(rng.choice([50, 100])), float(rng.choice([0.01, 0.022, 0.05, 0.1]))) if angles_only else (100, 0.022)
    grid_s, at_s = np.arange(0, count * STEP_S - 0.02, 1 / log_hz), np.arange(count) * STEP_S
    t_s, split, truth = np.round(grid_s + rng.normal(0, 3e-4, len(grid_s)), 6), int(0.7 * len(grid_s)), {}
    lever, clean_deg, clean = (np.array([np.interp(grid_s, at_s, c) for c in x.T]).T for x in (levers, np.degrees(angles), np.degrees(rates)))
    lever, angle_deg = np.round(lever, 3), quantum_deg * np.round((clean_deg + rng.normal(0, 0.01, clean.shape)) / quantum_deg)
    noise_degps = rng.uniform(0.15, 0.5, 4) * rng.standard_t(6, clean.shape)
    measured, clean = [np.gradient(x, t_s, axis=0) for x in (angle_deg, clean_deg)] if angles_only else (clean + noise_degps, clean)
    low_deg, high_deg = np.degrees([p["stops_rad"] for p in plants]).T + [[0.01], [-0.01]]
    free = lever * ~np.where(lever < 0, clean_deg < low_deg, clean_deg > high_deg)  # a map that knows where joints stop
    columns = [("percent", 100 * lever), ("deg", angle_deg)] + [("degps", measured)] * (not angles_only)
    write_owner(out / name, count * STEP_S, start_rad, {"t_s": t_s, **{f"{n}_{unit}": x[:, i] for unit, x in columns for i, n in enumerate(NAMES)}})
    for i, p in enumerate(plants):
        causes = [{"cause": CAUSES[m][0], "id": m, "also": CAUSES[m][1], "target": "pump_1" if m == "flow_sharing" else NAMES[i],
                   "numbers": {k: v for k, v in numbers(p, pump_m3ps).items() if k.split(".")[0] in [m] + CAUSES[m][1]},
                   "change_without": changes[i][m], "strong": changes[i][m] > 0.06} for m in has[i]]
        let_pass = ["asymmetric_gain"] * (p["end"][0] != p["end"][1] or p["droop"] < 1) + ["command_delay"] * int(p["spool_s"] > 0.03)
        truth[NAMES[i]] = {"kind": kinds[i], "causes": causes, "let_pass": let_pass, "rms": rms(clean[split:, i]), "plant": p,
                           "rmse_true": rms(clean[split:, i] - measured[split:, i]), "rmse_static": static_rmse(t_s, free[:, i], measured[:, i], split)}
    log = {"log_hz": log_hz, "angles_only": angles_only, "quantum_deg": quantum_deg, "split_s": t_s[split] - t_s[0], "pump_m3ps": pump_m3ps}
    (out / f"{name.replace('case', 'truth')}.json").write_text(json.dumps({"log": log, "joints": truth}, indent=1, default=lambda x: x.item()))


def run(tera, out):
    """Answers of the program, one case at a time and within 600 s; a case that was run is left as it is."""
    commands = (f"rm -rf report report.incomplete recording; export TERA_DATA_DIR=${{TERA_DATA_DIR:-{ROOT}}}; {tera} import mapping.yaml --out recording && "
                f"{tera} diagnose scenario.yaml recording --no-simulation --threads 1 --time-limit 560 --out report")
    for case in sorted(c for c in out.glob("case_*") if not (c / "run.json").exists()):
        begin_s, log = time.monotonic(), open(case / "run.log", "w")
        status = subprocess.run(["timeout", "600", "sh", "-c", commands], cwd=case, stdout=log, stderr=log)
        (case / "run.json").write_text(json.dumps({"status": status.returncode, "wall_s": round(time.monotonic() - begin_s, 1)}))
        print(case.name, (case / "run.json").read_text(), flush=True)


def mark_joint(name, truth, split_s, answer, report):
    """Marks of one joint: counts, and RMSE over that of noise; `said` is what was named."""
    findings, channel, strong = answer.get("findings", []), f"excavator1/encoders/{name}_radps", [c for c in truth["causes"] if c["strong"]]
    mine, told = [f for f in findings if f["channel"] == channel], lambda f: {f["mechanism"], *f.get("class", [])}
    named, known = [f for f in mine if f["mechanism"] != "unexplained"], set(truth["let_pass"]).union(*[{c["id"], *c["also"]} for c in truth["causes"]])
    m = {"causes": len(strong), "named": 0, "set": 0, "numbers": 0, "right": 0, "spurious": sum(not known & told(f) for f in named),
         "silent": bool(strong) and not named, "alarm": not truth["causes"] and bool(mine), "open": len(mine) > len(named), "after": math.nan,
         "final": math.degrees({h["channel"]: h["rmse_after"] for h in answer.get("held_out", [])}.get(channel, math.nan)) / truth["rmse_true"],
         "static": truth["rmse_static"] / truth["rmse_true"], "said": ", ".join(f["mechanism"] for f in mine) or "nothing"}
    for c in strong:
        ids, pool = {c["id"], *c["also"]}, [f for f in findings if f["target"] == "pump_1"] if c["target"] == "pump_1" else named
        by_name = [f for f in pool if f["mechanism"] in ids]
        m["named"], m["set"] = m["named"] + bool(by_name), m["set"] + any(ids & told(f) for f in pool)
        for wide, number in [(c["numbers"].get(f"{f['mechanism']}.{key}"), n["value"]) for f in by_name[:1] for key, n in f["parameters"].items()]:
            m["numbers"], m["right"] = m["numbers"] + bool(wide), m["right"] + (bool(wide) and wide[1] <= number <= wide[2])
    if answer:
        at = np.genfromtxt(report / f"series_{channel.replace('/', '_')}.csv", delimiter=",", names=True)
        m["after"] = math.degrees(rms((at["simulated_after_radps"] - at["measured_radps"])[at["t_ns"] * 1e-9 >= split_s])) / truth["rmse_true"]
    return m


def mark(out):
    """A line a joint of all cases that were run, and one table: a row a kind of joint."""
    rows, ran = {k: [] for k in KINDS}, {c.parent: json.loads(c.read_text()) for c in sorted(out.glob("case_*/run.json"))}
    for case in ran:
        truth, report = json.loads((out / f"{case.name.replace('case', 'truth')}.json").read_text()), case / "report"
        answer = json.loads((report / "diagnosis.json").read_text()) if (report / "diagnosis.json").exists() else {}
        for name, joint in truth["joints"].items():
            rows[joint["kind"]].append(m := mark_joint(name, joint, truth["log"]["split_s"], answer, report))
            true = ", ".join(c["id"] + " (weak)" * (not c["strong"]) for c in joint["causes"]) or "nothing"
            print(f"{case.name} {name}: {true} | said: {m['said']} | RMSE over noise {m['after']:.2f}, static {m['static']:.2f}")
    print(f"{'':70}median RMSE over noise\nkind     joints causes named% in set% numbers right% spurious silent alarms open  last 30 %  FINAL  static map")
    for kind, marks in rows.items():
        n = {key: sum(m[key] for m in marks) for key in ("causes", "named", "set", "numbers", "right", "spurious", "silent", "alarm", "open")}
        named, in_set, right = (f"{100 * n[a] / n[b]:.0f}" if n[b] else "-" for a, b in (("named", "causes"), ("set", "causes"), ("right", "numbers")))
        after, final, static = (np.median([m[key] for m in marks if m[key] == m[key]] or [math.nan]) for key in ("after", "final", "static"))
        print(f"{kind:8} {len(marks):6} {n['causes']:6} {named:>6} {in_set:>7} {right:>14} {n['spurious']:8} {n['silent']:6} {n['alarm']:6} {n['open']:4} "
              f"{after:10.2f} {final:6.2f} {static:11.2f}")
    walls_s, failed = [r["wall_s"] for r in ran.values()], [c.name for c in ran if not (c / "report/diagnosis.json").exists()]
    print(f"{len(ran)} cases, {sum(walls_s):.0f} s in all, {max(walls_s, default=0):.0f} s at most; without an answer: {', '.join(failed) or 'none'}")


if __name__ == "__main__":
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--out", type=pathlib.Path, required=True)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--cases", type=int, default=0)
    options.add_argument("--run", metavar="TERA", type=pathlib.Path)
    options.add_argument("--mark", action="store_true")
    args = options.parse_args()
    for k in [k for k in range(args.cases) if not (args.out / f"truth_{k + 1:02d}.json").exists()]:
        write_case(args.out, f"case_{k + 1:02d}", list(KINDS)[k % len(KINDS)], np.random.default_rng([args.seed, k]))
    if args.run:
        run(args.run.resolve(), args.out)
    if args.mark:
        mark(args.out)
