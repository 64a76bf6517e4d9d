#pragma once
/// Models as Python passes them to the compiled part.

#include <map>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include <pounding/input/read_model.hpp>
#include <pounding/linear/lowest_modes.hpp>

#include "host.hpp"

namespace pounding::python {

/// Text of a model, the name of its file for messages, and the contents of files that it names.
struct Source {
  std::string text, name;
  std::map<std::string, std::string> files = {};
  bool generated = false;  ///< true for the text of a model built by code, which the user does not see

  Input input() const {
    return Input::read_text(text, name, std::make_shared<const std::map<std::string, std::string>>(files), generated);
  }
};

inline Model read(const Input& input) { return read_model(input, petsc::lowest_modes); }
inline Model read(const Source& source) { return read(source.input()); }

/// Runs `task` without holding the interpreter, with PETSc started.
template <class Task>
auto with_petsc(Task&& task, PetscUse use = PetscUse::shared) {
  const pybind11::gil_scoped_release free;
  const PetscForThisThread mine(use);
  start_petsc();
  return task();
}

}  // namespace pounding::python
