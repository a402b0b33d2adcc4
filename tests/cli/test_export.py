"""The files of --export and morsel field, opened with ParaView's own reader (VTK)."""

import csv
import unittest

from support import OCTAHEDRON, SAMPLES, ProgramTest, made_in
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.Update()
    assert not errors, errors
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


def cells(cell_array):
    """The points of each cell."""
    ends = cell_array.GetOffsetsArray()
    points = cell_array.GetConnectivityArray()
    return [[points.GetValue(k) for k in range(ends.GetValue(i), ends.GetValue(i + 1))]
            for i in range(cell_array.GetNumberOfCells())]


class Export(ProgramTest):
    def test_the_lions_files_hold_what_the_report_says(self):
        report = self.report(SAMPLES / "lion-head.off", "--export", "out")
        for method in report["methods"]:
            name, counts, complex_ = method["name"], method["critical_points"], method["ms_complex"]
            surface = read(self.folder / "out" / f"{name}.surface.vtp")
            self.assertEqual(surface.GetNumberOfPoints(), report["mesh"]["vertices"])
            self.assertEqual(surface.GetNumberOfPolys(), report["mesh"]["faces"])
            points, cells = arrays(surface.GetPointData()), arrays(surface.GetCellData())
            field = points["mean-curvature"]
            self.assertEqual(field.GetRange(), (method["field"]["min"], method["field"]["max"]))
            types = [points["critical_type"].GetValue(v) for v in range(surface.GetNumberOfPoints())]
            self.assertEqual([types.count(k) for k in (1, 2, 3)],
                             [counts["minima"], counts["saddles"], counts["maxima"]])
            for item in method["items"]:
                self.assertEqual(tuple(item["position"]), surface.GetPoint(item["vertex"]))
                self.assertEqual(item["value"], field.GetValue(item["vertex"]))
            for label, count in complex_["segments"].items():
                values = {cells[label].GetValue(t) for t in range(surface.GetNumberOfPolys())}
                self.assertEqual(len(values), count, label)
                self.assertIn(label, points)
            lines = read(self.folder / "out" / f"{name}.complex.vtp")
            self.assertEqual(lines.GetNumberOfLines(), complex_["arcs"])
            self.assertEqual(lines.GetNumberOfVerts(), sum(complex_[k]
                                                           for k in ("minima", "saddles", "maxima", "caps")))
            bounds, outer = lines.GetBounds(), surface.GetBounds()
            for axis in range(3):
                self.assertGreaterEqual(bounds[2 * axis], outer[2 * axis] - 1e-12)
                self.assertLessEqual(bounds[2 * axis + 1], outer[2 * axis + 1] + 1e-12)
            with open(self.folder / "out" / f"{name}.points.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rows), counts["total"])
            for row, item in zip(rows, method["items"]):
                self.assertEqual((int(row["vertex"]), row["type"], float(row["value"])),
                                 (item["vertex"], item["type"], item["value"]))
                self.assertEqual(row["persistence"] == "inf", item["persistence"] is None)

    def test_chosen_points_take_the_place_of_critical_points(self):
        lion = SAMPLES / "lion-head.off"
        report = self.report(lion, "--method", "salient", "--points", 15, "--fill", "height",
                             "--export", "out")
        chosen = report["methods"][0]["chosen"]["points"]
        surface = read(self.folder / "out" / "salient.surface.vtp")
        points = arrays(surface.GetPointData())
        vertices = range(surface.GetNumberOfPoints())
        marked = {int(points["chosen"].GetValue(v)): v for v in vertices if points["chosen"].GetValue(v) > 0}
        self.assertEqual([marked[i + 1] for i in range(15)], [point["vertex"] for point in chosen])
        critical_types = points["critical_type"]
        types = {v: critical_types.GetValue(v) for v in vertices if critical_types.GetValue(v)}
        self.assertEqual(types, {point["vertex"]: {"minimum": 1, "saddle": 2, "maximum": 3}[point["type"]]
                                 for point in chosen})
        self.morsel("points", lion, "--field", "mean-curvature", "--method", "salient", "--points", 15,
                    "--fill", "height", "-o", "p.csv")
        with open(self.folder / "out" / "salient.points.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        with open(self.folder / "p.csv", newline="", encoding="utf-8") as file:
            alone = list(csv.DictReader(file))
        for row in rows + alone:
            del row["provenance"]
        self.assertEqual(rows, alone)
        self.assertEqual({row["percentile"] for row in rows}, {""})

    def test_cells_are_the_meshs_faces_and_the_complexs_arcs(self):
        lion = SAMPLES / "lion-head.off"
        self.morsel("compare", lion, "--method", "conventional", "--export", "out")
        lines = [line.split() for line in lion.read_text().splitlines() if line and not line.startswith("#")]
        vertices = int(lines[1][0])
        positions = [tuple(map(float, line[:3])) for line in lines[2:2 + vertices]]
        surface = read(self.folder / "out" / "conventional.surface.vtp")
        self.assertEqual(cells(surface.GetPolys()), [[int(v) for v in line[1:4]]
                                                     for line in lines[2 + vertices:]])
        self.assertEqual([surface.GetPoint(v) for v in range(vertices)], positions)

        complex_ = read(self.folder / "out" / "conventional.complex.vtp")
        of_cells = arrays(complex_.GetCellData())
        nodes, arcs = cells(complex_.GetVerts()), cells(complex_.GetLines())
        self.assertEqual(nodes, [[i] for i in range(len(nodes))])
        used = {point for cell in nodes + arcs for point in cell}
        self.assertEqual(used, set(range(complex_.GetNumberOfPoints())))
        ends = {0: set(), 2: set()}
        for i in range(len(nodes)):
            kind, vertex = of_cells["kind"].GetValue(i), of_cells["vertex"].GetValue(i)
            if kind != 3:
                self.assertEqual(complex_.GetPoint(i), positions[vertex])
            ends.setdefault(kind, set()).add(vertex)
        for i, arc in enumerate(arcs, len(nodes)):
            kind, start, end = (of_cells[name].GetValue(i) for name in ("kind", "vertex", "end_vertex"))
            self.assertGreaterEqual(len(arc), 2)
            self.assertEqual(complex_.GetPoint(arc[0]), positions[start])
            self.assertIn(start, ends[1])
            if end != -1:
                self.assertIn(end, ends[2 * (kind - 4)])
                self.assertEqual(complex_.GetPoint(arc[-1]), positions[end])

    def test_methods_of_one_name_get_files_of_their_own(self):
        mesh = self.file("o.off", OCTAHEDRON)
        self.morsel("compare", mesh, "--method", "tps", "--method", "tps:threshold=1%", "--export", "out")
        names = [p.name for p in made_in(self.folder / "out")]
        self.assertEqual(names, [f"{m}.{kind}" for m in ("tps-2", "tps")
                                 for kind in ("complex.vtp", "points.csv", "surface.vtp")])

    def test_a_field_as_vtp(self):
        self.morsel("field", self.file("o.off", OCTAHEDRON), "--field", "height", "-o", "z.vtp")
        surface = read(self.folder / "z.vtp")
        self.assertEqual(surface.GetNumberOfPolys(), 8)
        self.assertEqual(arrays(surface.GetPointData())["height"].GetRange(), (-1, 1))


if __name__ == "__main__":
    unittest.main()
