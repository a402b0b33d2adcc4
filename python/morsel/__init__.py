"""Few and meaningful critical points of scalar fields on triangle meshes.

>>> import morsel as ms
>>> mesh = ms.read("scan.ply")         # or ms.Mesh(V, F), or a mesh of trimesh, pyvista, meshio, Open3D
>>> f = ms.mean_curvature(mesh)        # a Morse function, or ms.field(mesh, values)
>>> g = ms.salient(f, iterations=10)   # a method, or f.apply("salient:iterations=5+tps:count=150")
>>> p = ms.critical_points(g)
>>> d = ms.persistence(g)
>>> c = ms.morse_smale(g)

Numbers are the same bits as the program's for the same request, at any number of threads. Lengths are in
the mesh's unit, or texts: "8eps" (of 0.3 % of the bounding box's diagonal), "5%" of that, "3edges" (mean
edges). Vertices are numbered from 0 on, as in the arrays or the file. Arrays that the library gives are
read-only views of its memory, which they keep alive. What is wrong raises morsel.Error; wrong arguments are
ValueErrors, too. """

from ._chosen import Points, points
from ._comparison import Comparison, Difference, Row, check, compare
from ._complex import ARC_KINDS, NODE_KINDS, Labels, MorseSmaleComplex, Segmentation, morse_smale
from ._errors import (
    ArgumentError, Cancelled, Defect, Error, InputError, MeshError, MorselWarning, WriteError)
from ._field import End, Field, Step, Target, field
from ._hierarchy import Level, Levels, Links, PersistenceHierarchy, hierarchy
from ._landmarks import Landmarks, Marks, MeshMean, landmarks
from ._library import version as __version__
from ._mesh import Mesh, defects, read
from ._molecules import Molecule, molecule
from ._own import File, Length, function, functions, method, methods, presets
from ._persistence import MINIMUM_SADDLE, SADDLE_CAP, SADDLE_MAXIMUM, Diagram, persistence
from ._points import MAXIMUM, MINIMUM, SADDLE, Counts, CriticalPoints, critical_points
from ._segments import Segments, segment
from ._surfaces import Cut, Quads, cut, quads
from ._shipped import *
from ._shipped import __all__ as _shipped
from ._sweep import Estimate, Stability, Sweep, stability, sweep
from ._threads import thread_count, threads

__all__ = [
    "ARC_KINDS", "ArgumentError", "Cancelled", "Comparison", "Counts", "CriticalPoints", "Cut", "Defect",
    "Diagram", "Difference", "End", "Error", "Estimate", "Field", "File", "InputError", "Labels",
    "Landmarks", "Length", "Level", "Levels", "Links", "MAXIMUM", "MINIMUM", "MINIMUM_SADDLE", "Marks",
    "Mesh", "MeshError", "MeshMean", "Molecule", "MorseSmaleComplex", "MorselWarning", "NODE_KINDS",
    "PersistenceHierarchy", "Points", "Quads", "Row", "SADDLE", "SADDLE_CAP", "SADDLE_MAXIMUM",
    "Segmentation", "Segments", "Stability", "Step", "Sweep", "Target", "WriteError", "check", "compare",
    "critical_points", "cut", "defects", "field", "function", "functions", "hierarchy", "landmarks",
    "method", "methods", "molecule", "morse_smale", "persistence", "points", "presets", "quads", "read",
    "segment", "stability", "sweep", "thread_count", "threads", *_shipped]
