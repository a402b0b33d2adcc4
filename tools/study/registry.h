#pragma once
/// The Morse functions and methods that can be chosen by name. A new one is a header and source pair in its
/// module and a line in registry.cpp; a user of the library adds their own to a copy.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "morsel/core/field/method.h"
#include "morsel/core/mesh/mesh_builder.h"
#include "morsel/core/text/parameters.h"

namespace morsel::tools {

struct FunctionEntry {
  std::string name;
  std::string summary;  ///< one line for help
  /// Reads the keys, each with a default, and makes the function. Throws InvalidArgument.
  std::function<std::unique_ptr<core::MorseFunction>(core::ParameterReader&)> make;
  std::string unit = {};  ///< of its values, in terms of the mesh's ("1/length"); empty if none or unknown
};

struct MethodEntry {
  std::string name;
  std::string summary;
  std::function<std::unique_ptr<core::Method>(core::ParameterReader&)> make;
};

/// A Morse function by its text ("height:axis=z").
struct NamedFunction {
  std::string specification;  ///< as given
  std::string name;
  std::unique_ptr<core::MorseFunction> function;
  std::vector<core::FileParameter> files = {};  ///< that it is going to read
  std::string unit = {};                        ///< its entry's
};

/// How a mesh is made on which the functions are evaluated: as `build` has it, and without the vertices where
/// values that they are given (MorseFunction::given_values()) are nan.
core::BuildOptions build_for(std::span<const NamedFunction> functions, core::BuildOptions build);
core::BuildOptions build_for(const NamedFunction& function, core::BuildOptions build);

/// One step of a chain of methods.
struct MethodStep {
  std::string name;
  std::unique_ptr<core::Method> method;
};

/// A method by its text, a chain ("salient:iterations=5+tps:count=150") or a single step.
struct MethodChain {
  std::string specification;  ///< as given
  std::string name;           ///< "salient+tps"
  std::vector<MethodStep> steps;

  /// MethodTraits::quantity of the last step.
  std::string quantity() const;
};

/// A value: copies are independent. Looking up is thread-safe, adding is not.
class Registry {
 public:
  /// What ships with the library.
  static const Registry& standard();

  /// Throw InvalidArgument if the name is taken, or is none: small letters, digits and dashes.
  Registry& add(FunctionEntry entry);
  Registry& add(MethodEntry entry);

  std::span<const FunctionEntry> functions() const { return functions_; }
  std::span<const MethodEntry> methods() const { return methods_; }

  /// Throw InvalidArgument on unknown names and keys, listing the valid ones, and on bad values. They touch
  /// no file. `what` names the text in errors.
  NamedFunction make_function(std::string_view specification,
                              std::string_view what = "the Morse function") const;
  MethodChain make_method(std::string_view specification, std::string_view what = "the method") const;

  /// The keys that a Morse function or method has, in the order in which it declares them. Throw
  /// InvalidArgument if there is none of that name.
  std::vector<core::ParameterInfo> parameters_of_function(const std::string& name) const;
  std::vector<core::ParameterInfo> parameters_of_method(const std::string& name) const;
  /// Their names alone.
  std::vector<std::string> keys_of_function(const std::string& name) const;
  std::vector<std::string> keys_of_method(const std::string& name) const;

  /// The traits that a method has with its defaults. Throws InvalidArgument as above.
  core::MethodTraits traits_of_method(const std::string& name) const;

  /// An entry with its keys, defaults and descriptions, as help shows it. Throw InvalidArgument as above.
  std::string describe_function(const std::string& name) const;
  std::string describe_method(const std::string& name) const;

 private:
  std::vector<FunctionEntry> functions_;
  std::vector<MethodEntry> methods_;
};

}  // namespace morsel::tools
