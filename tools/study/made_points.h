#pragma once
/// Chosen critical points of a field as the command line asks for them.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/chosen_points.h"
#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

/// In the words of the command line.
struct PointsRequest {
  std::size_t count = 20;
  morse::PointKind kind = morse::PointKind::extrema;
  morse::PointRank rank = morse::PointRank::persistence;
  core::Length spacing = core::Length::percent(5);  ///< along the surface, at least 0
  std::optional<std::string> fill;                  ///< the Morse function that fills up, if there is one
  std::optional<core::Length> scale;  ///< σ of mesh_salience(); none: the last method's sigma, or else 8ε
};

/// A request whose names have been looked up.
struct PointsPlan {
  PointsRequest request;
  std::optional<NamedFunction> fill;
};

/// Throws InvalidArgument on unknown names and keys, bad values, a count of 0, a negative spacing, and a
/// scale without rank=salience. Touches no file.
PointsPlan prepare(const PointsRequest& request, const Registry& registry = Registry::standard());

struct MadePoints {
  morse::ChosenPoints chosen;
  std::vector<std::size_t> candidates;  ///< of the field, and of the one that fills up
  std::optional<FieldOutcome> fill;     ///< if it was needed
  std::optional<double> scale;          ///< with rank=salience, in the mesh's unit
  std::vector<double> percentiles;      ///< of each chosen point: see saliency_percentiles()
  std::string note;                     ///< why there are fewer points than asked for; empty if there are not

  /// The mean of the percentiles; none without a point.
  std::optional<double> mean_percentile() const;
};

/// For each vertex the share of all vertices that have less mesh saliency (of the mean curvature, with the
/// scales of Lee et al.), half of those that have as much included: ½ on average.
std::vector<double> saliency_percentiles(const core::TriangleMesh& mesh, const core::Progress& progress = {});

/// Chooses among the critical points of the made field and, where these are too few, of the one that fills
/// up, which is evaluated then only: `count` points, whatever the request says, without their percentiles.
MadePoints choose_points(const PointsPlan& plan, std::size_t count, const core::LoadedMesh& loaded,
                         const MadeField& made, const core::Progress& progress = {});

/// The same with as many points as the request says, and with their percentiles.
MadePoints make_points(const PointsPlan& plan, const core::LoadedMesh& loaded, const MadeField& made,
                       const core::Progress& progress = {});

}  // namespace morsel::tools
