#!/usr/bin/env python3
"""Draft of a plane blade by a limit analysis that shares nothing with TERA.

    blade_limit.py [NAME ...]

Discontinuity layout optimisation (Smith and Gilbert 2007, Proc. R. Soc. A 463:2461): of all patterns of straight slip lines between the
points of a grid, the one in which a moving blade does least work, as a linear program. Plane strain, Mohr-Coulomb soil that dilates as it
slips, so that each figure is an upper bound, a few parts in a hundred above the least where the grid is coarse. Prints the cases of
docs/evidence/soil.md, or those named: K of slopes, drafts in N/m of others. Some minutes. Needs python3-numpy and python3-scipy.
"""

import math
import sys

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_matrix

GRAVITY_MPS2 = 9.80665
SAMPLES = np.linspace(0.05, 0.95, 10)  # along a line


class Ground:
    """A surface z(x), as a polyline, above the edge at (0, 0), and the top of what stands firm, which alone has cohesion."""

    def __init__(self, x_m, top_m, firm_m=None, density_kgpm3=1600.0, friction_deg=30.0, cohesion_pa=0.0):
        self.x_m, self.top_m = np.array(x_m, float), np.array(top_m, float)
        self.firm_m = self.top_m if firm_m is None else np.array(firm_m, float)
        self.weight_npm3 = density_kgpm3 * GRAVITY_MPS2
        self.tan_friction = math.tan(math.radians(friction_deg))
        self.cohesion_pa = cohesion_pa

    def top_at(self, x_m):
        return np.interp(x_m, self.x_m, self.top_m)

    def firm_at(self, x_m):
        return np.interp(x_m, self.x_m, self.firm_m)


class Grid:
    """Points in the soil before an upright blade, rows between the edge's level and the surface and some below, and its borders."""

    def __init__(self, ground, columns, rows, below):
        xs = np.concatenate([[0], ground.x_m[-1] * np.linspace(0, 1, columns)[1:] ** 1.25])
        depth_m = ground.top_m[0]
        index, points = {}, []
        for i, x in enumerate(xs):
            for j in range(-below, rows + 1):
                if i == 0 and j < 0:
                    continue
                index[i, j] = len(points)
                points.append((x, (ground.top_at(x) if j >= 0 else depth_m) * j / rows))
        self.points = np.array(points)
        last = len(xs) - 1
        wall = [index[0, j] for j in range(rows + 1)]
        surface = [index[i, rows] for i in range(last + 1)]
        bottom = [index[0, 0]] + [index[i, -below] for i in range(1, last + 1)]
        right = [index[last, j] for j in range(-below, rows + 1)]
        self.border = {}
        for kind, line in (("blade", wall), ("surface", surface), ("fixed", bottom), ("fixed", right)):
            self.border.update({pair: kind for pair in zip(line[:-1], line[1:])})
        self.on_blade = set(wall)

    def lines(self, ground):
        """(a, b, kind) of the borders and of all lines through soil alone that have no other point on them."""
        yield from ((a, b, kind) for (a, b), kind in self.border.items())
        longest_m = 0.9 * ground.x_m[-1]
        for a in range(len(self.points)):
            from_a = self.points - self.points[a]
            for b in range(a + 1, len(self.points)):
                if (a, b) in self.border or (b, a) in self.border or {a, b} <= self.on_blade:
                    continue
                d = from_a[b]
                length_m = np.hypot(*d)
                if not 1e-9 < length_m < longest_m:
                    continue
                along = from_a @ d / length_m**2
                off_m = np.abs(from_a[:, 0] * d[1] - from_a[:, 1] * d[0]) / length_m
                if np.any((along > 1e-6) & (along < 1 - 1e-6) & (off_m < 1e-7)):
                    continue
                x_m, z_m = self.points[a][0] + SAMPLES * d[0], self.points[a][1] + SAMPLES * d[1]
                if np.all(z_m <= ground.top_at(x_m) + 1e-9):
                    yield a, b, "soil"


def draft_npm(ground, blade_friction_deg, columns=18, rows=10, below=3):
    """Least level force for each metre of width that moves an upright blade ahead, with the edge at (0, 0)."""
    grid = Grid(ground, columns, rows, below)
    tan_blade = math.tan(math.radians(blade_friction_deg))
    entries, cost, bounds = [], [], []
    moved = np.zeros(2 * len(grid.points))  # what the blade's own motion puts into the points' equations

    def add(a, b, slip, opens, price, sign_free):
        """A jump across a-b, of its left side against its right; each point's jumps must close."""
        d = (grid.points[b] - grid.points[a]) / np.hypot(*(grid.points[b] - grid.points[a]))
        v = d[0] * slip - d[1] * opens, d[1] * slip + d[0] * opens
        for point, sign in ((a, 1), (b, -1)):
            entries.extend((2 * point + k, len(cost), sign * v[k]) for k in (0, 1) if v[k])
        cost.append(price(v[1]))
        bounds.append((None, None) if sign_free else (0, None))

    for a, b, kind in grid.lines(ground):
        d = grid.points[b] - grid.points[a]
        x_m, z_m = grid.points[a][0] + SAMPLES * d[0], grid.points[a][1] + SAMPLES * d[1]
        weight_npm = ground.weight_npm3 * np.mean(np.maximum(0, ground.top_at(x_m) - z_m)) * d[0]
        firm = np.mean(z_m < ground.firm_at(x_m) + 1e-9)
        cohesive_npm = firm * ground.cohesion_pa * np.hypot(*d)
        if kind == "surface":  # nothing resists beyond it
            add(a, b, 1, 0, lambda up: 0.0, True)
            add(a, b, 0, 1, lambda up: 0.0, True)
            continue
        if kind == "blade":  # up the blade, soil to its right: beside the blade's motion it slips and opens
            for point, sign in ((a, 1), (b, -1)):
                moved[2 * point] += sign
        friction, holds_npm = (tan_blade, 0.0) if kind == "blade" else (ground.tan_friction, cohesive_npm)
        for slip in (1, -1):
            add(a, b, slip, friction, lambda up, w=weight_npm, c=holds_npm: c + w * up, False)
    rows_at, columns_at, values = zip(*entries)
    matrix = coo_matrix((values, (rows_at, columns_at)), shape=(len(moved), len(cost)))
    result = linprog(cost, A_eq=matrix.tocsr(), b_eq=moved, bounds=bounds, method="highs")
    if result.status != 0:
        raise RuntimeError(result.message)
    return result.fun


def k_p(friction_deg, blade_deg, slope_deg):
    reach_m = 5.0
    ground = Ground([0, reach_m], [1, 1 + reach_m * math.tan(math.radians(slope_deg))], friction_deg=friction_deg)
    return draft_npm(ground, blade_deg) / math.cos(math.radians(blade_deg)) / (0.5 * ground.weight_npm3)


def berm(blade_deg):
    """0.6 m high at 35 deg, the blade 0.3 m deep in its near flank, its far foot cut off at 5 cm."""
    rise = math.tan(math.radians(35))
    ground = Ground([0, 0.3 / rise, 0.85 / rise], [0.3, 0.6, 0.05], friction_deg=40)
    return draft_npm(ground, blade_deg, columns=16, rows=8)


def heap(depth_m, heap_m, cohesion_pa):
    """Loose, falling off at 35 deg, on ground that stands `depth_m` above the edge."""
    foot_m = heap_m / math.tan(math.radians(35))
    reach_m = foot_m + 4 * depth_m + 0.6
    firm = [depth_m] * 3
    ground = Ground([0, foot_m, reach_m], [depth_m + heap_m, depth_m, depth_m], firm, friction_deg=40, cohesion_pa=cohesion_pa)
    return draft_npm(ground, 20, columns=20, rows=10)


CASES = {f"k_{phi}_{delta}_{slope}": (lambda p=phi, d=delta, s=slope: k_p(p, d, s))
         for phi, delta in ((30, 0), (30, 15), (40, 20), (40, 40)) for slope in (0, 10, 20)}
CASES.update({
    "berm_smooth": lambda: berm(0),
    "berm_rough": lambda: berm(20),
    "heap_on_a_thin_cut": lambda: heap(0.03, 0.5, 2100),
    "heap_on_a_deep_cut": lambda: heap(0.2, 0.25, 2100),
    "heap_on_a_deep_cut_in_sand": lambda: heap(0.2, 0.25, 0),
})

if __name__ == "__main__":
    for name in sys.argv[1:] or CASES:
        print(f"{name} {CASES[name]():.2f}", flush=True)
