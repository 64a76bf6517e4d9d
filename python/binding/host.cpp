#include "host.hpp"

#include <petscsys.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include <pounding/error.hpp>
#include <pounding/petsc/environment.hpp>

namespace pounding::python {
namespace {

// Ends with end_petsc(), not with the process: MPI must not outlive what it needs.
std::unique_ptr<petsc::Environment> environment;
bool ended = false;

std::set<std::string, std::less<>> names_in_environment() {
  std::set<std::string, std::less<>> names;
  for (char** variable = environ; *variable != nullptr; ++variable)
    names.emplace(std::string_view(*variable).substr(0, std::string_view(*variable).find('=')));
  return names;
}

class KeptEnvironment {
 public:
  ~KeptEnvironment() {
    for (const std::string& name : names_in_environment())
      if (!before_.contains(name)) unsetenv(name.c_str());
  }

 private:
  std::set<std::string, std::less<>> before_ = names_in_environment();
};

class KeptSignals {
 public:
  KeptSignals() {
    for (int i = 1; i < count; ++i) known_[i] = sigaction(i, nullptr, &before_[i]) == 0;
  }
  ~KeptSignals() {
    for (int i = 1; i < count; ++i)
      if (known_[i] && i != SIGKILL && i != SIGSTOP) sigaction(i, &before_[i], nullptr);
  }

 private:
  static constexpr int count = 32;  // those of the kernel, without the real-time ones
  std::array<struct sigaction, count> before_{};
  std::array<bool, count> known_{};
};

}  // namespace

void start_petsc() {
  if (environment) return;
  if (ended) throw SolverError("PETSc has ended in this process; start another one");
  const KeptEnvironment variables;
  const KeptSignals signals;
  environment = std::make_unique<petsc::Environment>();
}

void end_petsc() {
  ended = ended || environment;
  environment.reset();
}

OptionsOfRun::OptionsOfRun(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const std::string& word : words) {
    if (word.starts_with("-pounding_"))
      options.emplace_back(word, "");
    else if (!options.empty() && options.back().second.empty())
      options.back().second = word;
    else
      throw InputError(fmt::format("unknown option \"{}\"; PETSc's options for the run start with -pounding_", word));
  }
  for (const auto& [name, value] : options) {
    petsc::check(PetscOptionsSetValue(nullptr, name.c_str(), value.empty() ? nullptr : value.c_str()));
    names_.push_back(name);
  }
}

OptionsOfRun::~OptionsOfRun() {
  for (const std::string& name : names_) PetscOptionsClearValue(nullptr, name.c_str());
}

}  // namespace pounding::python
