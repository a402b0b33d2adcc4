#include "morsel/tools/study/registry.h"

#include <algorithm>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/text/nearest_name.h"
#include "morsel/morse/functions/atomic_density.h"
#include "morsel/morse/functions/curvature.h"
#include "morsel/morse/functions/curvature_functions.h"
#include "morsel/morse/functions/eigenfunction.h"
#include "morsel/morse/functions/geodesic.h"
#include "morsel/morse/functions/height.h"
#include "morsel/morse/functions/spectral_signatures.h"
#include "morsel/morse/functions/vertex_scalar.h"
#include "morsel/morse/smoothing/conventional.h"
#include "morsel/morse/smoothing/denoise.h"
#include "morsel/morse/smoothing/diffusion.h"
#include "morsel/morse/smoothing/fair.h"
#include "morsel/morse/smoothing/gaussian.h"
#include "morsel/morse/smoothing/saliency.h"
#include "morsel/morse/smoothing/salient.h"
#include "morsel/morse/smoothing/spectral.h"
#include "morsel/persistence/cancellation.h"

namespace morsel::tools {
namespace {

std::vector<FunctionEntry> standard_functions() {
  return {
      FunctionEntry{"atomic-density",
                    "density of the atoms around a molecular surface (Natarajan et al. 2006)",
                    morse::make_atomic_density},
      FunctionEntry{"curvedness", "how strongly the surface bends (Koenderink, van Doorn 1992)",
                    morse::make_curvedness, "1/length"},
      FunctionEntry{"eigenfunction",
                    "eigenfunction of the Laplacian (Dong et al. 2006), the lowest by default",
                    morse::make_eigenfunction},
      FunctionEntry{"gaussian-curvature",
                    "Gaussian curvature, the angle defect (Meyer et al. 2003), or diffused",
                    morse::make_gaussian_curvature, "1/length²"},
      FunctionEntry{"geodesic", "distance along the surface, from sources or on average (Crane et al. 2013)",
                    morse::make_geodesic, "length"},
      FunctionEntry{"heat-kernel-signature",
                    "the heat that is left at its source after a time (Sun et al. 2009)",
                    morse::make_heat_kernel_signature, "1/length²"},
      FunctionEntry{"height", "distance along an axis or a direction", morse::make_height, "length"},
      FunctionEntry{"mean-curvature", "mean curvature (Taubin 1995), positive on a sphere",
                    morse::make_mean_curvature, "1/length"},
      FunctionEntry{"principal-curvature", "the larger or the smaller principal curvature",
                    morse::make_principal_curvature, "1/length"},
      FunctionEntry{"shape-index", "cap 1, ridge, saddle 0, rut, cup -1 (Koenderink, van Doorn 1992)",
                    morse::make_shape_index},
      FunctionEntry{"vertex-scalar", "values from a text file or from a property of the mesh's PLY file",
                    morse::make_vertex_scalar},
      FunctionEntry{"wave-kernel-signature", "how likely a particle of an energy is met (Aubry et al. 2011)",
                    morse::make_wave_kernel_signature, "1/length²"},
  };
}

std::vector<MethodEntry> standard_methods() {
  return {
      MethodEntry{"conventional", "the field as it is: PL critical points (Banchoff 1970)",
                  morse::make_conventional},
      MethodEntry{"denoise",
                  "smoothing of the surface before the function is evaluated again (Fleishman et al. 2003)",
                  morse::make_denoise},
      MethodEntry{"fair", "harmonic but for chosen extrema (Ni, Garland, Hart 2004)", morse::make_fair},
      MethodEntry{"gaussian", "Gaussian averages, the paper's equation (1)", morse::make_gaussian},
      MethodEntry{"laplacian",
                  "Laplacian smoothing of the field (Ni, Garland, Hart 2004), explicit or implicit",
                  morse::make_laplacian},
      MethodEntry{"saliency", "mesh saliency over several scales (Lee, Varshney, Jacobs 2005)",
                  morse::make_saliency},
      MethodEntry{"salient", "iterated saliency, the paper's bilateral smoothing of the field",
                  morse::make_salient},
      MethodEntry{"spectral", "projection on the lowest eigenfunctions of the Laplacian",
                  morse::make_spectral},
      MethodEntry{"tps", "persistence simplification (Edelsbrunner, Letscher, Zomorodian 2002)",
                  persistence::make_tps},
  };
}

template <class Entries>
const auto& find_entry(const Entries& entries, const std::string& name, std::string_view kind) {
  const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.name == name; });
  if (entry != entries.end()) return *entry;
  std::vector<std::string> names(entries.size());
  std::ranges::transform(entries, names.begin(), [](const auto& e) { return e.name; });
  throw core::InvalidArgument("there is no " + std::string(kind) + " \"" + name + "\"" +
                              core::nearest_of(name, names, "there are"));
}

template <class Entries>
void check_new(const Entries& entries, const std::string& name, const std::string& kind) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789-";
  if (name.empty() || name.find_first_not_of(kLetters) != std::string::npos)
    throw core::InvalidArgument("\"" + name + "\" is no name of a " + kind +
                                ": it has small letters, digits and dashes only");
  if (std::ranges::find(entries, name, [](const auto& entry) { return entry.name; }) != entries.end())
    throw core::InvalidArgument("there is a " + kind + " of the name " + name + " already");
}

/// Makes the entry by `reader` and throws on keys that it does not declare.
template <class Entry>
auto make_entry(const Entry& entry, core::ParameterReader& reader) {
  auto made = entry.make(reader);
  reader.finish();
  return made;
}

template <class Entry>
std::vector<core::ParameterInfo> declared_by(const Entry& entry) {
  core::ParameterReader reader = core::ParameterReader::for_help(entry.name);
  entry.make(reader);
  return reader.declared();
}

template <class Entry>
std::vector<std::string> keys_of(const Entry& entry) {
  std::vector<std::string> keys;
  for (const core::ParameterInfo& info : declared_by(entry)) keys.push_back(info.key);
  return keys;
}

template <class Entry>
std::string describe(const Entry& entry) {
  std::string text = entry.name + ": " + entry.summary + "\n";
  for (const core::ParameterInfo& info : declared_by(entry)) {
    std::string key = "  " + info.key + "=" + (info.default_value.empty() ? "..." : info.default_value);
    key.resize(std::max<std::size_t>(key.size() + 2, 26), ' ');
    text += key + info.description + "\n";
  }
  return text;
}

}  // namespace

core::BuildOptions build_for(std::span<const NamedFunction> functions, core::BuildOptions build) {
  for (const NamedFunction& function : functions)
    if (const core::VertexValues* values = function.function->given_values()) build.needed.push_back(*values);
  return build;
}

core::BuildOptions build_for(const NamedFunction& function, core::BuildOptions build) {
  return build_for(std::span(&function, 1), std::move(build));
}

std::string MethodChain::quantity() const {
  return steps.empty() ? "" : steps.back().method->traits().quantity;
}

const Registry& Registry::standard() {
  static const Registry registry = [] {
    Registry made;
    for (FunctionEntry& entry : standard_functions()) made.add(std::move(entry));
    for (MethodEntry& entry : standard_methods()) made.add(std::move(entry));
    return made;
  }();
  return registry;
}

Registry& Registry::add(FunctionEntry entry) {
  check_new(functions_, entry.name, "Morse function");
  functions_.push_back(std::move(entry));
  return *this;
}

Registry& Registry::add(MethodEntry entry) {
  check_new(methods_, entry.name, "method");
  methods_.push_back(std::move(entry));
  return *this;
}

NamedFunction Registry::make_function(std::string_view specification, std::string_view what) const {
  core::Specification parsed = core::parse_specification(specification, what);
  const FunctionEntry& entry = find_entry(functions_, parsed.name, "Morse function");
  core::ParameterReader reader(std::move(parsed));
  auto function = make_entry(entry, reader);
  return {std::string(specification), entry.name, std::move(function), reader.files(), entry.unit};
}

MethodChain Registry::make_method(std::string_view specification, std::string_view what) const {
  MethodChain chain{std::string(specification), "", {}};
  for (core::Specification& link : core::parse_chain(specification, what)) {
    const MethodEntry& entry = find_entry(methods_, link.name, "method");
    const std::string text = core::to_string(link);
    core::ParameterReader reader(std::move(link));
    MethodStep step{entry.name, make_entry(entry, reader)};
    if (step.method->traits().reevaluates_function && !chain.steps.empty())
      throw core::InvalidArgument(text +
                                  " evaluates the Morse function again and does not use the field of " +
                                  chain.name + ", so it can only be the first step of a chain");
    chain.name += (chain.name.empty() ? "" : "+") + step.name;
    chain.steps.push_back(std::move(step));
  }
  return chain;
}

std::vector<core::ParameterInfo> Registry::parameters_of_function(const std::string& name) const {
  return declared_by(find_entry(functions_, name, "Morse function"));
}

std::vector<core::ParameterInfo> Registry::parameters_of_method(const std::string& name) const {
  return declared_by(find_entry(methods_, name, "method"));
}

std::vector<std::string> Registry::keys_of_function(const std::string& name) const {
  return keys_of(find_entry(functions_, name, "Morse function"));
}

std::vector<std::string> Registry::keys_of_method(const std::string& name) const {
  return keys_of(find_entry(methods_, name, "method"));
}

core::MethodTraits Registry::traits_of_method(const std::string& name) const {
  core::ParameterReader reader = core::ParameterReader::for_help(name);
  return find_entry(methods_, name, "method").make(reader)->traits();
}

std::string Registry::describe_function(const std::string& name) const {
  return describe(find_entry(functions_, name, "Morse function"));
}

std::string Registry::describe_method(const std::string& name) const {
  return describe(find_entry(methods_, name, "method"));
}

}  // namespace morsel::tools
