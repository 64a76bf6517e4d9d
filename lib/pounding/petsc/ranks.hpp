#pragma once
/// Processes that run one model together: what they must agree on.

#include <petscsys.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding::petsc {

/// Every function is called by all processes.
class Ranks {
 public:
  explicit Ranks(MPI_Comm comm);

  /// The communicator, its size, and the place of this process. Not collective.
  MPI_Comm comm() const { return comm_; }
  int size() const { return size_; }
  int rank() const { return rank_; }
  bool is_root() const { return rank_ == 0; }

  /// True on all when it is true on one.
  bool any(bool mine) const;
  /// What the first process says.
  int from_root(int its) const;
  /// Runs `task` on the first process; what it throws (InputError, std::exception) is thrown on all.
  void on_root(const std::function<void()>& task) const;
  /// Runs `task`, which must not call the other processes, on all of them. What the first that fails throws is thrown on all
  /// (InputError and SolverError as they are, std::invalid_argument as InputError, others as std::runtime_error); where not
  /// all have failed, the text says which: "process 2 of 4 failed alone: ...".
  void on_each(const std::function<void()>& task) const;
  /// Whether all have the same text.
  bool same(std::string_view mine) const;
  /// How a failure is told that this process, or one of another rank, has alone.
  std::string alone(std::string_view text, std::optional<int> rank = {}) const;
  /// The bytes of every process, on all of them.
  std::vector<std::vector<std::byte>> gather(const std::vector<std::byte>& mine) const;

 private:
  MPI_Comm comm_;
  int size_ = 1, rank_ = 0;
};

/// Lets processes leave a task together, by messages of its own: one that fails alone, while the others wait for it in the
/// middle of the task, would wait for them forever at the end of MPI.
class CollectiveExit {
 public:
  /// All processes make it, before the task.
  explicit CollectiveExit(MPI_Comm comm);
  ~CollectiveExit();
  CollectiveExit(const CollectiveExit&) = delete;
  CollectiveExit& operator=(const CollectiveExit&) = delete;

  /// One that fails waits this long for the others to fail alike; to read a model takes them no longer [s].
  static constexpr double patience = 5;
  /// Waits for the others; true when all have come, false after so many seconds.
  bool together(double seconds) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

}  // namespace pounding::petsc
