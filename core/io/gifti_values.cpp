// Values for vertices in GIFTI files.

#include <charconv>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/brain_values.h"
#include "morsel/core/io/gifti.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace gifti {
namespace {

/// One value a vertex: a column of an array.
struct Column {
  std::size_t array;
  std::uint64_t column;
};

bool has_values(const GiftiFile::Array& array) {
  return array.intent != "NIFTI_INTENT_POINTSET" && array.intent != "NIFTI_INTENT_TRIANGLE";
}

/// "sulc (column=1), 2": what a column may be chosen by.
std::string choice_of(const GiftiFile& gifti, const std::vector<Column>& columns) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < columns.size() && i < kMost; ++i) {
    const GiftiFile::Array& array = gifti.arrays()[columns[i].array];
    text += (i > 0 ? ", " : "") + std::to_string(i + 1);
    if (array.columns == 1 && !array.name.empty()) text += " " + shown(array.name);
  }
  if (columns.size() > kMost) text += ", … " + std::to_string(columns.size());
  return text;
}

Column chosen(const GiftiFile& gifti, const std::vector<Column>& columns, const ValueRequest& request) {
  if (request.column.empty() && columns.size() == 1) return columns.front();
  if (!request.column.empty()) {
    for (const Column& column : columns) {
      const GiftiFile::Array& array = gifti.arrays()[column.array];
      if (array.columns == 1 && array.name == request.column) return column;
    }
    std::size_t number = 0;
    const char* end = request.column.data() + request.column.size();
    const auto [stop, error] = std::from_chars(request.column.data(), end, number);
    if (error == std::errc() && stop == end && number >= 1 && number <= columns.size())
      return columns[number - 1];
  }
  fail_reading(request.file,
               (request.column.empty() ? "it has " + std::to_string(columns.size()) + " columns"
                                       : "it has no column " + shown(request.column)) +
                   "; choose one by column=, its name or its number: " + choice_of(gifti, columns));
}

}  // namespace
}  // namespace gifti

ValueFile read_gifti_values(std::string_view bytes, const ValueRequest& request) {
  GiftiFile gifti(bytes, request.file, request.progress);
  std::vector<gifti::Column> columns;
  for (std::size_t i = 0; i < gifti.arrays().size(); ++i) {
    const GiftiFile::Array& array = gifti.arrays()[i];
    if (array.intent == "NIFTI_INTENT_NODE_INDEX")
      fail_reading(request.file, gifti.called(i) +
                                     " lists which vertices have values, the others having none; "
                                     "only files with a value for every vertex are read");
    if (!gifti::has_values(array)) continue;
    if (array.columns > bytes.size() - columns.size())
      fail_reading(request.file, gifti.called(i) + " announces " + std::to_string(array.columns) +
                                     " columns, for which the file is too short");
    for (std::uint64_t column = 0; column < array.columns; ++column) columns.push_back({i, column});
  }
  if (columns.empty())
    fail_reading(request.file, gifti.arrays().empty() ? "it has no data array"
                                                      : "it has a surface, but no values for its vertices");
  const gifti::Column column = gifti::chosen(gifti, columns, request);
  std::vector<double> values = gifti.values(column.array);
  if (const GiftiFile::Array& array = gifti.arrays()[column.array]; array.columns > 1) {
    std::vector<double> one(array.rows);
    for (std::uint64_t row = 0; row < array.rows; ++row)
      one[row] = values[row * array.columns + column.column];
    values = std::move(one);
  }
  return {std::move(values), [](std::size_t i) { return "entry " + std::to_string(i); }, gifti.warnings()};
}

}  // namespace morsel::core
