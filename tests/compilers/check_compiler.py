#!/usr/bin/env python3
"""Fails when a compiler has an error or a warning for a source of a library module or of the program.

    check_compiler.py COMPILER COMMANDS WORK [--jobs N] [--folders FOLDER…]

COMMANDS is the compile_commands.json of a build, with whatever compiler; what it compiles in the folders (by
default those of the modules and of the program) is read by COMPILER with the same options, -fsyntax-only and
-Werror. Sources that a unity build joins are read together, so that templates are instantiated once for all
of them. Ninja does the work in WORK and reads sources again only if one, or a header of one, has changed.
Where many of them share their options, the headers that most of them need are read once for all.
"""

import argparse
import collections
import json
import pathlib
import re
import shlex
import subprocess
import sys

FOLDERS = ("core", "morse", "persistence", "mscomplex", "tools")
SHARED_FROM = 8  # from this many sources with the same options on a precompiled header saves time
SHARED = ("algorithm", "array", "atomic", "bit", "cmath", "functional", "limits", "map", "memory", "numeric",
          "optional", "queue",
          "set", "span", "string", "string_view", "thread", "unordered_map", "utility", "variant", "vector",
          "Eigen/Core",
          "Eigen/Geometry", "Eigen/SparseCore", "tbb/blocked_range.h", "tbb/parallel_for.h",
          "tbb/partitioner.h",
          "tbb/task_arena.h")
# Options of g++ alone, and those about the precompiled headers that it made.
DROPPED = ("-Wno-restrict", "-Wno-stringop-overflow", "-Wno-stringop-overread",
           "-Wno-array-bounds", "-Wno-maybe-uninitialized", "-Winvalid-pch", "-c")


def options_of(command):
    """The options of a command of the build: without the compiler, the source, the output and precompiled
    headers."""
    words = collections.deque(command)
    while not words[0].startswith("-"):  # a launcher such as ccache, the compiler
        words.popleft()
    options = []
    while words:
        word = words.popleft()
        if word in ("-o", "-MF", "-MT", "-MQ"):
            words.popleft()
        elif word == "-include" and "cmake_pch" in words[0]:
            words.popleft()
        elif word not in DROPPED and word not in ("-MD", "-MMD"):
            options.append(word)
    return options


def sources_of(file):
    """The sources that a file compiled by the build stands for: itself, or those that a unity build joins."""
    if file.parent.name != "Unity":
        return [file]
    included = re.findall(r'^#include "(.*)"$', file.read_text(), re.MULTILINE)
    return [pathlib.Path(path).resolve() for path in included]


def checks(commands, root, folders):
    """Yields (sources, directory, options) for what the build compiles, at once, of the folders of `root`."""
    for entry in commands:
        file = pathlib.Path(entry["directory"], entry["file"]).resolve()
        sources = [source for source in sources_of(file)
                   if any(source.is_relative_to(root / folder) for folder in folders)]
        if sources:
            words = entry.get("arguments") or shlex.split(entry["command"])
            yield sources, entry["directory"], tuple(o for o in options_of(words) if o != entry["file"])


def joined(sources):
    """The text of several sources as one. They are not included: of what stands in included files a compiler
    reports less, such as no unused variables."""
    return "".join(f'#line 1 "{source}"\n{source.read_text(encoding="utf-8")}\n' for source in sources)


def escaped(text):
    return str(text).replace("$", "$$").replace(" ", "$ ").replace(":", "$:")


def ninja_file(compiler, checks, work, root):
    """The build that reads the sources, and the headers and joined sources that it wants: {path: text}."""
    by_options = collections.defaultdict(list)
    for sources, directory, options in checks:
        by_options[directory, options].append(sources)
    run = f"cd $in_folder && {shlex.quote(compiler)} $options -Werror -MD -MF $out.d -MT $out"
    lines = ["rule read", f"  command = {run} -fsyntax-only $source && touch $out", "  description = $shown",
             "  depfile = $out.d", "  deps = gcc",
             "rule share", f"  command = {run} -fpch-instantiate-templates -x c++-header $source -o $out",
             "  description = the headers that many need",
             "  depfile = $out.d", "  deps = gcc"]
    made = {}
    for number, ((directory, options), units) in enumerate(sorted(by_options.items())):
        used = " ".join(map(shlex.quote, options))
        settings = [f"  in_folder = {escaped(shlex.quote(directory)).replace('$ ', ' ')}"]
        shared = ""
        if len(units) >= SHARED_FROM:
            header = work / f"shared{number}.h"
            made[header] = "".join(f"#include <{name}>\n" for name in SHARED)
            shared = f"{header}.pch"
            lines += [f"build {escaped(shared)}: share {escaped(header)}", *settings,
                      f"  options = {used}".replace("$", "$$"), f"  source = {shlex.quote(str(header))}"]
        for sources in units:
            names = [source.relative_to(root if source.is_relative_to(root) else source.anchor)
                     for source in sources]
            source, stamp = sources[0], work / names[0].with_suffix(".checked")
            if len(sources) > 1:
                source = work / names[0].with_suffix(".joined.cpp")
                made[source] = joined(sources)
            after = f" | {escaped(shared)}" if shared else ""
            own = f"{used} -include-pch {shlex.quote(shared)}" if shared else used
            if len(sources) > 1:  # headers that they include from beside them
                folders = sorted({str(path.parent) for path in sources})
                own = " ".join([own, *(f"-iquote {shlex.quote(folder)}" for folder in folders)])
            lines += [f"build {escaped(stamp)}: read {escaped(source)}{after}", *settings,
                      f"  options = {own}".replace("$", "$$"), f"  source = {shlex.quote(str(source))}",
                      f"  shown = {' '.join(map(str, names))}".replace("$", "$$")]
            stamp.parent.mkdir(parents=True, exist_ok=True)
    return {work / "build.ninja": "\n".join(lines) + "\n", **made}


def write_changed(texts):
    """Writes what is to be in the files, {path: text}, where it is not: else all would be read again."""
    for path, text in texts.items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")


def run_ninja(ninja, work, jobs):
    return subprocess.run([ninja, "-C", work, "-j", str(jobs), "-k", "0", "--quiet"]).returncode


def check_parser(documentation, jobs):
    """The command line of a check that has Ninja read sources with the commands of a build."""
    parser = argparse.ArgumentParser(description=documentation.splitlines()[0])
    parser.add_argument("compiler")
    parser.add_argument("commands", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--jobs", type=int, default=jobs)
    parser.add_argument("--ninja", default="ninja")
    return parser


def main():
    parser = check_parser(__doc__, jobs=2)
    parser.add_argument("--folders", nargs="+", default=FOLDERS)
    arguments = parser.parse_args()
    work = arguments.work.resolve()
    root = arguments.root.resolve()
    units = list(checks(json.loads(arguments.commands.read_text(encoding="utf-8")), root,
                        arguments.folders))
    if not units:
        sys.exit(f"{arguments.commands} compiles nothing in {', '.join(arguments.folders)}")
    write_changed(ninja_file(arguments.compiler, units, work, root))
    count = sum(len(sources) for sources, _, _ in units)
    print(f"{arguments.compiler}: {count} sources in {', '.join(arguments.folders)}", flush=True)
    return run_ninja(arguments.ninja, work, arguments.jobs)


if __name__ == "__main__":
    sys.exit(main())
