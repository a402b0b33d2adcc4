#pragma once
/// The one list of Morse functions and the one list of methods. A new one is a header and source pair in its
/// module and one line in registry.cpp.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/text/parameters.h"

namespace morsel::tools {

struct FunctionEntry {
  std::string_view name;
  std::string_view summary;  ///< one line for help
  std::unique_ptr<core::MorseFunction> (*make)(core::ParameterReader&);
  std::string_view file_key = {};  ///< the key that names a file to read, if there is one
};

/// What is peculiar about a method, for whoever composes methods.
enum class MethodRole : std::uint8_t {
  smooths,  ///< nothing: it makes a field of the field it is given
  cancels,  ///< takes critical points away pair by pair: fields between its input and its output have no use
  retakes   ///< takes the Morse function again whatever the field it is given: nothing can come before it
};

struct MethodEntry {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<core::Method> (*make)(core::ParameterReader&);
  MethodRole role = MethodRole::smooths;
  bool (*retakes)(const core::Method&) = nullptr;  ///< asked if parameters decide whether the role is that
};

std::span<const FunctionEntry> morse_functions();
std::span<const MethodEntry> methods();

/// A Morse function by its text ("height:axis=z").
struct NamedFunction {
  std::string specification;  ///< as given
  std::string name;
  std::unique_ptr<core::MorseFunction> function;
  std::string file_key = {};  ///< its entry's
};

/// One step of a chain of methods.
struct MethodStep {
  std::string name;
  std::unique_ptr<core::Method> method;
  MethodRole role = MethodRole::smooths;
};

/// A method by its text, a chain ("salient:iterations=5+tps:count=150") or a single step.
struct MethodChain {
  std::string specification;  ///< as given
  std::string name;           ///< "salient+tps"
  std::vector<MethodStep> steps;
};

/// Throw InvalidArgument on unknown names and keys, listing the valid ones, and on bad values. They touch no
/// file.
NamedFunction make_function(std::string_view specification);
MethodChain make_method(std::string_view specification);

/// The keys that a Morse function or method has. Throw InvalidArgument if there is none of that name.
std::vector<std::string> keys_of_function(const std::string& name);
std::vector<std::string> keys_of_method(const std::string& name);

/// An entry with its keys, defaults and descriptions, as help shows it. Throw InvalidArgument as above.
std::string describe_function(const std::string& name);
std::string describe_method(const std::string& name);

}  // namespace morsel::tools
