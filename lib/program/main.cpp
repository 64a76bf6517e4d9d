#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <new>

#include <pounding/core/error.hpp>
#include "exit_code.hpp"
#include "one_thread.hpp"
#include "python_process.hpp"
#include "serve.hpp"

namespace {

using pounding::program::report;

// If the caller has closed standard output, a results file must not get its descriptor: output would be written into
// the file. Opened read-only, so that printing fails.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDONLY);
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  // A reader that closes its pipe, such as head, must not end a run; failed output is reported at the end.
  std::signal(SIGPIPE, SIG_IGN);
  // Above a limit on file sizes (ulimit -f) the write fails, and the message names the file.
  std::signal(SIGXFSZ, SIG_IGN);
  pounding::program::use_one_thread();
  try {
    pounding::program::name_packaged_records();
    return pounding::program::serve(argc, argv);
  } catch (const std::bad_alloc&) {
    return report("out of memory; the results file, if any, contains the last complete state",
                  pounding::program::failed_solve);
  } catch (const std::exception& error) {
    return report(error.what(), pounding::program::exit_code(error));
  }
}
