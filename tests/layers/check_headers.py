#!/usr/bin/env python3
"""Fails when a header of a module does not compile first and alone, or compiles with a warning.

    check_headers.py COMPILER COMMANDS WORK [--jobs N] [--ninja NINJA] [--root ROOT]

COMPILER reads the headers that have no source of their name, and the public ones of the modules that users
find by default; with the options with which the build that made COMMANDS, a compile_commands.json, compiles
the sources beside them. Other headers are left to the source of their name, which includes them first
(check_layers.py) and which tools/lint compiles by itself.

Reading what all of them include again for each would take minutes. What a header includes anyway may come
before it without hiding that an include of it is missing. So a header is read in one source with headers that
include it, one after the other, and where core's mesh is among what they include, after a precompiled header
that is made of that alone. Ninja does the work in WORK and reads again what has changed.
"""

import collections
import json
import pathlib
import re
import shlex
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compilers"))
import check_compiler  # noqa: E402
import check_layers  # noqa: E402

BASE = "core/mesh/mesh.h"
BASE_FROM = 3  # from this many sources on a precompiled header saves time
BY_DEFAULT = ("core", "persistence", "morse", "mscomplex", "tools/study")  # find_package(morsel)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"morsel/([^"\n]+)"', re.MULTILINE)
QUIET = ("-O0", "-g0", "-Werror", "-Winvalid-pch")


def inclusions(root, modules):
    """{header: the headers of the modules that it includes, through others too, itself among them}"""
    direct = {}
    for module in modules:
        for path in sorted((root / module).rglob("*.h")):
            direct[str(path.relative_to(root))] = INCLUDE.findall(path.read_text(encoding="utf-8"))
    closed = {}
    for header in direct:
        found, waiting = set(), [header]
        while waiting:
            name = waiting.pop()
            if name in direct and name not in found:
                found.add(name)
                waiting += direct[name]
        closed[header] = found
    return closed


def public_headers(root, folders):
    for folder in folders:
        for listing in (root / folder).rglob("CMakeLists.txt"):
            for _, name in check_layers.public_headers(listing.read_text(encoding="utf-8")):
                yield str((listing.parent / name).relative_to(root))


def options_beside(commands, root):
    """A function from a header to (directory, options) of most of the sources in its folder, or in the next
    folder above that has sources below it; None if the build has none of them."""
    votes = collections.defaultdict(collections.Counter)
    for sources, directory, options in check_compiler.checks(commands, root, check_layers.MAY_INCLUDE):
        for source in sources:
            for folder in source.relative_to(root).parents:
                votes[folder][directory, options] += 1

    def beside(header):
        for folder in list(pathlib.PurePosixPath(header).parents)[:-1]:
            if folder in votes:
                return votes[folder].most_common(1)[0][0]
        return None

    return beside


def after_base(header, closed):
    return header != BASE and BASE in closed[header]


def chains(headers, closed, group):
    """The fewest lists of headers of one group in which each header includes the one before it: a matching of
    headers with headers that include them. All of a list come after BASE, or none."""
    kind = {header: (group[header], after_base(header, closed)) for header in headers}
    later = {header: [other for other in headers
                      if header in closed[other] and other not in closed[header]
                      and kind[other] == kind[header]]
             for header in headers}
    before = {}

    def match(header, tried):
        for other in later[header]:
            if other not in tried:
                tried.add(other)
                if other not in before or match(before[other], tried):
                    before[other] = header
                    return True
        return False

    for header in headers:
        match(header, set())
    after = {first: second for second, first in before.items()}
    for header in headers:
        if header not in before:
            chain = [header]
            while chain[-1] in after:
                chain.append(after[chain[-1]])
            yield chain


def build_of(compiler, root, commands, work):
    """The build that reads the headers, and its sources: {path: text}; and the number of the headers."""
    beside = options_beside(commands, root)
    closed = inclusions(root, check_layers.MAY_INCLUDE)
    public = set(public_headers(root, BY_DEFAULT))
    group = {header: beside(header) for header in closed
             if header in public or not (root / header).with_suffix(".cpp").exists()}
    headers = [header for header, options in group.items() if options is not None]
    escaped = check_compiler.escaped
    run = f"cd $in_folder && {shlex.quote(compiler)} $options -MD -MF $out.d -MT $out"
    lines = ["rule read", f"  command = {run} -fsyntax-only $source && touch $out", "  description = $shown",
             "  depfile = $out.d", "  deps = gcc",
             "rule share", f"  command = {run} -x c++-header $source -o $out",
             "  description = $shown", "  depfile = $out.d", "  deps = gcc"]
    made, bases = {}, {}

    def add(rule, output, source, folder, options, shown, after=""):
        used = " ".join(map(shlex.quote, (*options, *QUIET)))
        lines.extend([f"build {escaped(output)}: {rule} {escaped(source)}{after}",
                      f"  in_folder = {escaped(shlex.quote(folder)).replace('$ ', ' ')}",
                      f"  options = {used}".replace("$", "$$"), f"  source = {shlex.quote(str(source))}",
                      f"  shown = {shown}"])

    lists = list(chains(headers, closed, group))
    followers = collections.Counter(group[chain[0]] for chain in lists if after_base(chain[0], closed))
    for chain in lists:
        folder, options = group[chain[0]]
        name = chain[-1].replace("/", "_")
        source, after = work / f"{name}.cpp", ""
        made[source] = "".join(f'#include "morsel/{header}"\n' for header in chain)
        if after_base(chain[0], closed) and followers[folder, options] >= BASE_FROM:
            if (folder, options) not in bases:
                base = work / f"base{len(bases)}.h"
                bases[folder, options] = base
                made[base] = f'#include "morsel/{BASE}"\n'
                add("share", f"{base}.gch", base, folder, options, BASE)
            base = bases[folder, options]
            options = (*options, "-include", str(base))
            after = f" | {escaped(base)}.gch"
        add("read", work / f"{name}.checked", source, folder, options, " ".join(chain), after)
    return {work / "build.ninja": "\n".join(lines) + "\n", **made}, len(headers)


def main():
    arguments = check_compiler.check_parser(__doc__, jobs=1).parse_args()
    work = arguments.work.resolve()
    made, count = build_of(arguments.compiler, arguments.root.resolve(),
                           json.loads(arguments.commands.read_text(encoding="utf-8")), work)
    if not count:
        sys.exit(f"there is no header beside the sources that {arguments.commands} compiles")
    check_compiler.write_changed(made)
    print(f"{count} headers in {sum(path.suffix == '.cpp' for path in made)} sources", flush=True)
    return check_compiler.run_ninja(arguments.ninja, work, arguments.jobs)


if __name__ == "__main__":
    sys.exit(main())
