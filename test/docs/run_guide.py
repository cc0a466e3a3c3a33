"""Runs the commands of a guide as its reader would, in a copy of the project's data, and holds what they print against the page.

    test/docs/run_guide.py docs/guide/first-dataset.md --build build/release [--keep FOLDER]

Blocks of a page, told by the words behind their fence:

    ```sh          commands; all of a page run in one shell, in order, and the first that fails ends it
    ```sh fails    commands of which the last must fail, as the page says
    ```text        what the block above it prints, shortened: each line must be in what was printed, where numbers may
                   be others and … stands for anything
    ```console     what a test cannot run; not read here, as all other blocks

The shell runs in the root of the copy, whose `out/` is empty and whose `build/release` is the build.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COPIED = ["assets", "config", "docs", "examples", "scripts", "shaders"]
FENCE = re.compile(r"^```(.*)$")
NUMBER = r"[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


@dataclass
class Block:
    line: int
    commands: str
    fails: bool
    prints: list = field(default_factory=list)  # (line, text)


def blocks_of(page: str) -> list:
    """Blocks to run, each with the lines that it must print."""
    blocks, kind, start, body = [], None, 0, []
    for number, line in enumerate(page.splitlines(), 1):
        fence = FENCE.match(line)
        if not fence:
            body.append((number, line))
        elif kind is None:
            kind, start, body = fence[1].strip(), number, []
        else:
            if kind in ("sh", "sh fails"):
                blocks.append(Block(start, "\n".join(text for _, text in body), kind == "sh fails"))
            elif kind == "text":
                if not blocks:
                    raise ValueError(f"line {start}: no commands above this output")
                blocks[-1].prints += [(n, text) for n, text in body if text.strip(" …")]
            kind = None
    if kind is not None:
        raise ValueError(f"line {start}: this block has no end")
    return blocks


def is_printed(line: str, output: str) -> bool:
    """Whether a line of the page is in the output; numbers may differ, … is anything, spaces count as one."""
    parts = []
    for text in re.split(f"({NUMBER}|…)", " ".join(line.split())):
        if text == "…":
            parts.append(".*")
        elif re.fullmatch(NUMBER, text):
            parts.append(NUMBER)
        else:
            parts.append(re.escape(text).replace(r"\ ", " +"))
    form = re.compile("".join(parts))
    return any(form.search(" ".join(printed.split())) for printed in output.splitlines())


def script_of(blocks: list) -> str:
    """One script; each block is announced by a line of its own, so that what was printed can be told apart."""
    lines = ["set -euo pipefail", "export LC_ALL=C.UTF-8"]
    for index, block in enumerate(blocks):
        lines.append(f"echo; echo '@block {index}'")
        if block.fails:
            lines += ["set +e", "(set -e", block.commands, ")", "status=$?", "set -e",
                      "[ $status -ne 0 ] || { echo 'this should have failed'; exit 1; }"]
        else:
            lines.append(block.commands)
    return "\n".join(lines + ["echo; echo '@end'", ""])


def copy_of_project(scratch: Path, build: Path) -> None:
    for folder in COPIED:
        shutil.copytree(ROOT / folder, scratch / folder, ignore=shutil.ignore_patterns("__pycache__"))
    (scratch / "build").mkdir()
    (scratch / "build/release").symlink_to(build.resolve(), target_is_directory=True)


def faults_of(page: Path, blocks: list, status: int, output: str) -> list:
    """What went otherwise than the page says, each with its line."""
    printed = re.split(r"^@(?:block \d+|end)\n", output, flags=re.MULTILINE)[1:]
    if status != 0:
        block = blocks[len(printed) - 1] if printed else blocks[0]
        return [f"{page}:{block.line}: a command of this block ended with status {status}"]
    return [f"{page}:{line}: not printed: {text}"
            for block, text_of_block in zip(blocks, printed) for line, text in block.prints
            if not is_printed(text, text_of_block)]


def lint_faults_of(page: Path, scratch: Path, environment: dict) -> list:
    """Datasets that the commands left and that do not keep the rules of datasets."""
    faults = []
    for described in sorted((scratch / "out").rglob("dataset.yaml")):
        dataset = described.parent.relative_to(scratch)
        lint = subprocess.run(["tera", "lint", str(dataset)], cwd=scratch, env=environment, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
        if lint.returncode != 0:
            faults.append(f"{page}: {dataset} does not keep the rules of datasets:\n{lint.stdout}")
    return faults


def run(page: Path, build: Path, scratch: Path) -> list:
    blocks = blocks_of(page.read_text(encoding="utf-8"))
    if not blocks:
        return [f"{page}: no commands"]
    copy_of_project(scratch, build)
    environment = {**os.environ, "PATH": f"{scratch / 'build/release'}:{os.environ['PATH']}"}
    script = scratch / "build/guide.sh"
    script.write_text(script_of(blocks), encoding="utf-8")
    ended = subprocess.run(["bash", str(script)], cwd=scratch, env=environment, stdin=subprocess.DEVNULL, check=False,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    print(ended.stdout)
    return faults_of(page, blocks, ended.returncode, ended.stdout) + lint_faults_of(page, scratch, environment)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release", help="folder of the program and its Python package")
    parser.add_argument("--keep", type=Path, help="folder to run in, which must not exist and is left; else a temporary one")
    arguments = parser.parse_args()
    if arguments.keep:
        arguments.keep.mkdir(parents=True)
        faults = run(arguments.page, arguments.build, arguments.keep.resolve())
    else:
        with tempfile.TemporaryDirectory(prefix="guide_") as folder:
            faults = run(arguments.page, arguments.build, Path(folder).resolve())
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
