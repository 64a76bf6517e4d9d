#include <pounding/study/kernels.hpp>

namespace pounding::study {

Peaks run_pair(const LinearModel& model, const EvenRecord& record, const Settings& settings) {
  return run_by_law<2, 1>(model, record, settings);
}

}  // namespace pounding::study
