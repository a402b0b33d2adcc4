#pragma once
/// The surface of a molecule, made from its atoms.

#include <cstddef>
#include <span>
#include <string>

#include "morsel/core/io/molecule.h"
#include "morsel/core/mesh/mesh.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::tools {

/// Kinds of surfaces, with atom i at c_i, of van der Waals radius r_i:
enum class SurfaceKind {
  gaussian,  ///< Σ_i exp(B (1 − ‖x − c_i‖² / r_i²)) = 1 (Blinn 1982); smooth
  ses,  ///< solvent-excluded (Richards 1977, Connolly 1983): what a probe rolling over the atoms cannot enter
  sas,  ///< solvent-accessible (Lee, Richards 1971): where the center of that probe rolls
  vdw   ///< of the union of the balls of radius r_i
};

/// "gaussian", "ses", "sas", "vdw": as in the syntax of the command line.
std::string to_string(SurfaceKind kind);

struct SurfaceOptions {
  SurfaceKind kind = SurfaceKind::gaussian;
  double resolution = 0.5;  ///< the grid's spacing in Å, about the length of the mesh's edges
  double probe = 1.4;       ///< radius in Å of the solvent (water), > 0; for ses and sas
  /// B, from 0.1 to 100, for gaussian: the smaller, the smoother and larger. On a protein of 957 atoms, 1
  /// comes nearest to the area of the solvent-excluded surface; 2.3, also in use, leaves gaps between the
  /// atoms (genus 111).
  double blobbiness = 1;
  /// Keep the walls of cavities: components that face a closed room within the molecule.
  bool cavities = false;
};

/// Throws InvalidArgument if one is out of range.
void check_surface_options(const SurfaceOptions& options);

struct MolecularSurface {
  core::TriangleMesh mesh;
  std::size_t cavities = 0;  ///< components that are cavities' walls, kept or not
  double area = 0;           ///< of the mesh, in Å²
  double volume = 0;         ///< enclosed by it, in Å³
  int grids_tried = 1;       ///< 2 or more: the surface on the grids before was not a manifold
};

/// A closed, oriented (normals point away from the atoms) 2-manifold, in Å and in the place of the atoms, one
/// component for each separate part of the molecule, at any number of threads the same bits.
///
/// The solid is sampled on a grid around the atoms (ses exactly, from the spheres, arcs and points that bound
/// the region of the probe's center), its surface made by dual contouring (grid_mesh.h), and each
/// quadrilateral cut along the diagonal that gives the larger smallest angle (the first diagonal if there is
/// none). Vertices lie within about half a spacing of the true surface, much nearer where that is smooth;
/// details below the spacing are lost, no atom is. Dual contouring can pinch a surface at an edge or vertex
/// where two sheets of it pass one cell; OpenVDB does not exclude that, though it happened on none of
/// thousands of molecules and grids of noise. Such a mesh is discarded, and another made on a grid shifted by
/// a fraction of the spacing, up to 8 in all.
///
/// Throws InvalidArgument if an option is out of range and as core::require_molecules() does; BadInput if
/// there are no atoms, if the resolution is too coarse for the smallest atom (a ball must hold a grid point:
/// √3/2 spacings ≤ r) or so fine that the grid would have more than 5 · 10⁸ points or 65,536 along one side,
/// or if all 8 grids pinch; and for ses if the probe can touch more than 2²⁵ pairs of atoms, and 128 for each
/// atom, at once. Time in the number of grid points near the molecule, 4 bytes each, and of these pairs, 8
/// bytes each.
MolecularSurface molecular_surface(std::span<const core::Atom> atoms, const SurfaceOptions& options = {},
                                   const core::Progress& progress = {});

}  // namespace morsel::tools
