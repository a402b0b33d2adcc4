#include "molecule_checks.h"
#include "morsel/core/error.h"
#include "target.h"

void morsel::fuzz::mmcif(std::string_view bytes) {
  try {
    check_atoms(core::read_mmcif(bytes, "fuzz", {}));
  } catch (const core::BadInput&) {
  }
}
