import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from uncalled_functions import last_word, uncalled

HEADER = "namespace soil { int Asked(int); struct Bed { Bed(); int Depth() const; int Width() const; }; }"
ONE = """#include "soil.h"
namespace soil {
int Inlined(int x) { return x + 1; }  // Forgotten is a word of a comment
int Asked(int x) { return Inlined(x) * 2; }
int Asked(double x) { return static_cast<int>(x); }
int Forgotten(int x) { return x; }
Bed::Bed() {}
int Bed::Depth() const { return 3; }
int Bed::Width() const { return 4; }
}
"""
OTHER = """#include "soil.h"
int main() { return soil::Asked(1) + soil::Bed().Depth(); }
"""


class UncalledFunctionsTest(unittest.TestCase):
    def test_what_nobody_asks_for_is_named_and_what_is_inlined_is_not(self):
        with tempfile.TemporaryDirectory() as folder:
            objects = {}
            (Path(folder) / "soil.h").write_text(HEADER, encoding="utf-8")
            for name, text in (("one", ONE), ("other", OTHER)):
                source, made = Path(folder) / f"{name}.cpp", Path(folder) / f"{name}.o"
                source.write_text(text, encoding="utf-8")
                subprocess.run(["g++", "-O2", "-c", source, "-o", made], check=True)
                objects[made] = [source]
            self.assertEqual([name for _, name in uncalled(objects)],
                             ["soil::Asked(double)", "soil::Bed::Width() const", "soil::Forgotten(int)"])

    def test_the_last_word_of_a_name_is_that_of_the_function(self):
        self.assertEqual(last_word("tera::Soil::Act(std::vector<tera::Tool, std::allocator<tera::Tool> > const&) const"), "Act")
        self.assertEqual(last_word("tera::operator<<(std::ostream&, tera::Time)"), "")
        self.assertEqual(last_word("tera::Drive(std::function<void (int)> const&)"), "Drive")


if __name__ == "__main__":
    unittest.main()
