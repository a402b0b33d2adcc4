#pragma once
/// Cancelling any number of pairs of one field. For the module's own use.

#include <span>
#include <vector>

#include "morsel/core/field/scalar_field.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/persistence/diagram.h"
#include "morsel/persistence/reconstruction.h"
#include "morsel/persistence/sweep.h"

namespace morsel::persistence::detail {

/// The data that all cancellations of one field share. Refers to field and progress, which must outlive it.
class Canceller {
 public:
  /// Computes the sweeps and the pairs; O(n) and O(s log s).
  Canceller(const core::ScalarField& f, const core::Progress& progress);

  const core::ScalarField& field() const { return f_; }
  /// The diagram of the field, with unsorted pairs.
  const Diagram& diagram() const { return diagram_; }

  /// The field without the finite pairs that do not stay; f itself if all do. O(n) and O(s log s).
  core::ScalarField run(std::span<const PersistencePair> staying) const;

 private:
  std::vector<Role> survivors(std::span<const PersistencePair> staying) const;

  const core::ScalarField& f_;
  const core::Progress& progress_;
  Sweeps sweeps_;
  Diagram diagram_;
};

}  // namespace morsel::persistence::detail
