#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include <pounding/core/error.hpp>
#include "exit_code.hpp"
#include "one_thread.hpp"
#include "python_process.hpp"
#include "serve.hpp"

namespace {

using pounding::program::report;

std::terminate_handler usual_end = nullptr;

// Where memory ends in what must not throw, such as the destructor of a tree of JSON, or before main() has begun.
void end_without_memory() {
  constexpr std::string_view text = "pounding: out of memory; a results file keeps what was written before\n";
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
    _exit(pounding::program::failed_solve);
  } catch (...) {
  }
  usual_end();
}

[[gnu::constructor(101)]] void watch_over_memory() { usual_end = std::set_terminate(end_without_memory); }

// A results file must never become standard output, where the caller has closed that: what is printed would be in the
// middle of it. Reading ends serve, since what is printed has to fail.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDONLY);
}

// HDF5 1.10 ends a process by exit(-1) when a table of its own gets no memory; nothing else here does.
void tell_of_hdf5(int status, void*) {
  if (status != -1) return;
  report("there is no memory left for HDF5; a results file keeps what was written before",
         pounding::program::failed_solve);
  std::fflush(nullptr);
  _exit(pounding::program::failed_solve);
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  // A reader that closes its pipe, such as head, must not end a run: failed output is reported at the end.
  std::signal(SIGPIPE, SIG_IGN);
  pounding::program::use_one_thread();
  on_exit(tell_of_hdf5, nullptr);
  try {
    pounding::program::name_packaged_records();
    return pounding::program::serve(argc, argv);
  } catch (const pounding::OutOfMemory& error) {
    return report(error.what(), pounding::program::failed_solve);
  } catch (const std::bad_alloc&) {
    return report("out of memory before the work began", pounding::program::failed_solve);
  } catch (const std::exception& error) {
    return report(error.what(), pounding::program::exit_code(error));
  }
}
