// The fuzz targets over their corpora and over seeded mutations of them, as ordinary tests.

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "support/corpus.h"
#include "target.h"

using namespace morsel::test;
using morsel::fuzz::Target;

namespace {

/// One small change of the kinds that damage files or find bugs.
std::string mutated(const std::string& bytes, const std::vector<CorpusFile>& corpus, std::mt19937& random) {
  static const std::vector<std::string> kPieces = {"0",
                                                   "-1",
                                                   "4294967295",
                                                   "1e308",
                                                   "nan",
                                                   "\n",
                                                   " ",
                                                   "#",
                                                   "\\",
                                                   "OFF",
                                                   "3 0 1 2\n",
                                                   "f ",
                                                   "/",
                                                   "\r",
                                                   "\xff",
                                                   std::string(1, '\0'),
                                                   "99999999999999999999"};
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  std::string result = bytes;
  const std::size_t at = below(result.size() + 1);
  const std::size_t length = std::min(below(20), result.size() - at);
  switch (random() % 6) {
    case 0:
      if (at < result.size()) result[at] = static_cast<char>(random());
      break;
    case 1:
      result.erase(at, length);
      break;
    case 2:
      result.insert(at, result.substr(at, length));
      break;
    case 3:
      result.insert(at, kPieces[below(kPieces.size())]);
      break;
    case 4: {
      const std::string& other = corpus[below(corpus.size())].bytes;
      const std::size_t from = below(other.size() + 1);
      result.replace(at, length, other.substr(from, below(40)));
      break;
    }
    default: {  // one digit for another, which keeps the file's form
      std::vector<std::size_t> digits;
      for (std::size_t i = 0; i < result.size(); ++i)
        if (result[i] >= '0' && result[i] <= '9') digits.push_back(i);
      if (!digits.empty()) result[digits[below(digits.size())]] = static_cast<char>('0' + random() % 10);
    }
  }
  return result;
}

/// The files of its kind.
std::vector<CorpusFile> own_files(const Target& target) {
  std::vector<CorpusFile> files = corpus(target.corpus);
  std::erase_if(files, [&](const CorpusFile& file) { return !file.name.ends_with(target.extension); });
  REQUIRE(files.size() >= 5);
  return files;
}

}  // namespace

TEST_CASE("fuzz targets find nothing in their corpora") {
  for (const Target& target : morsel::fuzz::targets())
    for (const CorpusFile& file : corpus(target.corpus)) {  // files of other formats, too
      INFO(target.name << ": " << file.name);
      CHECK_NOTHROW(target.run(file.bytes));
    }
}

TEST_CASE("fuzz targets find nothing in mutations of their corpora") {
  for (const Target& target : morsel::fuzz::targets()) {
    const std::vector<CorpusFile> files = own_files(target);
    std::mt19937 random(20240607);
    for (std::size_t run = 0; run < 2000; ++run) {
      const CorpusFile& file = files[run % files.size()];
      std::string bytes = file.bytes;
      for (unsigned changes = 1 + random() % 4; changes > 0; --changes) bytes = mutated(bytes, files, random);
      INFO(target.name << ": " << file.name << ", run " << run << ":\n" << bytes);
      REQUIRE_NOTHROW(target.run(bytes));
    }
  }
}
