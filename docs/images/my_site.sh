#!/usr/bin/env bash
# Draws docs/images/my_site.jpg: the survey of docs/guide/my-site.md from above, what its terrain rests on, and the site
# as the camera of its mast sees it. Needs out/yard, out/site and out/site_run of that page.
set -euo pipefail
cd "$(dirname "$0")/../.."
gdaldem hillshade -q -z 1.5 out/site/terrain.tif out/site_shade.tif
/usr/bin/python3 - <<'PY'
import json
import cv2
import numpy as np

HEIGHT = 480

# The survey, higher points brighter, later ones over earlier ones.
las = open("out/yard/yard.las", "rb").read()
first, count = np.frombuffer(las[96:100], "<u4")[0], np.frombuffer(las[107:111], "<u4")[0]
points = np.frombuffer(las[first:], np.dtype([("xyz", "<i4", 3), ("rest", "V8")]))["xyz"][:count] * 0.001
points = points[np.argsort(points[:, 2])]
scale = HEIGHT / 30
survey = np.full((HEIGHT, int(40 * scale), 3), 255, np.uint8)
shade = np.clip((points[:, 2] + 1.5) / 6 * 255, 0, 255).astype(np.uint8)
colour = cv2.applyColorMap(shade[:, None], cv2.COLORMAP_VIRIDIS)[:, 0]
i, j = (points[:, 0] * scale).astype(int), HEIGHT - 1 - (points[:, 1] * scale).astype(int)
inside = (i >= 1) & (i < survey.shape[1] - 1) & (j >= 1) & (j < HEIGHT - 1)
for di in (-1, 0, 1):
    for dj in (-1, 0, 1):
        survey[j[inside] + dj, i[inside] + di] = colour[inside]

# The terrain's relief, tinted by what it rests on.
relief = cv2.imread("out/site_shade.tif", cv2.IMREAD_UNCHANGED).astype(float)
mask = cv2.imread("out/site/mask.tif", cv2.IMREAD_UNCHANGED)
tint = np.array([[1, 1, 1], [1, 0.75, 0.35], [0.35, 0.6, 1], [0.6, 0.6, 0.6]])[mask]  # blue, green, red
terrain = np.clip(relief[..., None] * tint, 0, 255).astype(np.uint8)
terrain = cv2.resize(terrain, (int(terrain.shape[1] * HEIGHT / terrain.shape[0]), HEIGHT), interpolation=cv2.INTER_NEAREST)

seen = cv2.imread(sorted(__import__("glob").glob("out/site_run/mast1/camera_site/rgb/*.png"))[0])
seen = cv2.resize(seen, (int(seen.shape[1] * HEIGHT / seen.shape[0]), HEIGHT), interpolation=cv2.INTER_AREA)
gap = np.full((HEIGHT, 12, 3), 255, np.uint8)
cv2.imwrite("docs/images/my_site.jpg", np.hstack([survey, gap, terrain, gap, seen]), [cv2.IMWRITE_JPEG_QUALITY, 80])
PY
