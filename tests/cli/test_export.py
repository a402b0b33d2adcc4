"""The files of --export and morsel field, opened with the programs that they are for: ParaView's own reader
(VTK), numpy, pandas, NetworkX."""

import math
import re
import unittest

import networkx
import numpy
import pandas
from support import OCTAHEDRON, SAMPLES, ProgramTest, made_in, read_csv
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

SINGLE = """OFF
3 1 0
0 0 0
1 0 0
0 1 0
3 0 1 2
"""


def read(path):
    # ParaView 5.11 of Debian refuses appended data, unlike the VTK that is used here.
    data = path.read_bytes()
    assert b"AppendedData" not in data and b'format="appended"' not in data
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
            rows = read_csv(self.folder / "out" / f"{name}.points.csv")
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
        rows = read_csv(self.folder / "out" / "salient.points.csv")
        self.assertEqual(rows, read_csv(self.folder / "p.csv"))
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
                                 for kind in ("complex.graphml", "complex.vtp", "nodes.vtp", "points.csv",
                                              "surface.vtp")])

    def test_the_arrays_of_the_surface_are_finite_and_tell_what_the_method_changed(self):
        report = self.report(SAMPLES / "lion-head.off", "--export", "out")
        original = None
        for method in report["methods"]:
            points = arrays(read(self.folder / "out" / f"{method['name']}.surface.vtp").GetPointData())
            field, before, change, persistence, essential = (
                numpy.array(points[name]) for name in (
                    "mean-curvature", "mean-curvature_original", "mean-curvature_change", "persistence",
                    "essential"))
            self.assertTrue(numpy.array_equal(change, field - before))
            original = before if original is None else original
            self.assertTrue(numpy.array_equal(before, original))
            self.assertEqual(numpy.any(change), method["name"] != "conventional")
            extent = method["field"]["max"] - method["field"]["min"]
            infinite = {item["vertex"] for item in method["items"] if item["persistence"] is None}
            self.assertEqual(set(numpy.flatnonzero(essential)), infinite)
            self.assertEqual(set(persistence[essential == 1]), {extent})
            for item in method["items"]:
                if item["persistence"] is not None:
                    self.assertEqual(persistence[item["vertex"]], item["persistence"])

    def test_nodes_and_arcs_have_types_values_and_persistence(self):
        report = self.report(SAMPLES / "lion-head.off", "--export", "out")
        for method in report["methods"]:
            name, items = method["name"], {item["vertex"]: item for item in method["items"]}
            low, high = method["field"]["min"], method["field"]["max"]
            caps = method["ms_complex"]["caps"]
            self.assertEqual(caps, 1)
            data = read(self.folder / "out" / f"{name}.nodes.vtp")
            self.assertEqual((data.GetNumberOfPoints(), data.GetNumberOfVerts()), (len(items) + caps,) * 2)
            nodes, again = arrays(data.GetPointData()), arrays(data.GetCellData())
            self.assertEqual({key: list(numpy.array(array)) for key, array in nodes.items()},
                             {key: list(numpy.array(array)) for key, array in again.items()})
            types = ("minimum", "saddle", "maximum")
            found = 0
            for i in range(data.GetNumberOfPoints()):
                kind, vertex, multiplicity, value, persistence, essential = (
                    nodes[key].GetValue(i) for key in ("CriticalType", "VertexId", "Multiplicity",
                                                       "mean-curvature", "Persistence", "Essential"))
                if kind == 3:
                    self.assertEqual((value, persistence, essential), (high, high - low, 1))
                    continue
                item = items[vertex]
                found += 1
                self.assertEqual((types[kind], multiplicity, value, data.GetPoint(i)),
                                 (item["type"], item["multiplicity"], item["value"], tuple(item["position"])))
                self.assertEqual((persistence, essential), (high - low, 1) if item["persistence"] is None
                                 else (item["persistence"], 0))
            self.assertEqual(found, len(items))

            cell = {key: numpy.array(array) for key, array in
                    arrays(read(self.folder / "out" / f"{name}.complex.vtp").GetCellData()).items()}
            for i, kind in enumerate(cell["kind"]):
                value, end = cell["value"][i], cell["end_value"][i]
                if kind >= 4:
                    self.assertEqual(value, items[cell["vertex"][i]]["value"])
                    at_cap = cell["end_vertex"][i] == -1
                    self.assertEqual(end, high if at_cap else items[cell["end_vertex"][i]]["value"])
                    self.assertEqual((cell["persistence"][i], cell["essential"][i]),
                                     (high - low, 1) if at_cap else (abs(end - value), 0))
                elif kind < 3:
                    self.assertEqual((value, end), (items[cell["vertex"][i]]["value"],) * 2)

    def test_vtks_own_writer_writes_the_same_arrays(self):
        """Digit by digit, so that what reads VTK's files reads these."""
        self.morsel("compare", SAMPLES / "lion-head.off", "--method", "salient", "--export", "out")

        def contents(path):
            return re.findall(r'<DataArray type="(\w+)" Name="(\S+)"[^>]*format="binary"[^>]*>'
                              r'\s*(\S*)\s*</DataArray>', path.read_text())
        for kind in ("surface", "complex", "nodes"):
            ours = self.folder / "out" / f"salient.{kind}.vtp"
            writer = vtkXMLPolyDataWriter()
            writer.SetInputData(read(ours))
            writer.SetFileName(str(self.folder / "vtk.vtp"))
            writer.SetDataModeToBinary()
            writer.SetCompressorTypeToNone()
            writer.SetHeaderTypeToUInt64()
            writer.Write()
            theirs = {(number, name, text) for number, name, text in contents(self.folder / "vtk.vtp")}
            mine = contents(ours)
            self.assertGreater(len(mine), 7)
            shared = [array for array in mine if array[1] not in ("connectivity", "offsets")]
            for array in shared:  # cells of the reader are 64 bits wide
                self.assertIn(array, theirs)

    def test_a_table_is_read_by_numpy_and_pandas(self):
        lion = SAMPLES / "lion-head.off"
        report = self.report(lion, "--method", "salient", "--export", "out")
        self.morsel("points", lion, "--points", 9, "-o", "p.csv")
        for path, rows in ((self.folder / "out" / "salient.points.csv",
                            report["methods"][0]["critical_points"]["total"]), (self.folder / "p.csv", 9)):
            numbers = numpy.genfromtxt(path, delimiter=",", names=True, comments="#")
            typed = numpy.genfromtxt(path, delimiter=",", names=True, comments="#", dtype=None,
                                     encoding="utf-8")
            table = pandas.read_csv(path, comment="#")
            plain = read_csv(path)
            self.assertEqual([len(each) for each in (numbers, typed, table, plain)], [rows] * 4)
            names = list(plain[0])
            self.assertEqual((list(numbers.dtype.names), list(table.columns)), (names, names))
            for i, row in enumerate(plain):
                for name in ("vertex", "x", "y", "z", "type_code", "value", "persistence"):
                    number = float(row[name])
                    self.assertEqual((numbers[name][i], typed[name][i], table[name][i]), (number,) * 3)
                self.assertEqual((typed["type"][i], table["type"][i]), (row["type"],) * 2)
                self.assertEqual(row["type_code"],
                                 {"minimum": "1", "saddle": "2", "maximum": "3"}[row["type"]])
            self.assertEqual(table["vertex"].dtype, numpy.int64)

    def test_the_complex_as_a_graph(self):
        report = self.report(SAMPLES / "lion-head.off", "--export", "out")
        for method in report["methods"]:
            graph = networkx.read_graphml(self.folder / "out" / f"{method['name']}.complex.graphml",
                                          force_multigraph=True)
            items = {item["vertex"]: item for item in method["items"]}
            complex_ = method["ms_complex"]
            types = [node["type"] for _, node in graph.nodes(data=True)]
            self.assertEqual({kind: types.count(kind) for kind in ("minimum", "saddle", "maximum", "cap")},
                             {"minimum": complex_["minima"], "saddle": complex_["saddles"],
                              "maximum": complex_["maxima"], "cap": complex_["caps"]})
            self.assertEqual((graph.number_of_edges(), graph.is_directed()), (complex_["arcs"], False))
            extent = method["field"]["max"] - method["field"]["min"]
            for name, node in graph.nodes(data=True):
                self.assertIsInstance(node["vertex"], int)
                self.assertIsInstance(node["cell"], int)
                self.assertEqual(graph.degree(name) == 4 or node["type"] != "saddle", True)
                if node["type"] == "cap":
                    self.assertEqual((node["value"], node["persistence"], node["essential"]),
                                     (method["field"]["max"], extent, True))
                    continue
                item = items[node["vertex"]]
                self.assertEqual((node["type"], node["value"], [node[axis] for axis in "xyz"]),
                                 (item["type"], item["value"], item["position"]))
                self.assertEqual((node["persistence"], node["essential"]),
                                 (extent, True) if item["persistence"] is None else
                                 (item["persistence"], False))
            for a, b, arc in graph.edges(data=True):
                kinds = {graph.nodes[a]["type"], graph.nodes[b]["type"]} - {"saddle"}
                self.assertLessEqual(kinds, {"minimum"} if arc["kind"] == "descending" else
                                     {"maximum", "cap"})
                if not arc["essential"]:
                    self.assertTrue(math.isclose(
                        arc["persistence"], abs(graph.nodes[a]["value"] - graph.nodes[b]["value"])))

    def test_a_complex_without_a_saddle(self):
        self.morsel("compare", self.file("t.off", SINGLE), "--field", "height", "--method", "conventional",
                    "--export", "out", "--glb")
        graph = networkx.read_graphml(self.folder / "out" / "conventional.complex.graphml")
        self.assertEqual((sorted(kind for _, kind in graph.nodes(data="type")), graph.number_of_edges()),
                         (["cap", "minimum"], 0))
        self.assertEqual(read(self.folder / "out" / "conventional.complex.vtp").GetNumberOfLines(), 0)

    def test_what_a_method_changed_is_in_the_field_s_file_too(self):
        mesh = self.file("o.off", OCTAHEDRON)
        self.morsel("field", mesh, "--field", "height", "-o", "z.vtp")
        self.assertEqual(list(arrays(read(self.folder / "z.vtp").GetPointData())), ["height"])
        self.morsel("field", mesh, "--field", "height", "--method", "laplacian:iterations=1", "-o", "s.vtp")
        points = {name: numpy.array(array)
                  for name, array in arrays(read(self.folder / "s.vtp").GetPointData()).items()}
        self.assertEqual(list(points), ["height", "height_original", "height_change"])
        self.assertEqual(points["height_original"].tolist(), [1, -1, 0, 0, 0, 0])
        self.assertTrue(numpy.array_equal(points["height_change"],
                                          points["height"] - points["height_original"]))

    def test_a_field_as_vtp(self):
        self.morsel("field", self.file("o.off", OCTAHEDRON), "--field", "height", "-o", "z.vtp")
        surface = read(self.folder / "z.vtp")
        self.assertEqual(surface.GetNumberOfPolys(), 8)
        self.assertEqual(arrays(surface.GetPointData())["height"].GetRange(), (-1, 1))


if __name__ == "__main__":
    unittest.main()
