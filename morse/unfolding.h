#pragma once
/// Unfolding a multiple saddle into simple ones.

#include <optional>

#include "morsel/core/field/scalar_field.h"

namespace morsel::morse {

struct Unfolding {
  core::ScalarField field;
  double change;  ///< how far the vertex was moved, in the field's unit; 0 on a plateau
};

/// Moves the value of one multiple saddle v so that some of its multiplicity goes to neighbours: there is one
/// saddle more, and neither the sum of multiplicities nor any extremum changes (Edelsbrunner, Harer,
/// Zomorodian 2003, "Hierarchical Morse-Smale complexes for piecewise linear 2-manifolds", unfold saddles in
/// the complex; here the field itself is changed, so that all measurements see separate saddles).
///
/// v is moved just past neighbours, to the value of the last one and next to it in the order, up or down, by
/// the least change of value that achieves this (of equal changes past the fewest neighbours, up rather than
/// down). Empty if v is no multiple saddle or no such change exists. O(n), and O(degree²) at v; the field is
/// copied.
std::optional<Unfolding> unfold_saddle(const core::ScalarField& field, core::Index v);

}  // namespace morsel::morse
