#pragma once
/// The page of `morsel compare --html`: an interactive comparison in one file.

#include <memory>
#include <string>

#include "morsel/core/io/file_writer.h"
#include "morsel/tools/report/provenance.h"
#include "morsel/tools/report/report_writer.h"
#include "morsel/tools/study/comparison.h"

namespace morsel::tools {

/// Writes, while the comparison runs, a self-contained HTML document: it needs no network, no server and no
/// other file. Its elements are
///   #page     JSON, "morsel.page/1": the command line, the report without its items
///             ("morsel.comparison/1"), and the references to the arrays of the mesh and of each method
///             (html/page_data.h)
///   #buffers  those arrays (html/buffers.h), one after the other, deflated, in base64: positions (16 bits a
///             coordinate of the bounding box), triangles, and per method the field (16 bits between
///             percentiles), critical points (values in full), pairs, segment labels and arcs
///   #three    three.js r111, deflated, in base64
/// File names and parameters are escaped so that they cannot end the element that they are in, and the page
/// shows them as text alone. But for the timings in the report the bytes are the same at any number of
/// threads.
///
/// Throws WriteFailed. No more than one method's arrays are in memory at a time.
class HtmlSink : public ComparisonSink {
 public:
  /// Refers to `file` and `loaded`. `command`: the command line that makes the page.
  HtmlSink(core::FileWriter& file, const core::LoadedMesh& loaded, const ReportInput& input,
           const ComparisonRequest& request, std::string command, Provenance provenance);
  ~HtmlSink() override;
  void field(const FieldOutcome& outcome) override;
  void method(const MethodOutcome& outcome) override;
  /// Ends the document; the caller commits the file.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace morsel::tools
