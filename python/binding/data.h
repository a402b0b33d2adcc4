#pragma once
/// The meshes, fields and results that Python's objects hold. None is changed once it is made; pointers to
/// them are not to constants since pybind11 holds none.

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "morsel/core/io/mesh_io.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/cutting.h"
#include "morsel/tools/study/hierarchy.h"
#include "morsel/tools/study/made_field.h"
#include "morsel/tools/study/made_points.h"
#include "morsel/tools/study/made_segments.h"
#include "morsel/tools/study/quadrangulation.h"
#include "morsel/tools/study/stability.h"
#include "morsel/tools/study/sweep.h"

namespace morsel::python {

/// A mesh, and what it was made from.
struct MeshData {
  core::LoadedMesh loaded;
  std::string path = {};                           ///< of its file, as given; empty for a mesh made in memory
  core::BuildOptions build = {};                   ///< how it was made of that
  std::filesystem::file_time_type file_time = {};  ///< last_change() before it was read
  std::string file = {};                           ///< `path`, made absolute when it was read

  const core::TriangleMesh& mesh() const { return loaded.mesh; }
};
using MeshHandle = std::shared_ptr<MeshData>;

/// When a mesh's file, or one that it names (core::companion_files()), was last changed.
inline std::filesystem::file_time_type last_change(const std::string& file, std::error_code& error) {
  auto time = std::filesystem::last_write_time(file, error);
  for (const std::filesystem::path& companion : core::companion_files(file)) {
    std::error_code missing;  // of which reading the mesh tells, if it needs it
    const auto changed = std::filesystem::last_write_time(companion, missing);
    if (!missing) time = std::max(time, changed);
  }
  return time;
}

/// How a field was made, in the syntax of the command line.
struct FieldStory {
  std::string function;                    ///< a Morse function: "height:axis=x"; empty if values were given
  std::string name;                        ///< of given values: their name as a property of a file
  std::string method;                      ///< a chain of methods; empty for none
  std::optional<std::size_t> target = {};  ///< of the last one
  bool is_request = true;                  ///< false: no command line makes it, so no document can hold it
  std::shared_ptr<const tools::FieldOutcome> input = {};  ///< what the function gave
  std::vector<tools::StepOutcome> steps = {};             ///< the methods' outcomes
  std::optional<tools::TargetOutcome> reached = {};
  double method_seconds = 0;
};

/// A field. The story is shared with what was made from it.
struct FieldData {
  MeshHandle mesh;
  std::shared_ptr<const core::ScalarField> field;
  FieldStory story;
};
using FieldHandle = std::shared_ptr<FieldData>;

/// A field of the mesh's own values, whose `name` is that of the property that would hold them. A field with
/// an order of its own is no request.
FieldHandle given_field(const MeshHandle& mesh, core::ScalarField field, const std::string& name,
                        bool is_request);

/// The Morse function in the syntax of the command line; of given values, the property that holds them.
std::string function_text(const FieldStory& story);
/// The chain of methods, "conventional" for none.
std::string method_text(const FieldStory& story);

/// The mesh with its own vertex numbers in place of the input's.
core::LoadedMesh in_own_numbers(const core::LoadedMesh& loaded);

/// The mesh on which function_text() gives the field's values: given ones are a property of it, in its own
/// numbers.
core::LoadedMesh mesh_with_values(const FieldData& field);

/// The steps of `chain`, which come after those that the field has: these are not read again, since their
/// names may stand for others now. Throws InvalidArgument for methods that can only be first.
tools::MethodChain steps_after(const FieldStory& story, const std::string& chain,
                               const tools::Registry& registry);
/// Whether the chain evaluates the Morse function again.
bool reevaluates(const tools::MethodChain& chain);
/// The Morse function for apply_chain(): the field's if the chain evaluates it again; any other one if not.
tools::NamedFunction function_for(const tools::MethodChain& chain, const FieldStory& story,
                                  const tools::Registry& registry);

/// The field itself if no method was applied to it, else one of its values. Throws InvalidArgument where the
/// order is not that of the values.
FieldHandle without_methods(const FieldHandle& field);

/// The field as a request makes it.
tools::MadeField made_field(const FieldData& field);

/// The field as documents take it: the request's plan, and what it made. Throws InvalidArgument for a field
/// that no one command line makes.
struct Documented {
  tools::FieldRequest request;
  tools::FieldPlan plan;
  tools::MadeField made;
};
Documented documented(const FieldData& field, const tools::Registry& registry);
/// The same for files that are not made again, of any field: without the plan.
Documented documented(const FieldData& field);

/// What a study was made of: a mesh and, if its field is one of given values, that field.
struct StudyInput {
  MeshHandle mesh;
  FieldHandle values = {};  ///< null: the field is a Morse function of the request

  core::LoadedMesh loaded() const { return values ? mesh_with_values(*values) : mesh->loaded; }
};

/// The input that a field is on.
StudyInput study_input(const FieldHandle& field);

/// The field of a study that is of a given one.
struct StudyField {
  std::string text;    ///< as function_text()
  FieldHandle values;  ///< null where the text is a Morse function
};
/// Throws as without_methods().
StudyField study_field(const FieldHandle& field);

/// A comparison and its results, row by row.
struct ComparisonData {
  StudyInput input;
  tools::ComparisonRequest request;
  std::shared_ptr<const tools::FieldOutcome> field;
  std::vector<std::shared_ptr<const tools::MethodOutcome>> methods;
};
using ComparisonHandle = std::shared_ptr<ComparisonData>;

struct SweepData {
  StudyInput input;
  tools::SweepRequest request;
  tools::SweepPlan plan;
  std::vector<tools::SweepRow> rows;
};
using SweepHandle = std::shared_ptr<SweepData>;

struct StabilityData {
  StudyInput input;
  tools::StabilityRequest request;  ///< with its defaults
  tools::StabilityPlan plan;
  tools::StabilityResult result;
};
using StabilityHandle = std::shared_ptr<StabilityData>;

/// Segments, chosen points, a cut, quads: each of a field.
struct SegmentsData {
  FieldHandle field;
  tools::SegmentRequest request;
  tools::MadeSegments made;
};
using SegmentsHandle = std::shared_ptr<SegmentsData>;

struct PointsData {
  FieldHandle field;
  tools::PointsRequest request;
  std::shared_ptr<const tools::MadePoints> made;
};
using PointsHandle = std::shared_ptr<PointsData>;

struct CutData {
  FieldHandle field;
  bool shorten = true;
  tools::CutOutcome made;
};
using CutHandle = std::shared_ptr<CutData>;

struct QuadsData {
  FieldHandle field;
  tools::QuadRequest request;
  tools::Quadrangulation made;
};
using QuadsHandle = std::shared_ptr<QuadsData>;

/// Levels of a hierarchy, and the request that makes the same ones.
struct LevelsData {
  FieldHandle field;  ///< of the finest level by persistence; the method's input by iteration
  tools::HierarchyRequest request;
  std::vector<std::shared_ptr<const tools::Level>> levels;
  std::vector<FieldHandle> fields;  ///< of each level by iteration; empty by persistence
};
using LevelsHandle = std::shared_ptr<LevelsData>;

}  // namespace morsel::python
