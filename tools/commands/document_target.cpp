#include "morsel/tools/commands/document_target.h"

#include <iostream>

namespace morsel::tools {

DocumentTarget::DocumentTarget(const std::string& path) : to_stdout_(path == "-") {
  if (!path.empty() && !to_stdout_) file_.emplace(path);
}

JsonStream& DocumentTarget::json() {
  if (!json_) json_.emplace(to_stdout_ ? std::cout : file_->stream());
  return *json_;
}

void DocumentTarget::commit() {
  if (file_) file_->commit();
}

}  // namespace morsel::tools
