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
  std::span<const std::uint8_t> critical_types;  ///< per vertex: 0 regular, 1 minimum, 2 saddle, 3 maximum
  std::span<const double> persistence;           ///< per vertex
  const mscomplex::Segmentation& segmentation;
  std::span<const std::int32_t> chosen = {};  ///< per vertex, if points were chosen: chosen_order()
};

/// Per vertex the field, critical_type, persistence, input_vertex and, if it is there, chosen; per vertex and
/// triangle the labels descending, ascending and morse_smale; `more` are arrays of one value a triangle. Does
/// not wait until the file is on disk. Throws WriteFailed.
void write_surface_file(const core::FileTarget& target, const SurfaceFile& surface,
                        const Provenance& provenance, const std::vector<VtpArray>& more = {});

}  // namespace morsel::tools
