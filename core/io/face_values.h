#pragma once
/// Values of faces as values of vertices. Internal to the reading of meshes.

#include <vector>

#include "morsel/core/io/mesh_io.h"

namespace morsel::core {

/// LoadedSoup::face_properties at the soup's vertices: the mean over the polygons at each, weighted by their
/// areas (PolygonSoup::area()); unweighted where no polygon there has an area; nan where there is none. What
/// `representative` gives of a vertex, by its number, is the vertex that it was welded to, itself if to none:
/// those that became one get the mean over the polygons of all. A property is called as that of the faces,
/// or, as long as a property of the vertices has that name, with "face:" before it. O(corners) for each
/// property. Throws InvalidArgument if a property has not a value for each polygon.
std::vector<VertexProperty> face_values_at_vertices(const LoadedSoup& file,
                                                    const std::vector<Index>& representative);

}  // namespace morsel::core
