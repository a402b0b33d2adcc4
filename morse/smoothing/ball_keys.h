#pragma once
/// The keys that methods with a ball of neighbours around each vertex share. Each function declares the keys
/// of its name and reads them.

#include "morsel/core/text/parameters.h"
#include "morsel/morse/smoothing/salient.h"

namespace morsel::morse {

void read_sigma(core::ParameterReader& reader, SalientOptions& options);
void read_support(core::ParameterReader& reader, SalientOptions& options);
/// weights=none|area and ball=euclidean|connected.
void read_neighbors(core::ParameterReader& reader, SalientOptions& options);

}  // namespace morsel::morse
