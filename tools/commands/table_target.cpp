#include "morsel/tools/commands/table_target.h"

#include "morsel/core/io/file_extension.h"

namespace morsel::tools {

namespace {

std::string journal_path(const std::string& path) { return path + ".journal"; }

bool is_csv(const std::string& path) { return core::file_extension(path) == ".csv"; }

}  // namespace

RunFiles& write_table(RunFiles& files, const std::string& path) {
  if (path.empty() || path == "-") return files;
  core::checked_extension(path, "a table is written", {".json", ".csv"});
  return files.writes("-o", path).writes("the journal of -o", journal_path(path));
}

TableTarget::TableTarget(const std::string& path) : DocumentTarget(path) {}

Journal* TableTarget::open_journal(const Json& key) {
  if (is_file()) journal_.emplace(journal_path(path()), key);
  return journal_ ? &*journal_ : nullptr;
}

void TableTarget::tell_journal(std::size_t count, const std::string& of_what, Console& console) const {
  if (!journal_) return;
  for (const std::string& warning : journal_->warnings()) console.warning(warning);
  if (count > 0)
    console.message("resuming with " + std::to_string(count) + of_what + ": " + journal_path(path()));
}

void TableTarget::write(const std::function<void(JsonSink&)>& as_json,
                        const std::function<void(std::ostream&)>& as_csv) {
  if (!is_wanted()) return;
  if (is_csv(path()))
    as_csv(stream());
  else
    as_json(json());
  commit();
  if (journal_) journal_->finish();
}

}  // namespace morsel::tools
