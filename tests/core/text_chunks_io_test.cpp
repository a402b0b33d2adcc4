// Large text files, which are read in parallel, against the plain reader, which one thread takes.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/mesh_io.h"
#include "morsel/core/parallel/parallel.h"

using namespace morsel::core;

namespace {

/// What reading gives, or the error's sentence.
struct Outcome {
  PolygonSoup soup;
  std::string error;
};

Outcome outcome(const std::string& text, MeshFormat format, int threads) {
  const ThreadLimit limit(threads);
  try {
    return {parse_polygon_soup(text, format, "test").soup, ""};
  } catch (const BadInput& error) {
    return {{}, error.what()};
  }
}

bool same(const Outcome& a, const Outcome& b) {
  return a.error == b.error && a.soup.offsets == b.soup.offsets && a.soup.corners == b.soup.corners &&
         a.soup.positions.size() == b.soup.positions.size() &&
         (a.soup.positions.empty() || std::memcmp(a.soup.positions.data(), b.soup.positions.data(),
                                                  a.soup.positions.size() * sizeof(Point)) == 0);
}

/// A large file with all that its format allows, in lines.
std::vector<std::string> lines_of(MeshFormat format, std::mt19937& random) {
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
  const auto number = [&] {
    return std::to_string(static_cast<int>(random())) + "." + std::to_string(random()) + "e-7";
  };
  const unsigned vertices = 3000 + pick(1000);
  const unsigned faces = 5000 + pick(2000);
  const bool off = format == MeshFormat::off;
  std::vector<std::string> lines;
  const auto blanks = [&] {
    if (pick(40) == 0) lines.push_back(pick(2) == 0 ? "" : pick(2) == 0 ? "   # a comment, 1 2 3" : "\t ");
    if (!off && pick(100) == 0) lines.push_back("vn 1 2 3");
  };
  if (off) lines.push_back("OFF " + std::to_string(vertices) + " " + std::to_string(faces) + " 0");
  for (unsigned v = 0; v < vertices; ++v) {
    blanks();
    std::string line = off ? "" : "v ";
    line += number() + " " + number() + "\t" + number();
    if (pick(30) == 0) line += " 0.5 0.5 0.5";
    lines.push_back(line + (pick(50) == 0 ? " # end" : ""));
  }
  for (unsigned f = 0; f < faces; ++f) {
    blanks();
    const unsigned corners = pick(20) == 0 ? 3 + pick(6) : 3;
    std::string line = off ? std::to_string(corners) : "f";
    for (unsigned i = 0; i < corners; ++i) {
      const unsigned v = pick(vertices);
      line += " ";
      if (off)
        line += std::to_string(v);
      else
        line += pick(3) == 0 ? "-" + std::to_string(v + 1) + "//7"
                             : std::to_string(v + 1) + (pick(3) == 0 ? "/1/2" : "");
    }
    if (off && pick(30) == 0) line += " 255 0 0";
    lines.push_back(line);
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end) {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

/// Damages a line, or only writes the same in another way.
void change(std::vector<std::string>& lines, std::mt19937& random) {
  static const std::vector<std::string> kLines = {
      "x",         "v 1 2",       "3 0 1",      "f 1 2 99999", "f 1 2 -99999",
      "1 2 3",     "v 1 2 1e999", "f 1 2 3 \\", "3 0 1 99999", "\xEF\xBB\xBF",
      "v 0 0 nan", "# nothing",   "",           "f 0 1 2",     "v 1 2 3"};
  const std::size_t place = random() % lines.size();
  if (random() % 4 == 0)
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(place));
  else if (random() % 3 == 0)
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(place), kLines[random() % kLines.size()]);
  else
    lines[place] = kLines[random() % kLines.size()];
}

}  // namespace

TEST_CASE("large text files give the same at any number of threads, errors with their lines included") {
  std::mt19937 random(11);
  int accepted = 0;
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj}) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      const std::vector<std::string> lines = lines_of(format, random);
      const std::string text = joined(lines, end);
      REQUIRE(text.size() > (std::size_t{3} << 16));
      const Outcome plain = outcome(text, format, 1);
      REQUIRE(plain.error.empty());
      CHECK(same(plain, outcome(text, format, 4)));
      CHECK(same(plain, outcome(text.substr(0, text.size() - 1), format, 3)));
      int refused = 0;
      for (int run = 0; run < 25; ++run) {
        std::vector<std::string> changed = lines;
        for (std::size_t k = 0; k <= random() % 3; ++k) change(changed, random);
        const std::string spoiled = joined(changed, end);
        const Outcome expected = outcome(spoiled, format, 1);
        INFO(expected.error);
        REQUIRE(same(expected, outcome(spoiled, format, 4)));
        if (!expected.error.empty()) ++refused;
      }
      CHECK(refused > 5);
      accepted += 25 - refused;
    }
  }
  CHECK(accepted > 5);
}

TEST_CASE("reading in parallel reports from the caller's thread and can be stopped") {
  std::mt19937 random(2);
  const ThreadLimit limit(4);
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj}) {
    const std::string text = joined(lines_of(format, random), "\n");
    std::stop_source stop;
    int reports = 0;
    const auto report = [&](std::string_view, double fraction) {
      CHECK((fraction >= 0 && fraction <= 1));
      if (++reports == 2) stop.request_stop();
    };
    CHECK_THROWS_AS(parse_polygon_soup(text, format, "test", Progress(report, stop.get_token())), Cancelled);
    CHECK(reports == 2);
  }
}
