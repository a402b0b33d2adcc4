// Values in texts: one a line, or a column of a table.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/value_file.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace value_text {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// The line of each value, kept where it is not the one after the previous value's.
class LinesOfValues {
 public:
  void add(std::size_t line) {
    if (runs_.empty() || line - runs_.back().line != count_ - runs_.back().value)
      runs_.push_back({count_, line});
    ++count_;
  }
  std::size_t operator[](std::size_t value) const {
    const auto after = std::ranges::upper_bound(runs_, value, {}, &Run::value);
    return after == runs_.begin() ? 0 : after[-1].line + (value - after[-1].value);
  }

 private:
  struct Run {
    std::size_t value;
    std::size_t line;
  };
  std::vector<Run> runs_;
  std::size_t count_ = 0;
};

/// Collects values and their lines.
struct Collector {
  std::vector<double> values;
  LinesOfValues lines;

  void add(double value, std::size_t line) {
    values.push_back(value);
    lines.add(line);
  }
  ValueFile finish(std::vector<std::string> warnings) {
    return {std::move(values),
            [places = std::move(lines)](std::size_t i) { return "line " + std::to_string(places[i]); },
            std::move(warnings)};
  }
};

[[noreturn]] void fail_at(const ValueRequest& request, std::size_t line, const std::string& what) {
  throw BadInput(request.file + ", line " + std::to_string(line) + ": " + what);
}

[[noreturn]] void fail_number(const ValueRequest& request, std::size_t line, std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
  fail_at(request, line,
          shown(text) + (error == std::errc::result_out_of_range && stop == end
                             ? " is beyond the range of double precision"
                             : " is not one number"));
}

/// A text without its byte-order mark, UTF-16 as UTF-8, and what ends its lines: \r only where there is no
/// \n.
struct Lines {
  explicit Lines(std::string_view bytes, const std::string& file = {}) : text(bytes) {
    if (is_utf16(bytes)) text = converted = utf8_of_utf16(bytes, file);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.find('\n') == std::string_view::npos) terminator = '\r';
  }
  Lines(const Lines&) = delete;
  std::string converted;
  std::string_view text;
  char terminator = '\n';
};

/// "The 2 lines before the first number were skipped; the first is "x"."
std::string skipped_lines(const ValueRequest& request, std::size_t count, std::string_view first) {
  return request.file + ": " +
         (count == 1 ? "the line before the first number was skipped as a header: "
                     : "the " + std::to_string(count) +
                           " lines before the first number were skipped as a header, from ") +
         shown(first) + (count == 1 ? "" : " on");
}

/// How many numbers a line is that has nothing but numbers, between blanks, commas or semicolons; else 0.
std::size_t count_of_numbers(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0;;) {
    at = text.find_first_not_of(" \t\r\v\f,;", at);
    if (at == std::string_view::npos) return count;
    const std::size_t end = std::min(text.find_first_of(" \t\r\v\f,;", at), text.size());
    double value = 0;
    if (!parse_value(text.substr(at, end - at), value)) return 0;
    ++count;
    at = end;
  }
}

struct Cell {
  std::string_view text;  ///< without its quotes; doubled quotes within are still doubled
  bool quoted = false;

  bool is(std::string_view name) const {
    if (!quoted || text.find('"') == std::string_view::npos) return text == name;
    std::size_t at = 0;
    for (std::size_t i = 0; i < text.size(); ++i, ++at) {
      if (at == name.size() || text[i] != name[at]) return false;
      if (text[i] == '"') ++i;  // the second of two
    }
    return at == name.size();
  }
};

/// The records of a table, one after the other. A record is a line, or more where a quoted cell goes on.
class Records {
 public:
  static constexpr char kBlanks = ' ';  ///< the separator of cells between runs of blanks

  Records(const ValueRequest& request, bool only_separators)
      : request_(request), only_separators_(only_separators) {}

  void begin(const Lines& lines) {
    terminator_ = lines.terminator;
    cursor_ = lines.text.data();
    end_ = cursor_ + lines.text.size();
  }

  /// Reads the next record that is neither blank nor a comment; false at the end.
  bool next() {
    while (cursor_ != end_) {
      const char* line_end = std::find(cursor_, end_, terminator_);
      const std::string_view line = trimmed({cursor_, static_cast<std::size_t>(line_end - cursor_)});
      ++line_;
      if ((line_ & 0xFFFF) == 0) request_.progress.throw_if_cancelled();
      if (!line.empty() && line.front() != '#') {
        if (separator_ == 0) separator_ = separator_of(line);
        split(line_end);
        return true;
      }
      if (!line.empty() && !seen_) comment_ = trimmed(line.substr(1));
      cursor_ = line_end == end_ ? end_ : line_end + 1;
    }
    return false;
  }

  const std::vector<Cell>& cells() const { return cells_; }
  std::size_t line() const { return first_line_; }  ///< on which the record begins
  /// The names in the last comment before the first record, if they are as many as its cells.
  std::vector<Cell> comment_names() const {
    Records names(request_, only_separators_);
    std::vector<Cell> none;
    if (comment_.empty()) return none;
    names.begin(Lines(comment_));
    return names.next() ? names.cells_ : none;
  }

 private:
  char separator_of(std::string_view line) const {
    bool quoted = false;
    std::string outside;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (!quoted) outside += c;
    }
    for (const char c : {'\t', ';', ','})
      if (outside.find(c) != std::string::npos) return c;
    return only_separators_ ? ',' : kBlanks;
  }

  bool is_separator(char c) const {
    return separator_ == kBlanks ? kBlank.find(c) != std::string_view::npos : c == separator_;
  }
  /// A blank that is not the separator itself.
  bool is_padding(char c) const {
    return c != terminator_ && kBlank.find(c) != std::string_view::npos &&
           (separator_ == kBlanks || c != separator_);
  }

  /// Splits the record at the cursor, whose first line ends at `line_end`, and goes past it.
  void split(const char* line_end) {
    cells_.clear();
    seen_ = true;
    first_line_ = line_;
    for (;;) {
      while (cursor_ != line_end && is_padding(*cursor_)) ++cursor_;
      if (separator_ == kBlanks && cursor_ == line_end) break;
      if (cursor_ != line_end && *cursor_ == '"') {
        line_end = quoted_cell(line_end);
      } else {
        const char* stop = std::find_if(cursor_, line_end, [&](char c) { return is_separator(c); });
        cells_.push_back({trimmed({cursor_, static_cast<std::size_t>(stop - cursor_)})});
        cursor_ = stop;
      }
      if (cursor_ == line_end) break;
      ++cursor_;  // the separator
    }
    cursor_ = line_end == end_ ? end_ : line_end + 1;
  }

  /// Reads the cell whose opening quote is at the cursor; returns the end of the line on which it ends.
  const char* quoted_cell(const char* line_end) {
    const char* begin = ++cursor_;
    for (;; ++cursor_) {
      cursor_ = std::find(cursor_, end_, '"');
      if (cursor_ == end_) fail_at(request_, first_line_, "a quote is opened that is never closed");
      if (cursor_ + 1 == end_ || cursor_[1] != '"') break;
      ++cursor_;
    }
    cells_.push_back({{begin, static_cast<std::size_t>(cursor_ - begin)}, true});
    line_ += static_cast<std::size_t>(std::count(begin, cursor_, terminator_));
    if (cursor_ >= line_end) line_end = std::find(cursor_, end_, terminator_);
    ++cursor_;
    while (cursor_ != line_end && is_padding(*cursor_)) ++cursor_;
    const bool ends =
        cursor_ == line_end || is_separator(*cursor_) || (separator_ == kBlanks && is_separator(cursor_[-1]));
    if (!ends) fail_at(request_, line_, "a cell goes on after its closing quote");
    if (cursor_ != line_end && !is_separator(*cursor_)) --cursor_;  // the blank before the next cell
    return line_end;
  }

  const ValueRequest& request_;
  bool only_separators_;  // blanks do not separate cells
  char terminator_ = '\n';
  char separator_ = 0;
  const char* cursor_ = nullptr;
  const char* end_ = nullptr;
  std::size_t line_ = 0;
  std::size_t first_line_ = 0;
  bool seen_ = false;  // a record
  std::string_view comment_;
  std::vector<Cell> cells_;
};

/// The values of one column of a table.
class ColumnReader {
 public:
  ColumnReader(std::string_view bytes, const ValueRequest& request, bool only_separators)
      : request_(request), lines_(bytes, request.file), only_separators_(only_separators) {}

  ValueFile read() {
    Records records(request_, only_separators_);
    records.begin(lines_);
    if (!records.next()) return collector_.finish({});
    const bool has_row = find_column(records);
    if (has_row) do
        add(records);
      while (records.next());
    if (missing_ > 0)
      warnings_.push_back(request_.file + ": " + std::to_string(missing_) + " of " +
                          std::to_string(collector_.values.size()) +
                          " values are missing (empty or NA); they are nan");
    return collector_.finish(std::move(warnings_));
  }

 private:
  /// The column of that name. Throws BadInput if there are several.
  std::optional<std::size_t> find(const std::vector<Cell>& cells, std::string_view name) const {
    std::optional<std::size_t> first;
    std::vector<std::string> numbers;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].is(name)) continue;
      if (!first) first = i;
      numbers.push_back(std::to_string(i + 1));
    }
    if (numbers.size() < 2) return first;
    const std::string choice = ": choose one by its number, as in column=" + numbers[0];
    constexpr std::size_t kListed = 20;
    if (numbers.size() > kListed) {
      numbers.resize(kListed);
      numbers.emplace_back("more");
    }
    throw BadInput(request_.file + ": the columns " + listed(numbers, " and ") + " are called " +
                   shown(name) + choice);
  }

  /// Whether the first record is one of names: a cell is no number, or has quotes and that below it has none.
  static bool has_names(const std::vector<Cell>& first, Records following) {
    if (std::ranges::any_of(first, [](const Cell& cell) { return !is_number(cell); })) return true;
    if (std::ranges::none_of(first, &Cell::quoted) || !following.next()) return false;
    const std::vector<Cell>& below = following.cells();
    for (std::size_t i = 0; i < std::min(first.size(), below.size()); ++i)
      if (first[i].quoted && !below[i].quoted) return true;
    return false;
  }

  /// Whether choose_by_number() takes the text.
  bool is_column_number(std::string_view text) const {
    std::size_t number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size() && number >= 1 && number <= width_;
  }

  static bool is_number(const Cell& cell) {
    double value = 0;
    return parse_value(trimmed(cell.text), value);
  }

  /// Sets column_ and width_. The reader is at the first record, and then at the first of values; false if
  /// there is none.
  bool find_column(Records& records) {
    const std::vector<Cell> first = records.cells();
    const std::vector<Cell> comment = records.comment_names();
    width_ = first.size();
    const std::string& name = request_.column;
    const bool is_header = has_names(first, records);
    if (!name.empty()) {
      // Years, say, are names only where they are no numbers of columns.
      if (const auto found = find(first, name); found && (is_header || !is_column_number(name))) {
        column_ = *found;
        return records.next();
      }
      if (const auto found = find(comment, name); found && comment.size() == first.size()) {
        column_ = *found;
        return true;
      }
    }
    if (!name.empty() || width_ > 1) column_ = choose_by_number(is_header ? first : comment);
    if (is_header && first[column_].quoted && is_number(first[column_])) return records.next();
    if (is_number(first[column_])) return true;
    return skip_header(records, first[column_].text);
  }

  std::size_t choose_by_number(const std::vector<Cell>& names) const {
    std::string what = "the table";
    if (names.size() == width_ && width_ > 1) {
      std::vector<std::string> listed_names;
      for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 20); ++i)
        listed_names.push_back(shown(names[i].text));
      if (names.size() > listed_names.size()) listed_names.push_back("…");
      if (request_.column.empty())
        throw BadInput(request_.file + ": " + what + " has the columns " + listed(listed_names) +
                       ": choose one by column=NAME or column=1 to column=" + std::to_string(width_));
      what += " of the columns " + listed(listed_names);
    }
    return numbered_column(request_, width_, what);
  }

  /// Goes to the first record with a number in the column. One line of names is usual in a table; more lines
  /// are told of.
  bool skip_header(Records& records, std::string_view first) {
    std::size_t skipped = 0;
    const std::size_t first_line = records.line();
    do {
      const std::vector<Cell>& cells = records.cells();
      if (column_ < cells.size() &&
          (is_number(cells[column_]) || (skipped > 0 && is_missing(cells[column_])))) {
        width_ = cells.size();
        if (skipped > 1) warnings_.push_back(skipped_lines(request_, skipped, first));
        return true;
      }
      ++skipped;
    } while (records.next());
    if (skipped == 1) return false;  // names and no values
    fail_at(request_, first_line,
            shown(first) + " is not one number, nor does any other line have one in column " +
                std::to_string(column_ + 1));
  }

  static bool is_missing(const Cell& cell) { return cell.text.empty() || cell.text == "NA"; }

  void add(const Records& records) {
    const std::vector<Cell>& cells = records.cells();
    if (cells.size() != width_)
      fail_at(request_, records.line(),
              "it has " + std::to_string(cells.size()) + (cells.size() == 1 ? " column" : " columns") +
                  ", but the table has " + std::to_string(width_));
    const std::string_view text = trimmed(cells[column_].text);
    double value = 0;
    if (is_missing(cells[column_])) {
      ++missing_;
      value = std::numeric_limits<double>::quiet_NaN();
    } else if (!parse_value(text, value)) {
      fail_number(request_, records.line(), text);
    }
    collector_.add(value, records.line());
  }

  const ValueRequest& request_;
  Lines lines_;
  bool only_separators_;
  std::size_t column_ = 0;
  std::size_t width_ = 0;  // of the table, in columns
  std::size_t missing_ = 0;
  Collector collector_;
  std::vector<std::string> warnings_;
};

}  // namespace
}  // namespace value_text

ValueFile read_csv_values(std::string_view bytes, const ValueRequest& request) {
  return value_text::ColumnReader(bytes, request, true).read();
}

ValueFile read_text_values(std::string_view bytes, const ValueRequest& request) {
  using namespace value_text;
  if (!request.column.empty()) return ColumnReader(bytes, request, false).read();
  const Lines lines(bytes, request.file);
  Collector collector;
  std::size_t header = 0;  // lines before the first number
  std::size_t header_line = 0;
  std::string_view header_text;
  std::string_view rest = lines.text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    if (number % (1 << 16) == 0) request.progress.throw_if_cancelled();
    const std::size_t end = std::min(rest.find(lines.terminator), rest.size());
    std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    text = trimmed(text.substr(0, text.find('#')));
    if (text.empty()) continue;
    double value = 0;
    if (parse_value(text, value)) {
      collector.add(value, number);
    } else if (!collector.values.empty()) {
      fail_number(request, number, text);
    } else if (const std::size_t columns = count_of_numbers(text); columns > 1) {
      fail_at(request, number,
              shown(text) + " is not one number but " + std::to_string(columns) +
                  ": choose a column by column=1 to column=" + std::to_string(columns));
    } else {
      if (header++ > 0) continue;
      header_line = number;
      header_text = text;
    }
  }
  if (header > 0 && collector.values.empty()) fail_number(request, header_line, header_text);
  std::vector<std::string> warnings;
  if (header > 0) warnings.push_back(skipped_lines(request, header, header_text));
  return collector.finish(std::move(warnings));
}

}  // namespace morsel::core
