#include "morsel/tools/batch/state.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

#include "morsel/core/file_writer.h"
#include "morsel/core/parameters.h"
#include "morsel/tools/batch/request.h"
#include "morsel/tools/report/report_reader.h"

namespace morsel::tools::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchema = "morsel.batch-state/1";
constexpr int kOutOfMemory = 5;  // of the program's exit codes
constexpr int kInternalError = 70;

/// Whether a child had no memory left: it says so, or a library ended it because no thread could be made.
bool ran_out_of_memory(const ChildEnd& end) {
  if (end.exit_code == kOutOfMemory) return true;
  constexpr std::array kSaid = {"std::bad_alloc", "Resource temporarily unavailable"};
  return (end.signal == SIGABRT || end.exit_code == kInternalError) &&
         std::any_of(kSaid.begin(), kSaid.end(),
                     [&](const char* text) { return end.message.find(text) != std::string::npos; });
}

MeshError error_from(const Json& json) {
  return {json.at("kind").get<std::string>(),
          json.at("exit_code").is_null() ? -1 : json["exit_code"].get<int>(),
          json.at("signal").is_null() ? 0 : json["signal"].get<int>(), json.at("message").get<std::string>()};
}

ChildLimits limits_from(const Json& json) {
  ChildLimits limits;
  if (!json.at("seconds").is_null()) limits.seconds = json["seconds"].get<double>();
  if (!json.at("memory_mib").is_null()) limits.memory_mib = json["memory_mib"].get<std::uint64_t>();
  return limits;
}

/// A method of a report without what is listed of it.
Json method_result(const Json& method) {
  Json kept;
  for (const char* key :
       {"name", "parameters", "field", "critical_points", "ms_complex", "compared_to_first"})
    kept[key] = method.at(key);
  kept["persistence"] = method.at("persistence");
  kept["persistence"].erase("diagram");
  return kept;
}

}  // namespace

bool MeshError::may_pass() const {
  constexpr std::array kFromOutside = {SIGKILL, SIGTERM, SIGINT, SIGHUP};
  if (kind == "signal")
    return std::find(kFromOutside.begin(), kFromOutside.end(), signal) != kFromOutside.end();
  constexpr std::array kCodes = {4, kOutOfMemory, 127, 130, 143};
  return kind == "exit-code" && std::find(kCodes.begin(), kCodes.end(), exit_code) != kCodes.end();
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

void take_result(const fs::path& report, MeshState& state) {
  const Json head = std::move(read_report(report).document.head);
  try {
    state.result = {{"mesh", head.at("mesh")}, {"field", head.at("field")}, {"methods", Json::array()}};
    for (const Json& method : head.at("methods")) state.result["methods"].push_back(method_result(method));
    state.timings = head.at("timings");
  } catch (const Json::exception& error) {
    throw core::BadInput(report.string() + " is a damaged report: " + error.what());
  }
}

bool is_settled(const MeshState& state, const Json& key, const ChildLimits& limits,
                const std::vector<Product>& products) {
  if (state.key != key) return false;
  if (state.error) return state.limits == limits && !state.error->may_pass();
  return std::all_of(state.files.begin(), state.files.end(), [&](const std::string& file) {
    std::error_code error;  // what cannot be asked about is not there
    return fs::is_regular_file(place_of(file, products), error);
  });
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
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  try {
    const Json json = Json::parse(in);
    if (json.at("schema") != kSchema) return std::nullopt;
    MeshState state;
    state.key = json.at("key");
    state.seconds = json.at("seconds").get<double>();
    if (json.at("status") == "failed") {
      state.error = error_from(json.at("error"));
      state.limits = limits_from(json.at("limits"));
    } else {
      state.files = json.at("files").get<std::vector<std::string>>();
      state.result = json.at("result");
      state.timings = json.at("timings");
    }
    return state;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace morsel::tools::batch
