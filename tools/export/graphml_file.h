#pragma once
/// A Morse-Smale complex as a graph, for NetworkX, Gephi and other programs that read GraphML.

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/export/complex_file.h"
#include "morsel/tools/report/provenance.h"

namespace morsel::tools {

/// An undirected multigraph, node i being node i of the complex and edge i arc i. Of nodes: type ("minimum",
/// "saddle", "maximum", "cap"), cell (the critical vertex, edge or triangle of the mesh, or the loop), vertex
/// (in the input's numbers), value, persistence, essential, x, y, z; of edges: kind ("descending",
/// "ascending"), persistence, essential; numbers are finite, as complex_file.h has them. The provenance is a
/// property of the graph. Does not wait until the file is on disk. Throws WriteFailed.
void write_graphml_file(const core::FileTarget& target, const ComplexFile& file,
                        const Provenance& provenance);

}  // namespace morsel::tools
