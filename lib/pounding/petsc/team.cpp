#include <pounding/petsc/team.hpp>

#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>

#include <pounding/error.hpp>

namespace pounding::petsc {

Team::Team(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_size(comm, &size_);
  MPI_Comm_rank(comm, &rank_);
}

bool Team::any(bool mine) const {
  if (size_ == 1) return mine;
  int value = mine;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, comm_);
  return value != 0;
}

int Team::first_says(int its) const {
  if (size_ > 1) MPI_Bcast(&its, 1, MPI_INT, 0, comm_);
  return its;
}

void Team::first_does(const std::function<void()>& task) const {
  if (size_ == 1) return task();
  enum Failure : int { none, input, other };
  int failure = none;
  std::string text;
  if (is_first()) {
    try {
      task();
    } catch (const InputError& error) {
      failure = input;
      text = error.what();
    } catch (const std::exception& error) {
      failure = other;
      text = error.what();
    }
  }
  MPI_Bcast(&failure, 1, MPI_INT, 0, comm_);
  if (failure == none) return;
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, comm_);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm_);
  if (failure == input) throw InputError(text);
  throw std::runtime_error(text);
}

std::vector<std::vector<std::byte>> Team::gather(const std::vector<std::byte>& mine) const {
  if (size_ == 1) return {mine};
  std::vector<int> counts(size_), first(size_);
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  int sum = 0;
  for (int r = 0; r < size_; ++r) {
    first[r] = sum;
    sum += counts[r];
  }
  std::vector<std::byte> all(sum);
  MPI_Allgatherv(mine.data(), count, MPI_BYTE, all.data(), counts.data(), first.data(), MPI_BYTE, comm_);
  std::vector<std::vector<std::byte>> parts;
  for (int r = 0; r < size_; ++r) parts.emplace_back(all.begin() + first[r], all.begin() + first[r] + counts[r]);
  return parts;
}

Leaving::Leaving(MPI_Comm comm) {
  if (Team(comm).size() > 1) MPI_Comm_dup(comm, &comm_);
}

Leaving::~Leaving() {
  if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

bool Leaving::together(double seconds) const {
  if (comm_ == MPI_COMM_NULL) return true;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(comm_, &all);
  for (;;) {
    int come = 0;
    MPI_Test(&all, &come, MPI_STATUS_IGNORE);
    if (come) return true;
    if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace pounding::petsc
