#include <pounding/petsc/ranks.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {
namespace {

enum class Kind : char { input, solver, other };

// A failure as a message to other processes: its kind, then its text.
std::vector<std::byte> message(Kind kind, std::string text) {
  text.insert(text.begin(), static_cast<char>(kind));
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  return {bytes, bytes + text.size()};
}

// The failure of a task as a message; empty on success.
std::vector<std::byte> failure_of(const std::function<void()>& task) {
  try {
    task();
    return {};
  } catch (const InputError& error) {
    return message(Kind::input, error.what());
  } catch (const std::invalid_argument& error) {
    return message(Kind::input, error.what());
  } catch (const SolverError& error) {
    return message(Kind::solver, error.what());
  } catch (const std::exception& error) {
    return message(Kind::other, error.what());
  }
}

[[noreturn]] void fail_as(const std::vector<std::byte>& message, const std::string& before = {}) {
  const std::string text = before + std::string(reinterpret_cast<const char*>(message.data()) + 1, message.size() - 1);
  switch (static_cast<Kind>(message.front())) {
    case Kind::input: throw InputError(text);
    case Kind::solver: throw SolverError(text);
    case Kind::other: break;
  }
  throw std::runtime_error(text);
}

std::atomic<bool> runs_collectively = false;

}  // namespace

Ranks::Ranks(MPI_Comm comm) : comm_(comm) {
  const LibraryLock lock;
  MPI_Comm_size(comm, &size_);
  MPI_Comm_rank(comm, &rank_);
}

bool Ranks::any(bool mine) const {
  if (size_ == 1) return mine;
  const LibraryLock lock;
  int value = mine;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, comm_);
  return value != 0;
}

int Ranks::from_root(int its) const {
  if (size_ == 1) return its;
  const LibraryLock lock;
  MPI_Bcast(&its, 1, MPI_INT, 0, comm_);
  return its;
}

void Ranks::on_root(const std::function<void()>& task) const {
  if (size_ == 1) return task();
  const auto failures = gather(is_root() ? failure_of(task) : std::vector<std::byte>{});
  if (!failures.front().empty()) fail_as(failures.front());
}

void Ranks::on_each(const std::function<void()>& task) const {
  if (size_ == 1) return task();
  const auto failures = gather(failure_of(task));
  const auto fine = [](const std::vector<std::byte>& failure) { return failure.empty(); };
  const auto first = std::ranges::find_if_not(failures, fine);
  if (first == failures.end()) return;
  const int rank = static_cast<int>(first - failures.begin());
  fail_as(*first, std::ranges::any_of(failures, fine) ? alone("", rank) : "");
}

std::string Ranks::alone(std::string_view text, std::optional<int> rank) const {
  return fmt::format("process {} of {} failed alone: {}", rank.value_or(rank_) + 1, size_, text);
}

bool Ranks::same(std::string_view mine) const {
  const auto* bytes = reinterpret_cast<const std::byte*>(mine.data());
  const auto texts = gather({bytes, bytes + mine.size()});
  return std::ranges::adjacent_find(texts, std::ranges::not_equal_to()) == texts.end();
}

std::vector<std::vector<std::byte>> Ranks::gather(const std::vector<std::byte>& mine) const {
  if (size_ == 1) return {mine};
  const LibraryLock lock;
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

CollectiveRun::CollectiveRun(const Ranks& ranks) : collective_(ranks.size() > 1) {
  if (collective_ && runs_collectively.exchange(true))
    throw std::logic_error(
        "this process already runs a model together with other processes; runs in several threads need communicators "
        "of one process, such as PETSC_COMM_SELF");
}

CollectiveRun::~CollectiveRun() {
  if (collective_) runs_collectively = false;
}

}  // namespace pounding::petsc
