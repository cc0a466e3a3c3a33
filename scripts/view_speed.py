#!/usr/bin/env python3
"""How quickly `tera view` shows a large recording, in Chromium without a window.

    scripts/view_speed.py repeat DATASET OUT --times 15 --long-rows 10000000    a recording that is a short one over and over, and a long table
    scripts/view_speed.py measure DATASET [--program build/release/tera]        first picture, scrubs to places drawn at random, memory

A scrub is measured from the change of the time to the last panel that has its data and has drawn: pictures of all cameras with boxes, the scan and
the machine in 3-D, the values in the legends. WebGL draws behind that; on a computer without a GPU its own time is printed beside.
"""

import argparse
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "test" / "view"))
import browser  # noqa: E402

FRAME = re.compile(r"(\d+)\.(png|pcd|json)")
STRETCH_NS = 10**9
SCRUBS = 60
SCRUB = """(async (t) => {
  const begun = performance.now();
  tera.setTime(t);
  const busy = () => tera.view.update.is_busy || tera.plots.values.is_busy || tera.cameras.cards.some((c) => c.update.is_busy);
  while (busy()) await new Promise((r) => { const c = new MessageChannel(); c.port1.onmessage = r; c.port2.postMessage(0); });
  const data = performance.now() - begun, gl = tera.view.renderer.getContext();
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  return [data, performance.now() - begun - data];
})"""


def repeat(source, out, times, long_rows):
    """Every file with a stamp, and every row of a table, again and again, later each time by the recording's length."""
    length_ns = int(float(re.search(r"duration_s: (\S+)", (source / "dataset.yaml").read_text())[1]) * STRETCH_NS)
    for file in sorted(path for path in source.rglob("*") if path.is_file()):
        to = out / file.relative_to(source)
        to.parent.mkdir(parents=True, exist_ok=True)
        frame = FRAME.fullmatch(file.name)
        if frame and "terrain" not in file.parts:
            for k in range(times if int(frame[1]) < length_ns else 0):
                shutil.copyfile(file, to.with_name(f"{int(frame[1]) + k * length_ns}.{frame[2]}"))
        elif file.suffix == ".csv":
            to.write_text(repeated_table(file.read_text(), times, length_ns))
        else:
            shutil.copyfile(file, to)
    text = re.sub(r"duration_s: .*", f"duration_s: {times * length_ns / STRETCH_NS:g}", (out / "dataset.yaml").read_text(), count=1)
    (out / "dataset.yaml").write_text(text.replace("channels:\n", 'channels:\n  - {path: "long/long.csv", type: table}\n', 1))
    (out / "long").mkdir()
    with open(out / "long" / "long.csv", "w", encoding="ascii") as table:
        table.write("t_ns,wave_m,noise_m,count_m,x_m\n")
        step_ns = times * length_ns // long_rows
        for k in range(long_rows):
            table.write(f"{k * step_ns},{math.sin(k * 1e-5):.9f},{random.random():.9f},{k},{k / 7:.9f}\n")


def repeated_table(text, times, length_ns):
    head, *lines = text.splitlines()
    rows = [(int(stamp), comma, rest) for stamp, comma, rest in (line.partition(",") for line in lines)]
    out = [head]
    for k in range(times):
        for stamp, comma, rest in rows:
            if 0 <= stamp < length_ns:
                later = stamp + k * length_ns
                out.append(f"{later}{comma}" + (FRAME.sub(rf"{later}.\2", rest) if head == "t_ns,filename" else rest))
    return "\n".join(out) + "\n"


def measure(dataset, program):
    size = sum(path.stat().st_size for path in dataset.rglob("*") if path.is_file())
    server = subprocess.Popen([program, "view", dataset, "--stop-with-stdin"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    address = re.search(r"http://\S+", server.stdout.readline())[0]
    with browser.Browser(1600, 950) as page:
        page.open(address)
        page.wait("window.tera?.is_ready", 600)
        time.sleep(2)
        length_s = page.run("tera.state.to_s")
        random.seed(1)
        scrubs = [page.run(f"{SCRUB}({random.random() * length_s})") for _ in range(SCRUBS)]
        data, drawn = (sorted(one[k] for one in scrubs) for k in (0, 1))
        print(json.dumps({
            "recording_gb": round(size / 1e9, 2), "first_picture_ms": round(page.run("tera.first_picture_ms")),
            "scrub_ms_median": round(data[SCRUBS // 2]), "scrub_ms_95": round(data[int(0.95 * SCRUBS)]), "webgl_ms_median": round(drawn[SCRUBS // 2]),
            "webgl_in_software": page.run("tera.view.is_software"), "page_mb": round(page.memory_mb())}, indent=2))
    server.stdin.close()
    server.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    again = commands.add_parser("repeat")
    again.add_argument("dataset", type=pathlib.Path)
    again.add_argument("out", type=pathlib.Path)
    again.add_argument("--times", type=int, default=15)
    again.add_argument("--long-rows", type=int, default=10_000_000)
    seen = commands.add_parser("measure")
    seen.add_argument("dataset", type=pathlib.Path)
    seen.add_argument("--program", default="build/release/tera")
    arguments = parser.parse_args()
    if arguments.command == "repeat":
        repeat(arguments.dataset, arguments.out, arguments.times, arguments.long_rows)
    else:
        measure(arguments.dataset, arguments.program)


if __name__ == "__main__":
    main()
