#!/usr/bin/env python3
"""The judge of blades against a textbook's pressure, and its figures in docs/evidence/soil.md: those that take some seconds each."""
import pathlib
import sys
import unittest

try:
    import blade_limit
except ImportError as missing:
    print(f"skipped: {missing}; needs python3-numpy and python3-scipy")
    sys.exit(77)

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/evidence/soil.md"


class BladeLimit(unittest.TestCase):
    def test_smooth_blade_in_level_sand_meets_rankines_pressure(self):
        self.assertAlmostEqual(blade_limit.k_p(30, 0, 0), 3, delta=0.03)  # tan^2(45 deg + 30 deg / 2)

    def test_page_has_its_figures(self):
        page = PAGE.read_text()
        for name, digits in (("k_30_15_20", 2), ("berm_rough", 0), ("heap_on_a_thin_cut", 0)):
            self.assertIn(f" {blade_limit.CASES[name]():.{digits}f} ", page, name)


if __name__ == "__main__":
    unittest.main()
