#include "morsel/tools/report/report_document.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "morsel/tools/formats/json_reader.h"

namespace morsel::tools {
namespace {

// How a row is packed, in front of its bytes.
constexpr std::uint8_t kValues = 0;  // an object with the list's keys: its values
constexpr std::uint8_t kWhole = 1;   // anything else

bool has_keys(const Json& row, const std::vector<std::string>& keys) {
  return row.is_object() &&
         std::equal(row.items().begin(), row.items().end(), keys.begin(), keys.end(),
                    [](const auto& member, const auto& key) { return member.key() == key; });
}

Json to_json(Row row);

struct CellToJson {
  Json operator()(std::nullptr_t) const { return nullptr; }
  Json operator()(std::uint64_t value) const { return value; }
  Json operator()(double value) const { return std::isfinite(value) ? Json(value) : Json(); }
  Json operator()(std::string_view value) const { return value; }
  Json operator()(std::span<const double, 3> value) const {
    return {(*this)(value[0]), (*this)(value[1]), (*this)(value[2])};
  }
  Json operator()(const NestedRows& rows) const {
    Json list = Json::array();
    for (std::size_t i = 0; i < rows.count; ++i)
      (*rows.make)(i, [&](Row row) { list.push_back(to_json(row)); });
    return list;
  }
};

Json to_json(Row row) {
  Json object = Json::object();
  for (const RowMember& member : row)
    object[std::string(member.key)] = std::visit(CellToJson{}, member.value);
  return object;
}

/// Takes rows out of a document that is being read.
class ReportFollower : public JsonFollower {
 public:
  ReportFollower(ReportDocument& document, const std::string& name, std::string_view schema)
      : finder_(document), name_(name), schema_(schema) {}

  void key(std::size_t depth, std::string_view name) override {
    finder_.key(depth, name);
    if (depth == 1) is_schema_ = name == "schema";
  }
  void begin(std::size_t depth, bool is_array) override { finder_.begin(depth, is_array); }
  bool end(std::size_t depth, const Json& value) override {
    if (depth == 1 && is_schema_) check_schema(value);
    PackedRows* rows = finder_.rows(depth);
    if (rows != nullptr) rows->add(value);
    finder_.end(depth);
    return rows == nullptr;
  }

 private:
  void check_schema(const Json& value) const {
    const std::string actual = value.is_string() ? value.get<std::string>() : "none";
    if (!schema_.empty() && actual != schema_)
      throw OtherDocument(name_ + " is not a comparison report: its schema is \"" + actual + "\", not \"" +
                          std::string(schema_) + "\"");
  }

  RowFinder finder_;
  const std::string& name_;
  std::string_view schema_;
  bool is_schema_ = false;
};

}  // namespace

void PackedRows::add(const Json& row) {
  if (blocks_.empty() && row.is_object())
    for (const auto& member : row.items()) keys_.push_back(member.key());
  if (size() % kBlock == 0) blocks_.emplace_back();
  Block& block = blocks_.back();
  if (has_keys(row, keys_)) {
    Json values = Json::array();
    for (const auto& member : row.items()) values.push_back(member.value());
    block.bytes.push_back(kValues);
    Json::to_cbor(values, block.bytes);
  } else {
    block.bytes.push_back(kWhole);
    Json::to_cbor(row, block.bytes);
  }
  block.ends.push_back(block.bytes.size());
}

std::string_view PackedRows::packed(std::size_t i) const {
  const Block& block = blocks_[i / kBlock];
  const std::size_t k = i % kBlock;
  const std::size_t first = k == 0 ? 0 : block.ends[k - 1];
  return {reinterpret_cast<const char*>(block.bytes.data()) + first, block.ends[k] - first};
}

Json PackedRows::operator[](std::size_t i) const {
  const std::string_view bytes = packed(i);
  Json row = Json::from_cbor(bytes.begin() + 1, bytes.end());
  if (static_cast<std::uint8_t>(bytes.front()) == kWhole) return row;
  Json object = Json::object();
  for (std::size_t k = 0; k < keys_.size(); ++k) object[keys_[k]] = std::move(row[k]);
  return object;
}

bool PackedRows::has_equal(std::size_t i, const PackedRows& other) const {
  return packed(i) == other.packed(i) && keys_ == other.keys_;
}

void RowFinder::key(std::size_t depth, std::string_view name) {
  if (depth <= kLevels) levels_[depth - 1].key = name;
}

void RowFinder::begin(std::size_t depth, bool is_array) {
  if (depth >= kLevels) return;
  levels_[depth].is_array = is_array;
  levels_[depth].size = 0;
  if (PackedRows* rows = is_array ? found(depth) : nullptr) {
    rows->clear();  // JSON allows a key twice; the last one counts
    row_depth_ = depth + 1;
    rows_ = rows;
  }
}

void RowFinder::end(std::size_t depth) {
  if (depth + 1 == row_depth_) rows_ = nullptr;
  if (depth > 0 && depth <= kLevels) ++levels_[depth - 1].size;
}

/// The list that an array at `depth` is.
PackedRows* RowFinder::found(std::size_t depth) {
  const auto is_member = [&](std::size_t level, std::string_view name) {
    return !levels_[level].is_array && levels_[level].key == name;
  };
  if (depth < 3 || !is_member(0, "methods") || !levels_[1].is_array) return nullptr;
  const bool is_items = depth == 3 && is_member(2, "items");
  const bool is_diagram = depth == 4 && is_member(2, "persistence") && is_member(3, "diagram");
  if (!is_items && !is_diagram) return nullptr;
  const std::size_t method = levels_[1].size;
  if (method >= kMostMethods) return nullptr;
  if (document_.methods.size() <= method) document_.methods.resize(method + 1);
  return is_items ? &document_.methods[method].items : &document_.methods[method].diagram;
}

ReportDocument parse_report(std::istream& in, const std::string& name, std::string_view schema) {
  ReportDocument document;
  ReportFollower follower(document, name, schema);
  document.head = read_json(in, name, {}, &follower);
  return document;
}

void ReportCollector::begin(std::string_view key, Json container) {
  const std::size_t depth = open_.size();
  if (!key.empty()) finder_.key(depth, key);
  finder_.begin(depth, container.is_array());
  Json* place = &document_.head;
  if (!open_.empty() && open_.back()->is_array()) {
    open_.back()->push_back(nullptr);
    place = &open_.back()->back();
  } else if (!open_.empty()) {
    place = &(*open_.back())[std::string(key)];
  }
  *place = std::move(container);
  open_.push_back(place);
}

void ReportCollector::end() {
  open_.pop_back();
  finder_.end(open_.size());
}

void ReportCollector::member(std::string_view key, const Json& value) {
  (*open_.back())[std::string(key)] = Json::parse(json_text(value));
  finder_.key(open_.size(), key);
  finder_.end(open_.size());
}

void ReportCollector::row(Row row) {
  Json object = to_json(row);
  if (PackedRows* rows = finder_.rows(open_.size()))
    rows->add(object);
  else
    open_.back()->push_back(std::move(object));
  finder_.end(open_.size());
}

void ReportCollector::rows(std::size_t count, const MakeRow& make) {
  const TakeRow take = [&](Row row) { this->row(row); };
  for (std::size_t i = 0; i < count; ++i) make(i, take);
}

}  // namespace morsel::tools
