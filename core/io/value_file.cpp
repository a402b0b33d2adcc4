#include "morsel/core/io/value_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/brain_values.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_content.h"
#include "morsel/core/io/file_kind.h"
#include "morsel/core/io/freesurfer.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// One kind of file, told by its content or by its extension (with its dot, in small letters).
struct ValueKind {
  bool (*is_it)(std::string_view bytes, std::string_view extension);
  ValueFile (*read)(std::string_view bytes, const ValueRequest& request);
};

/// The first that fits; a file of none is text.
constexpr auto kKinds = std::to_array<ValueKind>({
    {[](std::string_view bytes, std::string_view extension) {
       return bytes.starts_with("\xFF\xFF\xFF") ||
              (extension != ".annot" && is_freesurfer_morphometry(bytes));
     },
     read_freesurfer_values},
    {[](std::string_view, std::string_view extension) { return extension == ".annot"; },
     read_annotation_values},
    {[](std::string_view, std::string_view extension) { return extension == ".gii"; }, read_gifti_values},
    {[](std::string_view bytes, std::string_view extension) {
       return bytes.starts_with("\x93NUMPY") || extension == ".npy";
     },
     read_npy_values},
    {[](std::string_view, std::string_view extension) { return extension == ".csv" || extension == ".tsv"; },
     read_csv_values},
    {[](std::string_view, std::string_view extension) {
       return has_mesh_extension("mesh" + std::string(extension));
     },
     read_mesh_values},
});

}  // namespace

ValueFile parse_value_file(std::string_view bytes, const std::string& file, const std::string& column,
                           const Progress& progress) {
  const ValueRequest request{file, column, progress};
  const DecodedBytes decoded(bytes, file, progress);
  const std::string_view content = decoded.view();
  const std::string extension = content_extension(file);
  for (const ValueKind& kind : kKinds)
    if (kind.is_it(content, extension)) return kind.read(content, request);
  try {
    return read_text_values(content, request);
  } catch (const BadInput& error) {
    const std::string_view kind = file_kind(content);
    if (kind.empty()) throw;
    throw BadInput(std::string(error.what()) + " (it is " + std::string(kind) + ")");
  }
}

ValueFile read_value_file(const std::filesystem::path& path, const std::string& column,
                          const Progress& progress) {
  const std::string name = path.string();
  const FileBytes bytes(path, name);
  return parse_value_file(bytes.view(), name, column, progress);
}

std::size_t numbered_column(const ValueRequest& request, std::size_t count, const std::string& what) {
  const std::string choice = count == 0   ? "it has none"
                             : count == 1 ? "it has only column=1"
                                          : "choose one by column=1 to column=" + std::to_string(count);
  if (request.column.empty()) {
    if (count == 1) return 0;
    throw BadInput(request.file + ": " + what + " has " + std::to_string(count) + " columns: " + choice);
  }
  std::size_t number = 0;
  const char* end = request.column.data() + request.column.size();
  const auto [stop, error] = std::from_chars(request.column.data(), end, number);
  if (error != std::errc() || stop != end || number == 0 || number > count)
    throw BadInput(request.file + ": " + what + " has no column " + shown(request.column) + ": " + choice);
  return number - 1;
}

bool parse_value(std::string_view text, double& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = read_number(text.data(), end, value);
  return error == std::errc() && stop == end;
}

ValueFile read_mesh_values(std::string_view bytes, const ValueRequest& request) {
  LoadedSoup loaded = parse_polygon_soup(bytes, mesh_format(request.file), request.file, request.progress);
  std::vector<VertexProperty>& properties = loaded.properties;
  const auto found = request.column.empty() && properties.size() == 1
                         ? properties.begin()
                         : std::ranges::find(properties, request.column, &VertexProperty::name);
  if (found == properties.end()) {
    constexpr std::size_t kListed = 20;
    std::string names;
    for (std::size_t i = 0; i < std::min(properties.size(), kListed); ++i)
      names += (i > 0 ? ", " : "") + properties[i].name;
    if (properties.size() > kListed) names += ", …";
    throw BadInput(request.file +
                   (request.column.empty()
                        ? " has " + std::to_string(properties.size()) + " arrays of values for its vertices"
                        : " has no array " + shown(request.column) + " of values for its vertices") +
                   (names.empty() ? std::string() : ": choose one by column=NAME: " + names));
  }
  return {std::move(found->values), [](std::size_t i) { return "entry " + std::to_string(i); },
          std::move(loaded.warnings)};
}

}  // namespace morsel::core
