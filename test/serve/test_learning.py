"""examples/python/learn_to_dig.py, small."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

EXAMPLE = Path(__file__).resolve().parents[2] / "examples/python/learn_to_dig.py"


def learnt(folder, *options):
    subprocess.run([sys.executable, "-B", EXAMPLE, "--out", folder, "--generations", "2", "--candidates", "4", "--yards",
                    "1", "--tests", "2", *options], check=True, capture_output=True)
    return json.loads((Path(folder) / "policy.json").read_text())


class LearningTest(unittest.TestCase):
    def test_one_seed_gives_one_policy_by_any_number_of_environments(self):
        with tempfile.TemporaryDirectory() as folder:
            first = learnt(f"{folder}/a", "--environments", "1")
            self.assertEqual(first, learnt(f"{folder}/b", "--environments", "3"))
            self.assertNotEqual(first["policy"], learnt(f"{folder}/c", "--seed", "2")["policy"])
            self.assertEqual(len(first["curve"]), 2)
            self.assertGreater(max(first["learnt_m3"]), 0)
            self.assertIn("<polyline", Path(f"{folder}/a/curve.svg").read_text())


if __name__ == "__main__":
    unittest.main()
