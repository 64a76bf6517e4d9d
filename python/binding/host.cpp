#include "host.hpp"

#include <petscsys.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <stdexcept>
#include <string_view>

#include <pybind11/pybind11.h>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/launch.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/ranks.hpp>

namespace py = pybind11;

namespace pounding::python {
namespace {

std::shared_timed_mutex petsc_in_use;
thread_local bool petsc_is_mine = false;

bool mpi_runs() {
  int begun = 0, over = 0;
  MPI_Initialized(&begun);
  MPI_Finalized(&over);
  return begun && !over;
}

bool alone = false;

bool has_others() { return !alone && mpi_runs() && petsc::Ranks(MPI_COMM_WORLD).size() > 1; }

// Ends in end_petsc(), not with the process: MPI must end before the libraries that it uses.
struct Session {
  bool owns_mpi = !mpi_runs();
  petsc::Environment environment;
  petsc::CollectiveExit leaving{PETSC_COMM_WORLD};
};
std::unique_ptr<Session> session;
bool ended = false, others_wait = false;

std::set<std::string, std::less<>> names_in_environment() {
  std::set<std::string, std::less<>> names;
  for (char** variable = environ; *variable != nullptr; ++variable)
    names.emplace(std::string_view(*variable).substr(0, std::string_view(*variable).find('=')));
  return names;
}

class SavedEnvironment {
 public:
  ~SavedEnvironment() {
    for (const std::string& name : names_in_environment())
      if (!before_.contains(name)) unsetenv(name.c_str());
  }

 private:
  std::set<std::string, std::less<>> before_ = names_in_environment();
};

class SavedSignals {
 public:
  SavedSignals() {
    for (int i = 1; i < count; ++i) known_[i] = sigaction(i, nullptr, &before_[i]) == 0;
  }
  ~SavedSignals() {
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
  const LibraryLock lock;
  if (others_wait) throw SolverError("an earlier run failed in this process alone, and the others still wait in it");
  if (session) return;
  if (ended) throw SolverError("PETSc has ended in this process; start another one");
  if (!alone) petsc::require_mpi_for_several();
  const SavedEnvironment variables;
  const SavedSignals signals;
  session = std::make_unique<Session>();
}

void end_petsc(bool failed) {
  ended = ended || session;
  if (has_others()) {
    // If the others have failed as well or are done, all processes end together.
    if (others_wait || (failed && !(session && session->leaving.together(petsc::CollectiveExit::patience))))
      MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    // Only the process that started MPI waits here for the others.
    if (!failed && session && session->owns_mpi) session->leaving.together(std::numeric_limits<double>::infinity());
  }
  session.reset();
}

void run_alone() {
  if (alone) return;
  if (session && has_others()) throw std::logic_error("PETSc runs already for all processes together");
  alone = true;
  // The communicator of PETSc can only be set before PETSc starts.
  if (!session && mpi_runs()) PETSC_COMM_WORLD = MPI_COMM_SELF;
}

void leave_the_others() { others_wait = true; }

PetscForThisThread::PetscForThisThread(PetscUse use)
    : alone_(use == PetscUse::alone || petsc::launch().value_or(petsc::Launch{}).size > 1) {
  if (petsc_is_mine)
    throw std::runtime_error(
        "a run reports its progress to this function, and its thread can start no other run: call check, modes and run "
        "when it has ended");
  constexpr std::chrono::milliseconds patience(50);
  while (!(alone_ ? petsc_in_use.try_lock_for(patience) : petsc_in_use.try_lock_shared_for(patience))) {
    const py::gil_scoped_acquire hold;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  petsc_is_mine = true;
}

PetscForThisThread::~PetscForThisThread() {
  petsc_is_mine = false;
  alone_ ? petsc_in_use.unlock() : petsc_in_use.unlock_shared();
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
  const LibraryLock lock;
  for (const auto& [name, value] : options) {
    petsc::check(PetscOptionsSetValue(nullptr, name.c_str(), value.empty() ? nullptr : value.c_str()));
    names_.push_back(name);
  }
}

OptionsOfRun::~OptionsOfRun() {
  const LibraryLock lock;
  for (const std::string& name : names_) PetscOptionsClearValue(nullptr, name.c_str());
}

}  // namespace pounding::python
