#include "morsel/tools/render/thumbnail_sink.h"

#include <utility>

#include "morsel/core/file_writer.h"
#include "morsel/tools/render/caption.h"

namespace morsel::tools::render {

ThumbnailSink::ThumbnailSink(std::filesystem::path prefix, std::size_t methods, CameraText camera,
                             core::Progress progress)
    : prefix_(std::move(prefix)),
      methods_(methods),
      camera_(std::move(camera)),
      progress_(std::move(progress)) {
  camera_.check();
  const core::FileWriter probe(path("first"));
}

void ThumbnailSink::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
  studio_.emplace(outcome.field.mesh());
  view_ = studio_->view(camera_.view, camera_.up, progress_);
}

void ThumbnailSink::method(const MethodOutcome& outcome) {
  ++seen_;
  if (seen_ != 1 && seen_ != methods_) return;
  const Subject subject{outcome.field, &outcome.measurement,
                        quantity_of(field_name_, outcome.steps.empty() ? "" : outcome.steps.back().name), "",
                        outcome.places};
  PictureRequest request;
  request.size = {240, 180};
  request.legend = false;
  const std::string bytes = encode_png(studio_->take(view_, subject, request, progress_));
  if (seen_ == 1) core::write_file(path("first"), bytes);
  if (seen_ == methods_) core::write_file(path("last"), bytes);
}

std::filesystem::path ThumbnailSink::path(const char* which) const {
  return prefix_.string() + "." + which + ".png";
}

}  // namespace morsel::tools::render
