#!/usr/bin/env python3
"""Prints what `llvm-cov export` tells: lines per module, and the largest functions that nothing enters.

    coverage_table.py [--files] [--functions N] COVERAGE.json ROOT
"""

import argparse
import collections
import json
import pathlib
import subprocess

MODULES = ("core", "persistence", "morse", "mscomplex", "tools")


def name_in(root, path):
    """The path of a source of a module, from the root; nothing for what is none."""
    resolved = pathlib.Path(path).resolve()  # headers are found through links in the build folder
    if not resolved.is_relative_to(root):
        return None
    name = resolved.relative_to(root)
    return str(name) if name.parts[0] in MODULES else None


def row(name, covered, count):
    share = f"{100 * covered / count:5.1f} %" if count else "      -"
    return f"{name:<48} {covered:>7} of {count:>7}  {share}"


def lines_of(files, root):
    """{source: (lines that run, lines)}; a header that programs found in several places counts once, by its
    best."""
    lines = {}
    for file in files:
        name = name_in(root, file["filename"])
        if name:
            summary = file["summary"]["lines"]
            lines[name] = max(lines.get(name, (0, 0)), (summary["covered"], summary["count"]))
    return lines


def functions_of(functions, root):
    """{(source, first line): [times entered, lines, mangled name]}; all instances of a template are one
    function."""
    found = {}
    for function in functions:
        name = name_in(root, function["filenames"][0])
        if not name:
            continue
        first, _, last = function["regions"][0][:3]
        entry = found.setdefault((name, first), [0, last - first + 1, function["name"]])
        entry[0] += function["count"]
    return found


def demangled(names):
    plain = [name.split(":")[-1]
             for name in names]  # those of internal linkage have their source's name before them
    run = subprocess.run(["c++filt"], input="\n".join(plain), capture_output=True, text=True, check=True)
    return run.stdout.splitlines()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("coverage", type=pathlib.Path)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--files", action="store_true", help="a row for each source, too")
    parser.add_argument("--functions", type=int, default=10)
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    data = json.loads(arguments.coverage.read_text(encoding="utf-8"))["data"][0]

    lines = lines_of(data["files"], root)
    by_module = collections.defaultdict(lambda: [0, 0])
    for name, (covered, count) in lines.items():
        module = by_module[name.split("/")[0]]
        module[0] += covered
        module[1] += count
    for module in MODULES:
        if module in by_module:
            print(row(module, *by_module[module]))
    if arguments.files:
        print()
        for name in sorted(lines):
            print(row(name, *lines[name]))

    unentered = sorted(((size, name, first, mangled)
                        for (name, first), (count, size, mangled) in functions_of(data["functions"],
                                                                                  root).items()
                        if count == 0), reverse=True)
    print(f"\n{len(unentered)} functions that no test enters; the largest:")
    largest = unentered[:arguments.functions]
    for (size, name, first, _), text in zip(largest, demangled([entry[3] for entry in largest])):
        print(f"{size:>5} lines  {name}:{first}  {text}")


if __name__ == "__main__":
    main()
