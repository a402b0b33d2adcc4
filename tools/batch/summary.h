#pragma once
/// One table and one document over a whole collection.

#include <filesystem>
#include <string>
#include <vector>

#include "morsel/tools/batch/batch.h"

namespace morsel::tools::batch {

struct SummaryOptions {
  std::string collection;     ///< as the user gave it
  bool with_timings = false;  ///< whether the table has a column of seconds, which differ from run to run
};

/// How many meshes have each status.
struct Tally {
  std::size_t done = 0;
  std::size_t failed = 0;
  std::size_t not_run = 0;
  std::size_t settled = 0;  ///< of the done and failed: by an earlier run
};
Tally tally(const std::vector<MeshOutcome>& outcomes);

std::string to_string(Status status);

/// Writes into the folder: summary.csv, a row for each mesh and method with all resolved parameters;
/// summary.json ("morsel.batch/1", see batch.schema.json), whose "timings" is all that differs between two
/// runs; plots/*.svg, distributions over the collection; and index.html, which shows all of these. Throws
/// WriteFailed.
void write_summary(const std::vector<MeshOutcome>& outcomes, const BatchRequest& request,
                   const SummaryOptions& options, ResultFolder& out);

/// Throws WriteFailed if one of these files could not be written because a file that is not the program's is
/// in its place.
void check_summary(ResultFolder& out);

/// A method's number of pairs with a persistence over 1 % of its field's extent, infinite ones included.
std::size_t pairs_over_one_percent(const Json& method);

}  // namespace morsel::tools::batch
