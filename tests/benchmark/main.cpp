// The benchmark: every step beside its baselines, in one process, as one table and one JSON document.

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <string_view>

#include "benchmark/published.h"
#include "benchmark/suites.h"
#include "support/scratch.h"

using namespace morsel::benchmark;

int main(int argc, char** argv) {
  if (argc > 2 && argv[1] == std::string_view(kWatch)) return watch_process(argv + 2);
  CLI::App app("Times every step beside its baselines");
  std::vector<std::string> suites = {"steps",   "memory", "structures", "salient",
                                     "methods", "files",  "scaling",    "adversarial"};
  const std::vector<std::string> known = suites;
  std::string output;
  Plan plan;
  app.add_option("SUITE", suites, "What to run; everything by default")->check(CLI::IsMember(known));
  app.add_option("--threads", plan.threads, "Numbers of threads")->delimiter(',')->capture_default_str();
  app.add_flag("--quick", plan.quick, "Small meshes, to see that everything runs");
  app.add_option("-o,--output", output, "Write the measurements here, as JSON");
  CLI11_PARSE(app, argc, argv);

  const morsel::test::Scratch scratch;
  plan.scratch = scratch.path().string();
  plan.program = MORSEL_PROGRAM;
  try {
    const Machine machine = this_machine(plan.threads);
    const double listing = listing_seconds_on_bunny();
    const double factor = listing / kListingSecondsThere;
    nlohmann::ordered_json json = {
        {"schema", "morsel.benchmark/1"},   {"processor", machine.processor},
        {"processors", machine.processors}, {"instruction_set", machine.instruction_set},
        {"compiler", machine.compiler},     {"listing_on_bunny_seconds", listing},
        {"machine_factor", factor}};
    std::printf("%s, %u processors, %s, %s\n", machine.processor.c_str(), machine.processors,
                machine.instruction_set.c_str(), machine.compiler.c_str());
    for (const auto& [threads, bandwidth] : machine.bandwidth) {
      json["bandwidth"][std::to_string(threads)] = bandwidth;
      std::printf("memory bandwidth with %d thread%s: %.1f GB/s\n", threads, threads == 1 ? "" : "s",
                  1e-9 * bandwidth);
    }
    std::printf("plain listing, 10 iterations on the bunny: %.2f s; TTK's seconds are scaled by %.2f\n",
                listing, factor);
    for (const std::string& suite : suites) {
      std::vector<Row> rows;
      const Report report = [&](Row row) {
        std::cerr << suite << ": " << row.step << ", " << row.mesh << ", " << row.field << ", threads "
                  << row.threads << ": " << row.cost.seconds << " s\n";
        json["suites"][suite].push_back(to_json(row, machine));
        rows.push_back(std::move(row));
      };
      if (suite == "steps") run_steps(plan, factor, report);
      if (suite == "memory") run_memory(plan, report);
      if (suite == "structures") run_structures(plan, report);
      if (suite == "salient") run_salient(plan, report);
      if (suite == "methods") run_methods(plan, report);
      if (suite == "files") run_files(plan, report);
      if (suite == "scaling") run_scaling(plan, report);
      if (suite == "adversarial") run_adversarial(plan, report);
      std::cout << '\n' << suite << '\n' << table(rows, machine) << std::flush;
    }
    if (!output.empty()) std::ofstream(output) << json.dump(1) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "benchmark: " << error.what() << '\n';
    return 1;
  }
}
