// The fuzzer's entry point over the corpus and over seeded mutations of it, as an ordinary test.

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "support/corpus.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

using namespace morsel::test;

namespace {

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

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

}  // namespace

TEST_CASE("every file of the corpus read as every format gives a mesh or an error") {
  for (const CorpusFile& file : mesh_corpus()) {
    INFO(file.name);
    CHECK_NOTHROW(run(file.bytes));
  }
}

TEST_CASE("mutations of the corpus give a mesh or an error") {
  const std::vector<CorpusFile> corpus = mesh_corpus();
  std::mt19937 random(20240607);
  for (int round = 0; round < 60; ++round)
    for (const CorpusFile& file : corpus) {
      std::string bytes = file.bytes;
      for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
        bytes = mutated(bytes, corpus, random);
      INFO(file.name << ", round " << round << ":\n" << bytes);
      REQUIRE_NOTHROW(run(bytes));
    }
}
