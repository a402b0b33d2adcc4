#!/usr/bin/env python3
"""check_layers.py finds planted violations, and nothing else."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import check_layers

CLEAN = {
    "core/CMakeLists.txt": "morsel_add_module(core PUBLIC_HEADERS a.h SOURCES a.cpp DEPENDS Eigen3::Eigen)\n",
    "core/a.h": "#pragma once\n#include <Eigen/Core>\n#include <vector>\n",
    "core/a.cpp": '#include "morsel/core/a.h"\n',
    "morse/functions/height.cpp": '#include "morsel/core/a.h"\n#include "morsel/morse/functions/height.h"\n',
    "persistence/pairing.h": '#pragma once\n#include "morsel/core/a.h"\n',
    "mscomplex/complex.h": '#pragma once\n#include <boost/graph/adjacency_list.hpp>\n'
                           '#include "morsel/core/a.h"\n',
    "tools/main.cpp": '#include <iostream>\n#include "morsel/mscomplex/complex.h"\n'
                      'int main() { std::cout << 1; }\n',
}


def complaints(changes):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**CLEAN, **changes}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return check_layers.check(root)[0]


class CheckLayers(unittest.TestCase):
    def test_clean_tree(self):
        self.assertEqual(complaints({}), [])

    def test_what_is_allowed(self):
        for code in ("// std::cout << exit(1)\n", "/* #include \"morsel/morse/x.h\"\n abort() */\n",
                     'const char* text = "exit(1) // std::cerr";\n', "auto c = '\"'; auto n = 1'000'000;\n",
                     'auto r = R"(printf("x"))";\n', "std::snprintf(buffer, 8, format);\n", "loop.exit();\n",
                     "#  include <algorithm>\n", "#include <nanoflann.hpp>\n", "int on_exit(int);\n",
                     "std::size_t inputs (0);\n"):
            with self.subTest(code=code):
                self.assertEqual(complaints({"core/b.cpp": code}), [])

    def test_exceptions_are_of_one_source(self):
        code = "#include <nlohmann/json.hpp>\n"
        self.assertEqual(complaints({"core/io/gltf_reader.cpp": code}), [])
        for name in ("core/io/obj_reader.cpp", "core/gltf_reader.cpp"):
            with self.subTest(name=name):
                self.assertEqual(len(complaints({name: code})), 1)
        self.assertEqual(len(complaints({"core/io/gltf_reader.cpp": "#include <iostream>\n"})), 1)

    def test_includes(self):
        for name, code in (("core/b.h", '#include "morsel/morse/critical_points.h"'),
                           ("core/b.h", "#include <morsel/tools/registry.h>"),
                           ("persistence/b.h", '#include "morsel/mscomplex/complex.h"'),
                           ("morse/deep/er/b.cpp", '  #  include "morsel/mscomplex/complex.h"'),
                           ("persistence/b.cpp", '#include "morsel/morse/critical_points.h"'),
                           ("mscomplex/b.h", '#include "morsel/morse/critical_points.h"'),
                           ("core/b.h", '#include "support/meshes.h"'),
                           ("morse/b.h", '#include "../core/a.h"'),
                           ("morse/b.h", '#include "morsel/tests/support/meshes.h"'),
                           ("core/b.h", "#include <catch2/catch.hpp>"),
                           ("mscomplex/b.h", "#include <nlohmann/json.hpp>"),
                           ("core/b.cpp", "#include <iostream>"),
                           ("core/b.h", "#include <nanoflann.hpp>"),
                           ("core/b.h", "#include <CGAL/IO/polygon_soup_io.h>"),
                           ("tools/commands/b.cpp", '#include "tests/support/meshes.h"'),
                           ("tools/commands/b.cpp", "#include <phat/boundary_matrix.h>")):
            with self.subTest(name=name, code=code):
                found = complaints({name: f"#pragma once\n{code}\n"})
                self.assertEqual(len(found), 1)
                self.assertTrue(found[0].startswith(f"{name}:2: "), found)

    def test_headers_stand_alone(self):
        for changes, where in (({"core/b.h": "#include <vector>\n"}, "core/b.h:1: "),
                               ({"core/a.cpp": "#include <vector>\n#include \"morsel/core/a.h\"\n"},
                                "core/a.cpp:1: "),
                               ({"core/a.cpp": "int x;\n"}, "core/a.cpp:1: ")):
            with self.subTest(changes=changes):
                found = complaints(changes)
                self.assertEqual(len(found), 1)
                self.assertTrue(found[0].startswith(where), found)

    def test_printing_and_exiting(self):
        for code in ("std::cout << 1;", "std::cerr << 1;", 'printf("x");', 'std::printf ("x");',
                     "std::exit(1);",
                     "exit(1);", "std::abort();", "std::terminate();", 'fprintf(stderr, "x");', 'puts("x");',
                     "if (bad) quick_exit(3);", "auto n = 1'000; abort();"):
            with self.subTest(code=code):
                found = complaints({"morse/b.cpp": f"void f() {{\n  {code}\n}}\n"})
                self.assertEqual(len(found), 1)
                self.assertTrue(found[0].startswith("morse/b.cpp:2: "), found)

    def test_rooms_of_tools(self):
        """A room includes rooms of lower floors only: neither one above, nor a neighbour, nor one that has no
        floor."""
        for name, code, said in (
                ("tools/study/a.h", '#include "morsel/tools/report/b.h"', "study may not include"),
                ("tools/html/a.h", '#include "morsel/tools/export/b.h"', "html may not include"),
                ("tools/formats/a.cpp", '#include "morsel/tools/study/b.h"', "formats may not include"),
                ("tools/batch/a.h", '#include "morsel/tools/commands/b.h"', "batch may not include"),
                ("tools/study/a.cpp", "#include <nlohmann/json.hpp>", "study may not include"),
                ("tools/study/a.cpp", '#include "morsel/tools/study/a.h"\n'
                                      'auto t = "give it by --by";', "no options"),
                ("tools/study/a.cpp", '#include "morsel/tools/attic/b.h"', "the room attic"),
                ("tools/attic/a.cpp", '#include "morsel/core/a.h"', "the room attic"),
                ("tools/plot/a.cpp", "#include <cstdio>\nvoid f() { puts(\"x\"); }", "plot may not print"),
                ("tools/export/CMakeLists.txt", "x(DEPENDS morsel::render)", "export may not be linked")):
            with self.subTest(code=code):
                text = ("#pragma once\n" if name.endswith(".h") else "") + code + "\n"
                found = complaints({name: text})
                self.assertEqual(len(found), 1, found)
                self.assertIn(said, found[0])
        self.assertEqual(complaints({"tools/batch/a.h": '#pragma once\n#include "morsel/tools/plot/b.h"\n',
                                     "tools/plot/CMakeLists.txt":
                                         "x(DEPENDS morsel::report morsel::core)\n"}), [])

    def test_rooms_of_python(self):
        """What `import morsel` loads does without documents and molecules; nothing of the library knows of
        Python."""
        for name, code, said in (
                ("python/library/a.cpp", '#include "morsel/tools/report/b.h"', "library may not include"),
                ("python/library/a.cpp", '#include "morsel/python/documents/b.h"', "library may not include"),
                ("python/binding/a.cpp", '#include "morsel/tools/html/b.h"', "binding may not include"),
                ("python/molecule/a.cpp", '#include "morsel/tools/export/b.h"', "molecule may not include"),
                ("python/library/a.cpp", "#include <cstdio>\nvoid f() { puts(\"x\"); }", "may not print"),
                ("tools/study/a.cpp", '#include "morsel/python/binding/b.h"', "tools may not include")):
            with self.subTest(code=code):
                found = complaints({name: code + "\n"})
                self.assertEqual(len(found), 1, found)
                self.assertIn(said, found[0])
        self.assertEqual(complaints({
            "python/documents/a.cpp":
                '#include "morsel/tools/html/b.h"\n#include "morsel/python/binding/c.h"\n',
            "python/library/a.cpp": '#include "morsel/tools/study/b.h"\n#include <pybind11/stl.h>\n',
            "python/CMakeLists.txt": "x(LINKS morsel::export)\n"}), [])

    def test_public_headers(self):
        """Listed headers are there, once, and include none that is not listed, in whatever module."""
        listing = ("morsel_add_module(\n  core\n  PUBLIC_HEADERS a.h  # the first\n    deep/b.h\n"
                   "  SOURCES a.cpp)\n")
        public = {"core/CMakeLists.txt": listing,
                  "core/deep/b.h": '#pragma once\n#include "morsel/core/a.h"\n'}
        private = {"core/c.h": "#pragma once\n"}
        includes_private = '#pragma once\n#include "morsel/core/c.h"\n'
        self.assertEqual(complaints({**public, **private, "core/b.cpp": '#include "morsel/core/c.h"\n'}), [])
        room = "morsel_add_module(study WITHIN tools PUBLIC_HEADERS d.h SOURCES d.cpp)\n"
        for changes, where, said in (
                ({"core/CMakeLists.txt": listing}, "core/CMakeLists.txt:4: ", "no header deep/b.h"),
                ({**public, "core/CMakeLists.txt": listing.replace("deep/b.h", "a.h")},
                 "core/CMakeLists.txt:4: ", "twice"),
                ({**public, **private, "core/deep/b.h": includes_private}, "core/deep/b.h:2: ", "is private"),
                ({"core/CMakeLists.txt": listing.replace("deep/b.h", ""), **private,
                  "core/a.h": "#pragma once\n#include <morsel/core/c.h>\n"}, "core/a.h:2: ", "is private"),
                ({**private, "tools/study/CMakeLists.txt": room,
                  "tools/study/d.h":
                      '#pragma once\n#include "morsel/core/a.h"\n#include "morsel/core/c.h"\n'},
                 "tools/study/d.h:3: ", "is private")):
            with self.subTest(changes=changes):
                found = complaints(changes)
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(where), found)
                self.assertIn(said, found[0])

    def test_links(self):
        found = complaints({"morse/CMakeLists.txt":
                                "# morsel::persistence\nx(\nDEPENDS morsel::core morsel::mscomplex)\n"})
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("morse/CMakeLists.txt:3: "), found)

    def test_exit_codes(self):
        script = pathlib.Path(check_layers.__file__)
        with tempfile.TemporaryDirectory() as folder:
            empty = subprocess.run([sys.executable, script, folder], capture_output=True, check=False)
            self.assertEqual(empty.returncode, 1)
            for name, text in {**CLEAN, "core/b.h": '#include "morsel/morse/b.h"\n'}.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            bad = subprocess.run([sys.executable, script, folder], capture_output=True, check=False)
            self.assertEqual(bad.returncode, 1)
            pathlib.Path(folder, "core/b.h").unlink()
            good = subprocess.run([sys.executable, script, folder], capture_output=True, check=False)
            self.assertEqual(good.returncode, 0)


if __name__ == "__main__":
    unittest.main()
