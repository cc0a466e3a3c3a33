#!/usr/bin/env python3
"""Measures what campaigns cost beside their episodes, and simulates the schedule of large ones (docs/evidence/campaigns.md).

    campaign_cost.py overhead TERA            seconds that a worker adds to an episode, by the episode's length
    campaign_cost.py pool TERA [ROUNDS]       throughput of the pool beside two single runs at once; files of an episode, merging
    campaign_cost.py index TERA [EPISODES]    planning, submitting to a Slurm that answers at once, collecting, status
    campaign_cost.py schedule                 a simulated cluster: makespan and load by size of tasks
"""

import csv
import heapq
import os
import random
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENARIO = """name: resting
seed: 5
duration_s: 0.2
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.1, soils: [dirt, sand], soil: dirt}
machines:
  - name: rover1
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis, rate_hz: 100}]}
"""


def seconds(*command, **options) -> float:
    begin = time.monotonic()
    subprocess.run([str(word) for word in command], check=True, capture_output=True, **options)
    return time.monotonic() - begin


def children_s() -> float:
    """Processor time of all processes that were waited for."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def plan(tera, scratch: Path, name: str, text: str) -> Path:
    (scratch / "resting.yaml").write_text(SCENARIO)
    (scratch / f"{name}.yaml").write_text(text)
    seconds(tera, "campaign", "plan", scratch / f"{name}.yaml", "--out", scratch / name)
    return scratch / name


def overhead(tera) -> None:
    """One worker after the other, beside `tera generate` of the same scenario, in turns."""
    rounds = 6
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        print("| simulated s | `tera generate` s | episode of a campaign s | added s |\n| --- | --- | --- | --- |")
        for duration in (0.2, 5, 20):
            campaign = plan(tera, scratch, f"c{duration}".replace(".", "_"), f"name: c\nscenario: resting.yaml\nepisodes: {rounds}\n"
                            f"factors: [{{key: duration_s, levels: [{duration}]}}]\n")
            alone, episode = [], []
            for number in range(rounds):
                alone.append(seconds(tera, "generate", scratch / "resting.yaml", "--out", scratch / f"g{duration}_{number}", "--threads", 1,
                                     "--set", f"duration_s={duration}"))
                episode.append(seconds(tera, "campaign", "run", campaign, "--index", number))
            added = statistics.median(e - a for e, a in zip(episode, alone))
            print(f"| {duration} | {statistics.median(alone):.2f} | {statistics.median(episode):.2f} | {added:.2f} |", flush=True)


def pool(tera, rounds: int) -> None:
    """Two processes of the pool beside two loops of single runs, in turns; each makes the same six episodes."""
    text = (ROOT / "config/campaigns/small_yard.yaml").read_text().replace("../", f"{ROOT}/config/")
    ratios, of_cpu = [], []
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        for turn in range(rounds):
            pooled = plan(tera, scratch, f"pooled{turn}", text)
            with open(pooled / "episodes.csv", encoding="utf-8") as table:
                episodes = list(csv.DictReader(table))
            runs = [f"'{tera}' generate '{ROOT}/config/scenarios/varied_site.yaml' --threads 1 --out '{scratch}/single{turn}_{e.pop('number')}' "
                    f"--seed {e.pop('seed')} " + " ".join(f"--set {key}={value}" for key, value in e.items()) for e in episodes]
            before, begin = children_s(), time.monotonic()
            loops = [subprocess.Popen(["sh", "-ec", "\n".join(runs[k::2])], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                     for k in range(2)]
            for process in loops:
                assert process.wait() == 0
            alone, alone_cpu = time.monotonic() - begin, children_s() - before
            together = seconds(tera, "campaign", "run", pooled, "--processes", 2)
            ratios.append(alone / together)
            of_cpu.append(alone_cpu / (children_s() - before - alone_cpu))
            print(f"two single runs at once {alone:.1f} s, pool {together:.1f} s: ratio {ratios[-1]:.3f}, of processor time {of_cpu[-1]:.3f}", flush=True)
        files = [file for file in pooled.glob("episodes/*/data/**/*") if file.is_file()]
        merged = seconds(tera, "campaign", "merge", pooled, "--out", scratch / "merged")
        megabytes = 1e-6 * sum(file.stat().st_size for file in files)
        print(f"an episode has {len(files) / 6:.0f} files and {megabytes / 6:.1f} MB; merging takes {merged / 6:.2f} s an episode")
    print(f"median ratio {statistics.median(ratios):.3f}, of processor time {statistics.median(of_cpu):.3f}")


RECORD = """{fingerprint}
number: {number}
draw: 0
seed: 1
values: {{"terrain.soil": "dirt", "environment.sun_elevation_deg": "31.4159"}}
refused: []
sha256: "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"
bytes: 1000000
frames: 100
simulated_s: 30
wall_s: 300
peak_mb: 900
host: "node"
"""
# A Slurm that makes all episodes of an array at once.
SBATCH = """#!/usr/bin/env python3
import re, sys, time
from pathlib import Path
sys.path.insert(0, {scripts!r})
from campaign_cost import make_records
here = Path(__file__).parent
if not (here / "submitted").exists():
    (here / "submitted").write_text(str(time.monotonic()))
tasks = re.findall(r"set -- ([0-9 ]+);;", Path(sys.argv[-1]).read_text())
make_records(Path(sys.argv[-1]).parent, [int(n) for task in tasks for n in task.split()])
(here / "state").write_text("".join(f"JobId={{k}} JobState=COMPLETED NodeList=node\\n" for k in range(len(tasks))))
(here / "made").write_text(str(time.monotonic()))
print(1)
"""


def make_records(campaign: Path, numbers) -> None:
    fingerprint = re.search("fingerprint: .*", (campaign / "plan.yaml").read_text())[0]
    for number in numbers:
        episode = campaign / "episodes" / f"{number:06}"
        episode.mkdir()
        (episode / "episode.yaml").write_text(RECORD.format(fingerprint=fingerprint, number=number))


def index(tera, episodes: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        begin = time.monotonic()
        campaign = plan(tera, scratch, "many", f"name: many\nscenario: resting.yaml\nepisodes: {episodes}\ndesign: latin_hypercube\n"
                        "factors: [{key: terrain.soil, levels: [dirt, sand]}, {key: environment.sun_elevation_deg, range: [10, 60]}]\n")
        print(f"plan of {episodes} episodes: {time.monotonic() - begin:.1f} s")
        (scratch / "sbatch").write_text(SBATCH.format(scripts=str(ROOT / "scripts")))
        (scratch / "scontrol").write_text('#!/bin/sh\n[ "$2" = config ] && echo "MaxArraySize = 1001" || cat "$(dirname "$0")/state"\n')
        for program in ("sbatch", "scontrol"):
            (scratch / program).chmod(0o755)
        begin = time.monotonic()
        seconds(tera, "campaign", "run", campaign, "--on", "slurm", "--poll", "0.1", env={**os.environ, "PATH": f"{scratch}:{os.environ['PATH']}"})
        end, submitted, made = time.monotonic(), *(float((scratch / name).read_text()) for name in ("submitted", "made"))
        print(f"until the first array is submitted: {submitted - begin:.1f} s; collecting all: {end - made:.1f} s")
        print(f"status: {seconds(tera, 'campaign', 'status', campaign):.1f} s")


DEVIATION = 0.25  # of the logarithm of an episode's time; a mean of 1 needs its median at exp(-DEVIATION^2 / 2)


def simulate(seed: int, per_task: int, creates_hz: float, files=400, node_life_s=30 * 86400, episodes=10_000, nodes=1_000, mean_s=300, dispatch_hz=20,
             start_s=2):
    """Makespan, shares of the nodes' and the server's time, and number of arrays of a campaign.

    Model  a controller starts dispatch_hz tasks a second; an episode lasts a lognormal time of this mean (deviation: a quarter of it)
           and then writes its files at a server that serves all nodes one after the other; a node that is lost loses the rest
           of its task, which a further array makes anew.
    """
    chance = random.Random(seed)

    def lasting_s() -> float:
        return mean_s * chance.lognormvariate(-DEVIATION**2 / 2, DEVIATION)

    free, left, busy_s, disk_s, served_s = [(0.0, n) for n in range(nodes)], list(range(episodes)), 0.0, 0.0, 0.0
    end_s, arrays = 0.0, 0
    while left:
        arrays += 1
        lost = []
        tasks = [left[k:k + per_task] for k in range(0, len(left), per_task)]
        free = [(end_s, node) for _, node in free]
        heapq.heapify(free)
        running = []  # (time at which an episode is made, node, episodes that remain)
        dispatched_s = end_s
        waiting = tasks[::-1]
        while waiting or running:
            if waiting and free and (not running or max(free[0][0], dispatched_s) <= running[0][0]):
                ready_s, node = heapq.heappop(free)
                dispatched_s = max(ready_s, dispatched_s + 1 / dispatch_hz)
                heapq.heappush(running, (dispatched_s + start_s + lasting_s(), node, waiting.pop()))
                continue
            now_s, node, task = heapq.heappop(running)
            if chance.random() < mean_s / node_life_s:
                lost += task
                end_s = max(end_s, now_s)
                continue
            disk_s = max(disk_s, now_s) + files / creates_hz
            served_s += files / creates_hz
            busy_s += mean_s
            end_s = max(end_s, disk_s)
            if task[1:]:
                heapq.heappush(running, (disk_s + lasting_s(), node, task[1:]))
            else:
                heapq.heappush(free, (disk_s, node))
        left = lost
    return end_s, busy_s / (end_s * nodes), served_s / end_s, arrays


def schedule() -> None:
    ideal_s = 10_000 * 300 / 1_000
    print("| file creations a second | a node is lost every | episodes a task | makespan / ideal | nodes busy | server busy | arrays |\n"
          "| --- | --- | --- | --- | --- | --- | --- |")
    for creates_hz, life_days in ((20_000, 1e6), (20_000, 30), (5_000, 30), (1_000, 30)):
        for per_task in (1, 2, 5, 10):
            runs = [simulate(seed, per_task, creates_hz, node_life_s=life_days * 86400) for seed in range(10)]
            end_s, busy, served, arrays = (statistics.mean(figure) for figure in zip(*runs))
            life = f"{life_days} days" if life_days < 1e6 else "never"
            print(f"| {creates_hz} | {life} | {per_task} | {end_s / ideal_s:.2f} | {busy:.2f} | {served:.2f} | {arrays:.1f} |")


if __name__ == "__main__":
    what, program = (sys.argv[1] if len(sys.argv) > 1 else ""), (sys.argv[2] if len(sys.argv) > 2 else "")
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    if what == "schedule":
        schedule()
    elif what in ("overhead", "pool", "index") and program:
        tera_program = Path(program).resolve()
        {"overhead": lambda: overhead(tera_program), "pool": lambda: pool(tera_program, count or 3),
         "index": lambda: index(tera_program, count or 10_000)}[what]()
    else:
        sys.exit(__doc__)
