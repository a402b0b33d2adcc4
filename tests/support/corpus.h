#pragma once
/// The corpus of small files in tests/corpus, shared by unit tests and fuzzers.

#include <string>
#include <vector>

namespace morsel::test {

struct CorpusFile {
  std::string name;  ///< with its extension, without folder
  std::string path;
  std::string bytes;
};

/// The files in tests/corpus/meshes, by name. Throws if there are none.
std::vector<CorpusFile> mesh_corpus();

}  // namespace morsel::test
