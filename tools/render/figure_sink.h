#pragma once
/// The pictures of `morsel compare --figures`.

#include <optional>
#include <string>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/render/sheet.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/results/file_names.h"
#include "morsel/tools/results/result_folder.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools::render {

/// Writes, into one folder:
///   NAME.png   per method: the surface coloured by its field, with its critical points, and the complex's
///              arcs if there are no more than 500 points; or, where points were chosen, with these alone;
///              all in the same view, each with its own range of colours
///   sheet.png  these side by side, with captions (method, counts)
/// NAME is the method's; a second method of the same name gets "-2", and so on. Called by the thread that
/// made it.
class FigureSink : public ComparisonSink {
 public:
  /// Throws InvalidArgument on a wrong view or inset, or an impossible size. Refers to `folder` and `loaded`.
  FigureSink(ResultFolder& folder, const core::LoadedMesh& loaded, CameraText camera, Size size,
             Provenance provenance, core::Progress progress = {});
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;
  /// Writes the sheet; to be called after the comparison.
  void finish();

 private:
  void write(const std::string& name, const Image& image, const Provenance& provenance) const;

  ResultFolder& folder_;
  const core::LoadedMesh& loaded_;
  CameraText camera_;
  Provenance provenance_;  // without methods
  Provenance all_;         // with all methods
  core::Progress progress_;
  PictureRequest request_;
  std::optional<Studio> studio_;
  View view_;
  std::string field_name_;
  std::string unit_;
  FileNames names_;
  std::vector<Panel> panels_;
};

}  // namespace morsel::tools::render
