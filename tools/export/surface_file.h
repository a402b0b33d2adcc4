#pragma once
/// A surface with its field, critical points and segments, as one file for ParaView.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/mscomplex/segmentation.h"
#include "morsel/tools/formats/vtp_writer.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// The file's content; refers to the caller's data.
struct SurfaceFile {
  const core::LoadedMesh& loaded;
  const std::string& field_name;
  const core::ScalarField& field;
  const core::ScalarField& original;             ///< before the method
  std::span<const std::uint8_t> critical_types;  ///< per vertex: 0 regular, 1 minimum, 2 saddle, 3 maximum
  std::span<const double> persistence;           ///< per vertex; may be infinite
  const mscomplex::Segmentation& segmentation;
  std::span<const std::int32_t> chosen = {};  ///< per vertex, if points were chosen: chosen_order()
};

/// The names of the arrays beside that of a field: of its values before the method, and of what the method
/// added to them.
std::string original_name(const std::string& field_name);
std::string change_name(const std::string& field_name);
/// field − original.
std::vector<double> change_of(std::span<const double> field, std::span<const double> original);

/// Per vertex the field, NAME_original, NAME_change, critical_type, persistence, essential
/// (finite_persistence.h), input_vertex and, if it is there, chosen; per vertex and triangle the labels
/// descending, ascending and morse_smale; `more` are arrays of one value a triangle. Does not wait until the
/// file is on disk. Throws WriteFailed.
void write_surface_file(const core::FileTarget& target, const SurfaceFile& surface,
                        const Provenance& provenance, const std::vector<VtpArray>& more = {});

}  // namespace morsel::tools
