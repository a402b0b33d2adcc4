#pragma once
/// Embedding discs in the plane. Internal.

#include <Eigen/Core>
#include <vector>

#include "morsel/mscomplex/quads/disc.h"

namespace morsel::mscomplex {

/// Places the inner vertices of a disc whose border is given on a convex curve: each is the mean of its
/// neighbours with mean-value weights (Floater 2003, "Mean value coordinates"), which are positive, so that
/// no triangle turns over provided that no inner edge joins two border vertices on one straight piece of the
/// curve. `place` has an entry per disc vertex, those of the border set.
///
/// Such a map shrinks protruding parts of the surface (an ear, a leg). So its stretch is reduced in at most
/// `rounds` rounds, fewer when the stretch no longer decreases, by weakening edges where it is large
/// (Yoshizawa, Belyaev, Seidel 2004, "A fast and simple stretch-minimizing mesh parameterization"); weights
/// stay positive.
///
/// Throws BadInput, naming `what`, if the linear system cannot be solved.
void embed_inside(const LayoutMesh& mesh, const Disc& disc, int rounds, std::vector<Eigen::Vector2d>& place,
                  const std::string& what);

/// The border on the unit circle: border vertices `at` (ascending, two or more) evenly spaced from angle 0
/// on, those between two of them by length along the border.
std::vector<Eigen::Vector2d> border_on_circle(const LayoutMesh& mesh, const Disc& disc,
                                              const std::vector<core::Index>& at);

/// Where each border vertex from `first` to `last` lies along the border between the two, by length: from 0
/// to 1, strictly increasing, for no step counts less than `floor` of the mean one. Numbers wrap around
/// at border_size().
std::vector<double> share_along_border(const LayoutMesh& mesh, const Disc& disc, core::Index first,
                                       core::Index last, double floor);

}  // namespace morsel::mscomplex
