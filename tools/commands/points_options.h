#pragma once
/// The options of chosen points, the same in all commands that choose them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/tools/commands/command.h"
#include "morsel/tools/study/made_points.h"

namespace morsel::tools {

/// How points are chosen: what the options hold, and the defaults that a command gives them.
struct ChoiceOptions {
  /// --fill where no Morse function fills up.
  static constexpr std::string_view kNoFill = "none";

  PointsRequest points = {};  ///< what is read into it directly: kind, rank, percentiles
  std::string spacing = core::to_string(PointsRequest().spacing);
  std::string fill = std::string(kNoFill);
  std::string scale = {};

  /// The request, whose number of points is the default. Throws InvalidArgument on what is no length.
  PointsRequest request() const;
};

/// The same with the number of points.
struct PointsOptions {
  std::optional<std::size_t> count = {};  ///< by default none: no points are chosen
  ChoiceOptions choice = {};

  /// The request, if points are wanted. Throws InvalidArgument on what is no length.
  std::optional<PointsRequest> request() const;
};

/// --kind, --rank, --spacing, --fill and --salience-scale.
void add_choice_options(Command& command, ChoiceOptions& choice);

/// These with --points and --percentiles: under a heading of their own or, if help has no room, with names
/// alone and the command whose help tells them. Without a default number of points the others are refused
/// where --points is not given.
void add_points_options(Command& command, PointsOptions& options, const std::string& told_by = {});

/// Adds the files that the Morse function that fills up reads, if there is one, to a RunFiles or FieldRun.
template <class Files>
void reads_of_points(Files& files, const std::optional<PointsRequest>& request) {
  if (request && request->fill) files.reads_of_field(*request->fill, "--fill");
}

}  // namespace morsel::tools
