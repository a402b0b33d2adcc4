#include "morsel/tools/render/thumbnail_sink.h"

#include <utility>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/formats/png_comment.h"

namespace morsel::tools::render {

std::filesystem::path thumbnail_path(const std::filesystem::path& prefix, const std::string& which) {
  return prefix.string() + "." + which + ".png";
}

ThumbnailSink::ThumbnailSink(std::filesystem::path prefix, std::size_t methods, CameraText camera,
                             const core::LoadedMesh& loaded, Provenance provenance, core::Progress progress)
    : prefix_(std::move(prefix)),
      methods_(methods),
      camera_(std::move(camera)),
      loaded_(loaded),
      provenance_(std::move(provenance)),
      progress_(std::move(progress)) {
  camera_.check();
  const core::FileWriter probe(thumbnail_path(prefix_, "first"));
}

void ThumbnailSink::field(const FieldOutcome& outcome) {
  field_name_ = outcome.name;
  unit_ = outcome.unit;
  provenance_.set_field(outcome);
  studio_.emplace(outcome.field.mesh());
  view_ = studio_->view(camera_.view, camera_.up, progress_);
}

void ThumbnailSink::method(const MethodOutcome& outcome) {
  ++seen_;
  if (seen_ != 1 && seen_ != methods_) return;
  PictureRequest request;
  request.size = {240, 180};
  request.legend = false;
  Provenance provenance = provenance_.with_method(outcome.steps);
  provenance.set("picture", picture_section(request, camera_, "", loaded_.source.numbering));
  const Image image = studio_->take(view_, subject_of(outcome, field_name_, unit_), request, progress_);
  const std::string bytes = drawing::with_png_comment(encode_png(image), provenance.json());
  if (seen_ == 1) core::write_file(thumbnail_path(prefix_, "first"), bytes);
  if (seen_ == methods_) core::write_file(thumbnail_path(prefix_, "last"), bytes);
}

}  // namespace morsel::tools::render
