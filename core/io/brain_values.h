#pragma once
/// Values for the vertices of a surface in the files of FreeSurfer and GIFTI. Internal.

#include <string_view>

#include "morsel/core/io/value_file.h"

namespace morsel::core {

/// FreeSurfer's morphometry (lh.curv, lh.sulc, lh.thickness): floats, or in the old kind hundredths.
ValueFile read_freesurfer_values(std::string_view bytes, const ValueRequest& request);

/// FreeSurfer's annotation (.annot): the number of each vertex's label in the colour table, as nibabel and
/// FreeSurfer count them; −1 at vertices without a label or with one that is not in the table. An annotation
/// without a colour table is refused.
ValueFile read_annotation_values(std::string_view bytes, const ValueRequest& request);

/// GIFTI (.shape.gii, .func.gii, .label.gii, …): an array of one value a vertex, or a column of one of
/// several; of labels, their keys. Columns are counted from 1 through all arrays, and an array of one goes by
/// the name that its metadata give it. Points and triangles do not count. Of the part FORMATS.
ValueFile read_gifti_values(std::string_view bytes, const ValueRequest& request);

}  // namespace morsel::core
