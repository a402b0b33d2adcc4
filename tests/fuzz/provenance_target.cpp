#include "morsel/core/error.h"
#include "morsel/tools/report/provenance.h"
#include "target.h"

void morsel::fuzz::provenance(std::string_view bytes) {
  try {
    const tools::Json found = tools::find_provenance(bytes);
    if (found.is_null()) return;
    require(found.is_object() && found.value("schema", "") == "morsel.provenance/1", "what provenance is");
    const std::string line = found.dump(-1, ' ', true);
    require(tools::find_provenance("some text\n# " + line + "\nmore\n") == found, "in a comment");
    require(tools::find_provenance(line) == found, "alone");
  } catch (const core::BadInput&) {
  }
}
