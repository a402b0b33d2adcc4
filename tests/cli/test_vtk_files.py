"""Files of VTK and meshio, and files of values: what other programs write is read to the last bit."""

import unittest

import numpy
from support import OCTAHEDRON, SAMPLES, ProgramTest, data_lines
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

try:
    import meshio
except ImportError:
    meshio = None


def off_arrays(path):
    """Vertices and faces of an OFF file of triangles."""
    words = path.read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    positions = numpy.array(words[4:4 + 3 * vertices], dtype=float).reshape(-1, 3)
    corners = numpy.array(words[4 + 3 * vertices:4 + 3 * vertices + 4 * faces], dtype=numpy.int64)
    return positions, corners.reshape(-1, 4)[:, 1:]


def ply_body(path):
    """The binary part of a PLY file, and its header without comments."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    return [line for line in head.splitlines() if not line.startswith(b"comment")], body


class VtkFiles(ProgramTest):
    """A mesh with irregular positions, written by others in each of their ways."""

    @classmethod
    def setUpClass(cls):
        cls.mesh = SAMPLES / "hand.off"
        cls.positions, cls.faces = off_arrays(cls.mesh)
        cls.values = numpy.sin(37 * cls.positions[:, 0]) / 3

    def polydata(self):
        data = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(self.positions, deep=True))
        data.SetPoints(points)
        cells = vtkCellArray()
        offsets = numpy.arange(0, self.faces.size + 1, 3)
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                      numpy_to_vtkIdTypeArray(self.faces.ravel(), deep=True))
        data.SetPolys(cells)
        array = numpy_to_vtk(self.values, deep=True)
        array.SetName("wave")
        data.GetPointData().SetScalars(array)
        return data

    def grid(self):
        data = self.polydata()
        grid = vtkUnstructuredGrid()
        grid.SetPoints(data.GetPoints())
        grid.SetCells(VTK_TRIANGLE, data.GetPolys())
        grid.GetPointData().SetScalars(data.GetPointData().GetScalars())
        return grid

    def check(self, name, exact=True):
        """The file has the mesh and the values."""
        with self.subTest(name):
            if not (self.folder / "mesh.ply").exists():
                self.morsel("field", self.mesh, "--field", "height:axis=x", "-o", "mesh.ply")
                (self.folder / "wave.txt").write_text("".join(f"{float(v)!r}\n" for v in self.values))
            result = self.morsel("field", name, "--field", "height:axis=x", "-o", "again.ply")
            self.assertEqual(result.stderr.count("warning"), 0)
            if exact:
                self.assertEqual(ply_body(self.folder / "again.ply"), ply_body(self.folder / "mesh.ply"))
            self.morsel("field", name, "--field", "vertex-scalar:property=wave", "-o", "again.txt")
            self.morsel("field", self.mesh, "--field", f"vertex-scalar:file={name},column=wave", "-o",
                        "other.txt")
            again = [float(line) for line in data_lines(self.folder / "again.txt")]
            if exact:
                self.assertEqual(again, list(self.values))
            self.assertEqual(data_lines(self.folder / "again.txt"), data_lines(self.folder / "other.txt"))

    def write(self, writer, name, data):
        writer.SetFileName(str(self.folder / name))
        writer.SetInputData(data)
        self.assertTrue(writer.Write())
        return name

    def test_legacy_files_of_vtk(self):
        for version in (42, 51):
            for kind, writer, data in (("surface", vtkPolyDataWriter, self.polydata()),
                                       ("grid", vtkUnstructuredGridWriter, self.grid())):
                made = writer()
                made.SetFileVersion(version)
                made.SetFileTypeToBinary()
                self.check(self.write(made, f"{kind}{version}.vtk", data))
                made.SetFileTypeToASCII()  # in which VTK writes few digits
                self.check(self.write(made, f"{kind}{version}a.vtk", data), exact=False)

    def test_xml_files_of_vtk(self):
        number = 0
        for writer, data, ending in ((vtkXMLPolyDataWriter, self.polydata(), "vtp"),
                                     (vtkXMLUnstructuredGridWriter, self.grid(), "vtu")):
            for mode in ("Ascii", "Binary", "Appended"):
                for compressor in ("None", "ZLib"):
                    for header, order, encode in ((32, "Little", True), (64, "Big", False)):
                        made = writer()
                        getattr(made, f"SetDataModeTo{mode}")()
                        getattr(made, f"SetCompressorTypeTo{compressor}")()
                        getattr(made, f"SetHeaderTypeToUInt{header}")()
                        getattr(made, f"SetByteOrderTo{order}Endian")()
                        made.SetEncodeAppendedData(encode)
                        number += 1
                        self.check(self.write(made, f"{number}.{ending}", data))

    @unittest.skipIf(meshio is None, "meshio is not installed")
    def test_files_of_meshio(self):
        mesh = meshio.Mesh(self.positions, [("triangle", self.faces)], point_data={"wave": self.values})
        for name, options in (("a.vtk", {"file_format": "vtk42"}), ("b.vtk", {"file_format": "vtk51"}),
                              ("c.vtk", {"file_format": "vtk42-ascii"}), ("d.vtu", {}),
                              ("e.vtu", {"binary": False}), ("f.vtu", {"compression": None})):
            try:
                meshio.write(self.folder / name, mesh, **options)
            except (TypeError, meshio.WriteError, KeyError):
                if "file_format" not in options:
                    raise
                continue  # this version of meshio has no such form
            self.check(name, exact=name != "e.vtu")  # where meshio writes twelve digits

    def test_what_the_program_writes_is_read_back(self):
        self.morsel("field", self.mesh, "--field", "height:axis=x", "-o", "mesh.ply")
        self.morsel("field", self.mesh, "--field", "height:axis=x", "-o", "height.vtp")
        self.morsel("field", "height.vtp", "--field", "height:axis=x", "-o", "again.ply")
        self.assertEqual(ply_body(self.folder / "again.ply"), ply_body(self.folder / "mesh.ply"))
        self.morsel("compare", self.mesh, "--field", "height:axis=x", "--method", "salient:iterations=1",
                    "--export", "out", "-o", "report.json")
        surfaces = sorted(path for path in (self.folder / "out").glob("*.vtp")
                          if path.name.endswith(".surface.vtp"))
        self.assertTrue(surfaces)
        for path in surfaces:
            with self.subTest(path.name):
                self.morsel("field", path, "--field", "height:axis=x", "-o", "again.ply")
                self.assertEqual(ply_body(self.folder / "again.ply"), ply_body(self.folder / "mesh.ply"))
        self.morsel("segment", self.mesh, "--field", "height:axis=x", "-o", "segments.vtp")
        self.morsel("segment", self.mesh, "--field", "height:axis=x", "-o", "segments.ply")
        for name in ("segments.vtp", "segments.ply"):
            self.morsel("field", name, "--field", "vertex-scalar:property=segment", "-o", name + ".txt")
        self.assertEqual(data_lines(self.folder / "segments.vtp.txt"),
                         data_lines(self.folder / "segments.ply.txt"))
        self.morsel("points", self.mesh, "--field", "height:axis=x", "-o", "points.vtp")
        said = self.morsel("info", "points.vtp").stdout
        self.assertIn("made by", said)
        self.assertNotIn("defect", said)
        self.assertIn("no triangle", self.morsel("field", "points.vtp", "-o", "x.txt", code=3).stderr)

    def test_volumes_are_refused(self):
        name = "v.vtk"
        self.file(name, "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
                        "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n")
        self.assertIn("it is a volume mesh", self.morsel("info", name, code=3).stderr)


class ValueFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.file("o.off", OCTAHEDRON)
        self.values = [0.1, -2, 3e-300, 4, 5, 6.5]

    def read(self, name, column=None, said=""):
        key = f"vertex-scalar:file={name}" + ("" if column is None else f",column={column}")
        result = self.morsel("field", self.mesh, "--field", key, "-o", "out.txt")
        self.assertIn(said, result.stderr)
        told = [line for line in result.stderr.splitlines() if "warning" in line and name in line]
        self.assertEqual(bool(said), bool(told), result.stderr)
        return [float(line) for line in data_lines(self.folder / "out.txt")]

    def test_arrays_of_numpy(self):
        table = numpy.array([range(6), self.values]).T
        for number, array in enumerate((table[:, 1], table[:, 1:], table[:, 1].astype(">f8"))):
            numpy.save(self.folder / f"{number}.npy", array)
            self.assertEqual(self.read(f"{number}.npy"), self.values)
        for number, array in enumerate((table, numpy.asfortranarray(table))):
            numpy.save(self.folder / f"t{number}.npy", array)
            self.assertEqual(self.read(f"t{number}.npy", 2), self.values)
        for kind in ("b1", "i1", "u1", "<i2", ">u2", "<i4", ">u4", "<i8", ">u8", "<f2", ">f4"):
            numpy.save(self.folder / "k.npy", numpy.array([0, 1, 1, 0, 1, 0]).astype(kind))
            self.assertEqual(self.read("k.npy"), [0, 1, 1, 0, 1, 0])
        numpy.save(self.folder / "c.npy", numpy.zeros(6, dtype=complex))
        self.assertIn("type \"<c16\"", self.morsel("field", self.mesh, "--field", "vertex-scalar:file=c.npy",
                                                   "-o", "out.txt", code=3).stderr)

    def test_tables(self):
        rows = list(enumerate(self.values))
        for name, separator in (("a.csv", ","), ("b.csv", ";"), ("c.tsv", "\t"), ("d.txt", " ")):
            self.file(name, f'id{separator}"depth"\n' + "".join(f"{i}{separator}{v!r}\n" for i, v in rows))
            self.assertEqual(self.read(name, "depth"), self.values)
            self.assertEqual(self.read(name, 2), self.values)
        numpy.savetxt(self.folder / "e.txt", numpy.array(rows), header="id depth", fmt="%r")
        self.assertEqual(self.read("e.txt", "depth"), self.values)
        said = self.morsel("field", self.mesh, "--field", "vertex-scalar:file=a.csv", "-o", "out.txt",
                           code=3).stderr
        self.assertIn('the columns "id", "depth": choose one by column=NAME', said)

    def test_a_header_is_told_of(self):
        self.file("h.txt", "depth\n" + "".join(f"{v!r}\n" for v in self.values))
        self.assertEqual(self.read("h.txt", said='skipped as a header: "depth"'), self.values)
        self.morsel("compare", self.mesh, "--field", "vertex-scalar:file=h.txt", "-o", "r.json")
        self.assertIn("skipped as a header", (self.folder / "r.json").read_text())


if __name__ == "__main__":
    unittest.main()
