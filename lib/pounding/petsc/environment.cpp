#include <pounding/petsc/environment.hpp>

#include <signal.h>
#include <slepcsys.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <pounding/core/text.hpp>
#include <pounding/petsc/launch.hpp>
#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {
namespace {

// PETSc calls its error handler once per function while it unwinds; this keeps the first message.
thread_local std::string failure;
// Exception thrown by a callback.
thread_local std::exception_ptr thrown;

PetscErrorCode keep_message(MPI_Comm, int line, const char* function, const char* file, PetscErrorCode code,
                            PetscErrorType type, const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL) {
    failure = message ? message : "no message";
    failure += std::string(" (PETSc, ") + (function ? function : "?") + ", " + (file ? file : "?") + ":" +
               std::to_string(line) + ")";
  }
  return code;
}

// Keeps variables that the user has set.
void prepare_mpi() {
  constexpr int keep_existing = 0;
  // hwloc, with which MPI discovers processors, would print messages in containers without /sys.
  setenv("HWLOC_HIDE_ERRORS", "2", keep_existing);
  // Open MPI looks for networks and a launcher daemon on startup, which takes 0.2 s. A process without a launcher needs
  // neither. It needs no session directory: concurrent processes would share one, and occasionally one of them would
  // find it deleted.
  if (launch()) return;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", keep_existing);
  setenv("OMPI_MCA_pml", "ob1", keep_existing);
  setenv("OMPI_MCA_btl", "self", keep_existing);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", keep_existing);
}

// By default PETSc reads ~/.petscrc, and .petscrc and petscrc in the working directory. The directory of a model could
// then load libraries, write files and change the tolerance. Options come from the command line and the environment
// only.
constexpr const char* no_options_files = "-skip_petscrc";
constexpr const char* no_list_of_unread = "-options_left";

// Newer versions list unused options when they end; a run reports its own before it starts.
void leave_unread_options_out() {
  PetscBool requested = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, no_list_of_unread, &requested));
  if (!requested) check(PetscOptionsSetValue(nullptr, no_list_of_unread, "0"));
}

}  // namespace

Environment::Environment(const std::vector<std::string>& options) {
  const LibraryLock lock;
  PetscBool ready = PETSC_FALSE;
  PetscInitialized(&ready);
  if (!ready) {
    struct sigaction of_pipes = {};
    sigaction(SIGPIPE, nullptr, &of_pipes);
    prepare_mpi();
    std::vector<std::string> words{"pounding", no_options_files};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    int count = static_cast<int>(words.size());
    char** arguments = pointers.data();
    // Runs may use MPI from several threads, one at a time.
    if (PETSC_MPI_THREAD_REQUIRED == PETSC_DECIDE) PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_SERIALIZED;
    check(PetscInitialize(&count, &arguments, nullptr, nullptr));
    owns_petsc_ = true;
    // PETSc has copied the options into its table. The program keeps its own signal handlers.
    PetscPopSignalHandler();
    sigaction(SIGPIPE, &of_pipes, nullptr);  // PETSc has made SIGPIPE end the process
  }
  check(PetscPushErrorHandler(keep_message, nullptr));
  if (owns_petsc_) leave_unread_options_out();
  check(SlepcInitialized(&ready));
  if (!ready) {
    check(SlepcInitialize(nullptr, nullptr, nullptr, nullptr));
    owns_slepc_ = true;
  }
}

Environment::~Environment() {
  const LibraryLock lock;
  // The handler stays installed until the end: the program, not PETSc, reports failures there, such as a full standard
  // output.
  if (owns_slepc_) SlepcFinalize();
  if (owns_petsc_)
    PetscFinalize();
  else
    PetscPopErrorHandler();
}

std::vector<std::string> Environment::unread_options() {
  const LibraryLock lock;
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::vector<std::string> unread;
  for (PetscInt i = 0; i < count; ++i)
    if (std::strncmp(names[i], "pounding_", 9) == 0) unread.push_back(std::string("-") + names[i]);
  check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  return unread;
}

std::vector<std::string> Environment::all_options() {
  const LibraryLock lock;
  char* text = nullptr;
  check(PetscOptionsGetAll(nullptr, &text));
  const std::string all = text;
  check(PetscFree(text));
  std::vector<std::string> options;
  for (const std::string_view word : parts_between(all, " \t\r\n")) {
    if (is_option_name(word))
      options.emplace_back(word);
    else if (!options.empty())
      options.back().append(1, ' ').append(word);
  }
  std::erase_if(options, [](const std::string& option) {
    return option == no_options_files || option == std::string(no_list_of_unread) + " 0";
  });
  std::sort(options.begin(), options.end());
  return options;
}

std::vector<std::string> Environment::given_options() {
  std::vector<std::string> given = all_options();
  std::erase_if(given, [](const std::string& option) {
    return !option.starts_with("-pounding_") || option.substr(0, option.find(' ')) == "-pounding_red_cache";
  });
  return given;
}

bool is_option_name(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

void check(PetscErrorCode code) {
  if (code == 0) return;
  if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
  throw SolverError(failure.empty() ? "PETSc error " + std::to_string(static_cast<int>(code))
                                    : std::exchange(failure, {}));
}

PetscErrorCode fail(std::exception_ptr error) {
  thrown = std::move(error);
  return static_cast<PetscErrorCode>(PETSC_ERR_CONV_FAILED);
}

}  // namespace pounding::petsc
