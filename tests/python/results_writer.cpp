/// Helper of the Python tests: `results_writer KIND FILE` writes one sample run, `results_writer forever FILE` rewrites
/// a growing run until it is killed.

#include <exception>
#include <iostream>
#include <string>

#include "sample_run.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "type: results_writer KIND FILE\n";
    return 2;
  }
  const std::string kind = argv[1], path = argv[2];
  try {
    if (kind != "forever") {
      pounding::write_results(pounding::sample::run(kind), path);
      return 0;
    }
    pounding::Results results = pounding::sample::run("running");
    for (;;) {
      results.status = results.status == "done" ? "running" : "done";
      pounding::write_results(results, path);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
