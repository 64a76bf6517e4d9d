// Damage to a results file: each four bytes of the input are a position of three bytes and a new byte. The file of an
// interrupted run is refused, or read correctly.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include <pounding/core/version.hpp>
#include <pounding/results/results.hpp>
#include <pounding/run/restart.hpp>
#include "fuzz.hpp"

namespace {

using namespace pounding;

Results interrupted() {
  Results run;
  run.version = POUNDING_VERSION;
  run.title = "A row";
  run.model_yaml = "title: A row\n";
  run.resolved_yaml = "title: A row\nanalysis: {tolerance: 1e-4}\n";
  run.time = {0, 0.5, 1};
  run.ground_acceleration = {0, 3, -1};
  StructureHistory body;
  body.name = "body";
  body.floors = {"1"};
  body.displacement = body.velocity = body.acceleration = {0, -1, -2};
  run.structures = {body};
  run.energy.time = run.energy.input = run.energy.kinetic = run.energy.strain = run.energy.damping = {0, 0, 0};
  run.energy.hysteretic = run.energy.impact = run.energy.error = {0, 0, 0};
  run.checkpoint =
      Checkpoint{"/models/row.yaml", {"-pounding_ts_rtol 1e-6"}, "", std::vector<std::byte>(500, std::byte{7})};
  return run;
}

const std::string& path() {
  static const std::string name =
      std::filesystem::temp_directory_path() / ("pounding_fuzz_" + std::to_string(getpid()) + ".h5");
  return name;
}

std::string written() {
  write_results(interrupted(), path());
  std::ifstream file(path(), std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  std::atexit([] { std::filesystem::remove(path()); });
  return bytes;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string whole = written();
  std::string bytes = whole;
  for (std::size_t i = 0; i + 4 <= size; i += 4)
    bytes[(data[i] + 256u * data[i + 1] + 65536u * data[i + 2]) % bytes.size()] = static_cast<char>(data[i + 3]);
  std::ofstream(path(), std::ios::binary) << bytes;
  fuzz::refusing([&] {
    const InterruptedRun run = read_interrupted_run(path());
    const Results original = interrupted();
    fuzz::require(bytes == whole, "a damaged file is refused");
    fuzz::require(run.model_yaml == original.model_yaml && run.checkpoint.state == original.checkpoint->state,
                  "a whole file is read as it was written");
  });
  return 0;
}
