#include "morsel/tools/report/difference.h"

#include <algorithm>
#include <cmath>

namespace morsel::tools {
namespace {

/// Largest magnitude of the field's values and the mesh's positions in the report, the scale of its real
/// numbers.
double scale_of(const Json& report) {
  double scale = 0;
  const auto consider = [&](const char* section, const char* key) {
    const auto part = report.find(section);
    if (part == report.end() || !part->is_object()) return;
    const auto value = part->find(key);
    if (value != part->end() && value->is_number()) scale = std::max(scale, std::abs(value->get<double>()));
  };
  consider("field", "min");
  consider("field", "max");
  consider("mesh", "bbox_diagonal");
  return scale;
}

class Comparer {
 public:
  Comparer(const ReportDocument& before, const ReportDocument& after)
      : before_(before), after_(after), scale_(std::max(scale_of(before.head), scale_of(after.head))) {}

  std::vector<Difference> run() {
    compare(before_.head, after_.head, "");
    return std::move(differences_);
  }

 private:
  void compare(const Json& before, const Json& after, const std::string& where) {
    if (before.is_object() && after.is_object()) {
      compare_objects(before, after, where);
    } else if (before.is_array() && after.is_array()) {
      const PackedRows* rows_before = rows(before_, where);
      const PackedRows* rows_after = rows(after_, where);
      if (rows_before != nullptr && rows_after != nullptr)
        compare_rows(*rows_before, *rows_after, where);
      else
        compare_arrays(before, after, where);
    } else if (!same_value(before, after)) {
      add(where, json_text(before), json_text(after));
    }
  }

  /// What an array in the current method lists outside the head.
  const PackedRows* rows(const ReportDocument& document, const std::string& where) const {
    if (method_ >= document.methods.size()) return nullptr;
    if (where == method_name_ + "items") return &document.methods[method_].items;
    return where == method_name_ + "persistence.diagram" ? &document.methods[method_].diagram : nullptr;
  }

  void compare_sizes(std::size_t before, std::size_t after, const std::string& where) {
    if (before != after) add(where, std::to_string(before) + " entries", std::to_string(after) + " entries");
  }

  void compare_rows(const PackedRows& before, const PackedRows& after, const std::string& where) {
    compare_sizes(before.size(), after.size(), where);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
      if (!before.has_equal(i, after)) compare(before[i], after[i], where + "[" + std::to_string(i) + "]");
  }

  void add(const std::string& where, std::string before, std::string after) {
    differences_.push_back({where, std::move(before), std::move(after)});
  }

  bool same_value(const Json& a, const Json& b) const {
    if (!a.is_number() || !b.is_number()) return a == b;
    if (!a.is_number_float() && !b.is_number_float()) return a == b;
    const double x = a.get<double>();
    const double y = b.get<double>();
    return std::abs(x - y) <= std::max(1e-9 * std::max(std::abs(x), std::abs(y)), 1e-12 * scale_);
  }

  void compare_objects(const Json& before, const Json& after, const std::string& where) {
    const std::string prefix = where.empty() || where.ends_with(": ") ? where : where + ".";
    for (const auto& [key, value] : before.items()) {
      if (where.empty() && key == "timings") continue;
      if (where == "tool" && key == "version") continue;
      const auto other = after.find(key);
      if (other == after.end()) {
        add(prefix + key, summary(value, rows(before_, prefix + key)), "absent");
      } else {
        compare(value, *other, prefix + key);
      }
    }
    for (const auto& [key, value] : after.items())
      if (!before.contains(key) && !(where.empty() && key == "timings"))
        add(prefix + key, "absent", summary(value, rows(after_, prefix + key)));
  }

  void compare_arrays(const Json& before, const Json& after, const std::string& where) {
    compare_sizes(before.size(), after.size(), where);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      std::string place = where + "[" + std::to_string(i) + "]";
      if (where == "methods" && before[i].is_object()) {
        const auto name = before[i].find("name");
        const bool is_named = name != before[i].end() && name->is_string();
        place += " (" + (is_named ? name->get<std::string>() : "?") + "): ";
        method_ = i;
        method_name_ = place;
      }
      compare(before[i], after[i], place);
    }
  }

  static std::string summary(const Json& value, const PackedRows* rows) {
    if (value.is_object()) return "{" + std::to_string(value.size()) + " members}";
    if (value.is_array())
      return "[" + std::to_string(rows != nullptr ? rows->size() : value.size()) + " entries]";
    return json_text(value);
  }

  const ReportDocument& before_;
  const ReportDocument& after_;
  double scale_;
  std::size_t method_ = static_cast<std::size_t>(-1);  // the method that is being compared
  std::string method_name_;                            // prefix of its differences
  std::vector<Difference> differences_;
};

}  // namespace

std::vector<Difference> report_differences(const ReportDocument& before, const ReportDocument& after) {
  return Comparer(before, after).run();
}

}  // namespace morsel::tools
