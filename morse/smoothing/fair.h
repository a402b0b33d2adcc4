#pragma once
/// Fair Morse functions: fields with chosen extrema only.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "morsel/core/field/method.h"
#include "morsel/morse/operators/laplacian.h"

namespace morsel::morse {

/// The fixed values of the chosen extrema.
enum class FairValues : std::uint8_t {
  ends,  ///< all minima at the input's least value, all maxima at its greatest: then they are the extrema,
         ///< exactly
  input  ///< each at its own value: a minimum of high value may become a maximum, others may become regular
};

struct FairOptions {
  FairValues values = FairValues::ends;
  EdgeWeights weights = EdgeWeights::clamped;  ///< clamped or uniform: not negative
};

struct FairResult {
  core::ScalarField field;
  std::size_t minima = 0;    ///< that were chosen
  std::size_t maxima = 0;    ///< that were chosen
  std::size_t left = 0;      ///< chosen ones that are extrema of the field; all of them with FairValues::ends
  std::size_t turned = 0;    ///< chosen minima that are maxima of the field, and vice versa; 0 with ends
  std::size_t rounding = 0;  ///< extrema that rounding of the solution caused and that were cancelled
  core::Index held_loops = 0;  ///< boundary loops whose caps were held at the greatest value
};

/// The persistence cancellation of MethodContext::cancel.
using Cancel = std::function<core::ScalarField(const core::ScalarField& field, double threshold)>;

/// A field g that is harmonic, Σ_j w_ij (g_i − g_j) = 0, at all vertices but the chosen `extrema` of `input`,
/// where it has the values that the options say (Ni, Garland, Hart 2004, "Fair Morse functions for extracting
/// the topological structure of a surface mesh").
///
/// A harmonic value is a mean of its neighbours' as long as no weight is negative, so it is no extremum.
/// Hence the clamped weights: cotangents are negative beyond obtuse angles. (After intrinsic Delaunay flips
/// they are not, but then along other edges than those that decide what is an extremum of this mesh.)
///
/// A boundary is free (natural conditions) where its component has a chosen maximum. A bounded component
/// needs none, since its caps are maxima at +∞; if it has none, each of its caps is held at the input's
/// greatest value and joined to the vertices of its loop by weight 1, or g would be constant.
///
/// Far from the extrema, in a finger of the surface say, g is constant to within rounding, and there
/// solutions have many extrema. They are cancelled: the chosen extrema are moved far outside of the range of
/// all other values, so that only they persist, whatever their own persistence. So the extrema of the result
/// are exactly the chosen ones, and the order of the vertices that comes with it is part of it. With
/// FairValues::input, where chosen extrema must stay where they are, the smallest threshold from 0, 10⁻¹⁵,
/// 10⁻¹⁴ … of the extent is taken that leaves no extremum elsewhere.
///
/// One factorisation, n^1.5, serial; the same bits for every number of threads. Throws InvalidArgument if a
/// vertex of `extrema` is not an extremum of the input or weights may be negative, and BadInput if a
/// component has no chosen minimum, or is closed and has no chosen maximum, with the least number of extrema
/// that this mesh needs.
FairResult fair(const core::ScalarField& input, std::span<const core::Index> extrema,
                const FairOptions& options, const Cancel& cancel, const core::Progress& progress = {});

/// The method "fair". Keys: extrema (default 8: the most persistent of the input, through the context; all if
/// it has fewer, and a note says so), values=ends|input, weights=clamped|uniform. Details: minima, maxima,
/// extrema_left, extrema_turned, rounding_extrema, held_loops. Throws InvalidArgument if the context computes
/// no persistence.
std::unique_ptr<core::Method> make_fair(core::ParameterReader& reader);

}  // namespace morsel::morse
