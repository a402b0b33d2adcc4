#!/usr/bin/env python3
"""check_headers.py finds planted headers that do not compile alone, also where it reads several at once.

    check_headers_test.py COMPILER NINJA
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("check_headers.py")
COMPILER, NINJA = sys.argv.pop(1), sys.argv.pop(1)


class CheckHeaders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="check headers ")  # a blank in the path
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "include").mkdir()
        for module in "core", "morse":
            (self.root / "include/morsel").mkdir(exist_ok=True)
            (self.root / f"include/morsel/{module}").symlink_to(self.root / module)
            self.write(f"{module}/source.cpp", "int number = 1;\n")
        # A mesh, and six headers that come after it: as many as make it a precompiled header.
        self.write("core/types.h", "using Index = int;\n")
        self.write("core/mesh/mesh.h", "struct Mesh { Index size; };\n", "core/types.h")
        for i in range(6):
            self.write(f"core/mesh/part{i}.h",
                       f"inline Index part{i}(const Mesh& mesh) {{ return mesh.size; }}\n",
                       "core/mesh/mesh.h")
        self.write("core/mesh/whole.h", "inline int whole(const Mesh& mesh) { return part1(mesh); }\n",
                   "core/mesh/part1.h")

    def write(self, name, text, *included):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        lines = "".join(f'#include "morsel/{header}"\n' for header in included)
        path.write_text(("#pragma once\n" if name.endswith(".h") else "") + lines + text, encoding="utf-8")

    def check(self):
        commands = self.root / "compile_commands.json"
        commands.write_text(json.dumps([
            {"directory": str(self.root), "file": str(self.root / f"{module}/source.cpp"),
             "arguments": [COMPILER, "-std=c++20", "-Wall", "-Wextra", "-Iinclude", "-o", "x.o", "-c",
                           str(self.root / f"{module}/source.cpp")]} for module in ("core", "morse")]),
            encoding="utf-8")
        run = subprocess.run([sys.executable, "-B", CHECK, COMPILER, commands, self.root / "work", "--root",
                              self.root, "--ninja", NINJA], capture_output=True, text=True)
        return run.returncode, run.stdout + run.stderr

    def test_headers_that_compile_alone(self):
        code, text = self.check()
        self.assertEqual(code, 0, text)
        # Read together: types and mesh, part1 and whole.
        self.assertIn("9 headers in 7 sources", text)
        self.assertTrue((self.root / "work/base0.h.gch").exists())

    def test_an_include_is_missing_in_a_header_on_its_own(self):
        self.write("core/lone.h", "inline Index lone() { return 1; }\n")
        self.assertIn("lone.h", self.failure())

    def test_an_include_is_missing_that_the_header_before_has(self):
        self.write("morse/first.h", "inline int first() { return 1; }\n")
        self.write("morse/second.h", "inline int second() { return first(); }\n")  # first.h is not included
        self.write("morse/third.h", "inline int third() { return first() + second(); }\n", "morse/first.h",
                   "morse/second.h")
        self.assertIn("second.h", self.failure())

    def test_an_include_of_the_mesh_is_missing(self):
        self.write("core/mesh/part3.h", "inline int part3(const Mesh& mesh) { return mesh.size; }\n",
                   "core/types.h")
        self.assertIn("part3.h", self.failure())

    def test_the_mesh_itself_does_not_compile_alone(self):
        self.write("core/mesh/mesh.h", "struct Mesh { Index size; };\n")
        self.assertIn("mesh.h", self.failure())

    def test_an_include_is_taken_away_later(self):
        self.assertEqual(self.check()[0], 0)
        self.write("core/mesh/whole.h", "inline int whole(const Mesh& mesh) { return mesh.size; }\n")
        self.assertIn("whole.h", self.failure())

    def test_a_warning(self):
        self.write("core/warns.h", "inline int warns(int x) { int unused; return x; }\n")
        self.assertIn("unused", self.failure())

    def test_a_private_header_is_left_to_its_source_and_a_public_one_is_not(self):
        self.write("core/lone.h", "inline Index lone() { return 1; }\n")
        self.write("core/lone.cpp", "\n")
        self.assertEqual(self.check()[0], 0)
        self.write("core/CMakeLists.txt", "morsel_add_module(core PUBLIC_HEADERS lone.h SOURCES lone.cpp)\n")
        self.assertIn("lone.h", self.failure())

    def test_no_header_is_an_error(self):
        for module in "core", "morse":
            (self.root / f"{module}/source.cpp").unlink()
        for path in self.root.rglob("*.h"):
            path.unlink()
        self.assertIn("no header", self.failure())

    def failure(self):
        code, text = self.check()
        self.assertNotEqual(code, 0)
        return text


if __name__ == "__main__":
    unittest.main()
