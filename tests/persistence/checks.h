#pragma once
/// What must hold for pairs and for cancelled fields, each check as a sentence about the first contradiction
/// (empty if there is none), so that a test can run thousands and report one.

#include <cstddef>
#include <string>

#include "morsel/persistence/cancellation.h"
#include "morsel/persistence/diagram.h"

namespace morsel::test {

/// Component by component: finite pairs + infinite pairs + essential saddles = saddle multiplicity, 2 × genus
/// essential saddles, a pair for each extremum and cap that is not essential; the documented order; the
/// look-ups.
std::string diagram_contradiction(const core::ScalarField& field, const persistence::Diagram& diagram);

/// The same pairs and essential classes, with their values, as PHAT gives.
std::string oracle_contradiction(const core::ScalarField& field, const persistence::Diagram& diagram);

/// Invariant 5: g is f without the first `cancelled` pairs of f's diagram. The number of pairs of non-zero
/// persistence is compared if `threshold_mode` (with a count, a pair as short as the longest cancelled one
/// may stay, and shrink to nothing).
std::string cancellation_contradiction(const core::ScalarField& f, const persistence::Diagram& diagram,
                                       std::size_t cancelled, const core::ScalarField& g,
                                       bool threshold_mode);

}  // namespace morsel::test
