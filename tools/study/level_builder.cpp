#include "morsel/tools/study/level_builder.h"

#include <optional>
#include <utility>

#include "morsel/mscomplex/quad_regions.h"

namespace morsel::tools {
namespace {

/// The time of `run` is added to the level's timings.
template <class Run>
auto timed(Timings& timings, const char* step, const Run& run) {
  const Stopwatch watch;
  auto result = run();
  timings.emplace_back(step, watch.seconds());
  return result;
}

Level make_level(LevelSeed seed, std::size_t place, const core::Progress& progress) {
  Timings timings;
  auto complex = timed(timings, "complex",
                       [&] { return mscomplex::MorseSmaleComplex(*seed.field, seed.gradient(), progress); });
  core::Index quad_cells = 0;
  auto segmentation = timed(timings, "segmentation", [&] {
    quad_cells = mscomplex::cell_count(*seed.field, complex);
    return mscomplex::segment(*seed.field, complex.gradient(), progress);
  });
  return {place,
          std::move(seed.name),
          std::move(seed.field),
          std::move(seed.points),
          std::move(seed.persistence),
          std::move(seed.parents),
          std::move(complex),
          std::move(segmentation),
          quad_cells,
          {},
          std::move(timings)};
}

CellLinks unlinked(const Level& level, SegmentKind kind, const std::vector<double>& areas) {
  const core::Index count = level.label_count(kind);
  return {mscomplex::segment_areas(level.cells(kind).triangle, count, areas),
          std::vector<mscomplex::Overlap>(count), std::vector<mscomplex::Overlap>(count)};
}

void link(Level& finer, Level& coarser, const std::vector<double>& areas) {
  for (const SegmentKind kind : mscomplex::kSegmentKinds) {
    const auto k = static_cast<std::size_t>(kind);
    const mscomplex::OverlapTable table =
        mscomplex::overlaps(finer.cells(kind).triangle, finer.label_count(kind), coarser.cells(kind).triangle,
                            coarser.label_count(kind), areas);
    finer.links[k].merges_into = mscomplex::largest_overlaps(table);
    coarser.links[k].parents =
        mscomplex::largest_overlaps(mscomplex::transposed(table, coarser.label_count(kind)));
  }
}

}  // namespace

void build_levels(std::vector<LevelSeed> seeds, const std::function<void(const Level&)>& take,
                  const core::Progress& progress) {
  if (seeds.empty()) return;
  const std::vector<double> areas = mscomplex::triangle_areas(seeds.front().field->mesh());
  std::optional<Level> before;
  for (std::size_t place = 0; place < seeds.size(); ++place) {
    Level level = make_level(std::move(seeds[place]), place, progress);
    const Stopwatch watch;
    for (const SegmentKind kind : mscomplex::kSegmentKinds)
      level.links[static_cast<std::size_t>(kind)] = unlinked(level, kind, areas);
    if (before) link(*before, level, areas);
    level.timings.emplace_back("links", watch.seconds());
    if (before) take(*before);
    before.emplace(std::move(level));
  }
  take(*before);
}

}  // namespace morsel::tools
