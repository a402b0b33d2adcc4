#pragma once
/// The fuzz targets: each reads any bytes as one kind of input and checks invariants of the result.

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace morsel::fuzz {

/// An invariant is violated.
class Violation : public std::logic_error {
 public:
  using logic_error::logic_error;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw Violation(what);
}

/// One source file each. They accept core::BadInput and core::InvalidArgument as results; any exception that
/// they throw is a bug.
void off(std::string_view bytes);
void obj(std::string_view bytes);
void ply(std::string_view bytes);
void stl(std::string_view bytes);
void freesurfer(std::string_view bytes);
void gifti(std::string_view bytes);
void vtk(std::string_view bytes);
void vtp(std::string_view bytes);
void compressed(std::string_view bytes);
void gltf(std::string_view bytes);
void asc(std::string_view bytes);
void pdb(std::string_view bytes);
void mmcif(std::string_view bytes);
void pqr(std::string_view bytes);
void selection(std::string_view bytes);
void values(std::string_view bytes);
void specification(std::string_view bytes);
void chain(std::string_view bytes);
void report(std::string_view bytes);
void state(std::string_view bytes);
void journal(std::string_view bytes);
void provenance(std::string_view bytes);
void marks(std::string_view bytes);
void landmarks(std::string_view bytes);

struct Target {
  std::string_view name;
  std::string corpus;     ///< a folder in tests/corpus
  std::string extension;  ///< of its files there; empty: all
  void (*run)(std::string_view bytes);
};

/// All of them, by these names.
std::span<const Target> targets();

}  // namespace morsel::fuzz
