// In place of the reading of atoms by gemmi, in a library without molecules.

#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/atom_records.h"

namespace morsel::core {

void require_molecules(std::string_view what) {
  throw InvalidArgument("this morsel was built without molecules, which " + std::string(what) +
                        " needs: build it with -DMORSEL_WITH_MOLECULES=ON, for which the packages gemmi-dev, "
                        "tao-pegtl-dev and libopenvdb-dev are needed");
}

AtomRecords read_pdb(std::string_view, const std::string&, const Progress&, std::int64_t) {
  require_molecules("a PDB file");
  return {};
}

AtomRecords read_mmcif(std::string_view, const std::string&, const Progress&, std::int64_t) {
  require_molecules("an mmCIF file");
  return {};
}

AtomRecords read_pqr(std::string_view, const std::string&, const Progress&) {
  require_molecules("a PQR file");
  return {};
}

}  // namespace morsel::core
