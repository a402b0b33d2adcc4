#include "support/corpus.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "support/scratch.h"

namespace morsel::test {

std::vector<CorpusFile> mesh_corpus() {
  std::vector<CorpusFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(MORSEL_CORPUS "/meshes"))
    files.push_back({entry.path().filename().string(), entry.path().string(), contents(entry.path())});
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  if (files.size() < 100)
    throw std::runtime_error("the corpus " MORSEL_CORPUS "/meshes is missing or has shrunk");
  return files;
}

}  // namespace morsel::test
