#pragma once
/// Agreement among the processes that run one model together.

#include <petscsys.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding::petsc {

/// The processes of a communicator. Functions are collective unless stated otherwise.
class Ranks {
 public:
  /// Not collective.
  explicit Ranks(MPI_Comm comm);

  /// The communicator, its size, and the rank of this process in it. Not collective.
  MPI_Comm comm() const { return comm_; }
  int size() const { return size_; }
  int rank() const { return rank_; }
  bool is_root() const { return rank_ == 0; }

  /// True on all processes if `mine` is true on any.
  bool any(bool mine) const;
  /// The value on the first process.
  int from_root(int its) const;
  /// Runs `task` on the first process. Its exception (InputError, std::exception) is thrown on all.
  void on_root(const std::function<void()>& task) const;
  /// Runs `task`, which must not be collective, on all processes. If it throws, all processes throw the exception of
  /// the first one that failed: InputError and SolverError unchanged, std::invalid_argument as InputError, others as
  /// std::runtime_error. If not all failed, the text names the process: "process 2 of 4 failed alone: ...".
  void on_each(const std::function<void()>& task) const;
  /// True if `mine` is equal on all processes.
  bool same(std::string_view mine) const;
  /// Text of a failure on one process only, this one unless `rank` names another. Not collective.
  std::string alone(std::string_view text, std::optional<int> rank = {}) const;
  /// The bytes of every process, on all of them, in rank order.
  std::vector<std::vector<std::byte>> gather(const std::vector<std::byte>& mine) const;

 private:
  MPI_Comm comm_;
  int size_ = 1, rank_ = 0;
};

/// The run of a model on several processes. A process allows one at a time: collective calls of several threads have no
/// common order, so the processes would deadlock. No effect for a communicator of one process.
class CollectiveRun {
 public:
  /// Not collective. Throws std::logic_error if another one exists in this process.
  explicit CollectiveRun(const Ranks& ranks);
  ~CollectiveRun();
  CollectiveRun(const CollectiveRun&) = delete;
  CollectiveRun& operator=(const CollectiveRun&) = delete;

 private:
  bool collective_;
};

}  // namespace pounding::petsc
