#!/usr/bin/env python3
"""Fails when a compiler has an error or a warning for a source of a library module or of the program.

    check_compiler.py COMPILER COMMANDS WORK [--jobs N] [--folders FOLDER…]

COMMANDS is the compile_commands.json of a build, with whatever compiler; what it compiles in the folders (by
default those of the modules and of the program) is read by COMPILER with the same options, -fsyntax-only and
-Werror. Ninja does the work in WORK and reads a source again only if it, or a header of it, has changed.
Where many sources share their options, the headers that most of them need are read once for all of them.
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
    """Yields (source, directory, options) for each source of the build in one of the folders of `root`."""
    for entry in commands:
        for source in sources_of(pathlib.Path(entry["directory"], entry["file"]).resolve()):
            if any(source.is_relative_to(root / folder) for folder in folders):
                words = entry.get("arguments") or shlex.split(entry["command"])
                yield source, entry["directory"], tuple(o for o in options_of(words) if o != entry["file"])


def escaped(text):
    return str(text).replace("$", "$$").replace(" ", "$ ").replace(":", "$:")


def ninja_file(compiler, checks, work, root):
    """The build that reads each source, and the headers that it wants: {path: text}."""
    by_options = collections.defaultdict(list)
    for source, directory, options in checks:
        by_options[directory, options].append(source)
    run = f"cd $in_folder && {shlex.quote(compiler)} $options -Werror -MD -MF $out.d -MT $out"
    lines = ["rule read", f"  command = {run} -fsyntax-only $source && touch $out", "  description = $shown",
             "  depfile = $out.d", "  deps = gcc",
             "rule share", f"  command = {run} -fpch-instantiate-templates -x c++-header $source -o $out",
             "  description = the headers that many need",
             "  depfile = $out.d", "  deps = gcc"]
    headers = {}
    for number, ((directory, options), sources) in enumerate(sorted(by_options.items())):
        used = " ".join(map(shlex.quote, options))
        settings = [f"  in_folder = {escaped(shlex.quote(directory)).replace('$ ', ' ')}"]
        shared = ""
        if len(sources) >= SHARED_FROM:
            header = work / f"shared{number}.h"
            headers[header] = "".join(f"#include <{name}>\n" for name in SHARED)
            shared = f"{header}.pch"
            lines += [f"build {escaped(shared)}: share {escaped(header)}", *settings,
                      f"  options = {used}".replace("$", "$$"), f"  source = {shlex.quote(str(header))}"]
        for source in sources:
            name = source.relative_to(root if source.is_relative_to(root) else source.anchor)
            stamp = work / name.with_suffix(".checked")
            after = f" | {escaped(shared)}" if shared else ""
            own = f"{used} -include-pch {shlex.quote(shared)}" if shared else used
            lines += [f"build {escaped(stamp)}: read {escaped(source)}{after}", *settings,
                      f"  options = {own}".replace("$", "$$"), f"  source = {shlex.quote(str(source))}",
                      f"  shown = {name}"]
            stamp.parent.mkdir(parents=True, exist_ok=True)
    return {work / "build.ninja": "\n".join(lines) + "\n", **headers}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("compiler")
    parser.add_argument("commands", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--ninja", default="ninja")
    parser.add_argument("--folders", nargs="+", default=FOLDERS)
    arguments = parser.parse_args()
    work = arguments.work.resolve()
    root = arguments.root.resolve()
    sources = list(checks(json.loads(arguments.commands.read_text(encoding="utf-8")), root,
                          arguments.folders))
    if not sources:
        sys.exit(f"{arguments.commands} compiles nothing in {', '.join(arguments.folders)}")
    work.mkdir(parents=True, exist_ok=True)
    for path, text in ninja_file(arguments.compiler, sources, work, root).items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:  # else all would be read again
            path.write_text(text, encoding="utf-8")
    print(f"{arguments.compiler}: {len(sources)} sources in {', '.join(arguments.folders)}", flush=True)
    return subprocess.run([arguments.ninja, "-C", work, "-j", str(arguments.jobs), "-k", "0",
                           "--quiet"]).returncode


if __name__ == "__main__":
    sys.exit(main())
