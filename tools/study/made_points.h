#pragma once
/// Chosen critical points of a field as the command line asks for them.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/morse/chosen_points.h"
#include "morsel/tools/study/chain.h"
#include "morsel/tools/study/field_outcome.h"

namespace morsel::tools {

/// In the words of the command line.
struct PointsRequest {
  std::size_t count = 20;
  morse::PointKind kind = morse::PointKind::extrema;
  morse::PointRank rank = morse::PointRank::persistence;
  core::Length spacing = core::Length::percent(5);  ///< along the surface, at least 0
  std::optional<std::string> fill = {};             ///< the Morse function that fills up, if there is one
  std::optional<core::Length> scale =
      {};                    ///< σ of mesh_salience(); none: the last method's sigma, or else 8ε
  bool percentiles = false;  ///< whether saliency percentiles are taken, too
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
  /// For each chosen point, the vertex at whose position it is reported: its own, but in a comparison that
  /// reports points at their origins.
  std::vector<core::Index> places;
  std::vector<std::size_t> candidates;  ///< of the field, and of the one that fills up
  std::optional<FieldOutcome> fill;     ///< if it was needed
  std::optional<double> scale;          ///< with rank=salience, in the mesh's unit
  bool has_percentiles = false;         ///< whether they were asked for
  std::vector<double> percentiles;      ///< of each chosen point, if so: saliency_percentiles()
  std::string note;                     ///< why there are fewer points than asked for; empty if there are not

  /// Of the i-th chosen point; none where percentiles were not asked for.
  std::optional<double> percentile(std::size_t i) const;
  /// The mean of the percentiles; none without a point, or where they were not asked for.
  std::optional<double> mean_percentile() const;
};

/// For each vertex the share of all vertices that have less mesh saliency (of the mean curvature, with the
/// scales of Lee et al.), half of those that have as much included: ½ on average.
std::vector<double> saliency_percentiles(const core::TriangleMesh& mesh, const core::Progress& progress = {});

/// A field to choose points of; refers to all of it.
struct PointsField {
  const std::string& name;  ///< of its Morse function
  const core::ScalarField& field;
  const std::vector<StepOutcome>& steps;  ///< of the method that made it
};

/// Chooses points of fields of one mesh. What depends on the mesh alone is computed once, when a field needs
/// it: the field that fills up, salience, percentiles.
class PointMaker {
 public:
  /// Refers to both, which must outlive it.
  PointMaker(const PointsPlan& plan, const core::LoadedMesh& loaded) : plan_(plan), loaded_(loaded) {}

  /// Chooses among the critical points of the field and, where these are too few, of the one that fills up,
  /// which is evaluated then only. Throws what Morse functions, mesh_salience() and saliency() throw.
  MadePoints make(const PointsField& from, const core::Progress& progress = {}) {
    return make(from, plan_.request.count, progress);
  }
  /// The same with another number of points than the request's.
  MadePoints make(const PointsField& from, std::size_t count, const core::Progress& progress = {});

 private:
  const std::vector<double>& salience_at(core::Length scale, const core::Progress& progress);

  const PointsPlan& plan_;
  const core::LoadedMesh& loaded_;
  std::optional<FieldOutcome> fill_;
  std::optional<morse::MeshSalience> salience_;
  std::map<double, std::vector<double>> weights_;  // by scale, in the mesh's unit
  std::vector<double> percentiles_;
};

struct MadeField;  // made_field.h

/// The points of one field.
MadePoints make_points(const PointsPlan& plan, const core::LoadedMesh& loaded, const MadeField& made,
                       const core::Progress& progress = {});

}  // namespace morsel::tools
