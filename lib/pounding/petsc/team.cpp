#include <pounding/petsc/team.hpp>

#include <exception>
#include <stdexcept>
#include <string>

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

bool Team::first_says(bool its) const {
  if (size_ == 1) return its;
  int value = its;
  MPI_Bcast(&value, 1, MPI_INT, 0, comm_);
  return value != 0;
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

}  // namespace pounding::petsc
