#pragma once
/// The parts of JSON documents about their fields and methods, the same in all of them.

#include <span>
#include <vector>

#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/formats/json_stream.h"
#include "morsel/tools/formats/sha256.h"
#include "morsel/tools/study/comparison.h"
#include "morsel/tools/study/made_field.h"
#include "morsel/tools/study/summary.h"

namespace morsel::tools {

/// A parameter's value as JSON; non-finite numbers become null.
Json to_json(const core::ParameterValue& value);
Json to_json(const core::Parameters& parameters);
/// The records of an iterative method: an object for each of its fields.
Json to_json(const std::vector<core::IterationRecord>& iterations);

/// {"name", "version"} of the program.
Json tool_section();
/// A field's resolved parameters, and KEY_sha256 for a KEY that names a file. The hash is that of `known`, or
/// else the file is read here. Throws BadInput if it cannot be read.
Json field_parameters(const FieldSummary& field, std::span<const HashedFile> known = {});
/// {"name", "parameters", "min", "max", "warnings" (if there are any)}
Json field_section(const FieldSummary& field, std::span<const HashedFile> known = {});
Json field_section(const FieldOutcome& outcome);
/// {"minima", "saddles", "saddle_multiplicity", "maxima", "total"}
Json counts_section(const morse::CriticalPoints& points);
/// {"pairs", "infinite_pairs", "essential_saddles", "max", "above" [{"percent", "pairs"}]}; the
/// percentages are of the input field's range.
Json persistence_section(const PersistenceSummary& summary);
Json persistence_section(const persistence::Diagram& diagram, double extent);
/// {"minima", "saddles", "maxima", "caps", "arcs", "quads", "cells", "segments" {"descending", "ascending",
/// "morse_smale"}}; `cells` are the quads that have area.
Json complex_section(const mscomplex::MorseSmaleComplex& complex, const mscomplex::Segmentation& segmentation,
                     core::Index cells);
/// Steps with their seconds.
Json timings_section(const Timings& timings);
/// The resolved parameters: of a single step directly, of a chain by step.
Json parameters_section(const std::vector<StepOutcome>& steps);
/// {"parameters", "details", "iterations"}: of a single step directly, of a chain by step; and "warnings" of
/// all steps, if there are any.
Json steps_section(const std::vector<StepOutcome>& steps);
/// How a wanted number was reached, without the list of the cancelled pairs; vertices in the input's numbers.
Json target_section(const TargetOutcome& target, const core::VertexNumbering& numbering);
/// The method that made a field: {"name", "parameters", "details", "iterations", "target" (if there was one),
/// "min", "max"}
Json method_section(const MethodChain& chain, const ChainOutcome& outcome,
                    const core::VertexNumbering& numbering);
Json method_section(const FieldPlan& plan, const MadeField& made, const core::VertexNumbering& numbering);

}  // namespace morsel::tools
