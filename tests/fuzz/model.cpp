// A model file: text to a model, or an InputError. What `check` and a run make of the model before its first step
// follows.

#include <stdexcept>

#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>
#include "fuzz.hpp"

namespace {

// The eigenvalues of a large structure take longer than everything that is sought here.
constexpr int max_unknowns = 60;

pounding::Eigenmodes modes_of_small(const pounding::SparseMatrix& mass, const pounding::SparseMatrix& stiffness,
                                    int count) {
  if (mass.rows() > max_unknowns) throw std::invalid_argument("the modes of so many unknowns are not sought here");
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
