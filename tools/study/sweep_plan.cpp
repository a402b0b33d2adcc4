#include "morsel/tools/study/sweep_plan.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/listed.h"
#include "morsel/core/text/nearest_name.h"

namespace morsel::tools {
namespace {

using core::InvalidArgument;

/// The place of a varied key: in the field (0) or in a step of the method (from 1 on).
struct Place {
  std::size_t link = 0;
  std::string key;
  friend bool operator==(const Place&, const Place&) = default;
};

/// The field followed by the steps, and the keys of each.
class Links {
 public:
  Links(const SweepRequest& request, const Registry& registry) {
    links_ = {core::parse_specification(request.field, "the Morse function")};
    for (core::Specification& step : core::parse_chain(request.method, "the method"))
      links_.push_back(std::move(step));
    keys_ = {registry.keys_of_function(links_.front().name)};
    for (std::size_t i = 1; i < links_.size(); ++i) keys_.push_back(registry.keys_of_method(links_[i].name));
  }

  Place place(const std::string& key) const {
    const std::size_t dot = key.find('.');
    Place found = dot == std::string::npos ? place_of(key)
                                           : Place{link_of(key, key.substr(0, dot)), key.substr(dot + 1)};
    if (std::ranges::count(keys_[found.link], found.key) == 0)
      throw refused(
          key, links_[found.link].name + " has no key \"" + found.key + "\"" +
                   (keys_[found.link].empty() ? "; it has none"
                                              : core::nearest_of(found.key, keys_[found.link], "it has")));
    for (const auto& [given, value] : links_[found.link].given)
      if (given == found.key)
        throw refused(key, "it is given as " + value + " in \"" + to_string(links_[found.link]) +
                               "\": leave it out there");
    return found;
  }

  Combination combination(const std::vector<Place>& places, const std::vector<Variation>& variations,
                          std::vector<std::size_t> choices) const {
    std::vector<core::Specification> links = links_;
    for (std::size_t i = 0; i < places.size(); ++i)
      links[places[i].link].given.emplace_back(places[i].key, variations[i].values[choices[i]]);
    core::Specification field = std::move(links.front());
    links.erase(links.begin());
    return {std::move(choices), std::move(field), std::move(links)};
  }

 private:
  static InvalidArgument refused(const std::string& key, const std::string& why) {
    return InvalidArgument("the key \"" + key + "\" cannot be varied: " + why);
  }

  static std::string names_text(const std::vector<std::string>& names) {
    return names.empty() ? "none" : core::listed(names);
  }

  /// The prefix of a key of this step: its name if that is unique, else its number.
  std::string prefix(std::size_t link) const {
    if (link == 0) return "field";
    const bool alone = std::count_if(links_.begin() + 1, links_.end(),
                                     [&](const auto& other) { return other.name == links_[link].name; }) == 1;
    return alone ? links_[link].name : std::to_string(link);
  }

  Place place_of(const std::string& key) const {
    std::vector<std::string> ways;
    Place found;
    for (std::size_t i = 0; i < links_.size(); ++i)
      if (std::ranges::count(keys_[i], key) > 0) {
        ways.push_back(prefix(i) + "." + key);
        found = {i, key};
      }
    if (ways.size() == 1) return found;
    if (ways.size() > 1)
      throw refused(key, "it could be any of " + core::listed(ways) + "; write one of these");
    std::string known;
    std::vector<std::string> all;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      known += (i == 0 ? "" : "; ") + links_[i].name + ": " + names_text(keys_[i]);
      all.insert(all.end(), keys_[i].begin(), keys_[i].end());
    }
    const std::string hint = core::nearest_hint(key, all);
    throw refused(key, "neither the field nor the method has it" +
                           (hint.empty() ? "; there are " : hint + " There are ") + known);
  }

  std::size_t link_of(const std::string& key, const std::string& name) const {
    if (name == "field") return 0;
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error == std::errc() && end == name.data() + name.size()) {
      if (number < 1 || number >= links_.size())
        throw refused(key, "there is no step " + name + ": the method has " +
                               std::to_string(links_.size() - 1) + (links_.size() == 2 ? " step" : " steps"));
      return number;
    }
    std::vector<std::string> ways;
    std::size_t found = 0;
    for (std::size_t i = 0; i < links_.size(); ++i)
      if (links_[i].name == name) {
        ways.push_back(prefix(i) + key.substr(name.size()));
        found = i;
      }
    if (ways.size() == 1) return found;
    if (ways.empty()) {
      std::vector<std::string> names;
      for (const core::Specification& link : links_) names.push_back(link.name);
      throw refused(key, "neither the field nor a step of the method is called " + name +
                             core::nearest_hint(name, names));
    }
    throw refused(key, "it could be any of " + core::listed(ways) + "; write one of these");
  }

  std::vector<core::Specification> links_;
  std::vector<std::vector<std::string>> keys_;
};

}  // namespace

SweepPlan prepare(const SweepRequest& request, const Registry& registry) {
  if (request.vary.empty())
    throw InvalidArgument(
        "nothing varies: give a key and its values, such as iterations=1..20 or sigma=4eps,8eps,16eps");
  const Links links(request, registry);
  SweepPlan plan{{}, {}, registry};
  std::vector<Place> places;
  std::size_t count = 1;
  for (const std::string& text : request.vary) {
    plan.variations.push_back(parse_variation(text));
    const Variation& variation = plan.variations.back();
    Place place = links.place(variation.key);
    if (std::ranges::count(places, place) > 0)
      throw InvalidArgument("the key \"" + variation.key + "\" is varied twice: give all its values at once");
    places.push_back(std::move(place));
    count = std::min(count * variation.values.size(), kMostCombinations + 1);
  }
  if (count > kMostCombinations)
    throw InvalidArgument("the sweep has more than " + std::to_string(kMostCombinations) +
                          " combinations; sweep in parts");
  std::vector<std::size_t> choices(places.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    plan.combinations.push_back(links.combination(places, plan.variations, choices));
    registry.make_function(to_string(plan.combinations.back().field));
    registry.make_method(to_string(plan.combinations.back().steps));
    for (std::size_t k = places.size(); k-- > 0;) {
      if (++choices[k] < plan.variations[k].values.size()) break;
      choices[k] = 0;
    }
  }
  return plan;
}

}  // namespace morsel::tools
