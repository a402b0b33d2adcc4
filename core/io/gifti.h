#pragma once
/// The arrays of a GIFTI file (Harwell et al. 2011, version 1.0). Internal, of the part FORMATS.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/io/decompression.h"
#include "morsel/core/parallel/progress.h"

namespace morsel::core {

class GiftiFile {
 public:
  struct Array {
    std::string intent;  ///< "NIFTI_INTENT_POINTSET", …
    std::string name;    ///< what its metadata call it; may be empty
    std::uint64_t rows = 0;
    std::uint64_t columns = 1;
  };

  /// Throws BadInput, naming the file and where it can be told the line, if it is no GIFTI file. What data
  /// the arrays have is not looked at.
  GiftiFile(std::string_view bytes, const std::string& file, const Progress& progress);
  ~GiftiFile();
  GiftiFile(const GiftiFile&) = delete;
  GiftiFile& operator=(const GiftiFile&) = delete;

  const std::vector<Array>& arrays() const { return arrays_; }
  /// "data array 2 (NIFTI_INTENT_SHAPE)", counted from 1.
  std::string called(std::size_t i) const;
  /// The numbers of array i, row by row. Throws BadInput if they are damaged, are in another file, or do not
  /// have the sizes announced, or if what is compressed in all that were asked for expands too much.
  std::vector<double> values(std::size_t i);
  /// What was odd but could be read, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Document;

  const std::string& file_;
  const Progress& progress_;
  DecompressionBudget budget_;
  std::unique_ptr<Document> document_;
  std::vector<Array> arrays_;
  std::vector<std::string> warnings_;
};

}  // namespace morsel::core
