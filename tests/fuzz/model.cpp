// A model file: text to a model, or an InputError. Then everything that `check` and a run compute before the first
// step.

#include <stdexcept>

#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include "fuzz.hpp"

namespace {

// The eigenvalues of a large structure would take most of the time.
constexpr int max_unknowns = 60;

pounding::Eigenmodes modes_of_small(const pounding::SparseMatrix& mass, const pounding::SparseMatrix& stiffness,
                                    int count) {
  if (mass.rows() > max_unknowns) throw std::invalid_argument("too many unknowns for modes in this test");
  return pounding::dense_modes(mass, stiffness, count);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pounding;
  fuzz::refusing([&] {
    const Input input = Input::read_text(std::string(fuzz::text_of(data, size)), "model.yaml");
    const Model model = read_model(input, modes_of_small);
    fuzz::require(!resolved_yaml(model).empty(), "a model that is read can be written");
  });
  return 0;
}
