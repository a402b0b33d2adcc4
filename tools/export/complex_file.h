#pragma once
/// A Morse-Smale complex as lines on its surface, as one file for ParaView.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/mscomplex/complex.h"
#include "morsel/tools/formats/vtp_writer.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// The files' content; refers to the caller's data.
struct ComplexFile {
  const core::LoadedMesh& loaded;
  const mscomplex::MorseSmaleComplex& complex;
  const std::string& field_name;
  const core::ScalarField& field;
  std::span<const double> persistence;  ///< per vertex, of critical points alone; may be infinite
};

/// Nodes as vertices, then arcs as lines. Per cell
///   kind              0 minimum, 1 saddle, 2 maximum, 3 cap, 4 descending arc, 5 ascending arc
///   vertex            a node's critical vertex, an arc's saddle, in the input's numbers
///   end_vertex        where an arc ends; −1 for nodes and at caps
///   value, end_value  the field there; of a cap, whose value is infinite, the field's maximum; both are a
///                     node's own
///   persistence       of a node; of an arc the difference of its values; essential (finite_persistence.h)
///
/// `more` are further arrays of one value a node and one an arc. Does not wait until the file is on disk.
/// Throws WriteFailed.
void write_complex_file(const core::FileTarget& target, const ComplexFile& file, const Provenance& provenance,
                        const std::vector<VtpArray>& more = {});

/// The nodes alone, a point for each critical point (a multiple saddle is one) and cap. Per point, and again
/// per cell, so that filters find them in either place: CriticalType (0 minimum, 1 saddle, 2 maximum, 3 cap),
/// VertexId, Multiplicity, Persistence, Essential (finite_persistence.h), the names of the filters for
/// ParaView and of TTK, and the field by its name. Does not wait until the file is on disk. Throws
/// WriteFailed.
void write_nodes_file(const core::FileTarget& target, const ComplexFile& file, const Provenance& provenance);

}  // namespace morsel::tools
