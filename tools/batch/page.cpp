#include "morsel/tools/batch/page.h"

#include <string_view>
#include <utility>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/batch/distributions.h"
#include "morsel/tools/batch/request.h"
#include "morsel/tools/drawing/pictures.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/formats/markup.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShownFirst = 500;  // rows; the others on request

std::vector<MethodTotals> totals_of(const std::vector<MeshOutcome>& outcomes,
                                    const std::vector<std::string>& names) {
  std::vector<MethodTotals> methods;
  methods.reserve(names.size());
  for (const std::string& name : names) methods.push_back({valid_text(name), {}, {}});
  for (const MeshOutcome& outcome : outcomes) {
    if (outcome.status != Status::done) continue;
    for (std::size_t i = 0; i < methods.size(); ++i) {
      methods[i].vertices.push_back(outcome.state.result.at("mesh").at("vertices").get<double>());
      methods[i].totals.push_back(
          outcome.state.result.at("methods").at(i).at("critical_points").at("total").get<double>());
    }
  }
  return methods;
}

/// Writes the plots; the section of the page that shows them.
std::string write_plots(const std::vector<MethodTotals>& methods, ResultFolder& out,
                        const Provenance& provenance) {
  std::vector<std::pair<std::string, plot::Plot>> plots = {{"histogram.svg", histogram(methods)},
                                                           {"cumulative.svg", cumulative(methods)},
                                                           {"against-size.svg", against_size(methods)}};
  std::string figures;
  for (auto& [name, plot] : plots) {
    plot.metadata = provenance.json();
    plot::write_svg(out.claim("plots/" + name), plot);
    figures += "<figure><img alt=\"" + markup_text(plot.title) + "\" src=\"plots/" + name + "\"></figure>\n";
  }
  return "<section class=\"plots\" aria-label=\"Distributions\">\n" + figures + "</section>\n";
}

std::string number_cell(std::uint64_t number) {
  return "<td data-v=\"" + std::to_string(number) + "\">" + grouped(number) + "</td>";
}

/// Markup in which lines may break after each of some characters.
std::string breakable(const std::string& markup, std::string_view after) {
  std::string text;
  for (const char c : markup) {
    text += c;
    if (after.find(c) != std::string_view::npos) text += "<wbr>";
  }
  return text;
}

std::string link_to(const fs::path& path, const std::string& markup) {
  return "<a href=\"" + path_text(path.generic_string()) + "\">" + markup + "</a>";
}

/// The most detailed output of a mesh, to which it is linked.
fs::path best_of(const std::string& name, const BatchRequest& request) {
  const OutFolder beside;
  return request.pages     ? beside.page(name)
         : request.figures ? beside.figures(name) / "sheet.png"
                           : beside.report(name);
}

std::string name_cell(const MeshOutcome& outcome, const BatchRequest& request) {
  const std::string& name = outcome.mesh.name;
  const std::string shown = markup_text(valid_text(name));
  std::string cell = "<th scope=\"row\" data-v=\"" + shown + "\">";
  if (outcome.status != Status::done) return cell + breakable(shown, "/") + "</th>";
  cell += link_to(best_of(name, request), breakable(shown, "/"));
  if (request.pages || request.figures || request.exports) {
    const OutFolder beside;
    cell += "<small>" + link_to(beside.report(name), "report");
    if (request.figures) cell += link_to(beside.figures(name) / "sheet.png", "pictures");
    if (request.exports) cell += link_to(beside.exports(name) / "", "files");
    cell += "</small>";
  }
  return cell + "</th>";
}

std::string picture_cell(const MeshOutcome& outcome, const BatchRequest& request, const char* which) {
  if (outcome.status != Status::done) return "<td></td>";
  const std::string& name = outcome.mesh.name;
  const std::string image =
      "<img loading=\"lazy\" width=\"240\" height=\"180\" alt=\"" +
      markup_text(valid_text(name) + ", " +
                  (std::string_view(which) == "first" ? request.comparison.methods.front()
                                                      : request.comparison.methods.back())) +
      "\" src=\"" + path_text(OutFolder("").thumbnail(name, which).generic_string()) + "\">";
  return "<td class=\"picture\">" + link_to(best_of(name, request), image) + "</td>";
}

std::string mesh_row(const MeshOutcome& outcome, const BatchRequest& request, bool shown) {
  std::string row = "<tr class=\"" + to_string(outcome.status) + (shown ? "\">" : "\" hidden>") +
                    name_cell(outcome, request);
  if (request.thumbnails)
    for (const char* which : {"first", "last"}) row += picture_cell(outcome, request, which);
  row += "<td class=\"text\" data-v=\"" + to_string(outcome.status) + "\">" + to_string(outcome.status);
  if (outcome.status == Status::failed)
    row += "<small>" + markup_text(valid_text(outcome.state.error->message)) + "</small>";
  for (const std::string& warning : mesh_warnings(outcome.state))
    row += "<small>" + markup_text(warning) + "</small>";
  row += "</td>";
  const std::size_t methods = request.comparison.methods.size();
  if (outcome.status != Status::done) {
    for (std::size_t i = 0; i < 1 + 2 * methods; ++i) row += "<td></td>";
    return row + "</tr>\n";
  }
  const Json& result = outcome.state.result;
  row += number_cell(result.at("mesh").at("vertices").get<std::uint64_t>());
  for (const Json& method : result.at("methods")) {
    row += number_cell(method.at("critical_points").at("total").get<std::uint64_t>());
    row += number_cell(pairs_over_one_percent(method));
  }
  return row + "</tr>\n";
}

std::string method_head(const std::string& method) {
  return breakable(markup_text(valid_text(method)), ",:+");
}

std::string sort_head(const std::string& label, const char* attributes = "") {
  return std::string("<th scope=\"col\"") + attributes + "><button type=\"button\">" + label +
         "</button></th>";
}

std::string table_head(const BatchRequest& request) {
  std::string head = "<tr>" + sort_head("mesh");
  const std::vector<std::string>& methods = request.comparison.methods;
  if (request.thumbnails)
    for (const std::string& method : {methods.front(), methods.back()})
      head += "<th scope=\"col\" class=\"picture\">" + method_head(method) + "</th>";
  head += sort_head("status", " class=\"text\"") + sort_head("vertices");
  for (const std::string& method : methods)
    head += sort_head(method_head(method) + "<br>total") +
            sort_head(method_head(method) + "<br>pairs &gt; 1&nbsp;%");
  return head + "</tr>\n";
}

/// The request as words of the command line, without the output folder, so that pages do not depend on it.
std::string request_line(const BatchRequest& request, const SummaryOptions& options) {
  std::vector<std::string> words = {"morsel", "batch", options.collection};
  add_words(words, batch_words(request));
  return command_line(words);
}

/// Provenance of the collection's files: their hash is that of the lines that sha256sum prints for its
/// meshes. Parameters are resolved mesh by mesh, in the summary's table and document.
Provenance provenance_of(const std::vector<MeshOutcome>& outcomes, const BatchRequest& request,
                         const SummaryOptions& options) {
  std::string sums;
  for (const MeshOutcome& outcome : outcomes)
    if (outcome.sha256.is_string())
      sums += outcome.sha256.get<std::string>() + "  " + outcome.mesh.name + "\n";
  std::vector<HashedFile> inputs = {{options.collection, sha256_of(sums)}};
  const Json key = common_key(request);
  for (const Json& file : key.at("files")) inputs.push_back({file.at("path"), file.at("sha256")});
  return {request_line(request, options), key.at("request"), inputs};
}

std::string counts_line(const Tally& sums) {
  const std::size_t all = sums.done + sums.failed + sums.not_run;
  return grouped(all) + (all == 1 ? " mesh: " : " meshes: ") + grouped(sums.done) + " done, " +
         grouped(sums.failed) + " failed, " + grouped(sums.not_run) + " not run";
}

}  // namespace

void write_page(const std::vector<MeshOutcome>& outcomes, const BatchRequest& request,
                const SummaryOptions& options, ResultFolder& out) {
  const Tally sums = tally(outcomes);
  const Provenance provenance = provenance_of(outcomes, request, options);
  std::string plots;
  if (sums.done > 0 && drawing::has_pictures())
    plots = write_plots(totals_of(outcomes, request.comparison.methods), out, provenance);
  const std::string title = markup_text(valid_text("morsel batch: " + options.collection));
  core::FileWriter file(out.claim("index.html"));
  file.write(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n<title>" +
      title + "</title>\n<style>\n");
  file.write(joined(kPageStyle));
  file.write("</style>\n</head>\n<body>\n<header><h1>" + title + "</h1>\n<p>" + counts_line(sums) +
             ". The numbers are in <a href=\"summary.csv\">summary.csv</a> and "
             "<a href=\"summary.json\">summary.json</a>.</p></header>\n<main>\n");
  file.write(plots);
  file.write(
      "<p class=\"find\"><label>Find a name, a status, an error: <input type=\"search\" "
      "id=\"find\"></label> <output id=\"found\"></output> <button "
      "type=\"button\" id=\"all\" hidden>Show all</button></p>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Meshes\"><table "
      "class=\"collection\" data-first=\"" +
      std::to_string(kShownFirst) + "\">\n<thead>" + table_head(request) + "</thead>\n<tbody>\n");
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    file.write(mesh_row(outcomes[i], request, i < kShownFirst));
  file.write("</tbody>\n</table></div>\n</main>\n<footer><p>morsel " + markup_text(kVersion) +
             "; what was asked for:</p><pre>" + markup_text(valid_text(request_line(request, options))) +
             "</pre></footer>\n<script>\n");
  file.write(joined(kPageScript));
  file.write("</script>\n</body>\n</html>\n");
  file.write(provenance.html_comment());
  file.commit();
}

}  // namespace morsel::tools::batch
