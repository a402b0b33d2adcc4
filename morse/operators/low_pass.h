#pragma once
/// Surfaces at a scale: smoothed by a low-pass filter, so that measurements reflect features, not noise.

#include "morsel/core/mesh/length.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"
#include "morsel/core/text/parameters.h"

namespace morsel::morse {

/// The surface without its undulations below a scale s: a wave of length 2πs keeps half of its height, a
/// longer one more, a shorter one less. Triangles stay.
///
/// Taubin, "A signal processing approach to fair surface design", SIGGRAPH 1995: the eigenvalues k of K = I −
/// P, P the mean over a vertex's neighbours, are the frequencies of the surface, from 0 to 2, and a
/// polynomial of K is a filter. His pairs of steps λ|μ multiply the part of frequency k by (1 − λk)(1 − μk).
/// In the limit of many small pairs that keep all of the lowest frequencies (μ → −λ), so that nothing shrinks
/// to first order, the filter is exp(−ln 2 (k/k_c)²), and it is evaluated as a Chebyshev series (Taubin,
/// Zhang, Golub, "Optimal surface smoothing as filter design", ECCV 1996), in O(s/h) products with P rather
/// than O(s⁴/h⁴) steps; its coefficients beyond 1e-9 are left out. Half the height is kept at k_c = (h/2s)²,
/// the frequency of such a wave on even triangles with edges h; h is the mean edge length. So the result does
/// not depend on how densely a surface of even triangles is sampled; where it is sampled more densely than on
/// average, its scale is smaller. Uniform means do not depend on the shapes of triangles, which noise
/// distorts; the price is that they depend on the triangulation: where vertices have other than six
/// neighbours or edges change in length, vertices slide along the surface, and one-ring curvatures keep a
/// trace of it (on an icosphere, at 2 edges, the twelve vertices with five neighbours have a mean curvature
/// of 1.8/r).
///
/// A boundary vertex takes the mean over its two neighbours along the boundary, so that boundaries are
/// smoothed as curves, independently of the interior (the hierarchical neighbourhoods of section 3 there). A
/// plane stays in its plane. Without its short waves a part that is thinner than the scale shrinks.
///
/// The scale is finite and not below 0; 0 returns the mesh itself. Throws InvalidArgument otherwise, BadInput
/// if it exceeds the diagonal of the mesh's box. Scales exactly by powers of two. O(n · (1 + s/h)), parallel,
/// the same bits for every number of threads.
core::TriangleMesh low_pass(const core::TriangleMesh& mesh, core::Length scale,
                            const core::Progress& progress = {});

/// Declares and reads the key `scale`.
core::Length read_scale(core::ParameterReader& reader, core::Length default_scale);

}  // namespace morsel::morse
