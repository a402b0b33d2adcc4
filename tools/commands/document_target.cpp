#include "morsel/tools/commands/document_target.h"

#include <utility>

namespace morsel::tools {

DocumentTarget::DocumentTarget(core::FileTarget target) : target_(std::move(target)) {
  if (!target_.path.empty()) file_.emplace(target_);
}

JsonStream& DocumentTarget::json() {
  if (!json_) json_.emplace(stream());
  return *json_;
}

void DocumentTarget::commit() {
  if (file_) file_->commit();
}

void DocumentTarget::tell(const std::string& what, const Run& run) const {
  if (is_wanted()) tell_written(what, target_, run);
}

}  // namespace morsel::tools
