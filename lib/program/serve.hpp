#pragma once
/// The program from its words to its exit code.

namespace pounding::program {

/// Does what the words of the command line ask for and returns the exit code. Throws what a command throws.
int serve(int argc, char** argv);
/// Tells of a failure, in the first process of several, and returns `code`.
int report(const char* text, int code);

}  // namespace pounding::program
