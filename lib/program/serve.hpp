#pragma once
/// The program, from its arguments to its exit code.

namespace pounding::program {

/// Executes the command line and returns the exit code. Throws what a command throws.
int serve(int argc, char** argv);
/// Prints a failure in the first process and returns `code`.
int report(const char* text, int code);

}  // namespace pounding::program
