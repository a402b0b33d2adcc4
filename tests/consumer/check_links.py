#!/usr/bin/env python3
"""Fails when a relative link of a page in Markdown leads nowhere: to a file, or to a heading of a page.

    check_links.py FOLDER…

Reads README.md and the like, and docs/, of each folder. Links out of the folder are followed, too.
"""

import pathlib
import re
import sys
import unicodedata

LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ +(.*?) *$", re.MULTILINE)


def anchors(text):
    """The names that GitHub gives the headings of a page."""
    names = set()
    for title in HEADING.findall(CODE.sub("", text)):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title).lower()
        kept = "".join(c for c in plain if c in " -_" or unicodedata.category(c)[0] in "LMN")
        names.add(kept.replace(" ", "-"))
    return names


def broken_links(folder):
    """Yields (page, link) for each that leads nowhere."""
    pages = sorted([*folder.glob("*.md"), *folder.glob("docs/*.md")])
    for page in pages:
        text = page.read_text()
        for link in LINK.findall(CODE.sub("", text)):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = page.parent / path if path else page
            if not target.exists():
                yield page, link
            elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text()):
                yield page, link


def main(folders):
    broken = []
    for name in folders:
        folder = pathlib.Path(name)
        if not (folder / "README.md").is_file() or not (folder / "docs").is_dir():
            sys.exit(f"{folder} has no README.md and docs/")
        broken += broken_links(folder)
    for page, link in broken:
        print(f"{page}: {link} leads nowhere")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
