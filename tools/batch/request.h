#pragma once
/// The request of a collection, and the key that decides whether a mesh's report is up to date.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/tools/batch/collection.h"
#include "morsel/tools/batch/out_folder.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/render/request_text.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools::batch {

/// Everything that determines the results besides the meshes.
struct BatchRequest {
  ComparisonRequest comparison;
  core::BuildOptions build = {};
  bool items = true;          ///< whether reports list critical points and pairs
  bool thumbnails = true;     ///< whether there is a picture of the first and of the last method
  bool pages = false;         ///< what `compare --html` writes
  bool figures = false;       ///< --figures
  bool exports = false;       ///< --export
  render::FigureText figure;  ///< how pictures are taken, where there are any
};

/// One of the outputs of a mesh, besides its state.
struct Product {
  bool wanted;
  bool is_folder;
  std::string made;             ///< its name in the folder where it is made
  std::filesystem::path place;  ///< where it belongs
};
std::vector<Product> products_of(const std::string& name, const BatchRequest& request, const OutFolder& out);
/// The files of those that are wanted, as they are called in the folder `work` where they were made:
/// "report.json", "figures/sheet.png".
std::vector<std::string> made_files(const std::vector<Product>& products, const std::filesystem::path& work);
/// Where such a file belongs; empty if it is none of these.
std::filesystem::path place_of(const std::string& made_file, const std::vector<Product>& products);

/// Valid UTF-8 of any bytes (a path, an error), which JSON documents reproduce exactly.
std::string valid_text(const std::string& text);

/// {"tool", "request", "files"}: everything that determines reports, except the mesh. "files" has name and
/// hash of each file that a value in --field or --method names. Throws BadInput on one that cannot be read.
Json common_key(const BatchRequest& request);

/// `common` with the mesh's "sha256"; null for one that cannot be read.
Json mesh_key(const Json& common, const std::filesystem::path& mesh);

/// The words of the command line that `compare` and `batch` have in common.
std::vector<std::string> request_words(const BatchRequest& request);
/// These, and what `batch` makes of each mesh.
std::vector<std::string> batch_words(const BatchRequest& request);

/// The arguments of the program that compare one mesh, the program's name first; it writes its products into
/// `work`.
std::vector<std::string> compare_words(const BatchRequest& request, const CollectionMesh& mesh,
                                       const std::filesystem::path& work, const OutFolder& out, int threads);

}  // namespace morsel::tools::batch
