#pragma once
/// The corpus of small files in tests/corpus, shared by unit tests and fuzzers.

#include <cstddef>
#include <string>
#include <vector>

namespace morsel::test {

struct CorpusFile {
  std::string name;  ///< with its extension, without folder
  std::string path;
  std::string bytes;
};

/// The folder tests/corpus.
std::string corpus_folder();

/// The files in tests/corpus/FOLDER, by name. Throws if there are fewer than `least`: a corpus that reads as
/// empty tests nothing.
std::vector<CorpusFile> corpus(const std::string& folder, std::size_t least = 1);

/// The files in tests/corpus/meshes.
std::vector<CorpusFile> mesh_corpus();

}  // namespace morsel::test
