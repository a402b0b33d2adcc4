#include "morsel/tools/reproduce/reproduction.h"

#include <string_view>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/text/nearest_name.h"
#include "morsel/tools/formats/command_line.h"
#include "morsel/tools/reproduce/document.h"
#include "morsel/tools/reproduce/page.h"
#include "morsel/tools/reproduce/table.h"

namespace morsel::tools::reproduce {
namespace {

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const ModelRecipe& model : models()) names.emplace_back(model.name);
  return names;
}

/// Assigns "VALUE" to every model and "MODEL=VALUE" to one.
template <class Take>
void for_models(const std::string& text, const Take& take) {
  const std::size_t equals = text.find('=');
  const std::string value = equals == std::string::npos ? text : text.substr(equals + 1);
  bool known = equals == std::string::npos;
  for (std::size_t i = 0; i < models().size(); ++i) {
    if (equals != std::string::npos && models()[i].name != std::string_view(text).substr(0, equals)) continue;
    known = true;
    take(i, value);
  }
  const std::string name = text.substr(0, equals);
  if (!known)
    throw core::InvalidArgument("there is no model \"" + name + "\"" +
                                core::nearest_of(name, model_names(), "there are"));
}

render::UpAxis up_axis(const std::string& text) {
  std::vector<std::string> names;
  for (const render::UpAxis axis : {render::UpAxis::x, render::UpAxis::y, render::UpAxis::z}) {
    names.push_back(to_string(axis));
    if (text == names.back()) return axis;
  }
  throw core::InvalidArgument("the axis that points up " + core::must_be_one_of(names, text));
}

Model load(const ModelRecipe& recipe, const MeshFile& file, const Prepared& prepared, ResultFolder& folder,
           const core::Progress& progress) {
  if (!file.is_made) return Model::read(recipe, file, prepared.request.repair, progress);
  return Model::make(recipe, file, folder.claim(file.path), provenance_of(prepared.request, {}).lines());
}

}  // namespace

std::vector<std::string> command_words(const Request& request) {
  std::vector<std::string> words = {"morsel", "reproduce"};
  if (!request.data.empty()) add_option(words, "--data", request.data.string());
  add_option(words, "--meshes", request.samples.string());
  add_option(words, "--size", request.size);
  add_option(words, "--samples", std::to_string(request.pixel_samples));
  for (const std::string& view : request.views) add_option(words, "--view", view);
  for (const std::string& up : request.ups) add_option(words, "--up", up);
  add_flag(words, "--repair", request.repair);
  return words;
}

Prepared prepare(const Request& request) {
  PictureOptions pictures;
  pictures.size = render::parse_size(request.size);
  pictures.samples = request.pixel_samples;
  Prepared prepared{request, {}, std::vector<PictureOptions>(models().size(), pictures)};
  for (std::size_t i = 0; i < models().size(); ++i) {
    prepared.pictures[i].camera.view = models()[i].view;
    prepared.pictures[i].camera.up = models()[i].up;
    prepared.pictures[i].repair = request.repair && models()[i].make == nullptr;
  }
  for (const std::string& view : request.views)
    for_models(view, [&](std::size_t i, const std::string& value) {
      prepared.pictures[i].camera.view = value;
      prepared.pictures[i].camera.check();
    });
  for (const std::string& up : request.ups)
    for_models(up, [&](std::size_t i, const std::string& value) {
      prepared.pictures[i].camera.up = up_axis(value);
    });
  prepared.files = find_meshes(request.data, request.samples);
  return prepared;
}

Reproduction run(const Prepared& prepared, const core::Progress& progress) {
  ResultFolder folder(prepared.request.folder);
  core::FileWriter csv(folder.claim("table1.csv")), controls(folder.claim("controls.csv")),
      json_file(folder.claim("reproduction.json")), page(folder.claim("index.html"));

  Reproduction reproduction;
  const Stopwatch total;
  const auto timed = [&](const std::string& step, const auto& work) {
    const Stopwatch watch;
    work();
    reproduction.timings.emplace_back(step, watch.seconds());
  };
  timed("load", [&] {
    for (std::size_t i = 0; i < models().size(); ++i)
      reproduction.models.push_back(
          std::make_unique<Model>(load(models()[i], prepared.files[i], prepared, folder, progress)));
  });
  timed("methods", [&] { reproduction.table = make_table(reproduction.models, progress); });
  timed("controls", [&] { reproduction.controls = make_controls(reproduction.models, progress); });
  for (const FigureRecipe& figure : figures())
    timed(figure.file_stem(), [&] {
      Model& model = *reproduction.models[figure.model];
      reproduction.figures.push_back(make_figure(figure, model, prepared.pictures[figure.model], folder,
                                                 provenance_of(prepared.request, {&model}), progress));
    });
  reproduction.timings.emplace_back("total", total.seconds());

  write_table_csv(csv.stream(), reproduction.table);
  write_controls_csv(controls.stream(), reproduction.controls);
  JsonStream json(json_file.stream());
  write_document(json, prepared, reproduction);
  page.write(make_page(prepared, reproduction));
  csv.commit();
  controls.commit();
  json_file.commit();
  page.commit();
  return reproduction;
}

}  // namespace morsel::tools::reproduce
