#include "morsel/tools/render/figure_sink.h"

#include <utility>

#include "morsel/core/file_writer.h"
#include "morsel/tools/render/caption.h"

namespace morsel::tools::render {
namespace {

constexpr std::size_t kPointsWithArcs = 500;  // beyond, arcs hide the surface
constexpr std::size_t kFullPanels = 12;       // beyond, a sheet's are halved

void write(const std::filesystem::path& path, const Image& image) {
  core::FileWriter file(path, core::Sync::never);
  file.write(encode_png(image));
  file.commit();
}

}  // namespace

FigureSink::FigureSink(std::filesystem::path folder, const core::LoadedMesh& loaded, CameraText camera,
                       Size size, core::Progress progress)
    : folder_(std::move(folder)),
      loaded_(loaded),
      camera_(std::move(camera)),
      progress_(std::move(progress)) {
  camera_.check();
  request_.size = size;
  check_size(size);
  if (!camera_.inset.empty()) request_.inset = find_inset(parse_inset(camera_.inset), loaded_);
  make_folder(folder_);
}

void FigureSink::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
  studio_.emplace(outcome.field.mesh());
  view_ = studio_->view(camera_.view, camera_.up, progress_);
}

void FigureSink::method(const MethodOutcome& outcome) {
  const std::string name = names_.next(outcome.name);
  const morse::CriticalPoints& points = outcome.measurement.critical_points;
  request_.arcs = points.total() <= kPointsWithArcs;
  const Subject subject{outcome.field, &outcome.measurement,
                        quantity_of(field_name_, outcome.steps.empty() ? "" : outcome.steps.back().name), "",
                        outcome.places};
  Image picture = studio_->take(view_, subject, request_, progress_);
  std::string caption =
      outcome.specification + "\n" + counts_line(points.minima, points.saddles, points.maxima);
  write(folder_ / (name + ".png"), with_caption(picture, caption));
  panels_.push_back({std::move(picture), std::move(caption)});
}

void FigureSink::finish() {
  if (panels_.size() > kFullPanels)
    for (Panel& panel : panels_) panel.image = halved(panel.image);
  write(folder_ / "sheet.png", make_sheet(panels_));
}

}  // namespace morsel::tools::render
