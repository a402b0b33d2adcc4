#pragma once
/// The results of the recipes.

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/tools/render/picture.h"
#include "morsel/tools/report/hashed_mesh.h"
#include "morsel/tools/reproduce/meshes.h"
#include "morsel/tools/reproduce/recipe.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools::reproduce {

/// A method on the field of one model, measured.
struct MethodRun {
  FieldPlan plan;
  MadeField made;
  Measurement measurement;
  double seconds = 0;  ///< of the method and of finding the critical points, as the paper counts

  std::size_t total() const { return measurement.critical_points.total(); }
};

/// A model: the mesh that stands in for it, and the methods' results on its fields, each run once.
class Model {
 public:
  /// A Morse function and a method, in the syntax of the command line.
  using RunName = std::pair<std::string, std::string>;

  /// Reads the mesh; throws what core::read_mesh() throws. A surface that is made is first written to
  /// `target`, with these comments.
  static Model read(const ModelRecipe& recipe, const MeshFile& file, const core::BuildOptions& build,
                    const core::Progress& progress = {});
  static Model make(const ModelRecipe& recipe, const MeshFile& file, const core::FileTarget& target,
                    const std::vector<std::string>& comments);

  const ModelRecipe& recipe() const { return recipe_; }
  const MeshFile& file() const { return file_; }
  const std::string& sha256() const { return sha256_; }
  const core::LoadedMesh& loaded() const { return loaded_; }
  const core::TriangleMesh& mesh() const { return loaded_.mesh; }
  const render::Studio& studio() const { return studio_; }

  /// The runs so far.
  const std::map<RunName, std::unique_ptr<const MethodRun>>& runs() const { return runs_; }
  /// Throws what make_field() and measure() throw.
  const MethodRun& run(const RunName& name, const core::Progress& progress = {});
  /// Of a method on the mean curvature.
  const MethodRun& run(const std::string& method, const core::Progress& progress = {}) {
    return run({std::string(kField), method}, progress);
  }

  /// The mean of the saliency percentiles (made_points.h) of these points; none without a point.
  std::optional<double> percentile(std::span<const core::Index> points, const core::Progress& progress = {});

 private:
  Model(const ModelRecipe& recipe, MeshFile file, HashedMesh mesh);

  const ModelRecipe& recipe_;
  MeshFile file_;
  core::LoadedMesh loaded_;
  std::string sha256_;
  render::Studio studio_;
  std::map<RunName, std::unique_ptr<const MethodRun>> runs_;
  std::vector<double> percentiles_;  // once they were asked for
};

/// The extrema of a run's field.
std::vector<core::Index> extrema_of(const MethodRun& run);

/// Where two panels are compared.
struct ComparedRegion {
  core::Index vertex = core::kNone;  ///< the mesh's number
  core::Length radius = {};
  std::size_t all = 0;    ///< critical points within the radius that both could keep
  std::size_t first = 0;  ///< of the first panel
  std::size_t second = 0;
  std::size_t places = 0;          ///< vertices that the view shows
  std::size_t more_of_first = 0;   ///< of these, where the first panel has more points within the radius
  std::size_t more_of_second = 0;  ///< where the second one has
};

struct PanelOutcome {
  const PanelRecipe* recipe = nullptr;
  std::string method;  ///< without placeholders
  const MethodRun* run = nullptr;
  std::string file;                        ///< name
  std::vector<std::string> shaping_words;  ///< of command(), but for the file's name
  std::string caption;                     ///< lines: title; method; counts; the paper's number
  std::string png;

  /// The words of the command line that makes the file.
  std::vector<std::string> command() const {
    std::vector<std::string> words = shaping_words;
    words.insert(words.end(), {"-o", file});
    return words;
  }
};

/// Counts from the links of one level of a hierarchy.
struct LevelLinks {
  std::size_t points = 0;
  std::size_t cells = 0;  ///< Morse-Smale segments
  std::size_t kept = 0;   ///< of the points, those at the vertex of their parent; 0 at the first level
  std::size_t moved = 0;
  std::size_t fresh = 0;
};

struct FigureOutcome {
  const FigureRecipe* recipe = nullptr;
  Model* model = nullptr;
  std::string file;  ///< name of the sheet
  std::vector<PanelOutcome> panels;
  std::optional<ComparedRegion> region;
  std::vector<LevelLinks> levels;
  std::string finding;
};

struct TableCell {
  const TableSetting* setting = nullptr;  ///< null of a conventional row
  const MethodRun* run = nullptr;
  std::optional<double> percentile = {};  ///< Model::percentile() of its extrema
};
struct TableRowOutcome {
  const TableRow* recipe = nullptr;
  Model* model = nullptr;
  std::vector<TableCell> cells;  ///< one of a conventional row, else one a setting
};

struct ControlOutcome {
  const ControlRecipe* recipe = nullptr;
  const TableRow* row = nullptr;
  Model* model = nullptr;
  const MethodRun* run = nullptr;
  std::size_t extrema = 0;           ///< that the percentile is of
  std::optional<double> percentile;  ///< Model::percentile()
};

}  // namespace morsel::tools::reproduce
