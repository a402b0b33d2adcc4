"""Twenty sample meshes through the kinds of files that are written and read: the same mesh and the same
values come back, by this program and by VTK, meshio and nibabel."""

import gzip
import json
import unittest

import meshio
import nibabel
import numpy
from support import SAMPLES, ProgramTest, data_lines, without_comments
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

# Of genus 0 to 9, with up to 106 boundary loops, of up to 122 components.
MESHES = ("ALSTOM_TEST4", "anchor", "blob-closed", "blobby_3cc", "boeing", "bones", "cactus", "couplingdown",
          "double-torus-3-holes", "dragknob", "eight", "elephant-with-holes", "femur", "hand", "head",
          "helmet", "knot", "pig", "three_peaks", "triceratops")
COUNTS = ("vertices", "edges", "faces", "components", "boundary_loops", "euler_characteristic", "genus")


class RoundTrips(ProgramTest):
    def counts(self, file):
        document = json.loads(self.morsel("info", file, "--json").stdout)
        return [document["mesh"][name] for name in COUNTS]

    def values(self, mesh, field):
        return without_comments(self.morsel("field", mesh, "--field", field, "-o", "-").stdout)

    def test_fields(self):
        for name in MESHES:
            with self.subTest(name):
                mesh = SAMPLES / f"{name}.off"
                counts = self.counts(mesh)
                for kind in ("txt", "ply", "vtp", "shape.gii"):
                    self.morsel("field", mesh, "--field", "height:axis=y", "-o", f"h.{kind}")
                height = data_lines(self.folder / "h.txt")
                numbers = numpy.array(height, float)
                for kind in ("ply", "vtp"):
                    self.assertEqual(self.counts(f"h.{kind}"), counts, kind)
                    # positions, too: the same height of what is read
                    for field in ("vertex-scalar:property=height", "height:axis=y"):
                        self.assertEqual(self.values(f"h.{kind}", field), height, (kind, field))
                single = numpy.array(self.values(mesh, "vertex-scalar:file=h.shape.gii"), float)
                numpy.testing.assert_array_equal(single, numbers.astype(numpy.float32))

                reader = vtkXMLPolyDataReader()
                reader.SetFileName(str(self.folder / "h.vtp"))
                reader.Update()
                surface = reader.GetOutput()
                points = vtk_to_numpy(surface.GetPoints().GetData())
                corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
                numpy.testing.assert_array_equal(points[:, 1], numbers)
                numpy.testing.assert_array_equal(
                    vtk_to_numpy(surface.GetPointData().GetArray("height")), numbers)
                ply = meshio.read(self.folder / "h.ply")
                numpy.testing.assert_array_equal(ply.points, points)
                numpy.testing.assert_array_equal(ply.point_data["height"], numbers)
                numpy.testing.assert_array_equal(ply.cells_dict["triangle"], corners)
                numpy.testing.assert_array_equal(
                    nibabel.load(self.folder / "h.shape.gii").darrays[0].data, numbers.astype(numpy.float32))
        self.assertEqual(self.values(mesh, "vertex-scalar:file=h.ply,column=height"), height)
        (self.folder / "h.ply.gz").write_bytes(gzip.compress((self.folder / "h.ply").read_bytes()))
        self.assertEqual(self.values("h.ply.gz", "vertex-scalar:property=height"), height)

    def test_labels(self):
        for name in MESHES:
            with self.subTest(name):
                mesh = SAMPLES / f"{name}.off"
                for kind in ("txt", "annot", "label.gii"):
                    self.morsel("segment", mesh, "--field", "height:axis=y", "--persistence", "1%", "-o",
                                f"s.{kind}")
                labels = data_lines(self.folder / "s.vertices.txt")
                numbers = numpy.array(labels, int)
                numpy.testing.assert_array_equal(
                    nibabel.freesurfer.read_annot(self.folder / "s.annot")[0], numbers)
                numpy.testing.assert_array_equal(
                    nibabel.load(self.folder / "s.label.gii").darrays[0].data, numbers)
                self.assertEqual(self.values(mesh, "vertex-scalar:file=s.annot"), labels)

    def test_meshes(self):
        """`cut` writes meshes: text and binary are one mesh."""
        for name in MESHES:
            with self.subTest(name):
                for kind in ("off", "ply"):
                    self.morsel("cut", SAMPLES / f"{name}.off", "--field", "height:axis=y", "-o", f"c.{kind}")
                self.assertEqual(self.counts("c.off"), self.counts("c.ply"))
                self.assertEqual(self.values("c.off", "height:direction=1/2/3"),
                                 self.values("c.ply", "height:direction=1/2/3"))


if __name__ == "__main__":
    unittest.main()
