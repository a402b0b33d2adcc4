#include "morsel/core/io/atom_selection.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/residue_names.h"
#include "morsel/core/text/ascii_case.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

constexpr int kDeepest = 100;

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

/// By recursive descent, whose depth is bounded.
class AtomSelection::Parser {
 public:
  Parser(std::string_view text, std::vector<Step>& steps) : text_(text), steps_(steps) { advance(); }

  void parse() {
    expression(0);
    if (!word_.empty()) fail("here " + shown(word_) + " cannot follow");
  }

 private:
  struct Keyword {
    std::string_view word;
    Operation operation;
    bool has_values;
  };
  static constexpr Keyword kKeywords[] = {{"all", Operation::all, false},
                                          {"polymer", Operation::polymer, false},
                                          {"ligand", Operation::ligand, false},
                                          {"ion", Operation::ion, false},
                                          {"water", Operation::water, false},
                                          {"hydrogen", Operation::hydrogen, false},
                                          {"hetero", Operation::hetero, false},
                                          {"chain", Operation::chain, true},
                                          {"resname", Operation::residue_name, true},
                                          {"residue", Operation::residue, true},
                                          {"name", Operation::name, true},
                                          {"element", Operation::element, true}};

  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidArgument("the selection " + shown(text_) + " is wrong at character " +
                          std::to_string(start_ + 1) + ": " + what);
  }

  /// Reads the next word: a parenthesis, a text in quotes, or up to a blank, comma or parenthesis.
  void advance() {
    constexpr std::string_view kSpace = " \t\r\n\f\v";
    next_ = std::min(text_.find_first_not_of(kSpace, next_), text_.size());
    after_comma_ = false;
    while (next_ < text_.size() && text_[next_] == ',') {
      after_comma_ = true;
      next_ = std::min(text_.find_first_not_of(kSpace, next_ + 1), text_.size());
    }
    start_ = next_;
    is_quoted_ = false;
    word_ = {};
    if (start_ == text_.size()) return;
    if (text_[start_] == '"') {
      const std::size_t end = text_.find('"', start_ + 1);
      if (end == std::string_view::npos) fail("the quotation mark is not closed");
      if (end == start_ + 1) fail("there is nothing between the quotation marks");
      is_quoted_ = true;
      word_ = text_.substr(start_ + 1, end - start_ - 1);
      next_ = end + 1;
      return;
    }
    const bool parenthesis = text_[start_] == '(' || text_[start_] == ')';
    next_ =
        parenthesis ? start_ + 1 : std::min(text_.find_first_of(" \t\r\n\f\v,()\"", start_), text_.size());
    word_ = text_.substr(start_, next_ - start_);
  }

  bool is(std::string_view keyword) const { return !is_quoted_ && is_keyword(word_, keyword); }

  void expression(int depth) {
    term(depth);
    while (is("or")) {
      advance();
      term(depth);
      steps_.push_back({Operation::disjunction});
    }
  }

  void term(int depth) {
    factor(depth);
    while (is("and")) {
      advance();
      factor(depth);
      steps_.push_back({Operation::conjunction});
    }
  }

  void factor(int depth) {
    if (depth > kDeepest)
      fail("there are more than " + std::to_string(kDeepest) + " parentheses and negations in one another");
    if (after_comma_) fail("a comma only separates values");
    if (is("not")) {
      advance();
      factor(depth + 1);
      steps_.push_back({Operation::negation});
      return;
    }
    if (is("(")) {
      advance();
      expression(depth + 1);
      if (!is(")")) fail("a closing parenthesis is missing");
      advance();
      return;
    }
    for (const Keyword& keyword : kKeywords) {
      if (!is(keyword.word)) continue;
      advance();
      Step step{keyword.operation};
      if (keyword.has_values) values(keyword.word, step);
      steps_.push_back(std::move(step));
      return;
    }
    fail((word_.empty() ? std::string("a group or property is missing")
                        : "there is no group or property " + shown(word_)) +
         "; there are all, polymer, ligand, ion, water, hydrogen and hetero, and chain, resname, residue, "
         "name and element, which take values");
  }

  void values(std::string_view property, Step& step) {
    const auto ends = [&] {
      return (word_.empty() && !is_quoted_) || is("and") || is("or") || is("(") || is(")");
    };
    if (ends()) fail(std::string(property) + " needs a value");
    while (!ends()) {
      if (step.operation == Operation::residue)
        step.stretches.push_back(stretch());
      else
        step.names.push_back(step.operation == Operation::chain ? std::string(word_) : in_capitals(word_));
      advance();
    }
    if (after_comma_) fail("a value is missing after the comma");
  }

  Stretch stretch() const {
    std::string_view rest = word_;
    Stretch result;
    bool good = parse_place(rest, result.first);
    result.last = result.first;
    if (good && !rest.empty()) {
      good = rest[0] == '-';
      rest.remove_prefix(1);
      good = good && parse_place(rest, result.last) && rest.empty();
    }
    if (!good)
      fail("a residue is a number with its insertion code, or a range of them, as in 52, 52A or 10-20, not " +
           shown(word_));
    if (result.last < result.first) fail("the range " + shown(word_) + " ends before it begins");
    return result;
  }

  std::string_view text_;
  std::vector<Step>& steps_;
  std::string_view word_;
  bool is_quoted_ = false;
  bool after_comma_ = false;
  std::size_t start_ = 0;  // of the word
  std::size_t next_ = 0;
};

AtomSelection::AtomSelection(std::string_view text) { Parser(text, steps_).parse(); }

/// Takes a number and the letters after it from the beginning of the text.
bool AtomSelection::parse_place(std::string_view& text, Place& place) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), place.number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  const std::size_t code = std::min(text.find('-'), text.size());
  place.code = in_capitals(text.substr(0, code));
  text.remove_prefix(code);
  return place.code.size() <= 1;
}

bool AtomSelection::takes(const Atom& atom) const {
  std::vector<bool> stack;
  for (const Step& step : steps_) {
    if (step.operation == Operation::negation) {
      stack.back() = !stack.back();
    } else if (step.operation == Operation::conjunction || step.operation == Operation::disjunction) {
      const bool right = stack.back();
      stack.pop_back();
      stack.back() = step.operation == Operation::conjunction ? stack.back() && right : stack.back() || right;
    } else {
      stack.push_back(holds(step, atom));
    }
  }
  return stack.back();
}

bool AtomSelection::holds(const Step& step, const Atom& atom) const {
  switch (step.operation) {
    case Operation::polymer:
      return atom.polymer;
    case Operation::ligand:
      return !atom.polymer && !atom.ion && !atom.water;
    case Operation::ion:
      return atom.ion;
    case Operation::water:
      return atom.water;
    case Operation::hydrogen:
      return atom.hydrogen;
    case Operation::hetero:
      return atom.hetero;
    case Operation::chain:
      return is_in(step.names, atom.chain);
    case Operation::residue_name:
      return is_in(step.names, in_capitals(atom.residue));
    case Operation::name:
      return is_in(step.names, in_capitals(atom.name));
    case Operation::element:
      return is_in(step.names, in_capitals(atom.element));
    case Operation::residue: {
      std::string_view text = atom.sequence_id;
      Place place;
      if (!parse_place(text, place) || !text.empty()) return false;
      return std::any_of(step.stretches.begin(), step.stretches.end(), [&](const Stretch& stretch) {
        return stretch.first <= place && place <= stretch.last;
      });
    }
    default:
      return true;
  }
}

}  // namespace morsel::core
