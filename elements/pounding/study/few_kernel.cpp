#include <pounding/study/kernels.hpp>

namespace pounding::study {

Peaks run_few(const LinearModel& model, const EvenRecord& record, const Settings& settings) {
  return run_by_law<8, 0>(model, record, settings);
}

}  // namespace pounding::study
