#include "morsel/tools/report/provenance.h"

#include <algorithm>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_content.h"
#include "morsel/tools/formats/base64.h"
#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools {
namespace {

constexpr std::string_view kBegin = R"({"schema":"morsel.provenance/1")";
constexpr std::string_view kBeginInTable = R"({""schema"":""morsel.provenance/1"")";
constexpr std::string_view kBeginInMarkup = "{&quot;schema&quot;:&quot;morsel.provenance/1&quot;";
constexpr std::string_view kBeginInArray =
    R"("schema":"morsel.provenance/1")";  // of a .vtp file, after a brace
constexpr std::size_t kLine = 150;
constexpr std::size_t kMost = 1 << 20;  // bytes of a provenance; the rest of the file may be large

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  std::string replaced;
  std::size_t begin = 0;
  for (std::size_t at = 0; (at = text.find(what, begin)) != std::string::npos; begin = at + what.size())
    replaced.append(text, begin, at - begin).append(with);
  text = replaced.append(text, begin);
}

/// Calls take(i) for each character of JSON text that is in no string until it returns false.
template <class Take>
void outside_strings(std::string_view json, const Take& take) {
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (in_string && json[i] == '\\')
      ++i;
    else if (json[i] == '"')
      in_string = !in_string;
    else if (!in_string && !take(i))
      return;
  }
}

/// The object that the text begins with; empty if it is cut off.
std::string_view first_object(std::string_view text) {
  int depth = 0;
  std::size_t size = 0;
  outside_strings(text, [&](std::size_t i) {
    if (text[i] == '{') ++depth;
    if (text[i] == '}' && --depth == 0) size = i + 1;
    return size == 0;
  });
  return text.substr(0, size);
}

/// The lines from `at` on without the mark that they all begin with, joined.
std::string marked_lines(std::string_view text, std::size_t at) {
  const std::size_t before = text.substr(0, at).find_last_of("\r\n");
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  const std::string_view mark = text.substr(begin, at - begin);
  if (mark != "# " && mark != "comment ") return std::string(text.substr(at));
  std::string joined;
  text.remove_prefix(begin);
  while (text.starts_with(mark)) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(mark.size(), end - mark.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    joined += line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return joined;
}

/// A quoted field of a table from within its quotes on, without doubling.
std::string table_field(std::string_view text) {
  std::string field;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && (i + 1 == text.size() || text[++i] != '"')) break;
    field += text[i];
  }
  return field;
}

/// Text of XML up to the next tag, without its entities.
std::string markup_content(std::string_view text) {
  std::string content(text.substr(0, text.find('<')));
  replace_all(content, "&quot;", "\"");
  replace_all(content, "&apos;", "'");
  replace_all(content, "&lt;", "<");
  replace_all(content, "&gt;", ">");
  replace_all(content, "&amp;", "&");
  return content;
}

/// Where an array of bytes that begins with an object of kBegin has its digits: of the last two bytes of its
/// size, and of the brace. So three bytes stand before kBeginInArray, whose own digits are whole groups.
std::size_t find_in_array(std::string_view bytes) {
  static_assert(kBeginInArray.size() % 3 == 0);
  static const std::string kDigits = base64(kBeginInArray);
  const std::size_t at = bytes.find(kDigits);
  return at == std::string_view::npos || at < 4 ? std::string_view::npos : at - 4;
}

/// What the digits from there on encode, without what stands before the object; empty if they are cut off.
std::string array_content(std::string_view digits) {
  const std::string bytes = decoded_base64(digits).value_or(std::string());
  return bytes.substr(std::min(bytes.size(), std::size_t{2}));
}

/// Checks it against provenance.schema.json.
void check(const JsonView& provenance) {
  const auto check_made = [](const JsonView& made) {
    static_cast<void>(made["name"].text());
    check_parameters(made["parameters"]);
  };
  static_cast<void>(provenance["tool"]["name"].text());
  static_cast<void>(provenance["tool"]["version"].text());
  static_cast<void>(provenance["command"].text());
  for (const JsonView& input : provenance["inputs"].list()) {
    static_cast<void>(input["path"].text());
    static_cast<void>(input["sha256"].text());
  }
  static_cast<void>(provenance["request"].members());
  if (const auto field = provenance.find("field")) check_made(*field);
  if (const auto methods = provenance.find("methods"))
    for (const JsonView& method : methods->list()) check_made(method);
}

}  // namespace

Provenance::Provenance(std::string_view command, Json request, const std::vector<HashedFile>& inputs)
    : document_({{"schema", "morsel.provenance/1"},
                 {"tool", tool_section()},
                 {"command", command},
                 {"inputs", files_section(inputs)},
                 {"request", std::move(request)}}) {}

Provenance::Provenance(std::string_view command, Json request, const FieldSource& source)
    : Provenance(command, std::move(request), {source.mesh}) {
  set_field(source.made.input);
  add_method(source.made.outcome.steps);
}

void Provenance::set_field(const FieldOutcome& field) { set_function("field", field); }

void Provenance::set_fill(const FieldOutcome& field) { set_function("fill", field); }

void Provenance::set_function(const char* member, const FieldOutcome& field) {
  const std::vector<HashedFile> files = hashed_files(field);
  document_[member] = {{"name", field.name}, {"parameters", field_parameters(summary_of(field), files)}};
  for (Json& file : files_section(files)) document_["inputs"].push_back(std::move(file));
}

void Provenance::add_method(const std::vector<StepOutcome>& steps) {
  std::string name;
  for (const StepOutcome& step : steps) name += (name.empty() ? "" : "+") + step.name;
  document_["methods"].push_back({{"name", name}, {"parameters", parameters_section(steps)}});
}

Provenance Provenance::with_method(const std::vector<StepOutcome>& steps) const {
  Provenance more = *this;
  more.add_method(steps);
  return more;
}

std::string Provenance::json() const {
  std::string text = document_.dump(-1, ' ', true, Json::error_handler_t::replace);
  replace_all(text, "<", "\\u003c");
  replace_all(text, ">", "\\u003e");
  replace_all(text, "&", "\\u0026");
  return text;
}

std::vector<std::string> Provenance::lines() const {
  const std::string text = json();
  std::vector<std::string> lines(1);
  std::size_t begin = 0;
  const auto add = [&](std::size_t end) {
    if (!lines.back().empty() && lines.back().size() + end - begin > kLine) lines.emplace_back();
    lines.back().append(text, begin, end - begin);
    begin = end;
  };
  outside_strings(text, [&](std::size_t i) {
    if (text[i] == ',') add(i + 1);
    return true;
  });
  add(text.size());
  return lines;
}

std::string Provenance::text_comment() const {
  std::string text;
  for (const std::string& line : lines()) text += "# " + line + "\n";
  return text;
}

std::string Provenance::html_comment() const {
  std::string text = json();
  replace_all(text, "--", "-\\u002d");  // which would end it
  return "<!-- " + text + " -->\n";
}

Json find_provenance(std::string_view bytes) {
  std::string text;
  if (const std::size_t at = bytes.find(kBegin); at != std::string_view::npos)
    text = marked_lines(bytes.substr(0, at + std::min(kMost, bytes.size() - at)), at);
  else if (const std::size_t in_table = bytes.find(kBeginInTable); in_table != std::string_view::npos)
    text = table_field(bytes.substr(in_table, kMost));
  else if (const std::size_t in_markup = bytes.find(kBeginInMarkup); in_markup != std::string_view::npos)
    text = markup_content(bytes.substr(in_markup, kMost));
  else if (const std::size_t in_array = find_in_array(bytes); in_array != std::string_view::npos)
    text = array_content(bytes.substr(in_array, kMost));
  else
    return {};
  const std::string_view object = first_object(text);
  if (object.empty()) throw core::BadInput("the provenance in it is damaged: it is cut off");
  Json found = read_json(object, "the provenance in it", {.bytes = kMost});
  check(JsonView(found, "the provenance in it is damaged"));
  return found;
}

Json read_provenance(const std::filesystem::path& path) {
  const core::FileBytes bytes(path, path.string());
  return find_provenance(core::DecodedBytes(bytes.view(), path.string()).view());
}

}  // namespace morsel::tools
