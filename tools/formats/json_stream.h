#pragma once
/// Writes a JSON document piece by piece, so that a million items are never in memory at once.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace morsel::tools {

using Json = nlohmann::ordered_json;

struct RowMember;
/// An object of scalars, for documents with many: written without a JSON value for each.
using Row = std::initializer_list<RowMember>;
using TakeRow = std::function<void(Row)>;
/// Hands the i-th of some rows to `take`.
using MakeRow = std::function<void(std::size_t, const TakeRow&)>;

/// An array of rows within a row; refers to the function that makes them.
struct NestedRows {
  NestedRows(std::size_t row_count, const MakeRow& make_row) : count(row_count), make(&make_row) {}
  std::size_t count;
  const MakeRow* make;
};

/// A row's value: null, a number (null if it is not finite), a text, a position or rows.
using Cell = std::variant<std::nullptr_t, std::uint64_t, double, std::string_view, std::span<const double, 3>,
                          NestedRows>;
struct RowMember {
  std::string_view key;
  Cell value;
};

/// Receives a JSON document piece by piece. The caller keeps it well-formed: keys in objects, none in arrays,
/// every begin with its end.
class JsonSink {
 public:
  virtual ~JsonSink() = default;
  virtual void begin_object(std::string_view key = {}) = 0;
  virtual void begin_array(std::string_view key = {}) = 0;
  virtual void end_object() = 0;
  virtual void end_array() = 0;
  /// A member of the current object: a whole (small) value.
  virtual void member(std::string_view key, const Json& value) = 0;
  /// An element of the current array.
  virtual void row(Row row) = 0;
  /// Many elements of the current array: make(i, take), for each i < count, hands the i-th to take. Calls of
  /// `make` may run in parallel and in any order.
  virtual void rows(std::size_t count, const MakeRow& make) = 0;
};

/// Writes it as text, with two-space indentation and a line to each row.
class JsonStream : public JsonSink {
 public:
  /// Refers to `out`.
  explicit JsonStream(std::ostream& out) : out_(out) {}

  void begin_object(std::string_view key = {}) override { begin(key, '{'); }
  void begin_array(std::string_view key = {}) override { begin(key, '['); }
  void end_object() override { end('}'); }
  void end_array() override { end(']'); }
  void member(std::string_view key, const Json& value) override;
  void row(Row row) override;
  void rows(std::size_t count, const MakeRow& make) override;

 private:
  void begin(std::string_view key, char bracket);
  void end(char bracket);
  void next_item(std::string_view key);
  void append_separator(std::string& text, bool is_first) const;
  void write_out();

  std::ostream& out_;
  std::vector<bool> has_items_;
  std::string text_;  // of the current call; kept for its memory
};

/// A value as text on one line (indent −1) or several. Text in it that is not UTF-8 (a path may hold any
/// bytes) is written with replacement characters; control characters, also those beyond ASCII, are escaped.
std::string json_text(const Json& value, int indent = -1);

}  // namespace morsel::tools
