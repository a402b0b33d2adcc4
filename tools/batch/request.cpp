#include "morsel/tools/batch/request.h"

#include <algorithm>

#include "morsel/core/error.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/render/request_words.h"
#include "morsel/tools/report/build_options.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/report/input_files.h"
#include "morsel/tools/report/outcome_sections.h"
#include "morsel/tools/report/request_words.h"
#include "morsel/tools/results/file_list.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

bool has_pictures(const BatchRequest& request) { return request.thumbnails || request.figures; }

}  // namespace

std::string valid_text(const std::string& text) {
  return Json::parse(json_text(Json(text))).get<std::string>();
}

std::vector<Product> products_of(const std::string& name, const BatchRequest& request, const OutFolder& out) {
  return {{true, false, "report.json", out.report(name)},
          {request.thumbnails, false, "thumbnail.first.png", out.thumbnail(name, "first")},
          {request.thumbnails, false, "thumbnail.last.png", out.thumbnail(name, "last")},
          {request.pages, false, "page.html", out.page(name)},
          {request.figures, true, "figures", out.figures(name)},
          {request.exports, true, "exports", out.exports(name)}};
}

std::vector<std::string> made_files(const std::vector<Product>& products, const fs::path& work) {
  std::vector<std::string> files;
  for (const Product& product : products) {
    if (!product.wanted) continue;
    if (!product.is_folder) {
      files.push_back(product.made);
      continue;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(work / product.made))
      if (entry.path().filename() != FileList::kName)  // of the folder where they were made
        files.push_back(product.made + "/" + entry.path().filename().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path place_of(const std::string& made_file, const std::vector<Product>& products) {
  for (const Product& product : products) {
    if (made_file == product.made) return product.place;
    if (made_file.starts_with(product.made + "/"))
      return product.place / made_file.substr(product.made.size() + 1);
  }
  return {};
}

Json common_key(const BatchRequest& request) {
  const ComparisonRequest& asked = request.comparison;
  const render::FigureText& figure = request.figure;
  const auto if_any = [](bool any, const std::string& text) { return any ? Json(text) : Json(); };
  std::vector<HashedFile> files = input_files({asked.field});
  if (request.build.mask && !request.build.mask->file.empty())
    files.push_back({request.build.mask->file.string(), sha256_of_file(request.build.mask->file)});
  Json key = {{"tool", tool_section()},
              {"request",
               {{"field", asked.field},
                {"methods", asked.methods},
                {"target", asked.target ? Json(*asked.target) : Json()},
                {"snap", asked.snap},
                {"repair", request.build.repair},
                {"items", request.items},
                {"thumbnails", request.thumbnails},
                {"html", request.pages},
                {"figures", request.figures},
                {"export", request.exports},
                {"view", if_any(has_pictures(request), figure.camera.view)},
                {"up", if_any(has_pictures(request), to_string(figure.camera.up))},
                {"size", if_any(request.figures, figure.size)},
                {"inset", if_any(request.figures && !figure.camera.inset.empty(), figure.camera.inset)}}},
              {"files", files_section(files)}};
  add_build_options(key["request"], request.build);
  return Json::parse(json_text(key));  // as it is read back from a state
}

Json mesh_key(const Json& common, const fs::path& mesh) {
  Json key = common;
  key["sha256"] = nullptr;
  try {
    key["sha256"] = sha256_of(MeshOrigin{mesh});
  } catch (const core::BadInput&) {  // the reader of meshes reports the error
  }
  return key;
}

std::vector<std::string> request_words(const BatchRequest& request) {
  std::vector<std::string> words = words_of(request.comparison, request.build);
  add_flag(words, "--no-items", !request.items);
  if (!has_pictures(request)) return words;
  add_words(words, request.figures ? render::words_of(request.figure)
                                   : render::words_of_thumbnails(request.figure.camera));
  return words;
}

std::vector<std::string> batch_words(const BatchRequest& request) {
  std::vector<std::string> words = request_words(request);
  add_flag(words, "--no-thumbnails", !request.thumbnails);
  add_flag(words, "--html", request.pages);
  add_flag(words, "--figures", request.figures);
  add_flag(words, "--export", request.exports);
  return words;
}

std::vector<std::string> compare_words(const BatchRequest& request, const CollectionMesh& mesh,
                                       const fs::path& work, const OutFolder& out, int threads) {
  std::vector<std::string> words = {"morsel", "compare", "--quiet", "--threads=" + std::to_string(threads)};
  add_words(words, request_words(request));
  words.push_back("--output=" + (work / "report.json").string());
  if (request.thumbnails) words.push_back("--thumbnails=" + (work / "thumbnail").string());
  if (request.pages)
    words.insert(words.end(),
                 {"--html=" + (work / "page.html").string(), "--html-place=" + out.page(mesh.name).string()});
  if (request.figures) words.push_back("--figures=" + (work / "figures").string());
  if (request.exports) words.push_back("--export=" + (work / "exports").string());
  words.insert(words.end(), {"--", mesh.path.string()});
  return words;
}

}  // namespace morsel::tools::batch
