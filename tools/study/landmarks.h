#pragma once
/// Landmarks: how well chosen critical points agree with the points that people marked on a set of meshes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/study/bootstrap.h"
#include "morsel/tools/study/made_points.h"
#include "morsel/tools/study/mark_scores.h"
#include "morsel/tools/study/summary.h"

namespace morsel::tools {

/// A study in the syntax of the command line.
struct LandmarksRequest {
  std::vector<std::string> fields = {"gaussian-curvature:estimator=diffused"};
  std::vector<std::string> methods = {"conventional"};
  std::optional<std::size_t> count;                ///< points on each mesh; none: as many as it has marks
  PointsRequest choice;                            ///< how they are chosen; its own count is not used
  core::Length radius = core::Length::percent(5);  ///< of a hit, along the surface
  core::Length largest_radius = core::Length::percent(12);  ///< of the curves of errors
  std::uint64_t first = 0;                                  ///< the number of a file's first vertex: 0 or 1
  std::size_t resamples = 10'000;                           ///< of the intervals
  std::uint64_t seed = 1;                                   ///< of the chance rows and of the intervals
};

/// A request whose names have been looked up.
struct LandmarksPlan {
  /// The two rows of chance: random_points(), of which kPlacements sets are averaged, and spread_points().
  enum class Chance : std::uint8_t { random, farthest };
  static constexpr std::array kChances = {Chance::random, Chance::farthest};
  static constexpr std::size_t kCurveSteps = 24;

  LandmarksRequest request;
  std::vector<NamedFunction> functions;
  std::vector<MethodChain> chains;
  PointsPlan choice;

  /// Rows of the result: each field with each method, then those of chance.
  std::size_t made_rows() const { return functions.size() * chains.size(); }
  std::size_t rows() const { return made_rows() + kChances.size(); }
  std::size_t field_of(std::size_t row) const { return row / chains.size(); }
  std::size_t method_of(std::size_t row) const { return row % chains.size(); }
  std::size_t sets_of(std::size_t row) const { return row == made_rows() ? kPlacements : 1; }
  /// What a table calls a row: "random", "farthest points", else the field, the method, or both where there
  /// are several of each.
  std::string name_of(std::size_t row) const;
  /// The radius of a step of the curves, 0 to kCurveSteps, in the request's unit.
  double curve_radius(std::size_t step) const {
    return request.largest_radius.value * static_cast<double>(step) / kCurveSteps;
  }
};

/// Throws InvalidArgument on unknown names and keys, bad values, radii below 0 and fewer than 100 resamples.
/// Touches no file.
LandmarksPlan prepare(const LandmarksRequest& request, const Registry& registry = Registry::standard());

/// A mesh and the vertices that are marked on it, at least one, all different.
struct MarkedMesh {
  core::LoadedMesh loaded;
  std::vector<core::Index> marks;
  std::vector<std::string> warnings;
};

/// The meshes of a study.
class MarkedMeshes {
 public:
  virtual ~MarkedMeshes() = default;
  virtual std::size_t size() const = 0;
  virtual std::string name(std::size_t i) const = 0;  ///< for errors
  /// May be called from several threads at once.
  virtual MarkedMesh load(std::size_t i, const core::Progress& progress) = 0;
};

/// What a row has on one mesh.
struct LandmarkRow {
  std::vector<StepOutcome> steps;  ///< of the method: names and parameters; none of chance rows
  double min = 0;                  ///< of the field that the method made
  double max = 0;
  std::optional<FieldSummary> fill;   ///< the field that filled up, if it was needed
  std::optional<double> scale;        ///< of salience, if points are ranked by it
  std::vector<std::string> warnings;  ///< of the steps, each with its name
  std::string note;                   ///< why there are fewer points than wanted; empty if there are not
  std::vector<core::Index> points;    ///< as chosen, in the numbers of the mesh's file; none of random ones
  std::vector<MarkScore> sets;        ///< of the points, or of each set of random ones

  /// The mean of a quantity over the sets.
  template <class Quantity>
  double mean(const Quantity& quantity) const {
    double sum = 0;
    for (const MarkScore& score : sets) sum += quantity(score);
    return sum / static_cast<double>(sets.size());
  }
};

/// What the rows have on one mesh.
struct LandmarksOnMesh {
  std::size_t marks = 0;
  std::size_t wanted = 0;  ///< points
  double radius = 0;       ///< in the mesh's unit
  double spacing = 0;      ///< likewise
  std::vector<std::string> warnings;
  std::vector<FieldSummary> fields;  ///< of the functions, before any method
  std::vector<LandmarkRow> rows;
  double seconds = 0;
};

/// Results that are known, and a callback for new ones: an interrupted run continues from them. Both may be
/// called from several threads at once.
class LandmarksStore {
 public:
  virtual ~LandmarksStore() = default;
  virtual std::optional<LandmarksOnMesh> find(std::size_t mesh) = 0;
  virtual void add(std::size_t mesh, const LandmarksOnMesh& result) = 0;
};

/// Chooses points on every mesh for each row (PointMaker: as many as it has marks, or the wanted number)
/// and scores them against its marks. Meshes are done in parallel, and no more of them are in memory than
/// there are threads; the result of one depends on itself, the plan and the seed alone, so it is the same
/// whatever else is listed and at any number of threads. Throws what functions and methods throw; an error
/// names the mesh and the row, and of several it is that of the first mesh. Results that the `store`, if
/// there is one, has are taken from it.
std::vector<LandmarksOnMesh> run_landmarks(MarkedMeshes& meshes, const LandmarksPlan& plan,
                                           const core::Progress& progress = {},
                                           LandmarksStore* store = nullptr);

/// A mean over the meshes with its bootstrap interval.
struct MeshMean {
  double mean = 0;
  std::optional<Interval> interval = {};  ///< none of a single mesh
};

/// A row over all meshes, each of which counts alike.
struct LandmarksSummary {
  MeshMean points;
  MeshMean recall, precision, f_score;  ///< by hits
  MeshMean matched_recall, matched_precision, matched_f_score;
  MeshMean false_negatives, false_positives;
  MeshMean f_score_gain;           ///< over the first row, mesh by mesh
  std::optional<double> distance;  ///< of matched pairs in radii, over the meshes that have any
  std::size_t fewer = 0;           ///< meshes with fewer points than wanted
  std::vector<double> false_negatives_within, false_positives_within;  ///< by step of the curve
};

/// One for each row. O(meshes · resamples) for each quantity.
std::vector<LandmarksSummary> summarize(const LandmarksPlan& plan,
                                        const std::vector<LandmarksOnMesh>& meshes);

}  // namespace morsel::tools
