#!/usr/bin/env python3
"""check_compiler.py finds planted warnings and errors, and only those; with the compiler that is `c++`.

    check_compiler_test.py NINJA
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("check_compiler.py")
NINJA = sys.argv.pop(1) if len(sys.argv) > 1 else "ninja"
COMPILER = shutil.which("clang++-14") or shutil.which("clang++-16")


class CheckCompiler(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="check compiler ")  # a blank in the path
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.entries = []
        self.source("core/clean.cpp", "#include \"a.h\"\nint twice(int x) { return 2 * x; }\n")
        self.source("core/a.h", "#pragma once\n")

    def source(self, name, text, options=("-Wall", "-Wextra", "-std=c++20")):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        if name.endswith(".cpp"):
            words = ["/usr/bin/ccache", "/usr/bin/c++", *options, "-Wno-restrict", "-DQUOTED=\"a b\"", "-o",
                     "x.o", "-c", str(path)]
            self.entries.append({"directory": str(self.root), "file": str(path), "arguments": words})

    def check(self):
        commands = self.root / "compile_commands.json"
        commands.write_text(json.dumps(self.entries), encoding="utf-8")
        run = subprocess.run([sys.executable, "-B", CHECK, COMPILER, commands, self.root / "work", "--root",
                              self.root,
                              "--ninja", NINJA, "--folders", "core"], capture_output=True, text=True)
        return run.returncode, run.stdout + run.stderr

    def test_clean_sources(self):
        self.assertEqual(self.check()[0], 0)

    def test_a_warning_and_an_error_are_both_reported(self):
        self.source("core/warns.cpp", "int f(int x) { int unused; return x; }\n")
        self.source("core/wrong.cpp", "int g() { return h(); }\n")
        code, text = self.check()
        self.assertNotEqual(code, 0)
        self.assertIn("unused variable", text)
        self.assertIn("undeclared identifier", text)

    def join(self, *names):
        """A unity source in the place of the sources."""
        paths = [self.root / name for name in names]
        self.entries = [entry for entry in self.entries if pathlib.Path(entry["file"]) not in paths]
        self.source("build/Unity/unity_0.cpp", "\n".join(f'#include "{path}"\n' for path in paths))

    def test_sources_that_a_unity_build_joins_are_read_together(self):
        self.source("core/warns.cpp",
                    "int g() { return twice(1); }\nint f(int x) { int unused; return x; }\n")
        self.join("core/clean.cpp", "core/warns.cpp")
        code, text = self.check()
        self.assertNotEqual(code, 0)
        self.assertEqual(text.count("error:"), 1, text)  # none for twice(), declared by the source before
        self.assertIn(f"{self.root / 'core/warns.cpp'}:2:", text)
        self.assertIn("unused variable", text)
        (self.root / "core/warns.cpp").write_text("int g() { return twice(1); }\n", encoding="utf-8")
        self.assertEqual(self.check()[0], 0)

    def test_of_joined_sources_all_is_reported_that_is_of_a_single_one(self):
        self.source("core/warns.cpp",
                    "static inline int f() { return 1; }\nstatic const int unused_number = 1;\n")
        self.source("core/warns_too.cpp", "namespace { constexpr int unused_constant = 2; }\n")
        for joined in False, True:
            if joined:
                self.join("core/warns.cpp", "core/warns_too.cpp")
            code, text = self.check()
            self.assertNotEqual(code, 0)
            for name in "unused function 'f'", "'unused_number'", "'unused_constant'":
                self.assertIn(name, text)

    def test_a_change_of_a_joined_source_and_of_its_header_is_seen(self):
        self.source("core/first.cpp", "int once(int x) { return x; }\n")
        self.join("core/first.cpp", "core/clean.cpp")
        self.assertEqual(self.check()[0], 0)
        for name in "core/clean.cpp", "core/a.h":
            path = self.root / name
            text = path.read_text(encoding="utf-8")
            path.write_text(f"{text}static int unused_function() {{ return 1; }}\n", encoding="utf-8")
            for _ in range(2):
                self.assertIn("unused function", self.check()[1])
            path.write_text(text, encoding="utf-8")
            self.assertEqual(self.check()[0], 0)

    def test_other_folders_are_ignored(self):
        self.source("other/wrong.cpp", "int g() { return h(); }\n")
        self.assertEqual(self.check()[0], 0)

    def test_a_change_of_a_header_is_seen_and_what_fails_fails_again(self):
        self.assertEqual(self.check()[0], 0)
        self.source("core/a.h", "#pragma once\nstatic int unused_function() { return 1; }\n")
        for _ in range(2):
            self.assertIn("unused function", self.check()[1])
        self.source("core/a.h", "#pragma once\n")
        self.assertEqual(self.check()[0], 0)

    def test_many_sources_share_a_header(self):
        for i in range(10):
            self.source(f"core/many{i}.cpp",
                        f"#include <vector>\nint f{i}(const std::vector<int>& v) {{ return v[{i}]; }}\n",
                        ("-Wall", "-std=c++20", "-isystem", "/usr/include/eigen3"))
        self.source("core/many_warns.cpp",
                    "#include <vector>\nint g() { std::vector<int> v; int unused; return 1; }\n",
                    ("-Wall", "-std=c++20", "-isystem", "/usr/include/eigen3"))
        code, text = self.check()
        self.assertNotEqual(code, 0)
        self.assertEqual(text.count("error:"), 1, text)
        self.assertIn("unused variable", text)

    def test_no_source_is_an_error(self):
        self.entries = []
        self.assertIn("compiles nothing", self.check()[1])


if __name__ == "__main__":
    unittest.main()
