#include "support/corpus.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "support/scratch.h"

namespace morsel::test {

std::string corpus_folder() { return MORSEL_CORPUS; }

std::vector<CorpusFile> corpus(const std::string& folder, std::size_t least) {
  const std::string path = corpus_folder() + "/" + folder;
  std::vector<CorpusFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    files.push_back({entry.path().filename().string(), entry.path().string(), contents(entry.path())});
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  if (files.size() < least) throw std::runtime_error("the corpus " + path + " is missing or has shrunk");
  return files;
}

std::vector<CorpusFile> mesh_corpus() { return corpus("meshes", 100); }

}  // namespace morsel::test
