#!/usr/bin/env python3
"""Takes one figure out of a report of `tera diagnose`, with the page's style, so that it stands by itself.

    docs/images/figure_of_report.py out/why/report.html 'measured and predicted over time' > figure.svg

A label that several figures have is followed by which of them, counted from 1.
"""
import re
import sys

page = open(sys.argv[1], encoding="utf-8").read()
style = re.search(r"<style>(.*?)</style>", page, re.S).group(1)
label = f"aria-label='{sys.argv[2]}'"
which = int(sys.argv[3]) if len(sys.argv) > 3 else 1
starts = [m.start() for m in re.finditer(r"<svg [^>]*>", page) if label in m.group(0)]
if len(starts) < which:
    sys.exit(f"{sys.argv[1]}: has {len(starts)} figures labelled '{sys.argv[2]}'")
end, depth = starts[which - 1], 0
for tag in re.finditer(r"<svg |</svg>", page[end:]):
    depth += 1 if tag.group(0) == "<svg " else -1
    if depth == 0:
        end += tag.end()
        break
figure = page[starts[which - 1] : end]
head, body = figure.split(">", 1)
sys.stdout.write(f"{head} xmlns='http://www.w3.org/2000/svg'><style>{style}svg{{font:13px sans-serif;background:var(--paper)}}</style>{body}\n")
