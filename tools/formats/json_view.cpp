#include "morsel/tools/formats/json_view.h"

#include <algorithm>

#include "morsel/core/error.h"

namespace morsel::tools {

JsonView JsonView::operator[](std::string_view key) const {
  std::optional<JsonView> member = find(key);
  if (!member) refuse("lacks \"" + std::string(key) + "\"");
  return *std::move(member);
}

std::optional<JsonView> JsonView::find(std::string_view key) const {
  if (!value_->is_object()) refuse("is not an object");
  const std::string name(key);
  const auto member = value_->find(name);
  if (member == value_->end()) return std::nullopt;
  return JsonView(*member, *this, where_.empty() ? name : where_ + "." + name);
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
  if (!value_->is_object()) refuse("is not an object");
  std::vector<std::pair<std::string, JsonView>> all;
  for (const auto& [key, value] : value_->items())
    all.emplace_back(key, JsonView(value, *this, where_.empty() ? key : where_ + "." + key));
  return all;
}

std::vector<JsonView> JsonView::list(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) refuse("is not a list");
  const std::size_t size = value_->size();
  if (size < least || size > most)
    refuse("has " + std::to_string(size) + (size == 1 ? " entry" : " entries") + ", not " +
           (least == most  ? std::to_string(least)
            : size < least ? "at least " + std::to_string(least)
                           : "at most " + std::to_string(most)));
  std::vector<JsonView> all;
  all.reserve(size);
  for (std::size_t i = 0; i < size; ++i)
    all.push_back(JsonView((*value_)[i], *this, where_ + "[" + std::to_string(i) + "]"));
  return all;
}

const std::string& JsonView::text() const {
  if (!value_->is_string()) refuse("is not a text");
  return value_->get_ref<const std::string&>();
}

const std::string& JsonView::text_of(std::initializer_list<std::string_view> choices) const {
  if (std::find(choices.begin(), choices.end(), text()) == choices.end()) {
    std::string valid;
    for (const std::string_view choice : choices) valid += (valid.empty() ? "" : ", ") + std::string(choice);
    refuse("is none of " + valid);
  }
  return text();
}

const std::string& JsonView::path() const {
  if (text().empty() || text().find('\0') != std::string::npos) refuse("is not a path");
  return text();
}

bool JsonView::truth() const {
  if (!value_->is_boolean()) refuse("is neither true nor false");
  return value_->get<bool>();
}

double JsonView::number(double least) const {
  if (!value_->is_number()) refuse("is not a number");
  const auto number = value_->get<double>();
  if (!(number >= least)) refuse("is out of range");
  return number;
}

std::int64_t JsonView::integer(std::int64_t least, std::int64_t most) const {
  if (!value_->is_number_integer()) refuse("is not a whole number");
  const bool fits = !value_->is_number_unsigned() ||
                    value_->get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<std::int64_t>::max()};
  const std::int64_t number = fits ? value_->get<std::int64_t>() : 0;
  if (!fits || number < least || number > most) refuse("is out of range");
  return number;
}

std::uint64_t JsonView::count(std::uint64_t most) const {
  if (!value_->is_number_integer()) refuse("is not a whole number");
  if (!value_->is_number_unsigned() && value_->get<std::int64_t>() < 0) refuse("is below 0");
  const auto number = value_->get<std::uint64_t>();
  if (number > most) refuse("is out of range");
  return number;
}

void JsonView::refuse(std::string_view what) const {
  throw core::BadInput(subject_ + ": " + (where_.empty() ? "it" : where_) + " " + std::string(what));
}

}  // namespace morsel::tools
