#include "molecule_checks.h"
#include "morsel/core/error.h"
#include "target.h"

void morsel::fuzz::pqr(std::string_view bytes) {
  try {
    check_atoms(core::read_pqr(bytes, "fuzz", {}));
  } catch (const core::BadInput&) {
  }
}
