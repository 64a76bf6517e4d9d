#pragma once
/// How processes leave a task that they do together, whether it succeeds or not.

#include <petscsys.h>

#include <exception>
#include <functional>
#include <string>

namespace pounding::petsc {

/// Barrier with a time-out at the end of a collective task. A process that fails alone leaves the others waiting for
/// its messages in the middle of the task; without this they would all deadlock, at the latest at the end of MPI. Its
/// own messages do not mix with those of the task.
class CollectiveExit {
 public:
  /// Collective, before the task.
  explicit CollectiveExit(MPI_Comm comm);
  ~CollectiveExit();
  CollectiveExit(const CollectiveExit&) = delete;
  CollectiveExit& operator=(const CollectiveExit&) = delete;

  /// How long a process that fails waits for the others to fail alike, at least as long as they take to read a model
  /// [s].
  static constexpr double patience = 5;
  /// Waits for the other processes; true when all have come, false after so many seconds.
  bool together(double seconds) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Called on a process that has failed while others wait for it in the middle of the task. They never come, so it must
/// not use `comm` again. `text` names the process: "process 2 of 4 failed alone: ...". May end the program or return.
using OnStranded = std::function<void(const std::string& text, const std::exception& error)>;

/// Runs `task`, in which the processes of `comm` call each other, on all of them. Collective.
///
/// A failure becomes that of all processes when all leave the task: they throw what the first one that failed has
/// thrown, as by Ranks::on_each. When this process has failed and the others do not come within
/// CollectiveExit::patience, `on_stranded` is called, and SolverError with its text is thrown if that returns.
void run_collectively(MPI_Comm comm, const std::function<void()>& task, const OnStranded& on_stranded);

}  // namespace pounding::petsc
