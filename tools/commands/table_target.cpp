#include "morsel/tools/commands/table_target.h"

#include <utility>

#include "morsel/core/io/file_extension.h"

namespace morsel::tools {

namespace {

std::string journal_path(const core::FileTarget& file) { return file.path.string() + ".journal"; }

std::string table_extension(const core::FileTarget& target) {
  return core::checked_extension(target, "a table is written", {".json", ".csv"});
}

}  // namespace

Option& add_table_option(Command& command, std::string& output, std::string help) {
  return command.output("-o,--output", output, {{"json", "csv"}, "json"}, std::move(help)).value("OUT");
}

RunFiles& write_table(RunFiles& files, const core::FileTarget& target) {
  if (target.path.empty()) return files;
  static_cast<void>(table_extension(target));
  files.writes("-o", target);
  return target.is_open_file() ? files : files.writes("the journal of -o", journal_path(target));
}

Journal* TableTarget::open_journal(const Json& key) {
  if (is_wanted() && !target().is_open_file()) journal_.emplace(journal_path(target()), key);
  return journal_ ? &*journal_ : nullptr;
}

void TableTarget::tell_journal(std::size_t count, const std::string& of_what, Console& console) const {
  if (!journal_) return;
  for (const std::string& warning : journal_->warnings()) console.warning(warning);
  if (count > 0)
    console.message("resuming with " + std::to_string(count) + of_what + ": " + journal_path(target()));
}

void TableTarget::write(const std::function<void(JsonSink&)>& as_json,
                        const std::function<void(std::ostream&)>& as_csv) {
  if (!is_wanted()) return;
  if (table_extension(target()) == ".csv")
    as_csv(stream());
  else
    as_json(json());
  commit();
  if (journal_) journal_->finish();
}

}  // namespace morsel::tools
