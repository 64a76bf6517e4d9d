#pragma once
/// Processes that run one model together: what they must agree on.

#include <petscsys.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace pounding::petsc {

/// Every function is called by all processes.
class Team {
 public:
  explicit Team(MPI_Comm comm);

  /// The communicator, its size, and the place of this process. Not collective.
  MPI_Comm comm() const { return comm_; }
  int size() const { return size_; }
  int rank() const { return rank_; }
  bool is_first() const { return rank_ == 0; }

  /// True on all when it is true on one.
  bool any(bool mine) const;
  /// What the first process says.
  int first_says(int its) const;
  /// Runs `task` on the first process; what it throws (InputError, std::exception) is thrown on all.
  void first_does(const std::function<void()>& task) const;
  /// The bytes of every process, on all of them.
  std::vector<std::vector<std::byte>> gather(const std::vector<std::byte>& mine) const;

 private:
  MPI_Comm comm_;
  int size_ = 1, rank_ = 0;
};

/// Lets processes leave a task together, by messages of its own: one that fails alone, while the others wait for it in the
/// middle of the task, would wait for them forever at the end of MPI.
class Leaving {
 public:
  /// All processes make it, before the task.
  explicit Leaving(MPI_Comm comm);
  ~Leaving();
  Leaving(const Leaving&) = delete;
  Leaving& operator=(const Leaving&) = delete;

  /// Waits for the others; true when all have come, false after so many seconds.
  bool together(double seconds) const;

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

}  // namespace pounding::petsc
