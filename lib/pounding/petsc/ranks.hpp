#pragma once
/// Agreement between the processes that run one model together.

#include <petscsys.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding::petsc {

/// The processes of a communicator. Functions are collective unless they say otherwise.
class Ranks {
 public:
  /// Not collective.
  explicit Ranks(MPI_Comm comm);

  /// The communicator, its size, and the rank of this process in it. Not collective.
  MPI_Comm comm() const { return comm_; }
  int size() const { return size_; }
  int rank() const { return rank_; }
  bool is_root() const { return rank_ == 0; }

  /// True on all processes when `mine` is true on one of them.
  bool any(bool mine) const;
  /// The value of the first process.
  int from_root(int its) const;
  /// Runs `task` on the first process. What it throws (InputError, std::exception) is thrown on all.
  void on_root(const std::function<void()>& task) const;
  /// Runs `task`, which must not be collective, on all processes. Where it throws, all processes throw what the first
  /// of those that failed has thrown: InputError and SolverError as they are, std::invalid_argument as InputError,
  /// others as std::runtime_error. When not all have failed the text names it: "process 2 of 4 failed alone: ...".
  void on_each(const std::function<void()>& task) const;
  /// Whether `mine` is the same on all processes.
  bool same(std::string_view mine) const;
  /// Text of a failure that one process has alone, this one unless `rank` names another. Not collective.
  std::string alone(std::string_view text, std::optional<int> rank = {}) const;
  /// The bytes of every process, on all of them, in the order of the ranks.
  std::vector<std::vector<std::byte>> gather(const std::vector<std::byte>& mine) const;

 private:
  MPI_Comm comm_;
  int size_ = 1, rank_ = 0;
};

}  // namespace pounding::petsc
