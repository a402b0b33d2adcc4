#include "morsel/tools/commands/table_target.h"

#include <iostream>

#include "morsel/core/error.h"
#include "morsel/core/io/file_extension.h"

namespace morsel::tools {

namespace {

std::string journal_path(const std::string& path) { return path + ".journal"; }

}  // namespace

RunFiles& write_table(RunFiles& files, const std::string& path) {
  if (path.empty() || path == "-") return files;
  return files.writes("-o", path).writes("the journal of -o", journal_path(path));
}

TableTarget::TableTarget(const std::string& path) : path_(path) {
  if (path.empty() || is_stdout()) return;
  const std::string extension = core::file_extension(path);
  if (extension != ".json" && extension != ".csv")
    throw core::InvalidArgument("cannot write " + path + ": the output is a .json or a .csv file");
  is_csv_ = extension == ".csv";
  file_.emplace(path);
}

Journal* TableTarget::open_journal(const Json& key) {
  if (file_) journal_.emplace(journal_path(path_), key);
  return journal_ ? &*journal_ : nullptr;
}

void TableTarget::write(const std::function<void(JsonSink&)>& as_json,
                        const std::function<void(std::ostream&)>& as_csv) {
  if (!file_ && !is_stdout()) return;
  std::ostream& out = file_ ? file_->stream() : std::cout;
  if (is_csv_) {
    as_csv(out);
  } else {
    JsonStream json(out);
    as_json(json);
  }
  if (file_) file_->commit();
  if (journal_) journal_->finish();
}

}  // namespace morsel::tools
