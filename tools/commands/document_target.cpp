#include "morsel/tools/commands/document_target.h"

#include <iostream>

namespace morsel::tools {

DocumentTarget::DocumentTarget(const std::string& path) : path_(path) {
  if (!path.empty() && !is_stdout()) file_.emplace(path);
}

std::ostream& DocumentTarget::stream() { return file_ ? file_->stream() : std::cout; }

JsonStream& DocumentTarget::json() {
  if (!json_) json_.emplace(stream());
  return *json_;
}

void DocumentTarget::commit() {
  if (file_) file_->commit();
}

void DocumentTarget::show(const std::string& text) const {
  if (!is_stdout()) std::cout << text;
}

void DocumentTarget::tell(const std::string& what, Console& console) const {
  if (is_file()) console.message(what + ": " + path_);
}

}  // namespace morsel::tools
