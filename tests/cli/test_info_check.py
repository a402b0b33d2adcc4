"""morsel info and morsel check."""

import json
import subprocess
import unittest

from support import DAMAGED, OCTAHEDRON, PROGRAM, SAMPLES, ProgramTest


class Info(ProgramTest):
    def test_text(self):
        result = self.morsel("info", SAMPLES / "lion-head.off")
        self.assertIn("8,356", result.stdout)
        self.assertRegex(result.stdout, r"Euler characteristic +1\n")
        self.assertRegex(result.stdout, r"boundary loops +1\n")

    def test_json(self):
        info = json.loads(self.morsel("info", "--json", self.file("o.off", OCTAHEDRON)).stdout)
        self.assertTrue(info["valid"])
        self.assertEqual(info["mesh"]["genus"], 0)
        self.assertEqual(info["components"], [{"euler_characteristic": 2, "genus": 0, "boundary_loops": 0}])
        self.assertEqual(info["defects"], [])

    def test_a_bad_mesh_is_described_and_is_no_error(self):
        mesh = self.file("d.off", DAMAGED)
        info = json.loads(self.morsel("info", "--json", mesh).stdout)
        self.assertFalse(info["valid"])
        self.assertEqual([(d["kind"], d["count"], d["first"]) for d in info["defects"]],
                         [("degenerate_face", 1, [2]), ("unreferenced_vertex", 1, [1])])
        self.assertIn("--repair fixes this", self.morsel("info", mesh).stdout)
        self.assertTrue(json.loads(self.morsel("info", "--json", "--repair", mesh).stdout)["valid"])

    def test_a_missing_file_is_an_error(self):
        self.assertIn("absent.off", self.morsel("info", "absent.off", code=3).stderr)
        self.assertIn('"notes.txt" is no mesh (.off, .obj, .ply, .stl, .gltf, .glb, .vtk, .vtp, .vtu, .gii, '
                      "FreeSurfer's lh.pial, .asc, .tif or .tiff) and has no provenance",
                      self.morsel("info", self.file("notes.txt", "1\n").name, code=3).stderr)


    def test_a_document_says_what_it_is_and_where_it_comes_from(self):
        """`info` once said that JSON documents of the program have no provenance."""
        mesh = self.file("o.off", OCTAHEDRON).name
        values = self.file("v.txt", "1\n2\n3\n4\n5\n6\n").name
        field = ("--field", f"vertex-scalar:file={values}")
        for command, schema, words in (
                ("compare", "comparison", ("-o",)), ("points", "points", ("--fill", "none", "-o")),
                ("hierarchy", "hierarchy", ("--levels", "0", "-o")),
                ("segment", "segments", ("-o", "s.ply", "--json")), ("cut", "cut", ("-o", "c.off", "--json")),
                ("sweep", "sweep", ("--vary", "iterations=1,2", "-o")),
                ("stability", "stability", ("--noise", "0.1", "--trials", "1", "-o"))):
            with self.subTest(command):
                name = f"{command}.json"
                self.morsel(command, mesh, *field, *words, name)
                shown = self.morsel("info", name).stdout
                self.assertRegex(shown, rf"\n  document +.*\(morsel {command}[,)].*, morsel\.{schema}/1\n")
                for line in (r"made by +morsel \d", r"request +\{.*vertex-scalar:file=v\.txt",
                             r"input +o\.off, sha256 "):
                    self.assertRegex(shown, r"\n  " + line)
                document = json.loads((self.folder / name).read_text())
                origin = json.loads(self.morsel("info", name, "--json").stdout)["provenance"]
                self.assertEqual(origin["request"], document["request"])
                self.assertEqual(origin["tool"], document["tool"])
                inputs = {file["path"]: file["sha256"] for file in origin["inputs"]}
                self.assertEqual(inputs[mesh], document["mesh"]["sha256"])
                self.assertEqual(list(inputs)[0], mesh)
        self.assertIn("v.txt, sha256", self.morsel("info", "compare.json").stdout)
        self.file("marks", "0\n1\n")
        self.file("list", "o.off marks\n")
        self.morsel("landmarks", "list", "--method", "conventional", "--field", "height", "-o", "l.json")
        shown = self.morsel("info", "l.json").stdout
        for path in ("list", "o.off", "marks"):
            self.assertRegex(shown, rf"input +{path}, sha256 [0-9a-f]{{64}}\n")

    def test_documents_of_others_and_damaged_ones(self):
        for text, sentence in (('{"a": 1}', "has no provenance; it is JSON"),
                               ('{"schema": "morsel.points/1", "tool": 3}', "tool"),
                               ('{"schema": "morsel.points/1", "tool": ', "is not JSON"),
                               ("[1]", "has no provenance")):
            said = self.morsel("info", self.file("d.json", text).name, code=3).stderr
            self.assertIn(sentence, said)
            self.assertEqual(said.count("d.json"), 1, said)


class Check(ProgramTest):
    def edited(self, edit):
        report = json.loads((self.folder / "report.json").read_text())
        edit(report)
        self.file("edited.json", json.dumps(report))
        return "edited.json"

    def setUp(self):
        super().setUp()
        self.mesh = self.file("octahedron.off", OCTAHEDRON)
        self.morsel("compare", self.mesh, "--field", "height:axis=x", "-o", "report.json")

    def test_a_fresh_report_is_unchanged_and_says_so_in_one_line(self):
        result = self.morsel("check", "report.json")
        self.assertEqual(result.stdout.count("\n"), 1)
        self.assertIn("unchanged", result.stdout)

    def test_a_report_of_a_real_mesh_is_unchanged(self):
        self.morsel("compare", SAMPLES / "lion-head.off", "-o", "lion.json")
        self.morsel("check", "lion.json", "--threads", "3")

    def test_an_edited_count_is_shown(self):
        def edit(report):
            report["methods"][1]["critical_points"]["total"] = 77
        result = self.morsel("check", self.edited(edit), code=1)
        self.assertIn("methods[1] (salient): critical_points.total: 77 -> 2", result.stdout)

    def test_a_changed_item_or_pair_of_a_real_mesh_is_shown_however_the_report_is_laid_out(self):
        self.morsel("compare", SAMPLES / "lion-head.off", "--method", "tps", "--method", "salient", "-o",
                    "report.json")
        def edit(report):
            report["methods"][1]["items"][3]["vertex"] = -7
            report["methods"][0]["persistence"]["diagram"][700]["kind"] = "none"
        self.edited(edit)
        report = json.loads((self.folder / "edited.json").read_text())
        self.file("sorted.json", json.dumps(report, sort_keys=True, indent=4))
        for name in ("edited.json", "sorted.json"):
            lines = self.morsel("check", name, code=1).stdout.splitlines()
            self.assertEqual(len(lines), 3)
            self.assertIn("methods[0] (tps): persistence.diagram[700].kind: \"none\" -> \"", lines[1])
            self.assertIn("methods[1] (salient): items[3].vertex: -7 -> ", lines[2])

    def test_a_report_without_items_can_be_checked(self):
        self.morsel("compare", self.mesh, "--no-items", "-o", "report.json")
        self.morsel("check", "report.json")
        edited = self.edited(lambda r: r["methods"][1]["critical_points"].update(total=9))
        self.assertIn("1 difference ", self.morsel("check", edited, code=1).stdout)

    def test_timings_and_version_may_differ(self):
        def edit(report):
            report["timings"] = {"total": 1e9}
            report["tool"]["version"] = "0.0.0"
        self.morsel("check", self.edited(edit))

    def test_an_item_that_is_gone_is_a_difference(self):
        result = self.morsel("check", self.edited(lambda r: r["methods"][0]["items"].pop()), code=1)
        self.assertIn("1 entries -> 2 entries", result.stdout)

    def test_a_changed_mesh_is_a_difference(self):
        self.file("octahedron.off", OCTAHEDRON.replace("0 0 1\n", "0 0 2\n", 1))
        self.assertIn("mesh.sha256", self.morsel("check", "report.json", code=1).stdout)

    def test_a_missing_mesh_is_a_difference(self):
        self.mesh.unlink()
        self.assertIn("missing", self.morsel("check", "report.json", code=1).stdout)

    def test_a_relative_mesh_is_found_from_the_reports_folder(self):
        (self.folder / "sub").mkdir()
        self.morsel("compare", "octahedron.off", "-o", "relative.json")
        self.morsel("check", self.folder / "relative.json", cwd=self.folder / "sub")

    def test_many_reports_have_a_line_each_and_a_table_of_differences(self):
        (self.folder / "reports" / "deeper").mkdir(parents=True)
        for name in ("reports/a.json", "reports/deeper/b.json"):
            self.morsel("compare", self.mesh, "--field", "height:axis=x", "-o", name)
        self.file("reports/notes.txt", "no report")
        self.file("reports/other.json", '{"schema": "morsel.cut/1"}')
        same = self.morsel("check", "reports", "report.json")
        self.assertEqual(same.stdout.splitlines()[-1],
                         "3 reports: 3 unchanged, 0 changed, 0 not checked; passed over: 1 other document")
        self.assertEqual(len(same.stdout.splitlines()), 4)

        report = json.loads((self.folder / "reports/a.json").read_text())
        report["methods"][1]["critical_points"]["total"] = 77
        self.file("reports/a.json", json.dumps(report))
        lines = self.morsel("check", "reports", code=1).stdout.splitlines()
        self.assertIn("1 difference", lines[0])
        self.assertIn("unchanged", lines[1])
        table = [line for line in lines if "critical_points.total" in line]
        self.assertEqual(len(table), 1)
        self.assertEqual(table[0].split()[-2:], ["77", "2"])
        self.assertEqual(lines[-1],
                         "2 reports: 1 unchanged, 1 changed, 0 not checked; passed over: 1 other document")

        # one that cannot be checked does not stop the others, and is never skipped
        self.file("reports/b.json", "{")
        self.file("reports/c.json", json.dumps({**report, "request": {}}))
        result = subprocess.run([PROGRAM, "check", "reports"], capture_output=True, text=True, timeout=240,
                                cwd=self.folder, check=False)  # results come with the error
        self.assertEqual(result.returncode, 3)
        self.assertEqual(result.stdout.splitlines()[-1],
                         "4 reports: 1 unchanged, 1 changed, 2 not checked; passed over: 1 other document")
        self.assertIn("2 of 4 reports", result.stderr)
        for named in ("absent.json", "reports/other.json"):
            bad = subprocess.run([PROGRAM, "check", "report.json", named], capture_output=True, text=True,
                                 timeout=240,
                                 cwd=self.folder, check=False)
            self.assertEqual(bad.returncode, 3)
            self.assertIn("1 of 2 reports", bad.stderr)
            self.assertIn(f"{named}: not checked: ", bad.stdout)
        (self.folder / "empty").mkdir()
        self.assertIn("empty", self.morsel("check", "empty", code=3).stderr)
        self.file("empty/other.json", '{"schema": "morsel.cut/1"}')
        nothing = subprocess.run([PROGRAM, "check", "empty"], capture_output=True, text=True, timeout=240,
                                 cwd=self.folder, check=False)
        self.assertEqual(nothing.returncode, 3)
        self.assertIn("no comparison report", nothing.stderr)

    def test_what_is_no_report_is_bad_input(self):
        self.morsel("check", "absent.json", code=3)
        self.morsel("check", self.file("x.json", "{"), code=3)
        self.morsel("check", self.file("y.json", '{"schema": "other"}'), code=3)
        self.morsel("check", self.edited(lambda r: r["request"].pop("methods")), code=3)
        self.morsel("check", self.edited(lambda r: r["request"].update(methods=["nonsense"])), code=3)


if __name__ == "__main__":
    unittest.main()
