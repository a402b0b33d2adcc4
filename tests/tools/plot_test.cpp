#include "morsel/tools/plot/plot.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <regex>
#include <thread>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/plot/comparison_plots.h"
#include "morsel/tools/plot/plot_sink.h"
#include "support/scratch.h"

using namespace morsel;
using namespace morsel::tools::plot;
using Catch::Contains;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string svg_of(const Plot& plot) {
  const test::Scratch folder;
  write_svg(folder / "p.svg", plot);
  return test::contents(folder / "p.svg");
}

std::string png_of(const Plot& plot, int width = 504) {
  const test::Scratch folder;
  write_png(folder / "p.png", plot, width);
  return test::contents(folder / "p.png");
}

std::vector<double> numbers_in(const std::string& text) {
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?");
  std::vector<double> numbers;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i)
    numbers.push_back(std::stod(i->str()));
  return numbers;
}

/// The first capture of each match.
std::vector<std::string> captures(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
    found.push_back((*i)[1]);
  return found;
}

/// The coordinates of the first shapes of a series, by its name in XML. (Regular expressions overflow on long
/// paths.)
std::vector<double> path_of(const std::string& svg, const std::string& name) {
  const std::string head = "<title>" + name + "</title>\n<path d=\"M";
  const std::size_t begin = svg.find(head);
  REQUIRE(begin != std::string::npos);
  std::string path =
      svg.substr(begin + head.size(), svg.find('"', begin + head.size()) - begin - head.size());
  for (std::size_t at = path.find("h0"); at != std::string::npos; at = path.find("h0", at))
    path.replace(at, 2, " ");
  return numbers_in(path);
}

/// The frame of the only panel: x, y, width, height.
std::vector<double> frame_of(const std::string& svg) {
  const auto found = captures(svg, "<rect (x=[^/]*) fill=\"none\"");
  REQUIRE(found.size() == 1);
  return numbers_in(found.front());
}

Plot unit_square() {
  Plot plot;
  plot.x = {.label = "x", .lower = 0, .upper = 1};
  plot.y = {.label = "y", .lower = 0, .upper = 2};
  plot.panels.resize(1);
  return plot;
}

Plot of_points(std::vector<double> x, std::vector<double> y) {
  Plot plot;
  Series series;
  series.name = "points";
  series.x = std::move(x);
  series.y = std::move(y);
  plot.panels = {{"", "", {series}}};
  return plot;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("points are where the axes say") {
  Plot plot = unit_square();
  Series series;
  series.name = "a & b";
  series.x = {0, 0.5, 1, 0.25, 7};  // the last one is outside
  series.y = {0, 1, 2, 1.5, 1};
  plot.panels[0].series = {series};
  const std::string svg = svg_of(plot);
  const std::vector<double> frame = frame_of(svg);
  const auto marks = captures(svg, "<title>a &amp; b</title>\n<path d=\"([^\"]*)\"");
  REQUIRE(marks.size() == 1);
  const std::vector<double> at = numbers_in(std::regex_replace(marks[0], std::regex("h0"), " "));
  REQUIRE(at.size() == 8);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(at[2 * i] == Approx(frame[0] + series.x[i] * frame[2]).margin(0.011));
    CHECK(at[2 * i + 1] == Approx(frame[1] + (1 - series.y[i] / 2) * frame[3]).margin(0.011));
  }
}

TEST_CASE("every mark of a series has its shape about its place") {
  for (const Mark mark : {Mark::square, Mark::triangle, Mark::diamond}) {
    Plot plot = unit_square();
    Series series;
    series.name = "marks";
    series.mark = mark;
    series.x = {0.5};
    series.y = {1};
    plot.panels[0].series = {series};
    const std::string svg = svg_of(plot);
    const std::vector<double> frame = frame_of(svg);
    const auto path = captures(svg, "<title>marks</title>\n<path d=\"([^\"]*)\"");
    REQUIRE(path.size() == 1);
    CHECK(path[0].back() == 'z');
    std::vector<double> at = numbers_in(path[0]);
    double x = at[0], y = at[1], left = x, right = x, top = y, bottom = y;
    for (std::size_t i = 2; i < at.size(); i += 2) {
      x += at[i];
      y += at[i + 1];
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
    CHECK((left + right) / 2 == Approx(frame[0] + frame[2] / 2).margin(0.03));
    CHECK(top < frame[1] + frame[3] / 2);
    CHECK(bottom > frame[1] + frame[3] / 2);
    CHECK(right - left < 6);
  }
}

TEST_CASE("a logarithmic axis has equal factors at equal distances") {
  Plot plot = of_points({1, 10, 1000}, {1, 1, 1});
  plot.x.scale = Scale::log;
  plot.panels[0].series[0].draw = Draw::line;
  const auto lines = captures(svg_of(plot), "<title>points</title>\n<path d=\"M([^\"]*)\"");
  REQUIRE(lines.size() == 1);
  const std::vector<double> at = numbers_in(lines[0]);
  REQUIRE(at.size() == 6);
  CHECK(at[4] - at[2] == Approx(2 * (at[2] - at[0])).margin(0.03));
}

TEST_CASE("a symmetric axis is odd, linear at 0 and logarithmic far away") {
  Plot plot = of_points({-1e6, -1e5, -1e-3, 0, 1e-3, 2e-3, 1e5, 1e6}, {0, 0, 0, 0, 0, 0, 0, 0});
  plot.x.scale = Scale::symmetric;
  plot.x.linear = 10;
  plot.width = 2000;
  plot.panels[0].series[0].draw = Draw::steps;
  const auto lines = captures(svg_of(plot), "<title>points</title>\n<path d=\"M([^\"]*)\"");
  REQUIRE(lines.size() == 1);
  const std::vector<double> at = numbers_in(lines[0]);
  const double first = at.front(), last = at[at.size() - 2];
  const std::vector<double> frame = frame_of(svg_of(plot));
  CHECK((first + last) / 2 == Approx(frame[0] + frame[2] / 2).margin(0.02));
}

TEST_CASE("steps hold their value up to the next point") {
  Plot plot = unit_square();
  Series series;
  series.name = "steps";
  series.draw = Draw::steps;
  series.x = {0, 0.5, 1};
  series.y = {2, 1, 0};
  plot.panels[0].series = {series};
  const std::string svg = svg_of(plot);
  const std::vector<double> f = frame_of(svg);
  const auto lines = captures(svg, "<title>steps</title>\n<path d=\"M([^\"]*)\"");
  REQUIRE(lines.size() == 1);
  const std::vector<double> at = numbers_in(lines[0]);
  const double middle = f[0] + f[2] / 2, right = f[0] + f[2], half = f[1] + f[3] / 2, bottom = f[1] + f[3];
  const std::vector<double> expected = {f[0], f[1], middle, f[1], middle, half, right, half, right, bottom};
  REQUIRE(at.size() == expected.size());
  for (std::size_t i = 0; i < at.size(); ++i) CHECK(at[i] == Approx(expected[i]).margin(0.011));
}

TEST_CASE("a line is cut off at the frame") {
  Plot plot = unit_square();
  Series series;
  series.name = "line";
  series.draw = Draw::line;
  series.x = {-1, 2, 2, 0.5};
  series.y = {1, 1, 9, 1};
  plot.panels[0].series = {series};
  const std::string svg = svg_of(plot);
  const std::vector<double> f = frame_of(svg);
  const auto lines = captures(svg, "<path d=\"M([^\"]*)\" fill=\"none\" stroke=\"#0072b2\"");
  REQUIRE(lines.size() == 3);  // what is left of two segments, and the legend's sample
  const std::vector<double> first = numbers_in(lines[0]);
  REQUIRE(first.size() == 4);
  CHECK(first[0] == Approx(f[0]).margin(0.011));
  CHECK(first[2] == Approx(f[0] + f[2]).margin(0.011));
  for (std::size_t line = 0; line < 2; ++line) {
    const std::vector<double> at = numbers_in(lines[line]);
    for (std::size_t i = 0; i < at.size(); i += 2) {
      CHECK((at[i] >= f[0] - 0.011 && at[i] <= f[0] + f[2] + 0.011));
      CHECK((at[i + 1] >= f[1] - 0.011 && at[i + 1] <= f[1] + f[3] + 0.011));
    }
  }
}

TEST_CASE("with a diagonal both axes have one range and infinity has a line above") {
  Plot plot = of_points({-1, 2, 0}, {5, 3, kInfinity});
  plot.diagonal = true;
  const std::string svg = svg_of(plot);
  const std::vector<double> f = frame_of(svg);
  const double finite_top = f[1] + f[3] - f[2];  // the finite part is a square
  CHECK(finite_top > f[1] + 5);
  const std::vector<double> diagonal = numbers_in(
      captures(svg, "<path d=\"M([^\"]*)\" fill=\"none\" stroke=\"#888888\" stroke-width=\"0.6\"/>").at(0));
  CHECK(diagonal[0] == Approx(f[0]).margin(0.011));
  CHECK(diagonal[1] == Approx(f[1] + f[3]).margin(0.011));
  CHECK(diagonal[2] == Approx(f[0] + f[2]).margin(0.011));
  CHECK(diagonal[3] == Approx(finite_top).margin(0.011));
  const std::vector<double> at = path_of(svg, "points");
  REQUIRE(at.size() == 6);
  CHECK(at[5] < finite_top);  // (0, ∞)
  CHECK(at[5] > f[1]);
  // Death − birth of (−1, 5) is six times that of (2, 3).
  const auto above = [&](std::size_t i) { return (f[1] + f[3] - at[2 * i + 1]) - (at[2 * i] - f[0]); };
  CHECK(above(0) == Approx(6 * above(1)).margin(0.1));
  CHECK_THAT(svg, Contains(">\u221e</text>"));
}

TEST_CASE("plots without data, with one point and of one value can be drawn") {
  CHECK_THAT(svg_of(of_points({}, {})), Contains(">0.2</text>") && Contains(">points</text>"));
  Plot log = of_points({}, {});
  log.y.scale = log.x.scale = Scale::log;
  CHECK_THAT(svg_of(log), Contains("</svg>"));
  for (const double value : {0., 5., -3e-7, 1e9, 1e-300, -1e300}) {
    const std::string svg = svg_of(of_points({value}, {value}));
    const std::vector<double> f = frame_of(svg);
    const std::vector<double> at = path_of(svg, "points");
    CHECK(at[0] == Approx(f[0] + f[2] / 2).margin(0.011));
    CHECK(at[1] == Approx(f[1] + f[3] / 2).margin(0.011));
  }
  for (const Draw draw : {Draw::line, Draw::steps}) {  // a line of one point is a mark
    Plot plot = of_points({3}, {4});
    plot.panels[0].series[0].draw = draw;
    CHECK_THAT(svg_of(plot), Contains("h0"));
  }
  Plot only_infinite = of_points({1}, {kInfinity});
  CHECK_THAT(svg_of(only_infinite), Contains("h0"));
  only_infinite.diagonal = true;  // once refused: no finite death was taken for an infinite one
  CHECK_THAT(svg_of(only_infinite), Contains("h0"));
}

TEST_CASE("a million marks are thinned to a small file with a note") {
  std::mt19937_64 random(7);
  std::vector<double> x(1'000'000), y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<double>(random() >> 11) * 0x1p-53;
    y[i] = x[i] + 0.2 * std::pow(static_cast<double>(random() >> 11) * 0x1p-53, 4);
  }
  x.push_back(0);
  y.push_back(1.3);  // far from all others
  Plot plot = of_points(x, y);
  plot.diagonal = true;
  const std::string svg = svg_of(plot);
  CHECK(svg.size() < 300'000);
  const std::size_t marks = occurrences(svg, "h0") - 1;  // without the legend's
  CHECK(marks > 2'000);
  CHECK(marks < 10'000);
  const auto note = captures(svg, ">(Of 1,000,001 crowded marks [^<]*)<");
  REQUIRE(note.size() == 1);
  std::string said = captures(note[0], "marks ([0-9,]*)").at(0);
  said.erase(std::remove(said.begin(), said.end(), ','), said.end());
  CHECK(std::stoul(said) == marks);
  // Every point has a mark within a cell's diagonal, sideways and upwards; that of the lonely one is its own.
  const std::string from_note_on = svg.substr(svg.find("crowded marks"));  // the note may be broken anywhere
  const auto cells = captures(from_note_on, "([0-9]\\.[0-9])(?: points|</text>)");
  REQUIRE(cells.size() == 1);
  const double cell = std::stod(cells[0]);
  CHECK(cell < 2);
  const std::vector<double> at = path_of(svg, "points");
  REQUIRE(at.size() == 2 * marks);
  const std::vector<double> f = frame_of(svg);
  const double lower = -0.04 * 1.3, upper = 1.3 * 1.04;
  const auto place = [&](double px, double py) {
    return std::pair{f[0] + f[2] * (px - lower) / (upper - lower),
                     f[1] + f[3] - f[3] * (py - lower) / (upper - lower)};
  };
  for (std::size_t i = 0; i < x.size(); i += 9973) {
    const auto [sx, sy] = place(x[i], y[i]);
    double nearest = kInfinity;
    for (std::size_t k = 0; k < at.size(); k += 2)
      nearest = std::min(nearest, std::max(std::abs(at[k] - sx), std::abs(at[k + 1] - sy)));
    CHECK(nearest <= cell + 0.02);
  }
  const auto [sx, sy] = place(0, 1.3);
  CHECK(at[at.size() - 2] == Approx(sx).margin(0.02));
  CHECK(at.back() == Approx(sy).margin(0.02));
  CHECK(png_of(plot, 1050).size() < 500'000);
}

TEST_CASE("a line of a million points loses no visible ones") {
  std::vector<double> x, y;
  for (int i = 1; i <= 1'000'000; ++i) {
    x.push_back(i);
    y.push_back(1'000'001 - i);
  }
  Plot plot = of_points(x, y);
  plot.x.scale = plot.y.scale = Scale::log;
  plot.panels[0].series[0].draw = Draw::steps;
  const std::string svg = svg_of(plot);
  CHECK(svg.size() < 60'000);
  const std::vector<double> at = path_of(svg, "points");
  for (std::size_t i = 0; i + 3 < at.size(); i += 2) {
    CHECK(at[i + 2] >= at[i]);
    CHECK(at[i + 3] >= at[i + 1]);
  }
}

TEST_CASE("a plot has the same bytes from any thread, with other plots drawn at the same time") {
  Plot plot = of_points({1, 2, 3, -4e5}, {2, 3, kInfinity, 7});
  plot.diagonal = true;
  plot.title = "\u00fcber \u2202\u03c6";
  plot.panels.push_back(plot.panels[0]);
  plot.columns = 2;
  plot.width = Plot::kPageWidth;
  const std::string svg = svg_of(plot), png = png_of(plot);
  for (const int threads : {1, 2, 7}) {
    const core::ThreadLimit limit(threads);
    std::vector<std::string> made(16);
    core::parallel_for(0, made.size(), 1, [&](std::size_t i, std::size_t) {
      made[i] = i % 2 == 0 ? svg_of(plot) : png_of(plot);
    });
    for (std::size_t i = 0; i < made.size(); ++i) CHECK(made[i] == (i % 2 == 0 ? svg : png));
  }
}

TEST_CASE("a PNG has the width that was asked for and says nothing of when it was made") {
  const Plot plot = of_points({1, 2, 3}, {2, 3, 1});
  const std::string png = png_of(plot, 777);
  REQUIRE(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png[at + i]);
    return value;
  };
  CHECK(number(16) == 777);
  const double height = std::stod(captures(svg_of(plot), "height=\"([0-9.]*)pt\"").at(0));
  CHECK(number(20) == Approx(height * 777 / plot.width).margin(1.01));
  for (const char* chunk : {"tIME", "tEXt", "zTXt", "iTXt"}) CHECK(png.find(chunk) == std::string::npos);
}

TEST_CASE("long names and titles are cut so that nothing leaves the plot") {
  Plot plot = of_points({1, 2}, {2, 3});
  const std::string name(300, 'W');
  plot.title = plot.panels[0].title = plot.panels[0].caption = plot.panels[0].series[0].name = plot.x.label =
      plot.y.label = name;
  plot.notes = {
      name, "many words " + std::string(200, '-') + " more words and more and more and more and more words"};
  const std::string svg = svg_of(plot);
  const double height = std::stod(captures(svg, "height=\"([0-9.]*)pt\"").at(0));
  const std::regex text("<text x=\"([^\"]*)\" y=\"([^\"]*)\"[^>]* textLength=\"([^\"]*)\"([^>]*)>");
  std::size_t count = 0;
  for (std::sregex_iterator i(svg.begin(), svg.end(), text), end; i != end; ++i, ++count) {
    const double x = std::stod((*i)[1]), y = std::stod((*i)[2]), length = std::stod((*i)[3]);
    const std::string rest = (*i)[4];
    const double back = rest.find("middle") != std::string::npos ? length / 2
                        : rest.find("end") != std::string::npos  ? length
                                                                 : 0;
    const bool upwards = rest.find("rotate") != std::string::npos;
    const double begin = upwards ? height - y - back : x - back, room = upwards ? height : plot.width;
    CHECK(begin >= 4.9);
    CHECK(begin + length <= room - 4.9);
  }
  CHECK(count > 10);
}

TEST_CASE("what cannot be drawn is refused and leaves no file") {
  const test::Scratch folder;
  const auto refused = [&](const Plot& plot, const char* why) {
    CHECK_THROWS_AS(write_svg(folder / "p.svg", plot), core::InvalidArgument);
    CHECK_THROWS_WITH(write_png(folder / "p.png", plot, 500), Contains(why));
    CHECK(std::filesystem::is_empty(folder.path()));
  };
  const double nan = std::nan("");
  refused(Plot{}, "no panel");
  refused(of_points({1, 2}, {1}), "'points' has 2 x and 1 y");
  refused(of_points({1, nan}, {1, 2}), "point 1");
  refused(of_points({kInfinity}, {1}), "not finite");
  refused(of_points({1}, {-kInfinity}), "not finite");
  refused(of_points({1e301}, {1}), "1e300");
  Plot plot = of_points({1, 2}, {0, 1});
  plot.y.scale = Scale::log;
  refused(plot, "logarithmic");
  plot = of_points({1, 2}, {1, kInfinity});
  plot.panels[0].series[0].draw = Draw::line;
  refused(plot, "not finite");
  plot = of_points({1}, {1});
  plot.x.lower = 2;
  plot.x.upper = 2;
  refused(plot, "interval");
  plot.x.upper = nan;
  refused(plot, "limit");
  plot = of_points({1}, {1});
  plot.x.scale = Scale::log;
  plot.x.lower = 0;
  refused(plot, "limit");
  plot = of_points({1}, {1});
  plot.width = 99;
  refused(plot, "width");
  plot.width = nan;
  refused(plot, "width");
  plot = of_points({1}, {1});
  plot.columns = 0;
  refused(plot, "columns");
  plot = of_points({1}, {1});
  plot.diagonal = true;
  plot.x.lower = 0;
  refused(plot, "diagonal");
  plot = of_points({1}, {1});
  plot.x.scale = Scale::symmetric;
  plot.x.linear = 0;
  refused(plot, "linear part");
  plot = of_points({1}, {1});
  plot.panels.resize(40, plot.panels[0]);
  plot.columns = 40;
  refused(plot, "no room");
  for (const char* text :
       {"\xff", "\xc3", "a\nb", "\xed\xa0\x80", "\xc0\x80", "\xf5\x80\x80\x80", "\xef\xbf\xbf"}) {
    plot = of_points({1}, {1});
    plot.panels[0].title = text;
    refused(plot, "UTF-8");
  }
  for (const int width : {99, 10'001, -5})
    CHECK_THROWS_AS(write_png(folder / "p.png", of_points({1}, {1}), width), core::InvalidArgument);
  static_cast<void>(folder.file("no"));
  CHECK_THROWS_AS(write_svg(folder / "no" / "p.svg", of_points({1}, {1})), core::WriteFailed);
}

TEST_CASE("styles of lines repeat only after 28") {
  std::vector<Series> styles(28);
  for (std::size_t i = 0; i < styles.size(); ++i) set_line_style(styles[i], i);
  for (std::size_t i = 0; i < styles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK_FALSE((styles[i].color == styles[j].color && styles[i].dash == styles[j].dash));
}
