#include "morsel/tools/study/hierarchy.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/parallel/parallel.h"
#include "morsel/tools/study/iteration_levels.h"
#include "morsel/tools/study/matching.h"
#include "morsel/tools/study/persistence_levels.h"
#include "support/counted_method.h"
#include "support/fields.h"
#include "support/made.h"
#include "support/meshes.h"
#include "support/random_surfaces.h"
#include "support/shapes.h"

using namespace morsel;
using namespace morsel::test;
using core::kNone;
using core::ScalarField;
using morse::CriticalType;
using mscomplex::SegmentKind;
using tools::Level;
using tools::PointStatus;

namespace {

std::vector<Level> built(std::vector<tools::LevelSeed> seeds) {
  std::vector<Level> levels;
  tools::build_levels(std::move(seeds), [&](const Level& level) { levels.push_back(level); });
  return levels;
}

std::vector<Level> by_iteration(const ScalarField& field, const std::string& method,
                                const std::vector<int>& iterations) {
  const tools::MethodChain chain =
      tools::Registry::standard().make_method(tools::with_iterations(method, iterations.back()));
  return built(tools::iteration_levels(chain, {field.mesh(), {}},
                                       tools::Registry::standard().make_function("mean-curvature"), field,
                                       iterations)
                   .seeds);
}

/// A method that passes through given fields, after some of a first attempt.
class Scripted final : public core::Method {
 public:
  explicit Scripted(std::vector<ScalarField> fields, std::vector<ScalarField> first_try = {})
      : fields_(std::move(fields)), first_try_(std::move(first_try)) {}
  core::MethodResult apply(const ScalarField&, const core::MethodContext& context) const override {
    int iteration = 0;
    for (const ScalarField& field : first_try_) context.on_iteration(++iteration, field);
    iteration = 0;
    for (const ScalarField& field : fields_)
      if (!context.on_iteration(++iteration, field)) break;
    core::MethodResult result{fields_[static_cast<std::size_t>(iteration) - 1], {}, {}};
    result.end = {iteration, "script"};
    return result;
  }

 private:
  std::vector<ScalarField> fields_;
  std::vector<ScalarField> first_try_;
};

std::vector<Level> by_script(const ScalarField& input, const Scripted& method,
                             const std::vector<int>& iterations) {
  tools::MethodChain chain{"scripted", "scripted", {}};
  chain.steps.push_back({"scripted", std::make_unique<Scripted>(method)});
  return built(tools::iteration_levels(chain, {input.mesh(), {}},
                                       tools::Registry::standard().make_function("height"), input, iterations)
                   .seeds);
}

tools::FieldHierarchy hierarchy_of(const ScalarField& field) {
  return {std::make_shared<ScalarField>(field), std::make_shared<mscomplex::PersistenceHierarchy>(field)};
}

/// The levels after so many cancellations.
std::vector<Level> by_count(const ScalarField& field, const std::vector<std::size_t>& counts) {
  return built(tools::levels_by_count(hierarchy_of(field), counts));
}

std::size_t cells_left(const Level& level) {
  return level.points.minima + level.points.saddle_multiplicity + level.points.maxima;
}

/// (vertex, type, multiplicity) of all nodes but caps, those of a saddle vertex as one.
std::vector<std::tuple<Index, CriticalType, Index>> nodes(const mscomplex::MorseSmaleComplex& complex) {
  std::map<Index, std::pair<CriticalType, Index>> found;
  for (Index n = 0; n < complex.node_count(); ++n) {
    const mscomplex::Node node = complex.node(n);
    if (node.kind == mscomplex::NodeKind::cap) continue;
    auto& [type, multiplicity] = found[node.vertex];
    type = node.kind == mscomplex::NodeKind::minimum  ? CriticalType::minimum
           : node.kind == mscomplex::NodeKind::saddle ? CriticalType::saddle
                                                      : CriticalType::maximum;
    ++multiplicity;
  }
  std::vector<std::tuple<Index, CriticalType, Index>> result;
  for (const auto& [vertex, what] : found) result.emplace_back(vertex, what.first, what.second);
  return result;
}

/// What holds for the links of one kind of cells between two levels, from a plain map of areas.
void check_cells(const Level& finer, const Level& coarser, SegmentKind kind) {
  const std::vector<double> areas = mscomplex::triangle_areas(finer.field->mesh());
  std::map<std::pair<Index, Index>, double> shared;  // (finer, coarser)
  for (std::size_t t = 0; t < areas.size(); ++t)
    shared[{finer.cells(kind).triangle[t], coarser.cells(kind).triangle[t]}] += areas[t];
  std::vector<mscomplex::Overlap> merges(finer.label_count(kind));
  std::vector<mscomplex::Overlap> parents(coarser.label_count(kind));
  for (const auto& [pair, area] : shared) {
    if (merges[pair.first].segment == kNone || area > merges[pair.first].area)
      merges[pair.first] = {pair.second, area};
    if (parents[pair.second].segment == kNone || area > parents[pair.second].area)
      parents[pair.second] = {pair.first, area};
  }
  CHECK(finer.cell_links(kind).merges_into == merges);
  CHECK(coarser.cell_links(kind).parents == parents);
}

/// What holds for every hierarchy.
void check_levels(const std::vector<Level>& levels) {
  const Level* before = nullptr;
  for (const Level& level : levels) {
    const TriangleMesh& mesh = level.field->mesh();
    REQUIRE(level.place == static_cast<std::size_t>(&level - levels.data()));
    // The points are the complex's nodes.
    std::vector<std::tuple<Index, CriticalType, Index>> points;
    for (const auto& p : level.points.points) points.emplace_back(p.vertex, p.type, p.multiplicity);
    CHECK(points == nodes(level.complex));
    CHECK(level.points.minima == level.complex.minimum_count());
    CHECK(level.points.saddle_multiplicity == level.complex.saddle_count());
    CHECK(level.points.maxima == level.complex.maximum_count());
    CHECK(level.points.total() == points.size());
    CHECK(level.persistence.size() == points.size());
    CHECK(static_cast<long>(level.points.minima + level.points.maxima) -
              static_cast<long>(level.points.saddle_multiplicity) ==
          mesh.euler_characteristic());
    // Parents are points of the level before, of the same type.
    REQUIRE(level.parents.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Index parent = level.parents[i];
      if (parent == kNone) continue;
      REQUIRE(before != nullptr);
      const auto found = std::ranges::find(before->points.points, parent, &morse::CriticalPoint::vertex);
      REQUIRE(found != before->points.points.end());
      CHECK(found->type == level.points.points[i].type);
    }
    CHECK(level.count(PointStatus::first) == (before == nullptr ? points.size() : 0));
    CHECK(level.count(PointStatus::first) + level.count(PointStatus::kept) + level.count(PointStatus::moved) +
              level.count(PointStatus::fresh) ==
          points.size());
    const std::vector<double> areas = mscomplex::triangle_areas(mesh);
    double whole = 0;
    for (const double area : areas) whole += area;
    for (const SegmentKind kind : mscomplex::kSegmentKinds) {
      const std::set<Index> carried(level.cells(kind).triangle.begin(), level.cells(kind).triangle.end());
      CHECK(level.labels(kind) == std::vector<Index>(carried.begin(), carried.end()));
      CHECK(level.labels(kind).size() == level.cells(kind).count);
      const tools::CellLinks& links = level.cell_links(kind);
      REQUIRE(links.areas.size() == level.label_count(kind));
      double sum = 0;
      for (const double area : links.areas) sum += area;
      CHECK(sum == Approx(whole));
      const std::vector<mscomplex::Overlap> none(links.areas.size());
      if (before == nullptr) CHECK(links.parents == none);
      if (&level == &levels.back()) CHECK(links.merges_into == none);
      if (before != nullptr) check_cells(*before, level, kind);
    }
    before = &level;
  }
}

/// Everything in which two runs must agree.
bool same(const Level& a, const Level& b) {
  const auto same_links = [](const tools::CellLinks& x, const tools::CellLinks& y) {
    return x.areas == y.areas && x.parents == y.parents && x.merges_into == y.merges_into;
  };
  return a.points.points == b.points.points && a.parents == b.parents && a.persistence == b.persistence &&
         std::ranges::equal(a.field->values(), b.field->values()) &&
         a.segmentation.morse_smale.triangle == b.segmentation.morse_smale.triangle &&
         std::ranges::equal(a.links, b.links, same_links);
}

/// A strip of unit squares, 9 × 3 vertices, high in its middle row at two places with a dip between them.
ScalarField two_bumps() {
  const TriangleMesh mesh = grid(9, 3).mesh();
  std::vector<double> values(27, 0);
  const double middle[] = {1, 4, 7, 6, 5, 6, 9, 4, 1};
  for (std::size_t i = 0; i < 9; ++i) {
    values[i] = middle[i] / 10 - 0.05;
    values[9 + i] = middle[i];
    values[18 + i] = middle[i] / 10;
  }
  return {mesh, std::move(values)};
}

}  // namespace

TEST_CASE("keys of documents for kinds of segments have no dashes") {
  CHECK(tools::key_of(SegmentKind::descending) == "descending");
  CHECK(tools::key_of(SegmentKind::ascending) == "ascending");
  CHECK(tools::key_of(SegmentKind::morse_smale) == "morse_smale");
}

TEST_CASE("two bumps that merge, by persistence") {
  const ScalarField field = two_bumps();
  const mscomplex::MorseSmaleComplex complex(field);
  REQUIRE(complex.maximum_count() == 2);
  const std::vector<Level> levels = built(tools::levels_by_threshold(
      hierarchy_of(field), {persistence::Threshold::absolute(2), persistence::Threshold::absolute(1)}));
  check_levels(levels);
  REQUIRE(levels.size() == 2);
  const Level& fine = levels[0];
  const Level& coarse = levels[1];
  CHECK(fine.name.asked == "1");
  CHECK(coarse.name.asked == "2");
  // The bump of 7 and the dip of 5 between the bumps have a persistence of 2.
  CHECK(fine.points.maxima == 2);
  CHECK(coarse.points.maxima == 1);
  CHECK(coarse.points.saddle_multiplicity + 1 == fine.points.saddle_multiplicity);
  CHECK(coarse.name.cancelled->largest == 2);
  CHECK(*coarse.name.cancelled->threshold == 2);
  // Which cells merge: those of the maxima at 11 and 15 into that of 15.
  const auto& links = fine.cell_links(SegmentKind::descending);
  CHECK(links.merges_into[0] == mscomplex::Overlap{0, links.areas[0]});
  CHECK(links.merges_into[1] == mscomplex::Overlap{0, links.areas[1]});
  CHECK(coarse.cell_links(SegmentKind::descending).parents[0].segment ==
        (links.areas[0] >= links.areas[1] ? 0 : 1));
  CHECK(coarse.count(PointStatus::kept) == coarse.points.total());
}

TEST_CASE("a hill that moves, one that appears and one that disappears, by iteration") {
  // The middle row of a strip is a range of hills; 2 % of the root of its area are more than 1 and less
  // than 2.
  const TriangleMesh mesh = moved(grid(100, 3).mesh(), Point(1, 20, 1).asDiagonal(), {0, 0, 0});
  const auto hills = [&](const std::vector<std::pair<int, double>>& tops) {
    std::vector<double> values;
    for (int v = 0; v < 300; ++v) {
      double height = 0;
      for (const auto& [x, top] : tops) height = std::max(height, top - 0.1 * std::abs(v % 100 - x));
      values.push_back(v / 100 == 1 ? height : height - 100);
    }
    return ScalarField(mesh, std::move(values));
  };
  const ScalarField input = hills({{20, 6}, {60, 9}});
  const Scripted method(
      {hills({{21, 6}, {60, 9}}), hills({{22, 6}, {60, 9}, {90, 7}}), hills({{60, 9}, {90, 7}})});
  const std::vector<Level> levels = by_script(input, method, {0, 2, 3});
  check_levels(levels);
  using Link = std::tuple<Index, Index, PointStatus>;  // vertex, parent, status
  const auto maxima = [](const Level& level) {
    std::vector<Link> found;
    for (std::size_t i = 0; i < level.points.points.size(); ++i)
      if (level.points.points[i].type == CriticalType::maximum)
        found.emplace_back(level.points.points[i].vertex, level.parents[i], level.status(i));
    return found;
  };
  CHECK(maxima(levels[0]) ==
        std::vector<Link>{{120, kNone, PointStatus::first}, {160, kNone, PointStatus::first}});
  CHECK(maxima(levels[1]) == std::vector<Link>{{122, 120, PointStatus::moved},
                                               {160, 160, PointStatus::kept},
                                               {190, kNone, PointStatus::fresh}});
  CHECK(maxima(levels[2]) == std::vector<Link>{{160, 160, PointStatus::kept}, {190, 190, PointStatus::kept}});
  // The cell of the hill that disappears merges into the one beside it.
  CHECK(levels[1].cell_links(SegmentKind::descending).merges_into[0].segment == 0);
  CHECK(levels[1].cell_links(SegmentKind::descending).merges_into[1].segment == 0);
  CHECK(levels[1].cell_links(SegmentKind::descending).merges_into[2].segment == 1);
}

TEST_CASE("parents are followed through all iterations between two levels") {
  const TriangleMesh mesh = sphere(2).mesh();
  const ScalarField field(mesh, smooth_values(mesh, 2, 5));
  const std::vector<Level> levels = by_iteration(field, "laplacian", {0, 1, 2, 3, 8});
  check_levels(levels);
  morse::CriticalPointTracker tracker(*levels[3].field, tools::matching_radius(mesh));
  const tools::MethodChain one = tools::Registry::standard().make_method("laplacian:iterations=1");
  ScalarField at = *levels[3].field;
  for (int i = 3; i < 8; ++i) {
    at = tools::apply_chain(one, {mesh, {}}, tools::Registry::standard().make_function("height"), at).field;
    tracker.advance(at);
  }
  CHECK(std::ranges::equal(at.values(), levels[4].field->values()));
  CHECK(levels[4].parents == std::vector<Index>(tracker.origins().begin(), tracker.origins().end()));
}

TEST_CASE("levels by iteration are the fields of the method, linked") {
  for (const NamedMesh& entry : mesh_zoo())
    for (const NamedField& f : field_zoo(entry.mesh, 31)) {
      INFO(entry.name << " | " << f.name);
      const std::vector<Level> levels = by_iteration(f.field, "salient:sigma=0.6", {0, 1, 3});
      check_levels(levels);
      for (const int k : {0, 1, 3}) {
        const tools::MethodChain chain =
            tools::Registry::standard().make_method("salient:sigma=0.6,iterations=" + std::to_string(k));
        const ScalarField alone =
            tools::apply_chain(chain, {entry.mesh, {}}, tools::Registry::standard().make_function("height"),
                               f.field)
                .field;
        const Level& level = levels[k == 3 ? 2 : static_cast<std::size_t>(k)];
        CHECK(level.name.iteration == k);
        CHECK(std::ranges::equal(level.field->values(), alone.values()));
        CHECK(level.points.points == morse::classify(alone).points);
      }
    }
}

TEST_CASE("levels by persistence are nested") {
  std::vector<std::pair<std::string, TriangleMesh>> meshes;
  for (const NamedMesh& entry : mesh_zoo()) meshes.emplace_back(entry.name, entry.mesh);
  for (unsigned seed = 0; seed < 60; ++seed)
    meshes.emplace_back("random surface " + std::to_string(seed), random_surface(seed));
  for (const auto& [name, mesh] : meshes)
    for (const NamedField& f : field_zoo(mesh, 32)) {
      INFO(name << " | " << f.name);
      const std::size_t all = cells_left({by_count(f.field, {1'000'000}).front()});
      const std::vector<Level> levels = by_count(f.field, {1, all / 3 + 1, all / 2 + 1, all});
      check_levels(levels);
      CHECK(cells_left(levels.front()) == all);
      CHECK(levels.front().points.points == morse::classify(f.field).points);
      for (std::size_t k = 1; k < levels.size(); ++k) {
        const Level& level = levels[k];
        const std::size_t asked = *level.name.cancelled->count;
        CHECK((cells_left(level) == asked) == level.name.note.empty());
        CHECK(cells_left(level) == all - 2 * level.name.cancelled->cancellations);
        CHECK(level.count(PointStatus::kept) == level.points.total());
        // A cell lies in one coarser cell as a whole.
        for (const SegmentKind kind : mscomplex::kSegmentKinds) {
          const tools::CellLinks& links = levels[k - 1].cell_links(kind);
          for (const Index label : levels[k - 1].labels(kind))
            REQUIRE(links.merges_into[label].area == links.areas[label]);
        }
      }
    }
}

TEST_CASE("persistence by which points go is that of the diagram") {
  const TriangleMesh mesh = torus(12, 9).mesh();
  for (const NamedField& f : field_zoo(mesh, 33)) {
    INFO(f.name);
    const Level level = by_count(f.field, {1'000'000}).front();
    const std::vector<double> of_diagram =
        persistence::vertex_persistence(persistence::pair_extrema(f.field), mesh.vertex_count());
    for (std::size_t i = 0; i < level.points.points.size(); ++i)
      CHECK(level.persistence[i] == of_diagram[level.points.points[i].vertex]);
  }
}

TEST_CASE("levels are the same for every number of threads") {
  const TriangleMesh mesh = punctured_sphere(5, 4).mesh();
  const ScalarField field(mesh, smooth_values(mesh, 1, 34));
  const auto with = [&](int threads) {
    const core::ThreadLimit limit(threads);
    std::vector<Level> levels = by_iteration(field, "salient:sigma=0.1", {0, 2, 3});
    for (Level& level : by_count(field, {2000, 500, 20})) levels.push_back(std::move(level));
    return levels;
  };
  const std::vector<Level> one = with(1);
  for (const int threads : {2, 7}) CHECK(std::ranges::equal(one, with(threads), same));
}

TEST_CASE("a method that restarts leaves no levels of its first attempt") {
  // As salient smoothing does that gives way to the exact algorithm in the middle.
  const TriangleMesh mesh = sphere(1).mesh();
  const ScalarField field(mesh, random_values(mesh.vertex_count(), 35));
  const auto shifted = [&](double by) {
    std::vector<double> values = values_of(field);
    for (double& value : values) value += by;
    return ScalarField(mesh, std::move(values));
  };
  const Scripted method({shifted(1), shifted(2), shifted(3), shifted(4)}, {shifted(100), shifted(200)});
  for (const std::vector<int>& iterations : {std::vector<int>{0, 1, 3}, {1, 3}, {2, 3}, {4}}) {
    const std::vector<Level> levels = by_script(field, method, iterations);
    check_levels(levels);
    REQUIRE(levels.size() == iterations.size());
    for (std::size_t i = 0; i < levels.size(); ++i) {
      CHECK(levels[i].field->value(0) == field.value(0) + iterations[i]);
      if (i > 0) CHECK(levels[i].count(PointStatus::kept) == levels[i].points.total());
    }
  }
  CHECK_THROWS_WITH(by_script(field, method, {2, 5}),
                    Catch::Contains("iterations (script), so that level 5"));
}

TEST_CASE("a method's text with the iterations that levels need") {
  using tools::with_iterations;
  CHECK(with_iterations("salient", 7) == "salient:iterations=7");
  CHECK(with_iterations("salient:sigma=2", 7) == "salient:sigma=2,iterations=7");
  CHECK(with_iterations("salient:iterations=9,sigma=2", 7) == "salient:iterations=9,sigma=2");
  CHECK(with_iterations("tps+laplacian", 2) == "tps+laplacian:iterations=2");
  CHECK(with_iterations("salient:iterations=1+laplacian", 2) ==
        "salient:iterations=1+laplacian:iterations=2");
  for (const char* text : {"tps", "fair", "spectral", "conventional", "saliency", "salient+tps",
                           "salient:iterations=6", "salient:iterations=x", "nonsense", ""})
    CHECK_THROWS_AS(with_iterations(text, 7), core::InvalidArgument);
}

TEST_CASE("requests for hierarchies are checked and completed") {
  using tools::HierarchyKind;
  const auto prepared = [](HierarchyKind kind, const std::string& levels, const std::string& counts = "") {
    tools::HierarchyRequest request;
    request.kind = kind;
    request.levels = levels;
    request.counts = counts;
    return tools::prepare(request);
  };
  CHECK(prepared(HierarchyKind::iteration, "").iterations == std::vector<int>{1, 5, 10});
  CHECK(prepared(HierarchyKind::iteration, "30,0,2").iterations == std::vector<int>{0, 2, 30});
  CHECK(prepared(HierarchyKind::iteration, "").field.chain.name == "salient");
  CHECK(prepared(HierarchyKind::persistence, "").field.chain.name == "conventional");
  CHECK(prepared(HierarchyKind::persistence, "").thresholds.size() == 3);
  CHECK(prepared(HierarchyKind::persistence, "", "9,3").counts == std::vector<std::size_t>{9, 3});
  CHECK(prepared(HierarchyKind::persistence, "", "9,3").thresholds.empty());
  for (const char* levels : {"1,1", ",", "1,", "-1", "1%", "1.5", "1000001", "x"})
    CHECK_THROWS_AS(prepared(HierarchyKind::iteration, levels), core::InvalidArgument);
  for (const char* levels : {"1%,1%", ",", "-1", "nan", "inf%", "x"})
    CHECK_THROWS_AS(prepared(HierarchyKind::persistence, levels), core::InvalidArgument);
  for (const char* counts : {"0", "5,5", "5%", "-3"})
    CHECK_THROWS_AS(prepared(HierarchyKind::persistence, "", counts), core::InvalidArgument);
  CHECK_THROWS_AS(prepared(HierarchyKind::persistence, "1%", "5"), core::InvalidArgument);
  CHECK_THROWS_AS(prepared(HierarchyKind::iteration, "", "5"), core::InvalidArgument);
}

TEST_CASE("a hierarchy is made with a method of one's own") {
  Counts counts;
  const tools::Registry registry = registry_with_counted(counts);
  tools::HierarchyRequest request{
      .field = {.field = "height", .method = "counted", .target = {}}, .levels = "0,2,3", .counts = {}};
  CHECK_THROWS_AS(tools::prepare(request), core::InvalidArgument);
  struct Kept : tools::HierarchySink {
    void begin(const tools::HierarchyBasis&) override {}
    void level(const Level& level) override { extents.push_back(level.field->extent()); }
    std::vector<double> extents;
  } kept;
  run_hierarchy({jittered(sphere(2).mesh(), 0.01, 3), {}}, tools::prepare(request, registry), {&kept});
  CHECK(counts.iterations == 3);
  REQUIRE(kept.extents.size() == 3);
  CHECK(kept.extents[1] == Approx(kept.extents[0] / 4));
  CHECK(kept.extents[2] == Approx(kept.extents[0] / 8));

  CHECK(tools::with_iterations("tps+counted", 7, registry) == "tps+counted:iterations=7");
  CHECK_THROWS_WITH(tools::with_iterations("tps", 7, registry), Catch::Contains("counted"));
  request.field.method = "counted:iterations=2";
  CHECK_THROWS_WITH(tools::prepare(request, registry), Catch::Contains("level 3 is never reached"));
}
