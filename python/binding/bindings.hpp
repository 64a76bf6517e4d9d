#pragma once
/// Compiled part of the Python package, `pounding._core`. It is thin: the package's own modules (python/pounding) check
/// arguments and explain errors.

#include <pybind11/pybind11.h>

#include <pounding/laws/table.hpp>

namespace pounding {
class Input;
}

namespace pounding::python {

/// Whether a parameter of a law is required, as text.
const char* need_word(laws::Need need);
/// Kind of a parameter of a law, as text: number, list or flag.
const char* kind_word(const laws::ParameterInfo& parameter);

/// Typical value of a parameter of a law [SI]: a number, a list, or True or False.
pybind11::object typical_value(const laws::ParameterInfo& parameter);

/// Nested dicts, lists and texts of an input.
pybind11::object plain(const Input& input);

void bind_hysteresis(pybind11::module_& module);
void bind_laws(pybind11::module_& module);
void bind_models(pybind11::module_& module);
void bind_runs(pybind11::module_& module);
void bind_spectra(pybind11::module_& module);
void bind_studies(pybind11::module_& module);
void bind_study_keys(pybind11::module_& module);
void bind_study_rows(pybind11::module_& module);

}  // namespace pounding::python
