#include "morsel/tools/study/marks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::tools {
namespace {

using core::Index;

constexpr double kMostNumber = 9007199254740992;  // 2⁵³: whole numbers up to it are exact

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw core::BadInput(name + ", line " + std::to_string(line) + ": " + what);
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Whether a character outside of quotes is in the line.
bool has_outside_quotes(std::string_view line, char wanted) {
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == wanted && !quoted) return true;
  }
  return false;
}

/// Takes the next field off `rest`, which begins with it; nothing if a quote is not closed or is followed by
/// other text.
template <class IsSeparator>
std::optional<std::string> take_field(std::string_view& rest, const IsSeparator& is_separator) {
  std::string field;
  if (!rest.starts_with('"')) {
    const auto end = std::find_if(rest.begin(), rest.end(), is_separator);
    field = trimmed(rest.substr(0, static_cast<std::size_t>(end - rest.begin())));
    rest.remove_prefix(static_cast<std::size_t>(end - rest.begin()));
    return field;
  }
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] != '"') {
      field += rest[i];
    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
      field += rest[i++];
    } else {
      rest.remove_prefix(i + 1);
      while (!rest.empty() && is_blank(rest.front()) && !is_separator(rest.front())) rest.remove_prefix(1);
      if (!rest.empty() && !is_separator(rest.front())) return std::nullopt;
      return field;
    }
  }
  return std::nullopt;
}

/// The fields of a line; nothing if its quotes are wrong.
std::optional<std::vector<std::string>> fields_of(std::string_view line) {
  const bool by_comma = has_outside_quotes(line, ',');
  const bool by_tab = !by_comma && has_outside_quotes(line, '\t');
  const auto is_separator = [&](char c) {
    if (by_comma) return c == ',';
    return by_tab ? c == '\t' : is_blank(c);
  };
  std::vector<std::string> fields;
  for (std::string_view rest = line;;) {
    while (!rest.empty() && is_blank(rest.front()) && !(by_tab && rest.front() == '\t'))
      rest.remove_prefix(1);
    std::optional<std::string> field = take_field(rest, is_separator);
    if (!field) return std::nullopt;
    fields.push_back(std::move(*field));
    if (rest.empty()) return fields;
    rest.remove_prefix(1);
  }
}

/// A line of a file of marks, with its words.
struct Words {
  std::size_t line;
  std::vector<std::string_view> words;
};

std::vector<Words> words_of(const std::string& text, const std::string& name) {
  const core::Progress none;
  core::TextScanner scanner(text, name, {}, none);
  std::vector<Words> lines;
  while (scanner.next_line()) {
    Words& line = lines.emplace_back(Words{scanner.line(), {}});
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word())
      line.words.push_back(word);
  }
  return lines;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<std::uint64_t> whole_number_of(std::string_view word) {
  const std::optional<double> number = number_of(word);
  if (!number || !(*number >= 0) || *number > kMostNumber || *number != std::floor(*number))
    return std::nullopt;
  return static_cast<std::uint64_t>(*number);
}

/// A number and a position a line.
bool has_positions(const std::vector<Words>& lines) {
  bool any = false;
  for (const Words& line : lines) {
    if (line.words.size() != 4) return false;
    for (std::size_t i = 1; i < 4; ++i) {
      if (!number_of(line.words[i])) return false;
      any = any || !whole_number_of(line.words[i]);
    }
  }
  return any;
}

std::uint64_t vertices_of_file(const core::LoadedMesh& loaded) {
  const core::VertexNumbering& numbering = loaded.source.numbering;
  return numbering.from_input.empty() ? loaded.mesh.vertex_count() : numbering.input_count;
}

}  // namespace

std::vector<MarkedPair> parse_marked_pairs(std::string_view text, const std::string& name) {
  std::vector<MarkedPair> pairs;
  std::set<std::pair<std::string, std::string>> seen;
  bool is_first = true;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, length));
    text.remove_prefix(std::min(length + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::optional<std::vector<std::string>> fields = fields_of(line);
    if (!fields) fail(name, number, "a quote is not closed, or is followed by other text");
    if (std::exchange(is_first, false) && fields->front() == "mesh") continue;
    if (fields->size() != 2)
      fail(name, number,
           "a mesh and a file of vertices are expected, not " + std::to_string(fields->size()) +
               (fields->size() == 1 ? " field" : " fields") + " (" + core::shown(line) + ")");
    const auto& [mesh, marks] = std::pair(fields->front(), fields->back());
    if (mesh.empty() || marks.empty()) fail(name, number, "a path is empty");
    if (line.find('\0') != std::string_view::npos) fail(name, number, "a path has a NUL character");
    if (!seen.emplace(mesh, marks).second) fail(name, number, mesh + " with " + marks + " is listed twice");
    pairs.push_back({mesh, marks});
  }
  if (pairs.empty()) throw core::BadInput(name + " lists no mesh");
  return pairs;
}

std::vector<Mark> parse_marks(std::string_view bytes, const std::string& name) {
  std::string text(bytes);
  for (char& c : text) {
    if (c == ',' || c == ';') c = ' ';
    if (c == '%') c = '#';
  }
  std::vector<Words> lines = words_of(text, name);
  const bool is_table = !lines.empty() && lines.front().words.front() == "vertex";
  if (is_table) lines.erase(lines.begin());
  const bool only_first = is_table || has_positions(lines);
  std::vector<Mark> marks;
  for (const Words& line : lines)
    for (std::size_t i = 0; i < (only_first ? 1 : line.words.size()); ++i) {
      const std::optional<std::uint64_t> number = whole_number_of(line.words[i]);
      if (!number) fail(name, line.line, core::shown(line.words[i]) + " is not the number of a vertex");
      marks.push_back({*number, line.line});
    }
  if (marks.empty()) throw core::BadInput(name + " marks no vertex");
  return marks;
}

MarkedVertices find_marked_vertices(const std::vector<Mark>& marks, std::uint64_t first,
                                    const core::LoadedMesh& loaded, const std::string& name) {
  const std::uint64_t count = vertices_of_file(loaded);
  MarkedVertices found;
  std::set<Index> seen;
  std::size_t repeated = 0;
  for (const auto& [number, line] : marks) {
    if (number < first || number - first >= count)
      fail(name, line,
           "there is no vertex " + std::to_string(number) + " in the mesh, whose vertices are " +
               std::to_string(first) + " to " + std::to_string(first + count - 1));
    const Index v = loaded.source.numbering.mesh_vertex(static_cast<Index>(number - first));
    if (v == core::kNone)
      fail(name, line,
           "vertex " + std::to_string(number) + " is used by no face of the mesh and was removed by repair");
    if (seen.insert(v).second)
      found.vertices.push_back(v);
    else
      ++repeated;
  }
  if (repeated > 0)
    found.warnings.push_back(name + " marks " + std::to_string(repeated) +
                             (repeated == 1 ? " vertex" : " vertices") + " again, counted once");
  return found;
}

}  // namespace morsel::tools
