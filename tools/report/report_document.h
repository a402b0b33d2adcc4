#pragma once
/// A report in memory, without a JSON value for each of its million items.

#include <array>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/tools/formats/json_stream.h"

namespace morsel::tools {

/// The elements of a long array, about 60 bytes each: CBOR, with the keys of the first, an object, stored
/// once.
class PackedRows {
 public:
  void add(const Json& row);
  void clear() { *this = PackedRows(); }
  std::size_t size() const {
    return blocks_.empty() ? 0 : (blocks_.size() - 1) * kBlock + blocks_.back().ends.size();
  }
  Json operator[](std::size_t i) const;
  /// Whether the i-th rows are known to be equal without unpacking them.
  bool has_equal(std::size_t i, const PackedRows& other) const;

 private:
  static constexpr std::size_t kBlock = 4096;
  struct Block {  // blocks, so that growing does not copy
    std::vector<std::uint8_t> bytes;
    std::vector<std::size_t> ends;
  };
  std::string_view packed(std::size_t i) const;

  std::vector<std::string> keys_;
  std::vector<Block> blocks_;
};

/// The rows that a report lists of a method, point by point.
struct MethodRows {
  PackedRows diagram;  ///< methods[i].persistence.diagram
  PackedRows items;    ///< methods[i].items
};

/// A report. Of each method's items and diagram `head` keeps empty arrays; `methods` has their
/// rows.
struct ReportDocument {  // NOLINT(bugprone-exception-escape): of the JSON library
  Json head;
  std::vector<MethodRows> methods;
};

/// The largest number of methods whose points are kept apart from the head.
inline constexpr std::size_t kMostMethods = 10'000;

/// The document is JSON, but of another schema.
class OtherDocument : public core::BadInput {
 public:
  using BadInput::BadInput;
};

/// Reads a report, or any other JSON document, however it is laid out (json_reader.h: untrusted, limited in
/// depth). `name` is what errors call it. If a schema is given, throws OtherDocument as soon as the document
/// turns out to have another one. Throws BadInput.
ReportDocument parse_report(std::istream& in, const std::string& name = "the document",
                            std::string_view schema = {});

/// Follows a document piece by piece and finds the lists that its rows belong to. Depth is the number of
/// containers around a value.
class RowFinder {
 public:
  explicit RowFinder(ReportDocument& document) : document_(document) {}

  void key(std::size_t depth, std::string_view name);  ///< of a value at `depth`
  void begin(std::size_t depth, bool is_array);
  void end(std::size_t depth);  ///< of a value, container or not
  /// The list that a value at `depth` belongs to; null if it stays in the head.
  PackedRows* rows(std::size_t depth) { return depth == row_depth_ ? rows_ : nullptr; }

 private:
  PackedRows* found(std::size_t depth);

  static constexpr std::size_t kLevels = 5;  // containers around a row of the diagram
  struct Level {
    bool is_array = false;
    std::size_t size = 0;
    std::string key;
  };
  ReportDocument& document_;
  std::array<Level, kLevels> levels_;
  std::size_t row_depth_ = 0;
  PackedRows* rows_ = nullptr;
};

/// Takes a report from its writer instead of a file: the same result as writing and reading it.
class ReportCollector : public JsonSink {
 public:
  void begin_object(std::string_view key = {}) override { begin(key, Json::object()); }
  void begin_array(std::string_view key = {}) override { begin(key, Json::array()); }
  void end_object() override { end(); }
  void end_array() override { end(); }
  void member(std::string_view key, const Json& value) override;
  void row(Row row) override;
  void rows(std::size_t count, const MakeRow& make) override;
  ReportDocument take() { return std::move(document_); }

 private:
  void begin(std::string_view key, Json container);
  void end();

  ReportDocument document_;
  RowFinder finder_{document_};
  std::vector<Json*> open_;
};

}  // namespace morsel::tools
