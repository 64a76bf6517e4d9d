#include <pounding/petsc/collective_exit.hpp>

#include <chrono>
#include <limits>
#include <thread>

#include <pounding/core/error.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/petsc/version.hpp>

namespace pounding::petsc {

CollectiveExit::CollectiveExit(MPI_Comm comm) {
  const LibraryLock lock;
  if (Ranks(comm).size() > 1) MPI_Comm_dup(comm, &comm_);
}

CollectiveExit::~CollectiveExit() {
  if (comm_ == MPI_COMM_NULL) return;
  const LibraryLock lock;
  MPI_Comm_free(&comm_);
}

bool CollectiveExit::together(double seconds) const {
  if (comm_ == MPI_COMM_NULL) return true;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  MPI_Request all = MPI_REQUEST_NULL;
  const LibraryLock lock;
  begin_barrier(comm_, &all);
  for (;;) {
    if (is_complete(&all)) return true;
    const LibraryLock::Released released;
    if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void run_collectively(MPI_Comm comm, const std::function<void()>& task, const OnStranded& on_stranded) {
  const Ranks ranks(comm);
  const CollectiveExit exit(comm);
  std::exception_ptr failure;
  try {
    task();
  } catch (const std::exception& error) {
    if (!exit.together(CollectiveExit::patience)) {
      const std::string text = ranks.alone(error.what());
      on_stranded(text, error);
      throw SolverError(text);
    }
    failure = std::current_exception();
  }
  if (!failure) exit.together(std::numeric_limits<double>::infinity());
  ranks.on_each([&] {
    if (failure) std::rethrow_exception(failure);
  });
}

}  // namespace pounding::petsc
