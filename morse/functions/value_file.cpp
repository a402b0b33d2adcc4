#include "morsel/morse/functions/value_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <istream>
#include <streambuf>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/parallel/exhaustion.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::morse {
namespace {

using core::BadInput;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// A stream's source in memory.
class MemorySource : public std::streambuf {
 public:
  explicit MemorySource(std::string_view text) {
    char* const begin = const_cast<char*>(text.data());  // which is only read
    setg(begin, begin, begin + text.size());
  }
};

}  // namespace

ValueFile ValueFile::read(const std::filesystem::path& path, const core::Progress& progress) {
  const std::string name = path.string();
  core::check_regular_file(path, "cannot read values from " + name);
  const core::TextContent content(path, name, progress);
  MemorySource source(content.view());
  std::istream stream(&source);
  try {
    return {stream, name, progress};
  } catch (const BadInput& error) {
    const std::string_view kind = core::file_kind(content.view());
    if (kind.empty()) throw;
    throw BadInput(std::string(error.what()) + " (it is " + std::string(kind) + ")");
  }
}

ValueFile::ValueFile(std::istream& stream, std::string name, const core::Progress& progress)
    : name_(std::move(name)) {
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (number % (1 << 16) == 0) progress.throw_if_cancelled();
    std::string_view text = line;
    if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
    text = trimmed(text.substr(0, text.find('#')));
    if (text.empty())
      skipped_.push_back(values_.size());
    else
      values_.push_back(parse(text, number));
  }
  if (stream.bad()) core::fail_to_read(errno, "cannot read values from " + name_);
}

std::string ValueFile::place(std::size_t i) const {
  const auto skipped = std::upper_bound(skipped_.begin(), skipped_.end(), i) - skipped_.begin();
  return "line " + std::to_string(i + static_cast<std::size_t>(skipped) + 1);
}

double ValueFile::parse(std::string_view text, std::size_t number) const {
  double value = 0;
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && stop == end) return value;
  throw BadInput(name_ + ", line " + std::to_string(number) + ": " + core::shown(text) +
                 (error == std::errc::result_out_of_range && stop == end
                      ? " is beyond the range of double precision"
                      : " is not one number"));
}

}  // namespace morsel::morse
