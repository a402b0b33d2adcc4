#pragma once
/// Requests as the words of the command line that make them again. Every command that shows, runs or records
/// a command line has its words from here, those of pictures from render/request_words.h; for each option of
/// the tables that shapes a result, a test (tests/commands) checks that the words have it.

#include <string>
#include <vector>

#include "morsel/tools/study/made_field.h"

namespace morsel::tools {

/// --repair, --weld and --mask.
std::vector<std::string> words_of(const core::BuildOptions& build);
/// --field, --method, --target, --snap, --repair, --weld, --mask and the options of chosen points of the
/// commands that run several methods.
std::vector<std::string> words_of(const ComparisonRequest& request, const core::BuildOptions& build);
/// --field, --method, --target, --repair, --weld and --mask of the commands on one field.
std::vector<std::string> words_of(const FieldRequest& request, const core::BuildOptions& build);
/// --points, --kind, --rank, --spacing, --fill, --salience-scale and --percentiles.
std::vector<std::string> words_of(const PointsRequest& request);

}  // namespace morsel::tools
