"""Twenty sample meshes through each kind of file that is written and read: the same mesh and the same values
come back, by this program and by VTK, meshio and nibabel."""

import gzip
import json
import unittest

import meshio
import nibabel
import numpy
from support import SAMPLES, ProgramTest, data_lines
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

# Of genus 0 to 9, with up to 106 boundary loops, of up to 122 components.
MESHES = ("ALSTOM_TEST4", "anchor", "blob-closed", "blobby_3cc", "boeing", "bones", "cactus", "couplingdown",
          "double-torus-3-holes", "dragknob", "eight", "elephant-with-holes", "femur", "hand", "head", "helmet",
          "knot", "pig", "three_peaks", "triceratops")
COUNTS = ("vertices", "edges", "faces", "components", "boundary_loops", "euler_characteristic", "genus")


class RoundTrips(ProgramTest):
    def counts(self, file):
        document = json.loads(self.morsel("info", file, "--json").stdout)
        return [document["mesh"][name] for name in COUNTS]

    def values(self, mesh, field):
        return data_lines_of(self.morsel("field", mesh, "--field", field, "-o", "-").stdout)

    def test_fields(self):
        for name in MESHES:
            with self.subTest(name):
                mesh = SAMPLES / f"{name}.off"
                for kind in ("txt", "ply", "vtp", "shape.gii"):
                    self.morsel("field", mesh, "--field", "height:axis=y", "-o", f"h.{kind}")
                height = data_lines(self.folder / "h.txt")
                numbers = numpy.array(height, float)
                (self.folder / "h.ply.gz").write_bytes(gzip.compress((self.folder / "h.ply").read_bytes(), 1))
                for file in ("h.ply", "h.vtp", "h.ply.gz"):
                    self.assertEqual(self.counts(file), self.counts(mesh), file)
                    self.assertEqual(self.values(file, "vertex-scalar:property=height"), height, file)
                # positions, too: the same height of what is read
                self.assertEqual(self.values("h.ply", "height:axis=y"), height)
                self.assertEqual(self.values("h.vtp", "height:axis=y"), height)
                for file in ("h.txt", "h.ply,column=height", "h.vtp,column=height"):
                    self.assertEqual(self.values(mesh, f"vertex-scalar:file={file}"), height, file)
                single = numpy.array(self.values(mesh, "vertex-scalar:file=h.shape.gii"), float)
                numpy.testing.assert_array_equal(single, numbers.astype(numpy.float32))

                reader = vtkXMLPolyDataReader()
                reader.SetFileName(str(self.folder / "h.vtp"))
                reader.Update()
                surface = reader.GetOutput()
                points = vtk_to_numpy(surface.GetPoints().GetData())
                numpy.testing.assert_array_equal(points[:, 1], numbers)
                numpy.testing.assert_array_equal(
                    vtk_to_numpy(surface.GetPointData().GetArray("height")), numbers)
                ply = meshio.read(self.folder / "h.ply")
                numpy.testing.assert_array_equal(ply.points, points)
                numpy.testing.assert_array_equal(ply.point_data["height"], numbers)
                numpy.testing.assert_array_equal(
                    ply.cells_dict["triangle"], vtk_to_numpy(surface.GetPolys().GetConnectivityArray())
                    .reshape(-1, 3))
                numpy.testing.assert_array_equal(
                    nibabel.load(self.folder / "h.shape.gii").darrays[0].data, numbers.astype(numpy.float32))

    def test_labels(self):
        for name in MESHES:
            with self.subTest(name):
                mesh = SAMPLES / f"{name}.off"
                for kind in ("txt", "ply", "vtp", "annot", "label.gii"):
                    self.morsel("segment", mesh, "--field", "height:axis=y", "--persistence", "1%", "-o",
                                f"s.{kind}")
                labels = data_lines(self.folder / "s.vertices.txt")
                for file in ("s.ply,column=segment", "s.vtp,column=segment", "s.annot", "s.label.gii"):
                    self.assertEqual(self.values(mesh, f"vertex-scalar:file={file}"), labels, file)
                numbers = numpy.array(labels, int)
                numpy.testing.assert_array_equal(
                    nibabel.freesurfer.read_annot(self.folder / "s.annot")[0], numbers)
                numpy.testing.assert_array_equal(
                    nibabel.load(self.folder / "s.label.gii").darrays[0].data, numbers)

    def test_meshes(self):
        """`cut` writes meshes: text and binary are one mesh."""
        for name in MESHES:
            with self.subTest(name):
                for kind in ("off", "ply"):
                    self.morsel("cut", SAMPLES / f"{name}.off", "--field", "height:axis=y", "-o", f"c.{kind}")
                self.assertEqual(self.counts("c.off"), self.counts("c.ply"))
                for axis in "xyz":
                    self.assertEqual(self.values("c.off", f"height:axis={axis}"),
                                     self.values("c.ply", f"height:axis={axis}"))


def data_lines_of(text):
    return [line for line in text.splitlines() if not line.startswith("#")]


if __name__ == "__main__":
    unittest.main()
