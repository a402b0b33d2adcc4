#pragma once
/// Files with a value for each vertex of a mesh, of all kinds. Internal.
///
/// A new kind is a reader and a row of kKinds in value_file.cpp.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/parallel/progress.h"

namespace morsel::core {

struct ValueFile {
  std::vector<double> values;  ///< in the file's order; need not be finite
  /// Where value i is in the file: "line 12", "entry 11".
  std::function<std::string(std::size_t i)> place;
  std::vector<std::string> warnings = {};  ///< what was read tolerantly, guessed or left out, a sentence each
};

/// What the reader of a kind gets besides the bytes.
struct ValueRequest {
  const std::string& file;  ///< names the file in errors
  const std::string&
      column;  ///< name or number (from 1) of one of several columns or arrays; empty: the only one
  const Progress& progress;
};

/// The values of a file of any kind, told by its first bytes or by its extension. Throws BadInput, naming the
/// file and where possible the line, if it is missing, unreadable or damaged, has several columns where none
/// is named, or does not have the one that is.
ValueFile read_value_file(const std::filesystem::path& path, const std::string& column = {},
                          const Progress& progress = {});

/// The same for a file that is in memory, whose name is `file`.
ValueFile parse_value_file(std::string_view bytes, const std::string& file, const std::string& column = {},
                           const Progress& progress = {});

// The readers of the kinds.

/// A value a line. Blank lines and what follows a # do not count; lines before the first with a number are a
/// header, of which a warning tells. With a column: columns between tabs, semicolons, commas or blanks.
ValueFile read_text_values(std::string_view bytes, const ValueRequest& request);

/// Columns between tabs, semicolons or commas (that which the first line has, in this order), cells in
/// double quotes where they contain one. Lines that begin with # do not count. A column goes by its name in
/// the first line, or in the last comment before it, or by its number. Empty cells and NA are nan.
ValueFile read_csv_values(std::string_view bytes, const ValueRequest& request);

/// NumPy's .npy: one dimension or two, whole numbers, truth values and floats of 16, 32 and 64 bits in either
/// byte order, in C or Fortran order.
ValueFile read_npy_values(std::string_view bytes, const ValueRequest& request);

/// A vertex property of a mesh file (a point array of VTK's files).
ValueFile read_mesh_values(std::string_view bytes, const ValueRequest& request);

/// Which column a request means that has to name one by its number, counted from 0: of `count` columns, which
/// `what` has ("the array"). Throws BadInput if it names none or one that does not exist.
std::size_t numbered_column(const ValueRequest& request, std::size_t count, const std::string& what);

/// The number that a text is, as files of values have it ("+2", "nan", ".5"); false if it is none.
bool parse_value(std::string_view text, double& value);

}  // namespace morsel::core
