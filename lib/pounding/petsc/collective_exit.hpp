#pragma once
/// Exit of processes from a collective task, whether it succeeds or fails.

#include <petscsys.h>

#include <exception>
#include <functional>
#include <string>

namespace pounding::petsc {

/// Barrier with a time-out at the end of a collective task. A process that fails alone leaves the others waiting for
/// its messages; without this barrier they would deadlock, at the latest in MPI_Finalize. Its messages use a separate
/// communicator.
class CollectiveExit {
 public:
  /// Collective, before the task.
  explicit CollectiveExit(MPI_Comm comm);
  ~CollectiveExit();
  CollectiveExit(const CollectiveExit&) = delete;
  CollectiveExit& operator=(const CollectiveExit&) = delete;

  /// Time for which a failed process waits for the others to fail as well: at least as long as it takes to read a model
  /// [s].
  static constexpr double patience = 5;
  /// Waits for the other processes. True if all arrived, false after `seconds`.
  bool together(double seconds) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Called on a process that has failed while others wait for it inside the task. They never arrive, so it must not use
/// `comm` again. `text` names the process: "process 2 of 4 failed alone: ...". May end the program or return.
using OnStranded = std::function<void(const std::string& text, const std::exception& error)>;

/// Runs `task`, in which the processes of `comm` communicate, on all of them. Collective.
///
/// If a process fails and all leave the task, every process throws the exception of the first one that failed, as in
/// Ranks::on_each. If this process failed and the others do not arrive within CollectiveExit::patience, `on_stranded`
/// is called; if it returns, SolverError with its text is thrown.
void run_collectively(MPI_Comm comm, const std::function<void()>& task, const OnStranded& on_stranded);

}  // namespace pounding::petsc
