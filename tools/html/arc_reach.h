#pragma once
/// The persistence up to which each arc is drawn.

#include <vector>

#include "morsel/mscomplex/hierarchy.h"

namespace morsel::tools::html {

/// When a saddle and an extremum are cancelled, the arcs that ended in the extremum continue back along the
/// saddle's arc and along its other one: arcs are concatenated (Bremer, Edelsbrunner, Hamann, Pascucci 2004).
/// So a saddle's two arcs of a kind are shown up to the largest persistence of a saddle whose arc, at some
/// level of the hierarchy, runs along them; that may be its own.
///
/// Per saddle of the complex, the persistence up to which its arcs of that kind are part of those of a level:
/// that level's concatenated arcs are made of the arcs whose reach exceeds its threshold, and of nothing
/// else. +∞ if that saddle is essential or paired with a cap. O(s log s) in the number of
/// saddles.
std::vector<double> arc_reach(const mscomplex::PersistenceHierarchy& hierarchy, mscomplex::ArcKind kind);

}  // namespace morsel::tools::html
