#pragma once
/// The reproduction: figures, table, numbers and page in one folder.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "morsel/core/parallel/progress.h"
#include "morsel/tools/reproduce/figure.h"

namespace morsel::tools::reproduce {

/// A request in the syntax of the command line.
struct Request {
  std::filesystem::path folder;
  std::filesystem::path data;  ///< meshes of the paper's models; none if empty
  std::filesystem::path samples = "build/samples";
  std::string size = "800x680";  ///< of a panel
  int pixel_samples = 16;
  std::vector<std::string> views;  ///< "VIEW" for all models or "MODEL=VIEW" for one
  std::vector<std::string> ups;    ///< "AXIS" or "MODEL=AXIS"
  core::BuildOptions build = {};
};

/// The command line of the request, without the folder, which changes nothing.
std::vector<std::string> command_words(const Request& request);

/// A checked request.
struct Prepared {
  Request request;
  std::vector<MeshFile> files;           ///< one a model
  std::vector<PictureOptions> pictures;  ///< one a model
};

/// Throws InvalidArgument on wrong values, and what find_meshes() throws. Reads no mesh.
Prepared prepare(const Request& request);

struct Reproduction {
  std::vector<std::unique_ptr<Model>> models;
  std::vector<FigureOutcome> figures;
  std::vector<TableRowOutcome> table;
  std::vector<ControlOutcome> controls;
  Timings timings;
};

/// Writes into the request's folder (result_folder.h) the figures (make_figure()), the surfaces that are
/// made, table1.csv, controls.csv, reproduction.json ("morsel.reproduction/1") and index.html, which holds
/// all pictures. Everything but seconds is the same at any number of threads. Throws what meshes, methods,
/// pictures and files throw; a folder that cannot be written to is refused before the work.
Reproduction run(const Prepared& prepared, const core::Progress& progress = {});

/// The table and the controls as text for a terminal.
std::string table_text(const Reproduction& reproduction);

}  // namespace morsel::tools::reproduce
