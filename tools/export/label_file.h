#pragma once
/// Labels of vertices and triangles as files: PLY, VTP, GLB, text, and for FreeSurfer and GIFTI.

#include <span>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// Numbers from 0 on, below 2³¹.
struct Labels {
  std::string name;
  std::span<const core::Index> vertex;
  std::span<const core::Index> triangle;
};

/// Writes labels in the vertex numbers of the input file; an input vertex that the mesh does not have gets
/// −1, one that repair split the label of its first copy:
///   .ply  the surface (binary), the labels as int properties of vertices and faces, and a colour for each,
///         different from those of its neighbours (ply_colors.h)
///   .vtp  the surface, the labels as arrays of points and cells, and `field` as an array `field_name` of
///         points
///   .glb  the surface, a colour for each label (glb_scene.h)
///   .txt  two files, a label a line below lines that begin with #: NAME.vertices.txt, and NAME.faces.txt in
///         the order of the faces of the others
///   .annot, .label.gii  the labels of vertices, for FreeSurfer and GIFTI (brain_files.h)
/// Faces are the mesh's triangles: the input's faces in its order, polygons cut into triangles, without those
/// that repair dropped. Returns what was written. Throws InvalidArgument on another ending, WriteFailed where
/// writing fails; of the two text files then none or, should the second fail as it is finished, the first
/// alone is there.
std::vector<core::FileTarget> write_labels(const core::FileTarget& target, const Labels& labels,
                                           const core::ScalarField& field, const std::string& field_name,
                                           const core::VertexNumbering& numbering,
                                           std::span<const core::Point> input_positions,
                                           const Provenance& provenance);

/// The files that write_labels() would write; an open file takes all formats but .txt. Throws InvalidArgument
/// unless it knows the ending; to be called before long work.
std::vector<core::FileTarget> label_files(const core::FileTarget& target);

}  // namespace morsel::tools
