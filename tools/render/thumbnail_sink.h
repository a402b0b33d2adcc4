#pragma once
/// Small pictures of a comparison's first and last method, for pages that show many meshes.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools::render {

/// PREFIX.first.png or PREFIX.last.png
std::filesystem::path thumbnail_path(const std::filesystem::path& prefix, const std::string& which);

/// Writes PREFIX.first.png and PREFIX.last.png, 240 x 180 pixels each: the surface coloured by the method's
/// field, with its critical points. With a single method both are written, and equal.
class ThumbnailSink : public ComparisonSink {
 public:
  /// `methods`: how many there will be. Of `camera` the inset is left out. Throws WriteFailed if the files
  /// cannot be written, InvalidArgument on a wrong view. Refers to `loaded`.
  ThumbnailSink(std::filesystem::path prefix, std::size_t methods, CameraText camera,
                const core::LoadedMesh& loaded, Provenance provenance, core::Progress progress = {});
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;

 private:
  std::filesystem::path prefix_;
  std::size_t methods_;
  std::size_t seen_ = 0;
  CameraText camera_;
  const core::LoadedMesh& loaded_;
  Provenance provenance_;
  core::Progress progress_;
  std::optional<Studio> studio_;
  View view_;
  std::string field_name_;
  std::string unit_;
};

}  // namespace morsel::tools::render
