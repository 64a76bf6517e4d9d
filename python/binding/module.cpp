#include "bindings.hpp"

#include <exception>
#include <stdexcept>

#include <pounding/core/error.hpp>
#include <pounding/core/version.hpp>

namespace py = pybind11;

namespace {

void raise(const char* name, const std::exception& error) {
  py::set_error(py::module_::import("pounding.errors").attr(name), error.what());
}

// As in the program, a value that a law rejects is wrong input.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const pounding::InputError& error) {
    raise("InputError", error);
  } catch (const pounding::SolverError& error) {
    raise("SolverError", error);
  } catch (const std::invalid_argument& error) {
    raise("InputError", error);
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("version") = POUNDING_VERSION;
  py::register_local_exception_translator(translate);
  pounding::python::bind_hysteresis(module);
  pounding::python::bind_laws(module);
  pounding::python::bind_models(module);
  pounding::python::bind_runs(module);
  pounding::python::bind_spectra(module);
  pounding::python::bind_studies(module);
  pounding::python::bind_study_keys(module);
  pounding::python::bind_study_rows(module);
}
