"""morsel points: exact numbers, spacing, four formats that agree, and what is refused."""

import json
import math
import struct
import unittest

import jsonschema
import vtk
from support import DAMAGED, OCTAHEDRON, SAMPLES, SCHEMA, ProgramTest, read_csv
from vtk.util.numpy_support import vtk_to_numpy

POINTS_SCHEMA = SCHEMA.parent / "points.schema.json"
COLUMNS = ("value", "persistence", "rank", "distance", "percentile")


def read_ply(path):
    """Positions and properties, by name."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    lines = head.decode().split("element face")[0].splitlines()
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    properties = [line.split()[1:] for line in lines if line.startswith("property")]
    form = "<" + "".join({"double": "d", "int": "i", "uchar": "B"}[kind] for kind, _ in properties)
    rows = [struct.unpack_from(form, body, struct.calcsize(form) * i) for i in range(count)]
    return [dict(zip((name for _, name in properties), row)) for row in rows]


class Points(ProgramTest):
    def document(self, *arguments):
        text = self.morsel("points", *arguments, "-o", "-").stdout
        document = json.loads(text)
        jsonschema.validate(document, json.loads(POINTS_SCHEMA.read_text()))
        self.assertEqual(document["count"], len(document["points"]))
        return document

    def values(self, *numbers):
        self.file("values.txt", "".join(f"{number}\n" for number in numbers))
        return [self.file("octahedron.off", OCTAHEDRON), "--field", "vertex-scalar:file=values.txt", "--fill",
                "none"]

    def test_a_drawn_field(self):
        """The tips of an octahedron, whose distance runs across two triangles."""
        drawn = self.values(1, 0, 0.5, 0.6, 0.5, 0.6)
        document = self.document(*drawn)
        self.assertEqual([(p["vertex"], p["type"], p["value"], p["persistence"], p["rank"])
                          for p in document["points"]],
                         [(0, "maximum", 1, None, 1), (1, "minimum", 0, None, 1)])
        for point in document["points"]:
            self.assertAlmostEqual(point["distance"], math.sqrt(6), places=12)
        self.assertEqual(document["note"],
                         "2 of 20 points: vertex-scalar has 2 extrema that stand out at all")
        one = self.document(*drawn, "--spacing", 2.45, "--points", 2)
        self.assertEqual((one["count"], one["too_near"]), (1, [1]))
        self.assertIn("nearer than 2.45 along the surface", one["note"])
        self.assertEqual(self.document(*drawn, "--points", 1)["note"], "")
        self.assertEqual([p["vertex"] for p in self.document(*drawn, "--kind", "minima")["points"]], [1])
        self.assertEqual(self.document(*drawn, "--kind", "saddles")["note"],
                         "0 of 20 points: vertex-scalar has no saddle that stands out at all")

    def test_a_constant_field_has_no_points(self):
        document = self.document(*self.values(3, 3, 3, 3, 3, 3), "--kind", "all")
        self.assertEqual((document["count"], document["mean_percentile"]), (0, None))
        self.assertIn("no critical point", document["note"])

    def test_exactly_as_many_as_asked_for_and_apart(self):
        for mesh, rank in (("lion-head.off", "persistence"), ("lion-head.off", "salience"),
                           ("bunny00.off", "persistence")):
            with self.subTest(mesh=mesh, rank=rank):
                document = self.document(SAMPLES / mesh, "--field", "mean-curvature", "--points", 50,
                                         "--rank", rank, "--percentiles")
                self.assertEqual((document["count"], document["note"]), (50, ""))
                self.assertAlmostEqual(document["spacing"], 0.05 * document["mesh"]["bbox_diagonal"])
                self.assertEqual(len({p["vertex"] for p in document["points"]}), 50)
                for point in document["points"]:
                    self.assertGreaterEqual(point["distance"], document["spacing"] * (1 - 1e-12))
                ranks = [p["rank"] for p in document["points"]]
                self.assertEqual(ranks, sorted(ranks, reverse=True))
                mean = sum(p["percentile"] for p in document["points"]) / 50
                self.assertAlmostEqual(document["mean_percentile"], mean)
                self.assertEqual("salience_scale" in document, rank == "salience")

    def test_fifty_points_of_the_default_field(self):
        """One command, whatever the mesh: the second field fills up."""
        for name in ("lion-head", "bunny00", "elephant", "cow", "camel", "dino", "armadillo", "bull",
                     "cactus", "homer"):
            document = self.document(SAMPLES / f"{name}.off", "--points", 50)
            self.assertEqual((document["count"], document["note"]), (50, ""))
            self.assertGreaterEqual(min(p["distance"] for p in document["points"]),
                                    document["spacing"] * (1 - 1e-12))
            self.assertEqual(document["points"][0]["field"], "gaussian-curvature")

    def test_a_second_field_fills_up(self):
        document = self.document(SAMPLES / "lion-head.off", "--field", "height", "--method",
                                 "tps:threshold=20%", "--fill", "mean-curvature", "--points", 30)
        self.assertEqual((document["count"], document["note"]), (30, ""))
        names = [p["field"] for p in document["points"]]
        self.assertEqual(names, sorted(names))  # height, then mean-curvature
        self.assertEqual(document["fill"]["name"], "mean-curvature")
        self.assertLess(names.count("height"), 30)
        few = self.document(SAMPLES / "lion-head.off", "--field", "height", "--fill", "mean-curvature",
                            "--points", 1)
        self.assertNotIn("fill", few)  # not needed

    def test_formats_agree(self):
        arguments = (SAMPLES / "lion-head.off", "--field", "mean-curvature", "--points", 12, "--kind", "all",
                     "--percentiles")
        document = self.document(*arguments)
        expected = document["points"]
        extent = document["field"]["max"] - document["field"]["min"]
        for kind in ("csv", "json", "ply", "vtp"):
            said = self.morsel("points", *arguments, "-o", f"p.{kind}").stderr
            self.assertIn("points: 12, at least ", said)
            self.assertRegex(said, r"mean saliency percentile 0\.\d\d\n")
            self.assertIn(f"points: p.{kind}\n", said)
        self.assertEqual(json.loads((self.folder / "p.json").read_text())["points"], expected)
        table = read_csv(self.folder / "p.csv")
        cloud = read_ply(self.folder / "p.ply")
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "p.vtp"))
        reader.Update()
        surface = reader.GetOutput()
        self.assertEqual((surface.GetNumberOfPoints(), surface.GetNumberOfVerts()), (12, 12))
        arrays = {surface.GetPointData().GetArrayName(i):
                  vtk_to_numpy(surface.GetPointData().GetArray(i))
                  for i in range(surface.GetPointData().GetNumberOfArrays())}
        self.assertEqual((len(table), len(cloud)), (12, 12))
        for i, point in enumerate(expected):
            for name in COLUMNS:
                number = math.inf if point[name] is None else point[name]
                self.assertEqual(float(table[i][name]), number)
                if name == "persistence":
                    is_essential = point[name] is None
                    number = extent if is_essential else number
                    self.assertEqual((cloud[i]["essential"], arrays["essential"][i]), (is_essential,) * 2)
                self.assertEqual(cloud[i][name], number)
                self.assertEqual(arrays[name][i], number)
            self.assertEqual([float(table[i][axis]) for axis in "xyz"], point["position"])
            self.assertEqual([cloud[i][axis] for axis in "xyz"], point["position"])
            self.assertEqual(list(surface.GetPoint(i)), point["position"])
            self.assertEqual((int(table[i]["vertex"]), cloud[i]["vertex"], arrays["vertex"][i]),
                             (point["vertex"],) * 3)
            self.assertEqual(table[i]["type"], point["type"])
            code = {"minimum": 1, "saddle": 2, "maximum": 3}[point["type"]]
            self.assertEqual((int(table[i]["type_code"]), cloud[i]["type"], arrays["type"][i]), (code,) * 3)
            self.assertEqual(cloud[i]["quality"], point["value"])
            self.assertEqual([cloud[i][channel] for channel in ("red", "green", "blue")],
                             {1: [0x1f, 0x4f, 0xd0], 2: [0x1f, 0xa0, 0x40], 3: [0xd0, 0x1c, 0x1f]}[code])
            self.assertEqual((table[i]["field"], cloud[i]["field"]), (point["field"], 0))

    def test_percentiles_that_were_not_asked_for(self):
        arguments = self.values(1, 0, 0.5, 0.6, 0.5, 0.6)
        document = self.document(*arguments)
        self.assertEqual((document["mean_percentile"], document["points"][0]["percentile"]), (None, None))
        for kind in ("csv", "ply"):
            said = self.morsel("points", *arguments, "-o", f"p.{kind}").stderr
            self.assertNotIn("percentile", said)
        self.assertEqual([row["percentile"] for row in read_csv(self.folder / "p.csv")], ["", ""])
        self.assertTrue(all(math.isnan(point["percentile"]) for point in read_ply(self.folder / "p.ply")))

    def test_vertices_have_the_numbers_of_the_file(self):
        mesh = self.file("damaged.off", DAMAGED)
        document = self.document(mesh, "--repair", "--field", "height:axis=x", "--spacing", 0, "--kind",
                                 "all")
        for point in document["points"]:
            lines = DAMAGED.splitlines()
            self.assertEqual(point["position"], [float(x) for x in lines[2 + point["vertex"]].split()])

    def test_what_is_refused(self):
        mesh = self.values(1, 0, 0.5, 0.6, 0.5, 0.6)
        for words, naming in ((("--kind", "tips"), "extrema, maxima, minima, saddles or all"),
                              (("--rank", "height"), "persistence or salience"),
                              (("--points", "0"), "--points"),
                              (("--spacing", "wide"), "--spacing"),
                              (("--spacing=-1%",), "spacing"),
                              (("--fill", "curvature"), "curvature"),
                              (("--salience-scale", "8eps"), "rank=salience"),
                              (("--salience-scale", "0", "--rank", "salience"), "above 0")):
            with self.subTest(words):
                error = self.morsel("points", *mesh[:3], *words, "-o", "p.csv", code=2).stderr
                self.assertIn(naming, error)
        self.assertIn(".csv, .json, .ply or .vtp",
                      self.morsel("points", *mesh, "-o", "p.txt", code=2).stderr)
        self.assertIn("--fill vertex-scalar:file values.csv",
                      self.morsel("points", mesh[0], "--fill", "vertex-scalar:file=values.csv",
                                  "-o", "values.csv", code=2).stderr)
        self.morsel("points", *mesh, "-o", "octahedron.off/p.csv", code=4)
        self.assertFalse(list(self.folder.glob("p.*")))


if __name__ == "__main__":
    unittest.main()
