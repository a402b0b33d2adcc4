"""Complexes as objects of networkx and VTK."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np


if TYPE_CHECKING:
    from ._complex import MorseSmaleComplex


def graph(c: MorseSmaleComplex) -> Any:
    """A networkx.MultiGraph."""
    import networkx

    from ._complex import ARC_KINDS, NODE_KINDS

    made = networkx.MultiGraph()
    nodes, position = c.nodes, c.field.mesh.vertices[c.nodes["vertex"]]
    for i, (kind, vertex, value) in enumerate(zip(nodes["kind"].tolist(), nodes["vertex"].tolist(),
                                                  nodes["value"].tolist())):
        made.add_node(i, kind=NODE_KINDS[kind], vertex=vertex, value=value, position=position[i])
    arcs = c.arcs
    for i, (saddle, end, kind) in enumerate(zip(arcs["saddle"].tolist(), arcs["end"].tolist(),
                                                arcs["kind"].tolist())):
        made.add_edge(saddle, end, key=i, arc=i, kind=ARC_KINDS[kind])
    return made


def complex_polydata(c: MorseSmaleComplex) -> Any:
    """A vtkPolyData: a vertex for each node, then a line for each arc."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    def cells(offsets: Any, connectivity: Any) -> Any:
        made = vtkCellArray()
        made.SetData(numpy_to_vtkIdTypeArray(np.ascontiguousarray(offsets, np.int64), deep=True),
                     numpy_to_vtkIdTypeArray(np.ascontiguousarray(connectivity, np.int64), deep=True))
        return made

    nodes, arcs = c.nodes, c.arcs
    arc_points, offsets = c.polylines
    count = len(nodes)
    points = vtkPoints()
    positions = np.concatenate([c.field.mesh.vertices[nodes["vertex"]], arc_points])
    points.SetData(numpy_to_vtk(positions, deep=True))
    made = vtkPolyData()
    made.SetPoints(points)
    made.SetVerts(cells(np.arange(count + 1), np.arange(count)))
    made.SetLines(cells(offsets, count + np.arange(len(arc_points))))
    vertex = nodes["vertex"].astype(np.int64)
    is_cap = nodes["kind"] == 3
    of_arc = {
        "kind": np.concatenate([nodes["kind"], 4 + arcs["kind"]]).astype(np.int32),
        "vertex": np.concatenate([vertex, vertex[arcs["saddle"]]]).astype(np.int32),
        "end_vertex": np.concatenate([np.full(count, -1), np.where(is_cap, -1, vertex)[arcs["end"]]]).astype(
            np.int32)}
    for name, values in of_arc.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        made.GetCellData().AddArray(array)
    return made


