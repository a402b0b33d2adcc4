"""Documents that the program reads back, damaged in every way; and hostile names."""

import base64
import copy
import csv
import io
import itertools
import json
import os
import re
import signal
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from support import OCTAHEDRON, PROGRAM, SAMPLES, ProgramTest, interrupted

DEEP = 105_000
BEGIN = '{"schema":"morsel.provenance/1"'
DEEP_PROVENANCE = BEGIN + ',"x":' + "[" * DEEP + "]" * DEEP + "}"
REPLACEMENTS = (None, 7, "text", [], {})
HOSTILE = "a\x1b[2J\nb\x07\u009b\u202e"


def edits(value, most_of_a_list=2):
    """Functions that change one value within a document that they are given, each in its way; with what they
    are called."""
    if isinstance(value, dict):
        members = value.items()
    else:
        members = list(enumerate(value))[:most_of_a_list] if isinstance(value, list) else ()
    for key, inner in members:
        for other in REPLACEMENTS:
            yield (f"{key}={other!r}",
                   lambda document, key=key, other=other: document.__setitem__(key, copy.deepcopy(other)))
        yield f"{key} removed", lambda document, key=key: document.__delitem__(key)
        for name, edit in edits(inner, most_of_a_list):
            yield f"{key}.{name}", lambda document, key=key, edit=edit: edit(document[key])


def some(all_edits):
    """Every third of them, since each takes a run of the program; all, if the environment has
    MORSEL_ALL_EDITS."""
    return itertools.islice(all_edits, 0, None, 1 if "MORSEL_ALL_EDITS" in os.environ else 3)


class Documents(ProgramTest):
    def run_any(self, *arguments, codes=(0, 1, 3)):
        """Runs the program on input that may be damaged: one of these codes and, if it is an error, one
        sentence."""
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, timeout=240,
                                cwd=self.folder, check=False)
        errors = result.stderr.decode()
        self.assertIn(result.returncode, codes, f"{arguments}\n{errors}")
        self.assertNotIn("json.exception", errors)
        for line in (result.stdout.decode() + errors).split("\n"):
            self.assertNotRegex(line, "[\x00-\x08\x0b-\x1f\x7f-\x9f]")
        if result.returncode >= 2:
            self.assertRegex(errors, r"\A(morsel: warning: [^\n]+\n)*morsel: (?!warning)[^\n]+\n\Z")
        return result.returncode, result.stdout.decode(), errors

    def setUp(self):
        super().setUp()
        self.mesh = self.file("octahedron.off", OCTAHEDRON)


class Depth(Documents):
    def test_provenance_nested_105000_deep_in_every_format(self):
        """bug: `info` ended by SIGSEGV"""
        lines = OCTAHEDRON.split("\n", 1)
        encoded = DEEP_PROVENANCE.encode() + b"\0"
        in_array = base64.b64encode(len(encoded).to_bytes(8, sys.byteorder) + encoded).decode()
        doubled = DEEP_PROVENANCE.replace('"', '""')
        ply = ("ply\nformat ascii 1.0\ncomment " + DEEP_PROVENANCE + "\nelement vertex 3\n"
               "property float x\nproperty float y\nproperty float z\nelement face 1\n"
               "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        files = {
            "m.off": f"{lines[0]}\n# {DEEP_PROVENANCE}\n{lines[1]}",
            "m.obj": f"# {DEEP_PROVENANCE}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "m.ply": ply,
            "m.txt": f"# {DEEP_PROVENANCE}\n0\n1\n",
            "m.png": "\x89PNG\r\n\x1a\n\0\0tEXtComment\0" + DEEP_PROVENANCE,
            "m.svg": f"<svg><metadata>{DEEP_PROVENANCE}</metadata></svg>",
            "m.vtk": f"# vtk DataFile Version 3.0\n# {DEEP_PROVENANCE}\nASCII\nDATASET POLYDATA\n"
                     "POINTS 3 int\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n",
            "m.vtp": '<VTKFile type="PolyData"><PolyData><FieldData><Array type="String">'
                     f'{DEEP_PROVENANCE}</Array></FieldData>'
                     '<Piece NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Int8">'
                     '0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>'
                     '<DataArray type="Int8" Name="connectivity">0 1 2</DataArray>'
                     '<DataArray type="Int8" Name="offsets">3</DataArray></Polys></Piece>'
                     '</PolyData></VTKFile>',
            "m.html": f"<html></html>\n<!-- {DEEP_PROVENANCE} -->\n",
            "m.csv": f'vertex,provenance\n1,"{doubled}"\n',
            "n.csv": f"vertex\n1\n# {DEEP_PROVENANCE}\n",
            "n.vtp": '<VTKFile type="PolyData"><PolyData><FieldData><Array type="String" format="binary">'
                     f'\n{in_array}\n</Array></FieldData></PolyData></VTKFile>',
            "m.graphml": '<graphml><graph><data key="key0">' + DEEP_PROVENANCE.replace('"', "&quot;")
                         + "</data></graph></graphml>",
            "m.bin": 'glTF{"asset":{"extras":{"provenance":' + DEEP_PROVENANCE + "}}}",
            "m.stl": f"solid {DEEP_PROVENANCE}\nendsolid\n",
        }
        for name, text in files.items():
            with self.subTest(name):
                (self.folder / name).write_bytes(text.encode("latin-1"))
                is_mesh = name in ("m.off", "m.obj", "m.ply", "m.stl", "m.vtk", "m.vtp", "n.vtp")
                code, _, errors = self.run_any("info", name, codes=(0,) if is_mesh else (3,))
                self.run_any("info", "--json", name, codes=(code,))
                self.assertIn("nested deeper than 64 levels", errors)

    def test_reports(self):
        for text in ("[" * DEEP, '{"schema": "morsel.comparison/1", "x": ' + '{"a":' * DEEP,
                     '{"x":' * DEEP + "1" + "}" * DEEP):
            self.file("r.json", text)
            self.assertIn("nested deeper", self.run_any("check", "r.json", codes=(3,))[2])
        self.morsel("compare", self.mesh, "--field", "height", "-o", "r.json")
        report = (self.folder / "r.json").read_text()
        for place, key in (('"items": [', ""), ('"diagram": [', ""), ('"timings": {', '"x": '),
                           ('"minima": ', "")):
            self.assertIn(place, report)
            self.file("deep.json", report.replace(place, place + key + "[" * DEEP + "]" * DEEP + ",", 1))
            self.assertIn("nested deeper", self.run_any("check", "deep.json", codes=(3,))[2])

    def test_a_large_document_of_garbage_is_refused_at_once(self):
        with open(self.folder / "r.json", "wb") as file:
            file.write(b'{"schema": "morsel.comparison/1", "x": "' + bytes([120]) * 100_000_000)
        self.assertIn("more than 16777216 bytes", self.run_any("check", "r.json", codes=(3,))[2])
        with open(self.folder / "r.json", "wb") as file:
            file.write(b'{"schema": "other", "x": ' + b"[" * 100_000_000)
        self.assertIn("not a comparison report", self.run_any("check", "r.json", codes=(3,))[2])


class Reports(Documents):
    def test_whatever_is_wrong_in_a_report_is_a_difference_or_bad_input(self):
        self.morsel("compare", self.mesh, "--field", "height", "--method", "salient:iterations=1", "--target",
                    "2", "-o", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        codes = set()
        for name, edit in some(edits(report, 1)):
            damaged = copy.deepcopy(report)
            edit(damaged)
            if damaged == report:
                continue
            self.file("edited.json", json.dumps(damaged))
            with self.subTest(name):
                code, output, errors = self.run_any("check", "edited.json")
                codes.add(code)
                if code == 3:
                    self.assertIn("edited.json", errors)
                elif code == 0:
                    self.assertTrue(name.startswith(("timings", "tool.version", "request.items",
                                                     "request.snap")), name)
        self.assertEqual(codes, {0, 1, 3})

    def test_a_number_as_a_methods_name_is_refused(self):
        self.morsel("compare", self.mesh, "--field", "height", "-o", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        report["methods"][2]["name"] = 5
        self.file("r.json", json.dumps(report))
        self.assertEqual(self.run_any("check", "r.json", codes=(3,))[2],
                         "morsel: r.json is a damaged report: methods[2].name is not a text\n")

    def test_a_mesh_that_cannot_be_a_path(self):
        self.morsel("compare", self.mesh, "--field", "height", "-o", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        for path, code in (("x" * 5000, 1), ("a\0b", 3), ("", 3)):
            report["mesh"]["path"] = path
            self.file("r.json", json.dumps(report))
            self.run_any("check", "r.json", codes=(code,))
        self.run_any("check", "y" * 5000, codes=(3,))


class Provenances(Documents):
    def test_whatever_is_wrong_in_a_provenance(self):
        self.morsel("field", self.mesh, "--field", "height", "-o", "v.txt")
        text = (self.folder / "v.txt").read_text()
        lines = [line for line in text.splitlines() if line.startswith("# ")]
        provenance = json.loads("".join(line[2:] for line in lines))
        codes = []
        for name, edit in edits(provenance):
            if name.startswith("schema"):
                continue
            damaged = copy.deepcopy(provenance)
            edit(damaged)
            self.file("edited.txt", "# " + json.dumps(damaged, separators=(",", ":")) + "\n1\n")
            with self.subTest(name):
                codes.append(self.run_any("info", "edited.txt", codes=(0, 3))[0])
        self.assertGreater(codes.count(3), 50)

    def test_what_it_holds_does_not_reach_the_terminal_raw(self):
        provenance = {"schema": "morsel.provenance/1", "tool": {"name": "morsel", "version": HOSTILE},
                      "command": HOSTILE,
                      "inputs": [{"path": HOSTILE, "sha256": HOSTILE}], "request": {HOSTILE: HOSTILE},
                      "field": {"name": HOSTILE, "parameters": {HOSTILE: HOSTILE}}}
        for ascii_only in (False, True):
            self.file("p.txt", "# " + json.dumps(provenance, separators=(",", ":"),
                                                 ensure_ascii=ascii_only) + "\n")
            output = self.run_any("info", "p.txt", codes=(0,))[1]
            self.assertNotIn("\u202e", output)
            self.assertIn("\\x1b[2J\\nb\\x07\\u009b\\u202e", output)


class States(Documents):
    def setUp(self):
        super().setUp()
        (self.folder / "meshes").mkdir()
        self.mesh.rename(self.folder / "meshes" / "o.off")
        self.batch = ("batch", "meshes", "--out", "out", "--field", "height", "--method", "conventional",
                      "--no-thumbnails")
        self.morsel(*self.batch)
        self.state = self.folder / "out" / "state" / "o.off.json"

    def test_whatever_is_wrong_in_a_state_it_counts_as_absent(self):
        """bug: a state whose `result` lacks a member was an internal error, for good"""
        whole = self.state.read_text()
        state = json.loads(whole)
        told = 0
        for name, edit in some(edits(state)):
            damaged = copy.deepcopy(state)
            edit(damaged)
            self.state.write_text(json.dumps(damaged))
            with self.subTest(name):
                _, output, errors = self.run_any(*self.batch, "--summary-only", codes=(0, 1))
                if "not run" in output and not name.startswith(("key", "schema", "files.0='text'")):
                    self.assertRegex(errors,
                                     r"\Amorsel: warning: 1 damaged state counts as absent: [^\n]+\n\Z")
                told += "damaged state" in errors
                json.loads((self.folder / "out" / "summary.json").read_text())
        self.assertGreater(told, 70)

    def test_a_damaged_state_is_reported_and_replaced(self):
        for text in ("[" * DEEP, "", "{", "\0\xff", '{"schema": "morsel.batch-state/1"}'):
            self.state.write_text(text)
            _, output, errors = self.run_any(*self.batch, codes=(0,))
            self.assertIn("warning: 1 damaged state counts as absent: ", errors)
            self.assertIn("1 mesh: 1 done", output)
            self.assertNotIn("by earlier runs", output)
            _, output, errors = self.run_any(*self.batch, codes=(0,))
            self.assertEqual(errors, "")
            self.assertIn("by earlier runs", output)
        self.state.write_text("{")
        self.assertEqual(self.run_any(*self.batch, "--quiet", codes=(0,))[2], "")


class Journals(Documents):
    SWEEP = ("sweep", SAMPLES / "lion-head.off", "--method", "salient:iterations=1", "--vary",
             "sigma=1eps,2eps,3eps,4eps,5eps,6eps",
             "--field", "height", "-o", "rows.json", "--threads", "1")

    def interrupt(self):
        """A journal of a sweep with at least two entries; all but the first two are taken away."""
        journal = self.folder / "rows.json.journal"
        interrupted(self.folder, self.SWEEP, signal.SIGTERM, 143,
                    lambda: journal.exists() and journal.read_bytes().count(b"\n") >= 3)
        return journal.read_text().splitlines()[:3]

    def test_a_journal_with_damage_costs_its_rows_and_nothing_else(self):
        """bug: a sweep journal with the entry `5` was an internal error, for good"""
        self.morsel(*self.SWEEP)
        expected = json.loads((self.folder / "rows.json").read_text())["rows"]
        head, first, second = self.interrupt()
        entry = json.loads(second)
        damages = ["5", "null", "{}", "[" * DEEP, "{", "\0"]
        for name, edit in edits(entry):
            if ".parameters" in name or not name.endswith(("removed", "=[]", "={}")):
                continue  # of which some are right
            damaged = copy.deepcopy(entry)
            edit(damaged)
            damages.append(json.dumps(damaged))
        for damage in damages[:6] + damages[6::11]:
            self.file("rows.json.journal", f"{head}\n{first}\n{damage}\n")
            with self.subTest(damage[:80]):
                errors = self.run_any(*self.SWEEP, codes=(0,))[2]
                self.assertIn("warning: rows.json.journal: 1 damaged entry counts as absent", errors)
                self.assertIn("resuming with 1 of 6", errors)
                self.assertEqual(json.loads((self.folder / "rows.json").read_text())["rows"], expected)
                self.assertFalse((self.folder / "rows.json.journal").exists())

    def test_a_file_that_is_no_journal_is_left_alone(self):
        for text in ("my notes\n", "5\n", "{}", '{"schema":"morsel.sweep/1"}\n'):
            journal = self.file("rows.json.journal", text)
            self.assertIn("is no journal", self.run_any(*self.SWEEP, codes=(2,))[2])
            self.assertEqual(journal.read_text(), text)
            self.assertFalse((self.folder / "rows.json").exists())

    def test_a_journal_of_other_options_is_begun_anew(self):
        self.interrupt()
        errors = self.run_any(*self.SWEEP, "--repair", codes=(0,))[2]
        self.assertIn("warning: rows.json.journal is of a run with another mesh, other options or another "
                      "version", errors)


class Names(Documents):
    def test_control_characters_do_not_reach_the_terminal(self):
        name = HOSTILE + ".off"
        self.file(name, OCTAHEDRON)
        for arguments, code in ((("info", name), 0), (("info", "absent" + name), 3), (("check", name), 3),
                                (("compare", name, "--field", "height", "-o", HOSTILE + ".json"), 0),
                                (("check", HOSTILE + ".json"), 0), (("compare", name, "--field", HOSTILE), 2),
                                (("compare", name, "--method", HOSTILE), 2), ((HOSTILE,), 2),
                                (("field", name, "--field", "vertex-scalar:file=" + HOSTILE, "-o", "x.txt"),
                                 3)):
            with self.subTest(arguments):
                self.run_any(*arguments, codes=(code,))
        ply = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nproperty float q\x1b[31m\x9b\nelement face 1\n"
               "property list uchar int vertex_indices\nend_header\n"
               "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n")
        (self.folder / "p.ply").write_bytes(ply.encode("latin-1"))
        self.assertIn("q\\x1b[31m\\x9b", self.run_any("info", "p.ply", codes=(0,))[1])
        report = json.loads((self.folder / (HOSTILE + ".json")).read_text())
        report["methods"][0][HOSTILE] = HOSTILE
        self.file("r.json", json.dumps(report))
        self.run_any("check", "r.json", codes=(1,))
        self.run_any("check", "r.json", "r.json", codes=(1,))

    def test_documents_of_hostile_names_are_well_formed(self):
        (self.folder / "meshes").mkdir()
        for name in (b"=cmd.off", b"a\n\x1b]<&\".off", b"\xff\xfe.off"):
            with open(os.fsencode(self.folder / "meshes") + b"/" + name, "w", encoding="utf-8") as file:
                file.write(OCTAHEDRON)
        self.run_any("batch", "meshes", "--out", "out", "--field", "height", "--method", "conventional",
                     "--no-thumbnails",
                     "--html", "--figures", "--export", codes=(0,))
        out = self.folder / "out"
        json.loads((out / "summary.json").read_text())
        for path in [*out.rglob("*.svg"), *out.rglob("*.vtp")]:
            with self.subTest(path):
                data = re.sub(rb"<AppendedData.*</AppendedData>", b"", path.read_bytes(), flags=re.DOTALL)
                xml.etree.ElementTree.fromstring(data)
        for path in out.rglob("*.html"):
            self.assertNotRegex(path.read_text(), "[\x00-\x08\x0b-\x1f\x7f-\x9f]")
        rows = list(csv.reader(io.StringIO((out / "summary.csv").read_text(errors="surrogateescape"),
                                           newline="")))
        self.assertIn("./=cmd.off", [row[0] for row in rows])
        self.assertFalse([cell for row in rows for cell in row if cell[:1] in ("=", "@", "\t", "\r")])

    def test_json_on_a_terminal_has_no_character_that_acts_on_it(self):
        """C1 control characters and those that change the direction of writing were not escaped."""
        acting = "\x7f\x80\x9b\u061c\u200e\u2028\u202e\u2066\ufffe"
        name = f"a{acting}31m-\u00fc.off"
        self.file(name, OCTAHEDRON)
        quick = ("--field", "height")
        for arguments in (("info", "--json", name), ("compare", name, *quick, "-o", "-"),
                          ("sweep", name, *quick, "--vary", "iterations=1,2", "-o", "-"),
                          ("hierarchy", name, *quick, "--levels", "0", "-o", "-")):
            with self.subTest(arguments[0]):
                text = self.run_any(*arguments, codes=(0,))[1]
                self.assertNotRegex(text, f"[{acting}]")
                self.assertIn("a\\u007f\\u0080\\u009b", text)
                self.assertIn("\u00fc.off", text)
                self.assertIn(name, json.dumps(json.loads(text), ensure_ascii=False))

    def test_a_varied_path_in_a_table_is_the_same_path(self):
        """It had an apostrophe before it."""
        for name in ("=a.txt", "b.txt"):
            self.file(name, "0\n1\n2\n3\n4\n5\n")
        for key in ("file", "field.file"):
            with self.subTest(key):
                self.morsel("sweep", self.mesh, "--field", "vertex-scalar", "--vary", f"{key}==a.txt,b.txt",
                            "-o", "r.csv")
                with open(self.folder / "r.csv", newline="", encoding="utf-8") as table:
                    rows = list(csv.DictReader(table))
                self.assertEqual([row[key] for row in rows], ["./=a.txt", "b.txt"])

    def test_a_table_of_a_mesh_whose_name_is_a_formula(self):
        self.mesh.rename(self.folder / "=cmd.off")
        self.morsel("sweep", "=cmd.off", "--field", "height", "--method", "salient", "--vary",
                    "iterations=1,2", "-o", "r.csv")
        with open(self.folder / "r.csv", newline="", encoding="utf-8") as table:
            self.assertEqual({row["mesh"] for row in csv.DictReader(table)}, {"./=cmd.off"})


if __name__ == "__main__":
    unittest.main()
