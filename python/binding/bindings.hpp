#pragma once
/// The compiled part of the Python package, `pounding._core`: thin, for the package's own modules, which check and explain
/// (python/pounding/*.py).

#include <pybind11/pybind11.h>

namespace pounding::python {

void bind_laws(pybind11::module_& module);
void bind_models(pybind11::module_& module);

}  // namespace pounding::python
