#include "morsel/morse/functions/vertex_scalar.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/exhaustion.h"

namespace morsel::morse {
namespace {

using core::BadInput;
using core::Index;

/// A piece of a damaged file, fit for a message.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, kMost)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kMost ? "…\"" : "\"");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// The values of a text file, and on which line each stood.
class ValueFile {
 public:
  ValueFile(const std::filesystem::path& path, const core::Progress& progress) : name_(path.string()) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
      throw BadInput("cannot read values from " + name_ + ": it is a folder");
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
      core::throw_if_exhausted(errno, "cannot read values from " + name_);
      throw BadInput("cannot read values from " + name_ + ": " +
                     (errno != 0 ? std::generic_category().message(errno) : "it does not open"));
    }
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
    if (stream.bad()) throw BadInput("cannot read values from " + name_ + ": reading failed");
  }

  std::span<const double> values() const { return values_; }

  /// "line 12".
  std::string place(std::size_t i) const {
    const auto skipped = std::upper_bound(skipped_.begin(), skipped_.end(), i) - skipped_.begin();
    return "line " + std::to_string(i + static_cast<std::size_t>(skipped) + 1);
  }

 private:
  double parse(std::string_view text, std::size_t number) const {
    double value = 0;
    const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc() && stop == end) return value;
    throw BadInput(name_ + ", line " + std::to_string(number) + ": " + shown(text) +
                   (error == std::errc::result_out_of_range && stop == end
                        ? " is beyond the range of double precision"
                        : " is not one number"));
  }

  std::string name_;
  std::vector<double> values_;
  std::vector<std::size_t> skipped_;  // per line without a value: how many values came before
};

std::size_t input_vertex_count(const core::TriangleMesh& mesh, const core::VertexNumbering& numbering) {
  const bool same = numbering.to_input.empty() && numbering.from_input.empty();
  return same ? mesh.vertex_count() : numbering.input_count;
}

/// `place(i)` tells where value i stood.
template <class Place>
core::ScalarField make_field(const core::TriangleMesh& mesh, const core::VertexNumbering& numbering,
                             std::span<const double> values, const std::string& origin, const Place& place) {
  const std::size_t expected = input_vertex_count(mesh, numbering);
  if (values.size() != expected)
    throw BadInput(origin + " has " + std::to_string(values.size()) + " values, but the mesh's file has " +
                   std::to_string(expected) + " vertices");
  std::vector<double> chosen(mesh.vertex_count());
  std::size_t bad = 0;
  Index first = core::kNone;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index i = numbering.input_vertex(v);
    chosen[v] = values[i];
    if (std::isfinite(chosen[v])) continue;
    ++bad;
    first = std::min(first, i);
  }
  if (bad > 0)
    throw BadInput(origin + ", " + place(first) + ": vertex " + std::to_string(first) + " has the value " +
                   core::shortest(values[first]) +
                   (bad > 1 ? ", the first of " + std::to_string(bad) + " that are not finite"
                            : ", which is not finite"));
  return {mesh, std::move(chosen)};
}

const core::VertexProperty& find_property(const core::MeshSource* source, const std::string& name) {
  std::string available;
  if (source != nullptr)
    for (const core::VertexProperty& property : source->properties) {
      if (property.name == name) return property;
      available += (available.empty() ? "" : ", ") + property.name;
    }
  throw BadInput("the mesh's file has no scalar property " + shown(name) + " for its vertices; it has " +
                 (available.empty() ? "none (only PLY files have them)" : available));
}

class VertexScalar final : public core::MorseFunction {
 public:
  explicit VertexScalar(VertexScalarOptions options) : options_(std::move(options)) {}

  core::FunctionResult evaluate(const core::TriangleMesh& mesh,
                                const core::FunctionContext& context) const override {
    core::Parameters parameters;
    if (options_.file.empty())
      parameters.emplace_back("property", options_.property);
    else
      parameters.emplace_back("file", options_.file.string());
    return {vertex_scalar(mesh, context.source, options_, context.progress), std::move(parameters)};
  }

 private:
  VertexScalarOptions options_;
};

}  // namespace

core::ScalarField vertex_scalar(const core::TriangleMesh& mesh, const core::MeshSource* source,
                                const VertexScalarOptions& options, const core::Progress& progress) {
  if (options.file.empty() == options.property.empty())
    throw core::InvalidArgument("a vertex scalar comes from a file or from a property: name one of them");
  static const core::VertexNumbering kSame;
  const core::VertexNumbering& numbering = source == nullptr ? kSame : source->numbering;
  if (options.file.empty()) {
    const core::VertexProperty& property = find_property(source, options.property);
    return make_field(mesh, numbering, property.values, "the property " + shown(property.name),
                      [](std::size_t i) { return "entry " + std::to_string(i); });
  }
  const ValueFile file(options.file, progress);
  return make_field(mesh, numbering, file.values(), options.file.string(),
                    [&](std::size_t i) { return file.place(i); });
}

std::unique_ptr<core::MorseFunction> make_vertex_scalar(core::ParameterReader& reader) {
  const bool by_property = reader.given("property");
  VertexScalarOptions options;
  options.file =
      reader.text("file", by_property ? "" : nullptr,
                  "a text file with a value a line for each vertex of the mesh's file, or else a property");
  options.property = reader.text("property", "", "a scalar property of the vertices in the mesh's PLY file");
  const bool by_file = reader.given("file");
  if (by_property && by_file)
    throw core::InvalidArgument(reader.owner() + " takes file or property, not both");
  if ((by_property && options.property.empty()) || (by_file && options.file.empty()))
    throw core::InvalidArgument(reader.owner() + ":" + (by_file ? "file" : "property") +
                                " must not be empty");
  return std::make_unique<VertexScalar>(std::move(options));
}

}  // namespace morsel::morse
