"""morsel compare: the table, the report, its schema and its numbers."""

import json
import os
import pty
import subprocess
import unittest

import jsonschema
from support import DAMAGED, OCTAHEDRON, PROGRAM, SAMPLES, SCHEMA, ProgramTest


class Compare(ProgramTest):
    def test_report_of_a_drawn_mesh_has_the_right_numbers(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        report = self.report(mesh, "--field", "height:axis=z", "--method", "conventional")
        self.assertEqual(report["mesh"]["vertices"], 6)
        self.assertEqual(report["mesh"]["edges"], 12)
        self.assertEqual(report["mesh"]["faces"], 8)
        self.assertEqual(report["mesh"]["euler_characteristic"], 2)
        self.assertEqual(report["mesh"]["path"], str(mesh))
        self.assertEqual((report["field"]["min"], report["field"]["max"]), (-1, 1))
        method, = report["methods"]
        self.assertEqual(method["critical_points"],
                         {"minima": 1, "saddles": 0, "saddle_multiplicity": 0, "maxima": 1, "total": 2})
        self.assertEqual([(i["vertex"], i["type"], i["persistence"]) for i in method["items"]],
                         [(0, "maximum", None), (1, "minimum", None)])
        self.assertEqual(method["persistence"]["pairs"], 0)
        self.assertIsNone(method["persistence"]["max"])
        self.assertEqual(method["ms_complex"]["arcs"], 0)
        self.assertEqual(method["compared_to_first"], {"kept": 2, "moved": 0, "added": 0, "removed": 0})

    def test_reports_follow_the_schema(self):
        schema = json.loads(SCHEMA.read_text())
        mesh = self.file("octahedron.off", OCTAHEDRON)
        chain = "salient:iterations=2,sigma=0.5,range=local+tps:threshold=1%"
        for arguments in ([mesh], [mesh, "--field", "height:axis=x", "--method", chain],
                          [SAMPLES / "lion-head.off"],
                          [self.file("damaged.off", DAMAGED), "--repair"]):
            jsonschema.validate(self.report(*arguments), schema)

    def test_curvature_at_a_scale_and_the_robust_preset(self):
        report = self.report(SAMPLES / "lion-head.off", "--method", "salient", "--method",
                             "salient:preset=robust",
                             "--method", "salient:preset=robust,iterations=2,scale=1.5edges", "--target",
                             "101")
        paper, robust, own = (m["parameters"] for m in report["methods"])
        self.assertNotIn("scale", paper)
        self.assertEqual((robust["preset"], robust["iterations"], robust["range"]), ("robust", 1, "0.2std"))
        self.assertGreater(robust["scale"], own["scale"])
        self.assertEqual(own["iterations"], 2)
        for method in report["methods"]:
            self.assertEqual(method["critical_points"]["total"], 101)
        scaled = self.report(SAMPLES / "lion-head.off", "--field", "mean-curvature:scale=1.8edges",
                             "--method",
                             "salient:sigma=1edges,iterations=1,range=0.2std", name="scaled.json")
        alone = self.report(SAMPLES / "lion-head.off", "--method", "salient:preset=robust", name="alone.json")
        self.assertAlmostEqual(scaled["field"]["parameters"]["scale"], robust["scale"], delta=1e-12)
        # The same curvature smoothed alike; σ and its unit, edges, are those of the given surface.
        self.assertEqual(scaled["methods"][0]["critical_points"], alone["methods"][0]["critical_points"])
        self.morsel("compare", SAMPLES / "lion-head.off", "--field", "mean-curvature:scale=1e6edges", code=3)

    def test_diffused_curvature(self):
        report = self.report(SAMPLES / "lion-head.off", "--field",
                             "mean-curvature:estimator=diffused,diffusion=12eps",
                             "--method", "conventional")
        parameters = report["field"]["parameters"]
        self.assertEqual(parameters["estimator"], "diffused")
        self.assertAlmostEqual(parameters["diffusion"], 12 * 0.003 * report["mesh"]["bbox_diagonal"],
                               delta=1e-12)
        self.assertGreater(parameters["scale"], 0)
        self.assertEqual(report["methods"][0]["critical_points"]["total"], 103)
        self.morsel("compare", SAMPLES / "lion-head.off", "--field",
                    "mean-curvature:estimator=diffused,diffusion=400eps", code=3)

    def test_items_can_be_left_out(self):
        schema = json.loads(SCHEMA.read_text())
        full = self.report(SAMPLES / "lion-head.off")
        short = self.report(SAMPLES / "lion-head.off", "--no-items", name="short.json")
        jsonschema.validate(short, schema)
        self.assertIs(short["request"].pop("items"), False)
        with self.assertRaises(jsonschema.ValidationError):  # unless requested, they must be there
            jsonschema.validate(short, schema)
        full["request"]["items"] = False
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate(full, schema)
        del full["request"]["items"]
        for method in full["methods"]:
            del method["items"], method["persistence"]["diagram"]
        del full["timings"], short["timings"]
        self.assertEqual(full, short)
        self.assertLess((self.folder / "short.json").stat().st_size, 10000)

    def test_the_schema_refuses_what_it_should(self):
        schema = json.loads(SCHEMA.read_text())
        report = self.report(self.file("octahedron.off", OCTAHEDRON))
        for spoil in (lambda r: r["mesh"].pop("sha256"),
                      lambda r: r["methods"][0]["critical_points"].pop("total"),
                      lambda r: r.update(schema="morsel.comparison/2"), lambda r: r.update(methods=[])):
            spoiled = json.loads(json.dumps(report))
            spoil(spoiled)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(spoiled, schema)

    def test_the_lion_has_the_reference_counts(self):
        report = self.report(SAMPLES / "lion-head.off")
        names = [method["name"] for method in report["methods"]]
        self.assertEqual(names, ["conventional", "salient", "tps"])
        conventional, salient, tps = report["methods"]
        self.assertEqual(conventional["critical_points"],
                         {"minima": 462, "saddles": 934, "saddle_multiplicity": 960, "maxima": 499,
                          "total": 1895})
        self.assertAlmostEqual(salient["critical_points"]["total"], 97, delta=2)
        self.assertEqual(conventional["persistence"]["pairs"], 960)
        self.assertEqual([entry["pairs"] for entry in conventional["persistence"]["above"]], [734, 295, 98])
        self.assertEqual(tps["parameters"]["count"], salient["critical_points"]["total"])
        self.assertIn(salient["critical_points"]["total"] - tps["critical_points"]["total"], (0, 1))
        threshold, = self.report(SAMPLES / "lion-head.off", "--method", "tps")["methods"]
        self.assertEqual(threshold["persistence"]["above"][0]["pairs"], 734)
        for method in report["methods"]:
            counts, complex_ = method["critical_points"], method["ms_complex"]
            self.assertEqual(counts["minima"] - counts["saddle_multiplicity"] + counts["maxima"], 1)
            self.assertEqual(counts["total"], len(method["items"]))
            self.assertEqual(complex_["saddles"], counts["saddle_multiplicity"])
            self.assertEqual(complex_["arcs"], 4 * counts["saddle_multiplicity"])
            self.assertEqual(complex_["quads"], 2 * counts["saddle_multiplicity"])
            self.assertEqual(complex_["caps"], 1)
            compared = method["compared_to_first"]
            self.assertEqual(compared["kept"] + compared["moved"] + compared["added"], counts["total"])
            self.assertEqual(compared["kept"] + compared["moved"] + compared["removed"], 1895)
        self.assertEqual(salient["parameters"]["iterations"], 10)
        self.assertAlmostEqual(salient["parameters"]["sigma"], 0.024 * report["mesh"]["bbox_diagonal"])

    def test_vertex_numbers_are_those_of_the_input(self):
        report = self.report(self.file("damaged.off", DAMAGED), "--repair", "--field", "height:axis=x",
                             "--method", "conventional")
        repairs = {entry["action"]: entry["count"] for entry in report["mesh"]["repairs"]}
        self.assertEqual(repairs, {"removed_degenerate_faces": 1, "removed_unreferenced_vertices": 1})
        items = report["methods"][0]["items"]
        self.assertEqual([item["vertex"] for item in items], [0])
        self.assertEqual(items[0]["position"], [0, 0, 0])

    def test_runs_differ_in_timings_only_at_any_number_of_threads(self):
        reports = []
        for threads in (1, 2, 5):
            report = self.report(SAMPLES / "lion-head.off", "--threads", threads)
            del report["timings"]
            reports.append(json.dumps(report))
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[0], reports[2])

    def test_a_chain_reports_each_step(self):
        report = self.report(self.file("octahedron.off", OCTAHEDRON), "--field", "height", "--method",
                             "salient:iterations=1,sigma=2+tps:threshold=0")
        method, = report["methods"]
        self.assertEqual(method["name"], "salient+tps")
        self.assertEqual([step["name"] for step in method["parameters"]["steps"]], ["salient", "tps"])

    def test_denoising_evaluates_the_field_on_the_smoothed_surface(self):
        report = self.report(SAMPLES / "lion-head.off", "--field", "mean-curvature:estimator=quadric",
                             "--method",
                             "denoise:iterations=2+gaussian", "--method", "saliency")
        self.assertEqual(report["field"]["parameters"]["estimator"], "quadric")
        chain, saliency = report["methods"]
        denoise, gaussian = (step["values"] for step in chain["details"]["steps"])
        self.assertGreater(denoise["largest_displacement"], 0)
        self.assertNotIn("unchanged_because", denoise)
        self.assertEqual(gaussian["iterations_run"], 1)
        self.assertEqual(saliency["parameters"]["suppression"], "itti")

    def test_denoising_says_when_the_field_ignores_positions(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        values = self.file("values.txt", "1\n2\n3\n4\n5\n6\n")
        report = self.report(mesh, "--field", f"vertex-scalar:file={values}", "--method",
                             "denoise:kind=laplacian")
        self.assertIn("unchanged_because", report["methods"][0]["details"])

    def test_the_report_goes_to_standard_output(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        result = self.morsel("compare", mesh, "--method", "conventional", "-o", "-")
        self.assertEqual(json.loads(result.stdout)["schema"], "morsel.comparison/1")

    def test_presets_set_field_and_methods_and_a_report_of_one_can_be_checked(self):
        self.morsel("compare", SAMPLES / "lion-head.off", "--preset", "resampled", "-o", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertRegex(report["request"]["field"], "^mean-curvature:estimator=diffused,")
        conventional, laplacian, tps = report["methods"]
        self.assertEqual(tps["parameters"]["count"], laplacian["critical_points"]["total"])
        self.morsel("check", "r.json")
        for arguments, naming in ((("--preset", "best"), ["paper", "landmarks"]),
                                  (("--preset", "paper", "--field", "height"), ["--preset", "--field"]),
                                  (("--preset", "paper", "--method", "tps"), ["--preset", "--method"]),
                                  (("--method", "tps:count=salient"), ["salient", "no method before it"])):
            error = self.morsel("compare", SAMPLES / "lion-head.off", *arguments, code=2).stderr
            for word in naming:
                self.assertIn(word, error)

    def test_a_preset_is_made_for_the_wanted_number_of_points(self):
        mesh = SAMPLES / "mushroom.off"
        fields = []
        for arguments in (("--preset", "resampled", "--target", "80"),
                          ("--target", "80", "--preset", "resampled"), ("--preset", "resampled")):
            self.morsel("compare", mesh, *arguments, "-o", "r.json")
            fields.append(json.loads((self.folder / "r.json").read_text())["request"]["field"])
        self.assertEqual(fields[0], fields[1])
        self.assertIn("diffusion=0.0525rootarea", fields[0])
        self.assertIn("diffusion=0.105rootarea", fields[2])

    def test_points_are_chosen_of_every_row(self):
        lion = SAMPLES / "lion-head.off"
        methods = ("conventional", "salient:iterations=2,sigma=4eps", "tps:count=90")
        options = ("--points", 14, "--kind", "all", "--rank", "salience", "--spacing", "3%", "--percentiles")
        words = [word for method in methods for word in ("--method", method)]
        result = self.morsel("compare", lion, *words, *options, "-o", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        jsonschema.validate(report, json.loads(SCHEMA.read_text()))
        self.assertEqual(report["request"]["points"],
                         {"count": 14, "kind": "all", "rank": "salience", "spacing": "3%",
                          "percentiles": True})
        for method, row in zip(methods, report["methods"]):
            self.morsel("points", lion, "--field", "mean-curvature", "--method", method, "--fill", "none",
                        *options, "-o", "p.json")
            alone = json.loads((self.folder / "p.json").read_text())
            for key in ("spacing", "salience_scale", "candidates", "too_near", "count", "note",
                        "mean_percentile", "points"):
                self.assertEqual(row["chosen"][key], alone[key], (method, key))
            matching = row["chosen"]["compared_to_first"]
            self.assertEqual(matching["kept"] + matching["moved"] + matching["added"], 14)
            items = {item["vertex"]: item["type"] for item in row["items"]}
            for point in row["chosen"]["points"]:
                self.assertEqual(items[point["vertex"]], point["type"])
            self.assertIn(method, result.stdout)
        self.assertEqual(report["methods"][0]["chosen"]["compared_to_first"]["kept"], 14)
        for word in ("percentile", "chosen points of conventional", "points to added"):
            self.assertIn(word, result.stdout)
        self.assertNotIn("(mult.)", result.stdout)
        self.morsel("check", "r.json")

    def test_the_reason_for_fewer_points_is_below_the_table(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        result = self.morsel("compare", mesh, "--field", "height", "--method", "conventional", "--points", 9,
                             "--no-items", "-o", "r.json")
        note = "2 of 9 points: height has 2 extrema that stand out at all"
        self.assertIn(f"conventional: {note}\n", result.stdout)
        report = json.loads((self.folder / "r.json").read_text())
        jsonschema.validate(report, json.loads(SCHEMA.read_text()))
        chosen = report["methods"][0]["chosen"]
        self.assertEqual((chosen["note"], chosen["count"], chosen["mean_percentile"]), (note, 2, None))
        self.assertEqual(len(chosen["points"]), 2)  # few, and asked for
        del report["methods"][0]["chosen"]
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate(report, json.loads(SCHEMA.read_text()))

    def test_points_at_their_origins(self):
        lion = SAMPLES / "lion-head.off"
        plain, snapped = (self.report(lion, "--method", "salient", "--points", 12, *more, name=f"{i}.json")
                          for i, more in enumerate(((), ("--snap",))))
        items = {item["vertex"]: item for item in snapped["methods"][0]["items"]}
        before, after = (report["methods"][0]["chosen"]["points"] for report in (plain, snapped))
        self.assertEqual([p["vertex"] for p in before], [p["vertex"] for p in after])
        self.assertEqual([p["position"] for p in after], [items[p["vertex"]]["position"] for p in after])
        self.assertNotEqual([p["position"] for p in before], [p["position"] for p in after])

    def test_options_of_points_that_are_refused(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        for words, naming in ((("--kind", "maxima"), "--points"), (("--rank", "salience"), "--points"),
                              (("--spacing", "3%"), "--points"), (("--percentiles",), "--points"),
                              (("--points", 0), "--points"),
                              (("--points", 3, "--spacing", "wide"), "--spacing"),
                              (("--points", 3, "--salience-scale", "8eps"), "rank=salience"),
                              (("--points", 3, "--fill", "curvature"), "curvature")):
            error = self.morsel("compare", mesh, *words, "-o", "r.json", code=2).stderr
            self.assertIn(naming, error, words)
        values = self.file("values.txt", "1\n2\n3\n4\n5\n6\n")
        error = self.morsel("compare", mesh, "--points", 3, "--fill", f"vertex-scalar:file={values}", "-o",
                            values, code=2).stderr
        self.assertIn("values.txt", error)
        self.assertFalse((self.folder / "r.json").exists())

    def test_a_request_for_points_that_is_damaged(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        report = self.report(mesh, "--field", "height", "--points", 2)
        for key, value, naming in (("count", -1, "count"), ("kind", "tips", "kind"), ("rank", 3, "rank"),
                                   ("spacing", "wide", "not a length"), ("percentiles", "yes", "percentiles"),
                                   ("scale", "", "not a length"), ("spacing", "-1%", "spacing"),
                                   ("count", 0, "at least 1"), ("fill", "tips", "tips")):
            spoiled = json.loads(json.dumps(report))
            spoiled["request"]["points"][key] = value
            self.file("spoiled.json", json.dumps(spoiled))
            self.assertIn(naming, self.morsel("check", "spoiled.json", code=3).stderr, (key, value))

    def test_warnings_are_printed_and_in_the_report(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        values = self.file("values.txt", "1\n" * 6)
        result = self.morsel("compare", mesh, "--field", f"vertex-scalar:file={values}",
                             "--method", "salient", "-o", "r.json")
        self.assertIn("morsel: warning: vertex-scalar: the field is constant", result.stderr)
        self.assertIn("morsel: warning: salient: of 6 vertices 6 have no other", result.stderr)
        report = json.loads((self.folder / "r.json").read_text())
        jsonschema.validate(report, json.loads(SCHEMA.read_text()))
        self.assertIn("constant", report["field"]["warnings"][0])
        self.assertIn("no other", report["methods"][0]["warnings"][0])

    def test_the_table_names_each_method(self):
        result = self.morsel("compare", self.file("octahedron.off", OCTAHEDRON))
        for name in ("conventional", "salient", "tps:count=salient", "kept: points of conventional", ">1 %:"):
            self.assertIn(name, result.stdout)
        self.assertNotIn("\r", result.stderr)

    def test_a_terminal_shows_which_method_runs_and_what_remains(self):
        try:
            terminal, end = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminal can be made: {error}")
        with subprocess.Popen([PROGRAM, "compare", SAMPLES / "bunny00.off", "--method", "conventional",
                               "--method",
                               "salient:iterations=800", "--threads", "1"], stdout=subprocess.DEVNULL,
                              stderr=end) as process:
            os.close(end)
            shown = b""
            try:
                while chunk := os.read(terminal, 65536):
                    shown += chunk
            except OSError:  # how a terminal ends
                pass
        os.close(terminal)
        self.assertEqual(process.returncode, 0)
        self.assertIn(b"salient (2 of 2): ", shown)
        self.assertRegex(shown, rb"salient \(2 of 2\): .*, about \d+ (s|min) left")


if __name__ == "__main__":
    unittest.main()
