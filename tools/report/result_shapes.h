#pragma once
/// Checks of the shapes of results in documents that are read back. All throw BadInput (json_view.h).

#include <initializer_list>
#include <string_view>

#include "morsel/tools/formats/json_view.h"

namespace morsel::tools {

/// An object with these members and no others.
void check_members(const JsonView& object, std::initializer_list<std::string_view> names);

/// An object whose members of these names are counts.
void check_counts(const JsonView& object, std::initializer_list<std::string_view> names);

/// {"minima", "saddles", "saddle_multiplicity", "maxima", "total"}, which must agree.
void check_critical_points(const JsonView& points);

/// {"pairs", "infinite_pairs", "essential_saddles", "max", "above"}: of pairs over 0.1, 1 and 5 %.
void check_persistence(const JsonView& persistence);

/// {name: number, text, truth or null}, or {"steps": [{"name", "values"}]} of a chain's.
void check_parameters(const JsonView& parameters);

/// {"min", "max"}, min no larger than max.
void check_range(const JsonView& field);
/// {"name", "parameters", "min", "max"}
void check_field(const JsonView& field);

/// A SHA-256 as 64 hexadecimal digits.
void check_sha256(const JsonView& hash);

/// A report's "mesh".
void check_mesh(const JsonView& mesh);

}  // namespace morsel::tools
