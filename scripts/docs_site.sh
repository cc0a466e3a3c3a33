#!/usr/bin/env bash
# Builds the pages of this repository as a static site with search: build/docs_site/site/index.html. Broken links, and pages that
# mkdocs.yml does not list, are errors. Needs the Debian packages mkdocs and mkdocs-material.
set -euo pipefail
cd "$(dirname "$0")/.."

# shellcheck disable=SC2046
scripts/install_packages.sh $(sed -n 's/^docs: //p' scripts/packages.txt)

pages=build/docs_site/pages
rm -rf build/docs_site
mkdir -p $pages

# mkdocs reads one folder: the pages, and copies of all other files that they link to.
python3 - "$pages" <<'PYTHON'
import os
import re
import shutil
import sys
from pathlib import Path

target = Path(sys.argv[1])
pages = [Path("README.md"), Path("CONTRIBUTING.md"), Path("CHANGELOG.md"), *sorted(Path("docs").rglob("*.md"))]
files = set(pages)
for page in pages:
    for link in re.findall(r"\]\(([^)\s#]+)", page.read_text(encoding="utf-8")):
        if "://" in link:
            continue
        linked = Path(os.path.normpath(page.parent / link))
        if linked.is_file():
            files.add(linked)
        elif linked.is_dir():
            (target / linked).mkdir(parents=True, exist_ok=True)
            listed = "\n".join(sorted(f"- `{f.relative_to(linked)}`" for f in linked.rglob("*") if f.is_file()))
            (target / linked / "README.md").write_text(f"# {linked}\n\n{listed}\n", encoding="utf-8")
for file in files:
    (target / file).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, target / file)

listed = Path("mkdocs.yml").read_text(encoding="utf-8")
unlisted = [str(page) for page in pages if not re.search(rf": {re.escape(str(page))}$", listed, re.MULTILINE)]
if unlisted:
    sys.exit(f"mkdocs.yml: nav lacks {', '.join(unlisted)}")
PYTHON

mkdocs build --quiet --strict --config-file mkdocs.yml
echo "build/docs_site/site/index.html"
