#pragma once
/// Values of a document that was read, with a check of their types.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "morsel/tools/formats/json_reader.h"

namespace morsel::tools {

/// A value and its place in the document; refers to the value. All accessors throw BadInput if the value does
/// not fit: one sentence, "report.json is a damaged report: methods[2].name is not a text".
class JsonView {
 public:
  static constexpr std::uint64_t kMostCount = std::uint64_t{1} << 53;  // the same in every reader of JSON

  /// A whole document. `subject` begins the sentence: "report.json is a damaged report".
  JsonView(const Json& document, std::string subject) : value_(&document), subject_(std::move(subject)) {}

  /// The member of an object; throws if it is absent.
  JsonView operator[](std::string_view key) const;
  /// The member of an object; empty if it is absent.
  std::optional<JsonView> find(std::string_view key) const;
  /// An object's keys and values, `most` at most.
  std::vector<std::pair<std::string, JsonView>> members() const;
  /// An array's elements, at least and at most so many.
  std::vector<JsonView> list(std::size_t least = 0,
                             std::size_t most = std::numeric_limits<std::size_t>::max()) const;

  const std::string& text() const;
  /// A text, which must be one of these.
  const std::string& text_of(std::initializer_list<std::string_view> choices) const;
  /// A text that can be a path: not empty, without a NUL.
  const std::string& path() const;
  bool truth() const;
  double number(double least = -std::numeric_limits<double>::max()) const;
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  std::uint64_t count(std::uint64_t most = kMostCount) const;
  bool is_null() const { return value_->is_null(); }
  bool is_object() const { return value_->is_object(); }
  const Json& json() const { return *value_; }

  /// Throws BadInput with the place and `what`: "is not a text".
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  JsonView(const Json& value, const JsonView& parent, std::string where)
      : value_(&value), subject_(parent.subject_), where_(std::move(where)) {}

  const Json* value_;
  std::string subject_;
  std::string where_;
};

}  // namespace morsel::tools
