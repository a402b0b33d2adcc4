#pragma once
/// What `morsel reproduce` makes, as data: the paper's models, figures and table. A new figure is a new
/// entry.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/mesh/mesh.h"
#include "morsel/morse/chosen_points.h"
#include "morsel/tools/render/picture.h"

namespace morsel::tools::reproduce {

/// The Morse function of the paper's results.
inline constexpr std::string_view kField = "mean-curvature";

/// A model of the paper: a scan, which is not public, so that other meshes stand in for it, or a surface that
/// a formula makes.
struct ModelRecipe {
  std::string_view name;   ///< "lion": of the option, and of the file that is looked for first
  std::string_view paper;  ///< what the paper shows
  /// Other words in a file's name that identify this model.
  std::vector<std::string_view> words = {};
  std::string_view sample = {};            ///< file name of the sample mesh that stands in
  std::string_view sample_is = {};         ///< what it shows
  core::TriangleMesh (*make)() = nullptr;  ///< of a surface that is made: written as NAME.off
  std::string_view view = "best";
  render::UpAxis up = render::UpAxis::y;
};

/// The region in which two panels of a figure are compared, in a panel.
enum class Region : std::uint8_t { none, framed, close_up };

struct PanelRecipe {
  std::string_view title = {};
  /// A method in the syntax of the command line; "{c}" in it stands for the number of critical points of
  /// panel (c).
  std::string_view method = {};
  render::Show show = render::Show::field;
  bool points = true;
  bool arcs = false;
  /// Panels of a figure with the same word share the range of their colours; empty: its own.
  std::string_view scale = {};
  Region region = Region::none;
  std::string_view paper = {};  ///< the paper's number
};

struct FigureOutcome;

struct FigureRecipe {
  int number = 0;         ///< of the paper; 0 for what a section tells without a figure
  std::size_t model = 0;  ///< in models()
  std::string_view title;
  std::string_view paper;  ///< what the paper says about it
  std::vector<PanelRecipe> panels;
  /// Three panels (by number): the last two are compared where the first has most points.
  std::optional<std::array<std::size_t, 3>> compared = {};
  /// Panels that are levels of a hierarchy: the method without its iterations, and these.
  std::string_view hierarchy_method = {};
  std::string_view hierarchy_levels = {};
  /// Makes the sentences about the figure from its numbers.
  std::string (*finding)(const FigureOutcome& figure) = nullptr;
  std::string_view section = {};  ///< "3.1", where there is no number
  std::string_view field = kField;

  /// Of its files: "figure3", "section3.1".
  std::string file_stem() const;
  /// "Figure 3", "Section 3.1"
  std::string name() const;
};

/// A row of the paper's Table 1.
struct TableRow {
  std::size_t model = 0;
  std::string_view figure;  ///< "1(d)"
  int iterations = 0;       ///< 0: conventional
  std::optional<int> paper_points = {};
  std::optional<double> paper_seconds = {};
};

/// A column of results: a choice of what the paper leaves open.
struct TableSetting {
  std::string_view keys;  ///< of method salient, besides the iterations
  std::string_view note;
};

/// What the paper's method is compared with on the model of a row, at as many points as it leaves.
struct ControlRecipe {
  std::string_view title;
  /// In the syntax of the command line; "{n}" stands for the row's iterations, "{k}" for the number of
  /// critical points that the first control leaves.
  std::string_view method;
  /// Instead of all extrema of the method's field, as many as the first control leaves, by this rank.
  std::optional<morse::PointRank> rank = {};
};

std::span<const ModelRecipe> models();
std::span<const FigureRecipe> figures();
std::span<const TableRow> table_rows();
std::span<const TableSetting> table_settings();
/// The paper's method first; of each row of the table that iterates.
std::span<const ControlRecipe> controls();

}  // namespace morsel::tools::reproduce
