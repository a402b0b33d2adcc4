#include "morsel/core/io/vertex_mask.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/value_file.h"
#include "morsel/core/text/numbers.h"
#include "morsel/core/text/specification.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

std::string name_of(const VertexValues& values) {
  if (values.file.empty()) return "the property " + shown(values.property);
  return values.file.string() + (values.column.empty() ? "" : ", column " + shown(values.column));
}

const VertexProperty* find_property(const LoadedSoup& file, const std::string& name) {
  const auto found = std::ranges::find(file.properties, name, &VertexProperty::name);
  return found == file.properties.end() ? nullptr : &*found;
}

class MaskReader {
 public:
  MaskReader(const LoadedSoup& file, const Progress& progress) : file_(file), progress_(progress) {}

  void apply_mask(const VertexValues& mask) {
    if (mask.file.empty() == mask.property.empty())
      throw InvalidArgument("a mask comes from a file or from a property: name one of them");
    ValueFile read;
    std::span<const double> values;
    if (mask.file.empty()) {
      const VertexProperty* property = find_property(file_, mask.property);
      if (property == nullptr) fail_property(mask.property);
      values = property->values;
    } else {
      read = read_value_file(mask.file, mask.column, progress_);
      values = read.values;
      for (std::string& warning : read.warnings) result_.warnings.push_back(std::move(warning));
    }
    if (values.size() != count())
      throw BadInput("the mask " + name_of(mask) + " has " + std::to_string(values.size()) +
                     " values, but the mesh's file has " + std::to_string(count()) + " vertices");
    const std::size_t found = leave_out(values, [](double x) { return x == 0 || std::isnan(x); });
    result_.warnings.push_back("the mask " + name_of(mask) + " is 0 or nan at " + shares(found));
  }

  void apply_needed(const VertexValues& needed) {
    ValueFile read;
    std::span<const double> values;
    if (needed.file.empty()) {
      if (const VertexProperty* property = find_property(file_, needed.property)) values = property->values;
    } else if (std::error_code error; std::filesystem::is_regular_file(needed.file, error)) {
      try {
        read = read_value_file(needed.file, needed.column, progress_);
        values = read.values;
      } catch (const BadInput&) {  // the field that needs them says why
      }
    }
    if (values.size() != count()) return;
    if (const std::size_t found = leave_out(values, [](double x) { return std::isnan(x); }); found > 0)
      result_.warnings.push_back(name_of(needed) + " has no value (nan) at " + shares(found));
  }

  VertexMask take() { return std::move(result_); }

 private:
  std::size_t count() const { return file_.soup.positions.size(); }
  std::string shares(std::size_t found) const {
    return grouped(found) + " of " + grouped(count()) + " vertices";
  }

  [[noreturn]] void fail_property(const std::string& name) const {
    std::string available;
    for (const VertexProperty& property : file_.properties)
      available += (available.empty() ? "" : ", ") + property.name;
    throw BadInput("the mask is to be the property " + shown(name) +
                   ", which the mesh's file does not have for its vertices; it has " +
                   (available.empty() ? "none" : available));
  }

  /// Returns at how many vertices it is so.
  template <class Goes>
  std::size_t leave_out(std::span<const double> values, const Goes& goes) {
    std::size_t found = 0;
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (!goes(values[v])) continue;
      if (result_.left_out.empty()) result_.left_out.assign(count(), false);
      result_.left_out[v] = true;
      ++found;
    }
    return found;
  }

  const LoadedSoup& file_;
  const Progress& progress_;
  VertexMask result_;
};

/// Puts a backslash before what separates keys.
std::string escaped(std::string_view text) {
  std::string raw;
  for (const char c : text) {
    if (c == ',' || c == '\\') raw += '\\';
    raw += c;
  }
  return raw;
}

}  // namespace

VertexMask read_vertex_mask(const LoadedSoup& file, const BuildOptions& options, const Progress& progress) {
  MaskReader reader(file, progress);
  if (options.mask) reader.apply_mask(*options.mask);
  for (const VertexValues& needed : options.needed) reader.apply_needed(needed);
  return reader.take();
}

VertexValues parse_vertex_values(std::string_view text, std::string_view what) {
  VertexValues values;
  const auto fail = [&](const std::string& why) {
    return InvalidArgument(std::string(what) + " " + shown(text) + " " + why +
                           "; it is the path of a file, file=PATH, file=PATH,column=NAME or property=NAME");
  };
  if (text.find('=') == std::string_view::npos) {
    values.file = text;
  } else {
    for (const std::string_view entry : split_unescaped(text, ',')) {
      const std::size_t equals = entry.find('=');
      const std::string_view key = entry.substr(0, equals);
      if (equals == std::string_view::npos)
        throw fail("has " + shown(entry) + " where key=value is expected");
      const std::string value = unescape(entry.substr(equals + 1));
      const auto set = [&](auto& member) {
        if (!member.empty()) throw fail("has " + shown(key) + " twice");
        if (value.empty()) throw fail("has no value for " + shown(key));
        member = value;
      };
      if (key == "file")
        set(values.file);
      else if (key == "property")
        set(values.property);
      else if (key == "column")
        set(values.column);
      else
        throw fail("has the unknown key " + shown(key));
    }
  }
  if (values.file.empty() == values.property.empty())
    throw fail(values.file.empty() ? "names neither a file nor a property" : "names a file and a property");
  if (!values.column.empty() && values.file.empty()) throw fail("has a column but no file");
  return values;
}

std::string to_string(const VertexValues& values) {
  if (values.file.empty()) return "property=" + escaped(values.property);
  return "file=" + escaped(values.file.string()) +
         (values.column.empty() ? "" : ",column=" + escaped(values.column));
}

}  // namespace morsel::core
