#include "morsel/tools/batch/state.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "morsel/core/error.h"
#include "morsel/core/io/file_bytes.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/text/parameters.h"
#include "morsel/tools/batch/request.h"
#include "morsel/tools/formats/json_view.h"
#include "morsel/tools/report/report_reader.h"
#include "morsel/tools/report/result_shapes.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchema = "morsel.batch-state/1";
constexpr int kBadInput = 3;  // of the program's exit codes
constexpr int kOutOfMemory = 5;
constexpr int kMostExitCode = 255;
constexpr int kMostSignal = 64;
constexpr std::size_t kMostBytes = std::size_t{64} << 20;  // a thousand times what a state has

/// Whether the error of reading a file is that of its disk or network, not of the file.
bool is_of_a_device(const std::string& message) {
  constexpr std::array kErrors = {EIO, ESTALE, ETIMEDOUT, ENODEV, EHOSTDOWN};
  return std::any_of(kErrors.begin(), kErrors.end(), [&](int error) {
    return message.find(std::generic_category().message(error)) != std::string::npos;
  });
}

/// Whether a child had no memory left, by its exit code and sentence; the code is that of other resources,
/// too. Threads cannot be made either where there is no memory for their stacks.
bool ran_out_of_memory(const ChildEnd& end) {
  constexpr std::array kSaid = {"out of memory", "Resource temporarily unavailable"};
  return end.exit_code == kOutOfMemory && std::any_of(kSaid.begin(), kSaid.end(), [&](const char* text) {
           return end.message.find(text) != std::string::npos;
         });
}

std::optional<JsonView> unless_null(const JsonView& value) {
  return value.is_null() ? std::nullopt : std::optional(value);
}

MeshError error_from(const JsonView& json) {
  check_members(json, {"kind", "exit_code", "signal", "message"});
  MeshError error;
  error.kind = json["kind"].text_of({"exit-code", "signal", "time-limit", "memory-limit"});
  if (const auto code = unless_null(json["exit_code"]))
    error.exit_code = static_cast<int>(code->integer(0, kMostExitCode));
  if (const auto signal = unless_null(json["signal"]))
    error.signal = static_cast<int>(signal->integer(1, kMostSignal));
  error.message = json["message"].text();
  return error;
}

ChildLimits limits_from(const JsonView& json) {
  check_members(json, {"seconds", "memory_mib"});
  ChildLimits limits;
  if (const auto seconds = unless_null(json["seconds"])) limits.seconds = seconds->number(0);
  if (const auto memory = unless_null(json["memory_mib"])) limits.memory_mib = memory->count();
  return limits;
}

/// Whether a made file stays within the folders that are made.
bool is_made_file(const std::string& file) {
  const fs::path path = file;
  return !file.empty() && file.find('\0') == std::string::npos && path.is_relative() &&
         std::none_of(path.begin(), path.end(),
                      [](const fs::path& part) { return part.empty() || part == "." || part == ".."; });
}

std::vector<std::string> files_from(const JsonView& json) {
  std::vector<std::string> files;
  for (const JsonView& file : json.list(1)) {
    if (!is_made_file(file.text())) file.refuse("is not a file of the mesh's own");
    files.push_back(file.text());
  }
  return files;
}

void check_method(const JsonView& method) {
  check_members(method, {"name", "parameters", "field", "critical_points", "ms_complex", "compared_to_first",
                         "persistence"});
  static_cast<void>(method["name"].text());
  check_parameters(method["parameters"]);
  check_range(method["field"]);
  check_critical_points(method["critical_points"]);
  check_counts(method["ms_complex"], {"minima", "saddles", "maxima", "caps", "arcs", "quads"});
  check_counts(method["ms_complex"]["segments"], {"descending", "ascending", "morse_smale"});
  check_members(method["compared_to_first"], {"kept", "moved", "added", "removed"});
  check_counts(method["compared_to_first"], {"kept", "moved", "added", "removed"});
  check_persistence(method["persistence"]);
}

/// Checks all that the summary, its page and its plots read from a state's result and timings.
void check_result(const JsonView& result, const JsonView& timings, std::size_t methods) {
  check_members(result, {"mesh", "field", "methods"});
  check_mesh(result["mesh"]);
  check_field(result["field"]);
  for (const JsonView& method : result["methods"].list(methods, methods)) check_method(method);
  for (const JsonView& method : timings["methods"].list(methods, methods))
    for (const auto& [step, seconds] : method.members())
      step == "name" ? static_cast<void>(seconds.text()) : static_cast<void>(seconds.number(0));
}

/// A method of a report without its lists.
Json method_result(const JsonView& method) {
  Json kept;
  for (const char* key :
       {"name", "parameters", "field", "critical_points", "ms_complex", "compared_to_first", "persistence"})
    kept[key] = method[key].json();
  if (kept["persistence"].is_object()) kept["persistence"].erase("diagram");
  return kept;
}

}  // namespace

bool MeshError::may_pass() const {
  constexpr std::array kFromOutside = {SIGKILL, SIGTERM, SIGINT,  SIGHUP,  SIGPIPE, SIGALRM,
                                       SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU, SIGPWR};
  if (kind == "signal")
    return std::find(kFromOutside.begin(), kFromOutside.end(), signal) != kFromOutside.end();
  constexpr std::array kCodes = {4, kOutOfMemory, 127, 130, 143};
  if (kind != "exit-code") return false;
  if (exit_code == kBadInput) return is_of_a_device(message);
  return std::find(kCodes.begin(), kCodes.end(), exit_code) != kCodes.end();
}

std::vector<std::string> mesh_warnings(const MeshState& state) {
  if (!state.result.contains("mesh") || !state.result["mesh"].contains("warnings")) return {};
  return state.result["mesh"]["warnings"].get<std::vector<std::string>>();
}

std::optional<MeshError> error_of(const ChildEnd& end, const ChildLimits& limits) {
  if (end.exit_code == 0) return std::nullopt;
  MeshError error{"exit-code", end.exit_code, end.signal, valid_text(end.message)};
  if (end.timed_out) {
    error.kind = "time-limit";
    error.message = "longer than the time limit of " + core::shortest(limits.seconds) + " s";
  } else if (limits.memory_mib > 0 && ran_out_of_memory(end)) {
    error.kind = "memory-limit";
    error.message = "more memory than the limit of " + std::to_string(limits.memory_mib) + " MiB";
  } else if (end.signal != 0) {
    error.kind = "signal";
    const char* name = ::sigabbrev_np(end.signal);
    error.message = "ended by signal " + std::to_string(end.signal) +
                    (name != nullptr ? std::string(" (SIG") + name + ")" : "") +
                    (end.message.empty() ? "" : ": " + valid_text(end.message));
  }
  return error;
}

void take_result(const fs::path& path, MeshState& state) {
  const LoadedReport report = read_report(path);
  const JsonView head(report.document.head, path.string() + " is a damaged report");
  state.result = {{"mesh", head["mesh"].json()}, {"field", head["field"].json()}, {"methods", Json::array()}};
  for (const JsonView& method : head["methods"].list())
    state.result["methods"].push_back(method_result(method));
  state.timings = head["timings"].json();
  check_result({state.result, path.string() + " is a damaged report"}, head["timings"],
               report.request.methods.size());
}

bool is_settled(const MeshState& state, const Json& key, const ChildLimits& limits,
                const std::vector<Product>& products) {
  if (state.key != key) return false;
  if (state.error) return state.limits == limits && !state.error->may_pass();
  const auto is_there = [&](const std::string& file) {
    std::error_code error;
    return fs::is_regular_file(place_of(file, products), error);
  };
  const auto has_files = [&](const Product& product) {
    return std::any_of(state.files.begin(), state.files.end(), [&](const std::string& file) {
      return file == product.made || file.starts_with(product.made + "/");
    });
  };
  return std::all_of(state.files.begin(), state.files.end(), is_there) &&
         std::all_of(products.begin(), products.end(),
                     [&](const Product& product) { return !product.wanted || has_files(product); });
}

Json to_json(const MeshError& error) {
  return {{"kind", error.kind},
          {"exit_code", error.exit_code < 0 ? Json() : Json(error.exit_code)},
          {"signal", error.signal == 0 ? Json() : Json(error.signal)},
          {"message", error.message}};
}

Json to_json(const ChildLimits& limits) {
  return {{"seconds", limits.seconds == 0 ? Json() : Json(limits.seconds)},
          {"memory_mib", limits.memory_mib == 0 ? Json() : Json(limits.memory_mib)}};
}

void write_state(const fs::path& path, const MeshState& state) {
  Json json = {{"schema", kSchema}, {"key", state.key}, {"status", state.error ? "failed" : "done"}};
  if (state.error) {
    json["error"] = to_json(*state.error);
    json["limits"] = to_json(state.limits);
  } else {
    json["files"] = state.files;
    json["result"] = state.result;
    json["timings"] = state.timings;
  }
  json["seconds"] = state.seconds;
  core::write_file(path, json_text(json, 2) + "\n");
}

std::optional<MeshState> read_state(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return std::nullopt;
  if (const std::uintmax_t size = fs::file_size(path, error); !error && size > kMostBytes)
    throw core::BadInput(path.string() + " is not a state: it has " + std::to_string(size) + " bytes");
  const core::FileBytes bytes(path, path.string());
  return parse_state(bytes.view(), path.string());
}

std::optional<MeshState> parse_state(std::string_view text, const std::string& name) {
  const Json document = read_json(text, name, {.bytes = kMostBytes});
  const JsonView json(document, name + " is a damaged state");
  if (json["schema"].text() != kSchema) return std::nullopt;
  MeshState state;
  state.key = json["key"].json();
  const std::size_t methods = json["key"]["request"]["methods"].list(1).size();
  state.seconds = json["seconds"].number(0);
  if (json["status"].text_of({"done", "failed"}) == "failed") {
    state.error = error_from(json["error"]);
    state.limits = limits_from(json["limits"]);
  } else {
    state.files = files_from(json["files"]);
    check_result(json["result"], json["timings"], methods);
    state.result = json["result"].json();
    state.timings = json["timings"].json();
  }
  return state;
}

}  // namespace morsel::tools::batch
