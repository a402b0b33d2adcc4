#pragma once
/// Labels and values of vertices in the files of FreeSurfer and GIFTI.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// Labels from 0 to colors.size() − 1, and −1 where there is none, by vertex of the input's file.
struct BrainLabels {
  std::string name;  ///< of a label, which its number follows: "segment_12"
  std::span<const std::int32_t> of_vertex;
  std::span<const std::array<std::uint8_t, 3>> colors;  ///< red, green and blue of each label
};

/// FreeSurfer's annotation with a colour table, in which label i is entry i. A vertex without label has the
/// annotation 0, which no entry has: readers show it as unknown. Labels are told apart by their colours
/// there, so a colour that several labels have is changed in its last bits (distinct_colors()). The
/// provenance follows the table, under FreeSurfer's tag for a command line. Throws WriteFailed.
void write_annotation(const core::FileTarget& target, const BrainLabels& labels,
                      const Provenance& provenance);

/// GIFTI labels: keys are the labels, −1 is "???" and transparent. Throws WriteFailed.
void write_gifti_labels(const core::FileTarget& target, const BrainLabels& labels,
                        const Provenance& provenance);

/// GIFTI values in single precision, with this intent ("NIFTI_INTENT_SHAPE") and name. Throws WriteFailed.
void write_gifti_values(const core::FileTarget& target, std::span<const double> values,
                        const std::string& intent, const std::string& name, const Provenance& provenance);

/// The same colours, each once and none of them black: of equal ones all but the first are changed in as few
/// of the last bits as suffice, all three channels alike. Throws InvalidArgument if there are more than
/// colours. O(n).
std::vector<std::array<std::uint8_t, 3>> distinct_colors(std::span<const std::array<std::uint8_t, 3>> colors);

}  // namespace morsel::tools
