#include <pounding/study/kernel.hpp>

#include <cmath>
#include <stdexcept>

#include <pounding/study/kernels.hpp>

namespace pounding::study {
namespace {

void check(const EvenRecord& record, const Settings& settings) {
  if (record.accelerations.size() < 2) throw std::invalid_argument("a record needs at least two samples");
  for (const double a : record.accelerations)
    if (!std::isfinite(a)) throw std::invalid_argument("a sample of the record is not finite");
  if (!(record.step > 0 && std::isfinite(record.step)))
    throw std::invalid_argument("the step of the record must be finite and positive");
  if (!std::isfinite(record.factor)) throw std::invalid_argument("the factor of the record must be finite");
  if (!(settings.duration >= 0 && std::isfinite(settings.duration)))
    throw std::invalid_argument("duration must be finite and not negative");
  if (!(settings.tolerance >= 1e-13 && settings.tolerance <= 1e-2))
    throw std::invalid_argument("tolerance must be in [1e-13, 1e-2]");
  if (settings.max_steps < 1) throw std::invalid_argument("most_steps must be positive");
}

}  // namespace

Peaks run(const LinearModel& model, const EvenRecord& record, const Settings& settings) {
  model.check();
  check(record, settings);
  if (model.modes() == 2 && model.links.size() == 1) return run_pair(model, record, settings);
  return model.modes() <= 8 ? run_few(model, record, settings) : run_any(model, record, settings);
}

}  // namespace pounding::study
