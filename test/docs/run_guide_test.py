import unittest
from pathlib import Path

from run_guide import blocks_of, faults_of, is_printed, script_of

PAGE = """# A page
```sh
echo one; echo two 2.5 m
```
Words.
```text
two 3.1 m
…
```
```sh fails
false
```
```console
ros2 topic list
```
"""


class RunGuideTest(unittest.TestCase):
    def test_commands_and_what_they_print_are_found_and_other_blocks_are_not_read(self):
        first, second = blocks_of(PAGE)
        self.assertEqual(first.commands, "echo one; echo two 2.5 m")
        self.assertEqual(first.prints, [(7, "two 3.1 m")])
        self.assertFalse(first.fails)
        self.assertTrue(second.fails)
        self.assertEqual(second.line, 10)

    def test_a_block_without_end_and_output_without_commands_are_refused(self):
        for page in ("```sh\ntrue\n", "```text\none\n```\n"):
            with self.assertRaises(ValueError):
                blocks_of(page)

    def test_numbers_may_differ_and_words_may_not(self):
        self.assertTrue(is_printed("dead band 0.121 ± 0.006", "boom: dead band 0.119 ± 0.007, asymmetry 0"))
        self.assertTrue(is_printed("a … c", "a b  c"))
        self.assertTrue(is_printed("error -0.2 e", "error  1e-05 e"))
        self.assertFalse(is_printed("dead band 0.121", "rate gain 0.121"))
        self.assertFalse(is_printed("a c", "a\nc"))

    def test_a_fault_names_the_line_of_the_page(self):
        blocks = blocks_of(PAGE)
        self.assertEqual(faults_of(Path("p.md"), blocks, 0, "\n@block 0\ntwo 7 m\n\n@block 1\n\n@end\n"), [])
        self.assertEqual(faults_of(Path("p.md"), blocks, 0, "\n@block 0\ntwo\n\n@block 1\n\n@end\n"),
                         ["p.md:7: not printed: two 3.1 m"])
        self.assertEqual(faults_of(Path("p.md"), blocks, 3, "\n@block 0\n\n@block 1\nx\n"),
                         ["p.md:10: a command of this block ended with status 3"])

    def test_the_script_runs_blocks_in_their_order(self):
        script = script_of(blocks_of(PAGE))
        self.assertLess(script.index("@block 0"), script.index("echo one"))
        self.assertLess(script.index("echo one"), script.index("@block 1"))


if __name__ == "__main__":
    unittest.main()
