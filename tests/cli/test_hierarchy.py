"""morsel hierarchy: levels by iteration and by persistence, their links, their files."""

import json
import os
import unittest

import jsonschema
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, made_in
from test_export import arrays, read

HIERARCHY_SCHEMA = SCHEMA.parent / "hierarchy.schema.json"
LION = SAMPLES / "lion-head.off"
KINDS = ("descending", "ascending", "morse_smale")


class Hierarchy(ProgramTest):
    def hierarchy(self, *arguments, name="hierarchy.json"):
        self.morsel("hierarchy", *arguments, "-o", name)
        return json.loads((self.folder / name).read_text())

    def check_forest(self, document):
        """Every parent is there, of the same type; cells' links lead to cells and are no larger than
        those."""
        before = None
        for place, level in enumerate(document["levels"]):
            self.assertEqual(level["level"], place)
            counts, complex_ = level["critical_points"], level["ms_complex"]
            types = [point["type"] for point in level["points"]]
            self.assertEqual([types.count(t) for t in ("minimum", "saddle", "maximum")],
                             [counts["minima"], counts["saddles"], counts["maxima"]])
            self.assertEqual(sum(p["multiplicity"] for p in level["points"] if p["type"] == "saddle"),
                             counts["saddle_multiplicity"])
            euler = document["mesh"]["euler_characteristic"]
            self.assertEqual(counts["minima"] - counts["saddle_multiplicity"] + counts["maxima"], euler)
            statuses = [point["status"] for point in level["points"]]
            self.assertEqual({k: statuses.count(k) for k in ("kept", "moved", "new")}, level["links"])
            self.check_arcs(level)
            possible = set() if before is None else {(p["vertex"], p["type"]) for p in before["points"]}
            for point in level["points"]:
                if before is None:
                    self.assertEqual((point["parent"], point["status"]), (None, "first"))
                elif point["parent"] is None:
                    self.assertEqual(point["status"], "new")
                else:
                    self.assertIn((point["parent"], point["type"]), possible)
                    self.assertEqual(point["status"], "kept"
                                     if point["parent"] == point["vertex"] else "moved")
            for kind in KINDS:
                cells = level["cells"][kind]
                self.assertEqual(len(cells), complex_["segments"][kind])
                self.check_links(cells, before and before["cells"][kind], "parent")
                if before is not None:
                    self.check_links(before["cells"][kind], cells, "merges_into")
            before = level
        for kind in KINDS:
            self.check_links(before["cells"][kind], None, "merges_into")

    def check_arcs(self, level):
        types = {point["vertex"]: point["type"] for point in level["points"]}
        self.assertEqual(len(level["arcs"]), level["ms_complex"]["arcs"])
        for arc in level["arcs"]:
            self.assertEqual(types[arc["saddle"]], "saddle")
            self.assertNotEqual(arc["end"] is None, arc["cap"] is None)
            if arc["end"] is not None:
                self.assertEqual(types[arc["end"]], "minimum" if arc["kind"] == "descending" else "maximum")

    def check_links(self, cells, others, link):
        prefix = "parent" if link == "parent" else "merged"
        areas = {} if others is None else {cell["label"]: cell["area"] for cell in others}
        for cell in cells:
            if others is None:
                self.assertEqual([cell[link], cell[prefix + "_area"], cell[prefix + "_share"]], [None] * 3)
                continue
            shared = cell[prefix + "_area"]
            self.assertLessEqual(shared, 1.000001 * min(cell["area"], areas[cell[link]]))
            self.assertAlmostEqual(cell[prefix + "_share"], shared / cell["area"])
            # The largest of all shares is at least their mean.
            self.assertGreaterEqual(cell[prefix + "_share"] * len(others), 0.999999)


class ByIteration(Hierarchy):
    def test_a_level_is_what_compare_reports_of_that_many_iterations(self):
        document = self.hierarchy(LION, "--levels", "1,5,10")
        self.check_forest(document)
        self.assertEqual([level["critical_points"]["total"] for level in document["levels"]], [1033, 137, 97])
        self.assertEqual(document["method"]["details"]["stopped_by"], "iterations")
        self.assertEqual(len(document["method"]["iterations"]), 11)
        methods = [argument for k in (1, 5, 10) for argument in ("--method", f"salient:iterations={k}")]
        report = self.report(LION, *methods)
        self.assertEqual(document["mesh"], report["mesh"])
        self.assertEqual(document["field"], report["field"])
        for level, method in zip(document["levels"], report["methods"]):
            for part in ("field", "critical_points", "ms_complex"):
                self.assertEqual(level[part], method[part])
            for point, item in zip(level["points"], method["items"], strict=True):
                for part in ("vertex", "position", "type", "multiplicity", "value", "persistence"):
                    self.assertEqual(point[part], item[part])

    def test_parents_from_the_input_on_are_compares_origins(self):
        document = self.hierarchy(LION, "--method", "gaussian:iterations=3", "--levels", "0,2")
        self.check_forest(document)
        method, = self.report(LION, "--method", "gaussian:iterations=2")["methods"]
        self.assertEqual([point["parent"] for point in document["levels"][1]["points"]],
                         [item["origin"] for item in method["items"]])
        self.assertEqual(document["method"]["details"]["stopped_by"], "caller")

    def test_defaults_are_the_papers_figure_and_levels_come_in_any_order(self):
        one, other = self.hierarchy(LION), self.hierarchy(LION, "--levels", "10,1,5")
        self.assertEqual(one["request"], {"field": "mean-curvature", "method": "salient", "by": "iteration",
                                          "repair": False, "levels": "1,5,10"})
        self.assertEqual(one["levels"], other["levels"])

    def test_levels_count_iterations_of_the_last_step_of_a_chain(self):
        document = self.hierarchy(LION, "--method", "tps:threshold=1%+laplacian", "--levels", "0,4")
        self.check_forest(document)
        tps, both = self.report(LION, "--method", "tps:threshold=1%",
                                "--method", "tps:threshold=1%+laplacian:iterations=4")["methods"]
        for level, method in zip(document["levels"], (tps, both)):
            self.assertEqual(level["critical_points"], method["critical_points"])

    def test_a_single_level_has_no_links(self):
        document = self.hierarchy(self.file("o.off", OCTAHEDRON), "--field", "height", "--levels", "0")
        self.check_forest(document)
        level, = document["levels"]
        self.assertEqual([(p["vertex"], p["type"]) for p in level["points"]],
                         [(0, "maximum"), (1, "minimum")])
        cell, = level["cells"]["morse_smale"]
        self.assertEqual((cell["minimum"], cell["maximum"], cell["cap"]), (1, 0, None))
        self.assertAlmostEqual(cell["area"], 4 * 3 ** 0.5)

    def test_the_table(self):
        lines = self.morsel("hierarchy", LION).stdout.splitlines()
        self.assertIn("salient, levels by iteration", lines[0])
        self.assertEqual(lines[1].split()[0], "iteration")
        self.assertEqual([(row.split()[0], row.split()[5]) for row in lines[3:]],
                         [("1", "1,033"), ("5", "137"), ("10", "97")])

    def test_vertex_numbers_are_those_of_the_input(self):
        document = self.hierarchy(self.file("d.off", DAMAGED), "--repair", "--field",
                                  "height:direction=-1/0/0",
                                  "--by", "persistence", "--levels", "0,1")
        self.check_forest(document)
        self.assertEqual([(p["vertex"], p["parent"]) for level in document["levels"]
                          for p in level["points"]],
                         [(2, None), (2, 2)])
        self.assertEqual(document["levels"][0]["cells"]["ascending"][0]["minimum"], 2)


class ByPersistence(Hierarchy):
    def test_levels_are_nested_and_their_counts_those_of_the_diagram(self):
        document = self.hierarchy(LION, "--by", "persistence")
        self.check_forest(document)
        method, = self.report(LION, "--method", "conventional")["methods"]
        above = [entry["pairs"] - method["persistence"]["infinite_pairs"]
                 for entry in method["persistence"]["above"]]
        cells = 462 + 960 + 499
        pairs = method["persistence"]["pairs"] - method["persistence"]["infinite_pairs"]
        self.assertEqual(len(document["cancellations"]), pairs)
        before = None
        for level, left in zip(document["levels"], above, strict=True):
            counts = level["critical_points"]
            self.assertEqual(counts["minima"] + counts["saddle_multiplicity"] + counts["maxima"],
                             cells - 2 * (pairs - left))
            self.assertEqual(level["cancellations"], pairs - left)
            points = {(p["vertex"], p["type"], p["value"], p["persistence"]) for p in level["points"]}
            if before is not None:
                self.assertLess(points, before)
                self.assertEqual(level["links"], {"kept": len(points), "moved": 0, "new": 0})
            before = points
        self.assertEqual([level["asked"] for level in document["levels"]], ["0.1%", "1%", "5%"])
        persistence = [c["persistence"] for c in document["cancellations"]]
        self.assertEqual(persistence, sorted(persistence))

    def test_a_finer_cell_lies_in_one_coarser_cell(self):
        document = self.hierarchy(SAMPLES / "bunny00.off", "--by", "persistence", "--levels", "0,1%,20")
        self.check_forest(document)
        for level in document["levels"][:-1]:
            for kind in KINDS:
                self.assertEqual({cell["merged_share"] for cell in level["cells"][kind]}, {1})

    def test_counts_are_met_or_it_says_why_not(self):
        document = self.hierarchy(LION, "--by", "persistence", "--counts", "50,501,151,5000")
        self.check_forest(document)
        cells = [p["minima"] + p["saddle_multiplicity"] + p["maxima"]
                 for p in (level["critical_points"] for level in document["levels"])]
        self.assertEqual(cells, [1921, 501, 151, 49])
        self.assertEqual([level["note"] == "" for level in document["levels"]], [False, True, True, False])
        self.assertEqual([level["cancellations"] for level in document["levels"]], [0, 710, 885, 936])
        out = self.morsel("hierarchy", LION, "--by", "persistence", "--counts", "50").stdout
        self.assertIn("49 are left", out)

    def test_of_a_field_that_a_method_has_made(self):
        document = self.hierarchy(LION, "--by", "persistence", "--method", "salient", "--target", "101",
                                  "--counts", "51")
        self.check_forest(document)
        self.assertEqual(document["method"]["target"]["reached"], 101)
        self.assertEqual(document["request"]["target"], 101)


class Files(Hierarchy):
    def test_exported_files_hold_what_the_document_says(self):
        for kind in ("iteration", "persistence"):
            document = self.hierarchy(LION, "--by", kind, "--export", kind)
            names = [f"{what}.{k}.vtp" for what in ("complex", "surface") for k in range(3)]
            self.assertEqual([path.name for path in made_in(self.folder / kind)], names)
            for level in document["levels"]:
                self.check_surface(read(self.folder / kind / f"surface.{level['level']}.vtp"), document,
                                   level)
                self.check_complex(read(self.folder / kind / f"complex.{level['level']}.vtp"), level)

    def check_surface(self, surface, document, level):
        points, cells = arrays(surface.GetPointData()), arrays(surface.GetCellData())
        self.assertEqual(points["mean-curvature"].GetRange(), (level["field"]["min"], level["field"]["max"]))
        types = {1: "minimum", 2: "saddle", 3: "maximum"}
        found = [(v, types[points["critical_type"].GetValue(v)]) for v in range(surface.GetNumberOfPoints())
                 if points["critical_type"].GetValue(v) != 0]
        self.assertEqual(found, [(p["vertex"], p["type"]) for p in level["points"]])
        triangles = range(document["mesh"]["faces"])
        for kind in KINDS:
            rows = {(cells[kind].GetValue(t), cells[f"{kind}_parent"].GetValue(t),
                     cells[f"{kind}_merges_into"].GetValue(t)) for t in triangles}
            number = lambda label: -1 if label is None else label
            self.assertEqual(rows, {(c["label"], number(c["parent"]), number(c["merges_into"]))
                                    for c in level["cells"][kind]})

    def check_complex(self, lines, level):
        complex_ = level["ms_complex"]
        self.assertEqual(lines.GetNumberOfLines(), complex_["arcs"])
        of_cells = arrays(lines.GetCellData())
        self.assertEqual(lines.GetNumberOfVerts(), sum(complex_[k]
                                                       for k in ("minima", "saddles", "maxima", "caps")))
        parents = {p["vertex"]: -1 if p["parent"] is None else p["parent"] for p in level["points"]}
        for i in range(lines.GetNumberOfCells()):
            node = of_cells["kind"].GetValue(i) < 3
            expected = parents[of_cells["vertex"].GetValue(i)] if node else -1
            self.assertEqual(of_cells["parent"].GetValue(i), expected)

    def test_runs_differ_in_timings_only_at_any_number_of_threads(self):
        for kind in ("iteration", "persistence"):
            documents = []
            for threads in (1, 2, 5):
                document = self.hierarchy(LION, "--by", kind, "--threads", threads)
                del document["timings"]
                documents.append(document)
            self.assertEqual(documents[0], documents[1])
            self.assertEqual(documents[0], documents[2])

    def test_documents_follow_the_schema(self):
        schema = json.loads(HIERARCHY_SCHEMA.read_text())
        mesh = self.file("o.off", OCTAHEDRON)
        chain = "tps:count=9+gaussian:iterations=2,sigma=0.5"
        few = ("--by", "persistence", "--method", "salient", "--target", "61")
        for arguments in ([mesh, "--field", "height"], [mesh, "--method", chain, "--levels", "0,1"],
                          [LION, "--levels", "20"], [LION, *few], [LION, *few, "--counts", "31,9"],
                          [self.file("d.off", DAMAGED), "--repair"]):
            jsonschema.validate(self.hierarchy(*arguments), schema)

    def test_the_schema_refuses_what_it_should(self):
        schema = json.loads(HIERARCHY_SCHEMA.read_text())
        mesh = self.file("o.off", OCTAHEDRON)
        cell = lambda d: d["levels"][0]["cells"]["ascending"][0]
        for by, spoil in (("iteration", lambda d: d.update(cancellations=[])),
                          ("iteration", lambda d: d.update(schema="morsel.hierarchy/2")),
                          ("iteration", lambda d: d["levels"][0].pop("iteration")),
                          ("iteration", lambda d: d["levels"][0]["points"][0].pop("parent")),
                          ("iteration", lambda d: cell(d).update(merged_share=2)),
                          ("iteration", lambda d: d.update(levels=[])),
                          ("iteration", lambda d: d["levels"][0].pop("arcs")),
                          ("iteration", lambda d: d["request"].update(items=False)),
                          ("iteration", lambda d: d["request"].update(items=True)),
                          ("persistence", lambda d: d.pop("cancellations")),
                          ("persistence", lambda d: d["levels"][0].update(iteration=1)),
                          ("persistence", lambda d: d["request"].update(counts="3"))):
            document = self.hierarchy(mesh, "--field", "height", "--by", by)
            jsonschema.validate(document, schema)
            spoil(document)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(document, schema)

    def test_without_items_counts_stay(self):
        schema = json.loads(HIERARCHY_SCHEMA.read_text())
        for kind in ("iteration", "persistence"):
            whole = self.hierarchy(LION, "--by", kind)
            short = self.hierarchy(LION, "--by", kind, "--no-items", name="short.json")
            jsonschema.validate(short, schema)
            self.assertLess((self.folder / "short.json").stat().st_size, 20000)
            whole["request"]["items"] = False
            whole.pop("cancellations", None)
            for level in whole["levels"]:
                for part in ("points", "arcs", "cells"):
                    del level[part]
            for document in (whole, short):
                del document["timings"]
            self.assertEqual(short, whole)

    def test_standard_output(self):
        result = self.morsel("hierarchy", self.file("o.off", OCTAHEDRON), "--levels", "1", "-o", "-")
        self.assertEqual(json.loads(result.stdout)["schema"], "morsel.hierarchy/1")


class Refused(Hierarchy):
    def refuse(self, *arguments, naming, code=2):
        result = self.morsel("hierarchy", LION, *arguments, code=code)
        for word in naming:
            self.assertIn(word, result.stderr)

    def test_levels_that_are_none(self):
        self.refuse("--levels", "1,5,1", naming=["1,5,1", "1 twice"])
        self.refuse("--levels", "1,,5", naming=["1,,5"])
        self.refuse("--levels", "1,x", naming=["x"])
        self.refuse("--levels=-1", naming=["-1"])
        self.refuse("--levels", "0.1%", naming=["0.1%", "whole"])
        self.refuse("--by", "persistence", "--levels", "1%,x", naming=["x", "0.1%"])
        self.refuse("--by", "persistence", "--levels=-3", naming=["-3"])
        self.refuse("--by", "persistence", "--levels", "1%,1.0%", naming=["1.0%", "twice"])
        self.refuse("--by", "persistence", "--counts", "0", naming=["0"])
        self.refuse("--by", "height", naming=["height", "persistence"])

    def test_what_does_not_go_together(self):
        self.refuse("--counts", "50", naming=["counts", "by persistence"])
        self.refuse("--target", "50", naming=["a target", "by persistence"])
        self.refuse("--by", "persistence", "--levels", "1%", "--counts", "50",
                    naming=["levels", "counts"])

    def test_methods_without_enough_iterations(self):
        for method in ("tps", "spectral", "fair", "saliency", "conventional", "salient+tps"):
            self.refuse("--method", method, naming=[method.split("+")[-1], "iterations", "salient"])
        self.refuse("--method", "salient:iterations=3", naming=["3 iterations", "level 10"])
        self.refuse("--method", "salient:until-count=200", naming=["until-count", "after 5", "level 10"])
        self.refuse("--method", "salient:classify=saliency", "--levels", "2",
                    naming=["salient", "another field"])

    def test_other_errors(self):
        self.refuse("--method", "nonsense", naming=["nonsense", "salient"])
        self.file("taken", "")
        self.refuse("-o", "taken/h.json", naming=["taken"], code=4)
        self.refuse("--export", "taken", naming=["taken"], code=4)
        self.morsel("hierarchy", "absent.off", code=3)
        self.refuse("--method", "salient:until-count=200", "-o", "h.json", naming=["until-count"])
        self.assertEqual(os.listdir(self.folder), ["taken"])  # no half-written document


if __name__ == "__main__":
    unittest.main()
