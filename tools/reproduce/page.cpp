#include "morsel/tools/reproduce/page.h"

#include <cstdint>
#include <vector>

#include "morsel/tools/formats/base64.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/formats/markup.h"
#include "morsel/tools/formats/text_table.h"
#include "morsel/tools/formats/version.h"
#include "morsel/tools/reproduce/document.h"

namespace morsel::tools::reproduce {
namespace {

/// Keys of a method, with a place to break the line after each.
std::string breakable(std::string_view keys) {
  std::string text = markup_text(keys);
  for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos; at += 6)
    text.insert(at + 1, "<wbr>");
  return text;
}

std::string seconds_text(double seconds) {
  return core::to_decimals(seconds, seconds < 0.0995 ? 3 : seconds < 0.995 ? 2 : 1) + " s";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) c == '\n' ? lines.emplace_back() : lines.back() += c;
  return lines;
}

std::string models_table(const Reproduction& reproduction) {
  std::string text =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Models\"><table class=\"models\">"
      "<thead><tr><th>Model</th><th>In the "
      "paper</th><th>Here</th><th>Vertices</th><th>From</th></tr></thead><tbody>\n";
  for (const auto& model : reproduction.models) {
    const bool sample = model->file().is_sample;
    text += "<tr><th>" + markup_text(model->recipe().name) + "</th><td>" +
            markup_text(model->recipe().paper) + "</td><td>" +
            markup_text(model->file().path.filename().string()) +
            (sample ? ": " + markup_text(model->recipe().sample_is) : std::string()) + "</td><td>" +
            grouped(model->mesh().vertex_count()) + "</td><td>" +
            (sample                  ? "the sample meshes, in its place"
             : model->file().is_made ? "made by a formula"
                                     : "the data folder") +
            "</td></tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string percentile_text(const std::optional<double>& percentile) {
  return percentile ? core::to_decimals(*percentile, 2) : "–";
}

std::string number_cell(const TableCell& cell) {
  return "<td>" + grouped(cell.run->total()) + "<small>" + seconds_text(cell.run->seconds) +
         "</small><small>" + percentile_text(cell.percentile) + "</small></td>";
}

std::string table_section(const Reproduction& reproduction) {
  std::string text =
      "<section aria-labelledby=\"table1\"><h2 id=\"table1\">Table 1. Critical points and seconds</h2>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"table1\"><table "
      "class=\"table\"><thead><tr>"
      "<th>Model</th><th>Vertices</th><th>Figure</th><th>Iterations</th><th>The paper</th>";
  for (const TableSetting& setting : table_settings())
    text += "<th>" + breakable(setting.keys) + "<small>" + markup_text(setting.note) + "</small></th>";
  text += "</tr></thead><tbody>\n";
  const Model* before = nullptr;
  for (const TableRowOutcome& row : reproduction.table) {
    const bool conventional = row.recipe->iterations == 0;
    const bool first = row.model != before;
    text +=
        std::string("<tr") + (first ? " class=\"first\"" : "") + "><th>" +
        (first ? markup_text(row.model->recipe().name) : std::string()) + "</th><td>" +
        (first ? grouped(row.model->mesh().vertex_count()) : std::string()) + "</td><td>" +
        markup_text(row.recipe->figure) + "</td><td>" +
        (conventional ? std::string("conventional") : std::to_string(row.recipe->iterations)) +
        "</td><td class=\"paper\">" +
        (row.recipe->paper_points ? grouped(static_cast<std::uint64_t>(*row.recipe->paper_points)) : "–") +
        (row.recipe->paper_seconds ? "<small>" + seconds_text(*row.recipe->paper_seconds) + "</small>"
                                   : std::string()) +
        "</td>";
    for (std::size_t i = 0; i < table_settings().size(); ++i) {
      text += conventional && i > 0 ? "<td></td>" : number_cell(row.cells[conventional ? 0 : i]);
    }
    text += "</tr>\n";
    before = row.model;
  }
  return text +
         "</tbody></table></div>\n<p class=\"hint said\">σ = 8ε. Seconds of smoothing and of finding the "
         "critical points; "
         "the paper's are those of a Pentium IV of 1.7 GHz. The number below is the mean saliency "
         "percentile of the extrema, 0.50 by chance. Figures count panels as below; the paper's table "
         "calls 3(a) "
         "and 3(c) 3(b) and 3(d). The pictures are made with the first setting.</p></section>\n";
}

std::string controls_section(const Reproduction& reproduction) {
  std::string text =
      "<section aria-labelledby=\"controls\"><h2 id=\"controls\">Controls</h2>\n"
      "<p class=\"said\">Whether points are salient is measured by mesh saliency: the percentile of an "
      "extremum is the share of all vertices that have less. The means are to be compared with those of "
      "other ways to as many points, and with 0.50, which vertices taken at random have.</p>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"controls\"><table "
      "class=\"table\"><thead><tr><th>Model</th><th>Figure</th><th>Iterations</th><th>Control</th>"
      "<th>Method</th><th>Points</th><th>Extrema</th><th>Percentile</th></tr></thead><tbody>\n";
  const TableRow* before = nullptr;
  for (const ControlOutcome& control : reproduction.controls) {
    const bool first = control.row != before;
    const std::string rank =
        control.recipe->rank ? ", rank=" + std::string(to_string(*control.recipe->rank)) : std::string();
    text += std::string("<tr") + (first ? " class=\"first\"" : "") + "><th>" +
            (first ? markup_text(control.model->recipe().name) : std::string()) + "</th><td>" +
            (first ? markup_text(control.row->figure) : std::string()) + "</td><td>" +
            (first ? std::to_string(control.row->iterations) : std::string()) + "</td><td>" +
            markup_text(control.recipe->title) + "</td><td>" +
            breakable(control.run->plan.chain.specification + rank) + "</td><td>" +
            grouped(control.run->total()) + "</td><td>" + grouped(control.extrema) + "</td><td>" +
            percentile_text(control.percentile) + "</td></tr>\n";
    before = control.row;
  }
  return text + "</tbody></table></div></section>\n";
}

std::string panel_markup(const PanelOutcome& panel, std::size_t number) {
  const std::vector<std::string> lines = lines_of(panel.caption);
  const std::string name = std::string("(") + static_cast<char>('a' + number) + ") ";
  std::string text = "<figure><img alt=\"" + markup_text(name + lines[0] + ", " + lines.back()) +
                     "\" src=\"data:image/png;base64," + base64(panel.png) + "\">\n<figcaption>" +
                     markup_text(name + lines[0]);
  for (std::size_t i = 1; i < lines.size(); ++i)
    text += std::string("<span") + (i == 1 ? " class=\"soft\">" : ">") + markup_text(lines[i]) + "</span>";
  return text + "</figcaption>\n<details><summary>Command</summary><pre class=\"copy\">" +
         markup_text(command_line(panel.command())) + "</pre></details></figure>\n";
}

std::string figure_of_page(const FigureOutcome& figure) {
  const std::string id = figure.recipe->file_stem();
  std::string text = "<section aria-labelledby=\"" + id + "\"><h2 id=\"" + id + "\">" +
                     figure.recipe->name() + ". " + markup_text(figure.recipe->title) +
                     "</h2>\n<p class=\"said\"><b>In the paper:</b> " + markup_text(figure.recipe->paper) +
                     "</p>\n<p class=\"said\"><b>Here:</b> " + markup_text(figure.finding) +
                     "</p>\n<div class=\"panels\">\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) text += panel_markup(figure.panels[i], i);
  return text + "</div></section>\n";
}

}  // namespace

std::string make_page(const Prepared& prepared, const Reproduction& reproduction) {
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "img-src "
      "data:\">\n<link rel=\"icon\" href=\"data:,\">\n<title>Salient Critical Points for Meshes, made "
      "again</title>\n"
      "<style>\n" +
      joined(kStyle) +
      "</style>\n</head>\n<body>\n<header><h1>Salient Critical Points for Meshes, reproduced</h1>\n"
      "<p class=\"hint\">The figures and the table of the paper, by morsel " +
      markup_text(kVersion) +
      ". Minima are blue, saddles green, maxima red; descending arcs are dark blue, ascending ones dark "
      "red.</p></header>\n"
      "<main>\n<section aria-labelledby=\"models\"><h2 id=\"models\">Models</h2>\n"
      "<p class=\"said\">The paper's scans are not public. Other meshes stand in for them, so that numbers "
      "agree in trend, not in size.</p>\n" +
      models_table(reproduction) + "</section>\n" + table_section(reproduction) +
      controls_section(reproduction);
  for (const FigureOutcome& figure : reproduction.figures) text += figure_of_page(figure);
  std::vector<std::string> command = command_words(prepared.request);
  command.insert(command.begin() + 2, prepared.request.folder.string());
  return text + "</main>\n<footer><p>The command:</p><pre class=\"copy\">" +
         markup_text(command_line(command)) + "</pre></footer>\n</body>\n</html>\n" +
         page_provenance(prepared, reproduction).html_comment();
}

}  // namespace morsel::tools::reproduce
