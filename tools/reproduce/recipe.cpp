#include "morsel/tools/reproduce/recipe.h"

#include "morsel/tools/reproduce/findings.h"
#include "morsel/tools/reproduce/torus.h"

namespace morsel::tools::reproduce {
namespace {

using render::Show;

enum ModelNumber : std::size_t { lion, squirrel, protein, torus };

// In all figures: range=local,support=1, with which the numbers of the paper's table come out: a ball of
// radius σ, and for σ_s the largest difference in it, the second of the two choices that the paper names.

}  // namespace

std::span<const ModelRecipe> models() {
  static const std::vector<ModelRecipe> kModels = {
      {"lion",
       "the back of a lion's head, 24K vertices",
       {},
       "lion-head.off",
       "a scanned lion's head, open at the back"},
      {"squirrel",
       "a squirrel with light noise, 10K vertices",
       {},
       "bunny00.off",
       "the scanned Stanford bunny"},
      {"protein",
       "the molecular surface of phospholipase A2 (2bp2), 8K vertices",
       {"1bp2", "2bp2"},
       "retinal.off",
       "the surface of a small molecule, retinal"},
      {.name = "torus",
       .paper = "a torus that stands on its side",
       .make = standing_torus,
       .view = "25/15",
       .up = render::UpAxis::z}};
  return kModels;
}

std::span<const FigureRecipe> figures() {
  static const std::vector<FigureRecipe> kFigures = {
      {1,
       lion,
       "Salient critical points",
       "Mean curvature (a) is noisy, and has many critical points (b). Mesh saliency (c) takes in the hair's "
       "texture and not the noise. What is left by 10 iterations (d) is few, and lies in the interesting "
       "regions.",
       {{.title = "mean curvature", .method = "conventional", .points = false, .scale = "curvature"},
        {.title = "its critical points",
         .method = "conventional",
         .scale = "curvature",
         .paper = "7,629 critical points"},
        {.title = "mesh saliency", .method = "saliency:scales=2eps/3eps/4eps/5eps/6eps", .points = false},
        {.title = "salient critical points, 10 iterations",
         .method = "salient:iterations=10,range=local,support=1",
         .paper = "493 critical points"}},
       {},
       {},
       {},
       fewer_and_where},
      {2,
       lion,
       "Their Morse-Smale complexes",
       "The full complex (a) is too complicated for many uses; that of the salient critical points (b) is "
       "simpler "
       "and more uniform.",
       {{.title = "full complex of Figure 1(b)",
         .method = "conventional",
         .show = Show::morse_smale,
         .arcs = true,
         .paper = "7,629 critical points"},
        {.title = "complex of Figure 1(d)",
         .method = "salient:iterations=10,range=local,support=1",
         .show = Show::morse_smale,
         .arcs = true,
         .paper = "493 critical points"}},
       {},
       {},
       {},
       simpler_complex},
      {3,
       squirrel,
       "Salient critical points and persistence cancellation (TPS)",
       "With about as many points in (b) as in (c), TPS keeps a cluster of them at the noisy left eye (d), "
       "because "
       "noise there is more persistent than the threshold; salient smoothing leaves one (e).",
       {{.title = "all critical points", .method = "conventional", .arcs = true, .scale = "curvature"},
        {.title = "TPS",
         .method = "tps:count={c}",
         .arcs = true,
         .scale = "curvature",
         .region = Region::framed,
         .paper = "141 critical points, threshold 0.1 %"},
        {.title = "salient, 20 iterations",
         .method = "salient:iterations=20,range=local,support=1",
         .arcs = true,
         .scale = "smoothed",
         .region = Region::framed,
         .paper = "152 critical points"},
        {.title = "TPS, magnified",
         .method = "tps:count={c}",
         .arcs = true,
         .scale = "curvature",
         .region = Region::close_up},
        {.title = "salient, magnified",
         .method = "salient:iterations=20,range=local,support=1",
         .arcs = true,
         .scale = "smoothed",
         .region = Region::close_up}},
       std::array<std::size_t, 3>{0, 1, 2},
       {},
       {},
       region_compared},
      {4,
       protein,
       "A hierarchy of a molecular surface",
       "Iterations give a hierarchy of complexes, with fewer and larger segments from level to level; "
       "critical points "
       "may move.",
       {{.title = "1 iteration",
         .method = "salient:iterations=1,range=local,support=1",
         .show = Show::morse_smale,
         .arcs = true,
         .paper = "741 critical points"},
        {.title = "5 iterations",
         .method = "salient:iterations=5,range=local,support=1",
         .show = Show::morse_smale,
         .arcs = true},
        {.title = "10 iterations",
         .method = "salient:iterations=10,range=local,support=1",
         .show = Show::morse_smale,
         .arcs = true,
         .paper = "257 critical points"}},
       {},
       "salient:range=local,support=1",
       "1,5,10",
       levels_linked},
      {.number = 0,
       .model = torus,
       .title = "The absolute difference of mesh saliency",
       .paper =
           "The highest and the lowest vertex of the torus have the same saliency by the absolute difference "
           "of equation (2): the lowest is taken for a maximum.",
       .panels = {{.title = "height", .method = "conventional", .paper = "4 critical points"},
                  {.title = "absolute difference, equation (2)",
                   .method = "saliency:scales=20eps,suppression=none"},
                  {.title = "difference with its sign, equation (4)",
                   .method = "salient:iterations=1,range=local,support=1,sigma=20eps,classify=saliency"},
                  {.title = "salient, 10 iterations",
                   .method = "salient:iterations=10,range=local,support=1"}},
       .finding = types_of_ends,
       .section = "3.1",
       .field = "height:axis=z"}};
  return kFigures;
}

std::string FigureRecipe::file_stem() const {
  return number > 0 ? "figure" + std::to_string(number) : "section" + std::string(section);
}

std::string FigureRecipe::name() const {
  return number > 0 ? "Figure " + std::to_string(number) : "Section " + std::string(section);
}

std::span<const TableRow> table_rows() {
  static constexpr std::array<TableRow, 7> kRows = {{{lion, "1(b)", 0, 7629, {}},
                                                     {lion, "1(d)", 10, 493, 3.9},
                                                     {squirrel, "3(a)", 0, 2864, {}},
                                                     {squirrel, "3(c)", 20, 152, 1.4},
                                                     {protein, "", 0, {}, {}},
                                                     {protein, "4(a)", 1, 741, 0.13},
                                                     {protein, "4(b)", 10, 257, 0.63}}};
  return kRows;
}

std::span<const TableSetting> table_settings() {
  static constexpr std::array<TableSetting, 4> kSettings = {
      {{"range=local,support=1", "σ_s the largest difference in the ball, radius σ"},
       {"range=literal,support=1", "σ_s = σ, as the paper has it, radius σ"},
       {"range=1std,support=1", "σ_s the field's standard deviation, radius σ"},
       {"range=1std,support=2", "the same with radius 2σ, the program's default"}}};
  return kSettings;
}

std::span<const ControlRecipe> controls() {
  static constexpr std::array<ControlRecipe, 5> kControls = {
      {{"the paper's method", "salient:iterations={n},range=local,support=1"},
       {"without the weight of values", "salient:iterations={n},range=none,support=1"},
       {"persistence at equal count", "tps:count={k}"},
       {"extrema by persistence and saliency", "conventional", morse::PointRank::salience},
       {"all critical points", "conventional"}}};
  return kControls;
}

}  // namespace morsel::tools::reproduce
