"""Control over the number of critical points: targets, conditions to stop, origins, snapping."""

import json
import math
import unittest

import jsonschema
from support import OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, data_lines, read_csv

METHODS = ["salient", "tps", "laplacian", "gaussian"]


class Control(ProgramTest):
    def test_targets_are_reached(self):
        schema = json.loads(SCHEMA.read_text())
        methods = [word for method in METHODS for word in ("--method", method)]
        for mesh, totals in (("bunny00.off", {150}), ("lion-head.off", {149, 150})):
            report = self.report(SAMPLES / mesh, *methods, "--target", 150)
            jsonschema.validate(report, schema)
            self.assertEqual(report["request"]["target"], 150)
            for method in report["methods"]:
                target = method["target"]
                self.assertIn(method["critical_points"]["total"], totals)
                self.assertEqual(target["reached"], method["critical_points"]["total"])
                self.assertEqual(target["note"] == "", target["reached"] == 150)
                self.assertEqual(target["cancelled_pairs"], len(target["cancelled"]))
                largest = max((pair["persistence"] for pair in target["cancelled"]), default=0)
                self.assertEqual(target["largest_cancelled"], largest)
        self.assertIn("odd", report["methods"][1]["target"]["note"])

    def test_a_target_that_is_missed_is_reported_with_the_table_and_by_field(self):
        lion = SAMPLES / "lion-head.off"
        result = self.morsel("compare", lion, "--method", "tps", "--target", 150)
        self.assertIn("149 are left", result.stdout)
        result = self.morsel("field", lion, "--method", "tps", "--target", 150, "-o", "lion.txt")
        self.assertIn("149 are left", result.stderr)
        self.assertEqual(len(data_lines(self.folder / "lion.txt")), 8356)

    def test_a_target_is_of_the_methods_own_points(self):
        """`--target K` once gave the input where that had no more than K points."""
        lion = SAMPLES / "lion-head.off"
        alone, = self.report(lion, "--field", "height", "--method", "saliency")["methods"]
        self.assertGreater(alone["critical_points"]["total"], 1000)
        saliency, denoise = self.report(lion, "--field", "height", "--method", "saliency", "--method",
                                        "denoise", "--target", 31)["methods"]
        self.assertEqual(saliency["target"]["before_cancelling"], alone["critical_points"]["total"])
        self.assertEqual(saliency["critical_points"]["total"], 31)
        self.assertEqual(denoise["critical_points"]["total"], 31)
        self.assertGreaterEqual(saliency["field"]["min"], 0)  # of heights it is -0.5
        for target in (33, 2001):
            method, = self.report(lion, "--field", "height", "--method", "conventional", "--target",
                                  target)["methods"]
            self.assertTrue(method["target"]["note"].startswith(
                f"the method's own field has 31 critical points, fewer than {target}"))
            self.assertIsNone(method["target"]["left_by_next"])

    def test_conditions_to_stop_are_reported_with_the_curve(self):
        report = self.report(SAMPLES / "lion-head.off", "--method", "salient:until-count=300", "--method",
                             "laplacian:until-stable=2", "--method", "laplacian:until-change=0.001",
                             "--method", "salient:iterations=2+laplacian:iterations=1")
        salient, stable, change, chain = report["methods"]
        self.assertEqual(salient["details"]["stopped_by"], "until-count")
        totals = [entry["total"] for entry in salient["iterations"]]
        self.assertEqual([entry["iteration"] for entry in salient["iterations"]], list(range(len(totals))))
        self.assertEqual(totals[0], 1895)
        self.assertTrue(all(total > 300 for total in totals[:-1]))
        self.assertLessEqual(totals[-1], 300)
        self.assertEqual(totals[-1], salient["critical_points"]["total"])
        self.assertEqual(salient["details"]["iterations_run"], len(totals) - 1)
        self.assertEqual(stable["details"]["stopped_by"], "until-stable")
        last, before = ({k: v for k, v in entry.items() if k not in ("iteration", "change")}
                        for entry in stable["iterations"][-1:-3:-1])
        self.assertEqual(last, before)
        self.assertEqual(change["details"]["stopped_by"], "until-change")
        extent = report["field"]["max"] - report["field"]["min"]
        self.assertLessEqual(change["iterations"][-1]["change"], 0.001 * extent)
        self.assertEqual([len(step["values"]) for step in chain["iterations"]["steps"]], [3, 2])

    def test_origins_are_critical_points_of_the_input(self):
        schema = json.loads(SCHEMA.read_text())
        arguments = (SAMPLES / "lion-head.off", "--method", "conventional", "--method", "salient", "--method",
                     "tps")
        plain = self.report(*arguments)
        input_types = {item["vertex"]: item["type"] for item in plain["methods"][0]["items"]}
        positions = {item["vertex"]: item["position"] for item in plain["methods"][0]["items"]}
        found = 0
        for method in plain["methods"]:
            for item in method["items"]:
                if item["origin"] is None:
                    self.assertIsNone(item["moved"])
                    continue
                found += 1
                self.assertEqual(input_types[item["origin"]], item["type"])
                self.assertAlmostEqual(item["moved"], math.dist(item["position"], positions[item["origin"]]))
        self.assertGreater(found, 1895)
        self.assertTrue(all(item["origin"] == item["vertex"] for item in plain["methods"][0]["items"]))
        snapped = self.report(*arguments, "--snap", "--export", "files")
        jsonschema.validate(snapped, schema)
        self.assertIs(snapped["request"]["snap"], True)
        moved = 0
        for before, after in zip(plain["methods"], snapped["methods"]):
            for item, other in zip(before["items"], after["items"]):
                self.assertEqual(other["vertex"], item["vertex"])
                expected = item["position"] if item["origin"] is None else positions[item["origin"]]
                self.assertEqual(other["position"], expected)
                moved += other["position"] != item["position"]
        self.assertGreater(moved, 10)
        rows = read_csv(self.folder / "files" / "salient.points.csv")
        for row, item in zip(rows, snapped["methods"][1]["items"], strict=True):
            self.assertEqual([float(row[axis]) for axis in "xyz"], item["position"])
            self.assertEqual(row["origin"], "" if item["origin"] is None else str(item["origin"]))

    def test_such_reports_are_their_own_regression_tests(self):
        self.report(SAMPLES / "lion-head.off", "--method", "salient", "--target", 81, "--snap")
        self.assertIn("unchanged", self.morsel("check", "report.json").stdout)

    def test_targets_give_the_same_at_any_number_of_threads(self):
        reports = []
        for threads in (1, 2, 5):
            report = self.report(SAMPLES / "lion-head.off", "--method", "salient", "--method", "laplacian",
                                 "--target", 80, "--threads", threads)
            del report["timings"]
            reports.append(json.dumps(report))
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[0], reports[2])

    def test_wrong_targets_are_refused(self):
        mesh = self.file("octahedron.off", OCTAHEDRON)
        for value in ("0", "-3", "many", "2.5"):
            self.assertIn("--target", self.morsel("compare", mesh, "--target", value, code=2).stderr)


if __name__ == "__main__":
    unittest.main()
